"""What was baked onto a mesh."""

from __future__ import annotations

import os
from typing import Any, Dict, Union

from . import _core
from ._arrays import result
from ._layers import Layers, layer


class Bake(Layers):
    """Estimates at the vertices of a mesh, or at the corners of its triangles.

    bake["ao"] has a float32 for each vertex, shape (n,), or for each corner, shape (m, 3); bake["bent"] three
    more, the direction. An effect is named as in the scene, or by its type. `properties` are those of the PLY
    file, and can be asked for by name as well: "bent_cone" is the half-angle in degrees, "bent_ao" the ambient
    occlusion. numpy.asarray(bake) is the first effect.

    vertices: (n, 3) float64, world units. faces: (m, 3) uint32, each triangle from the corner that it was given
    from; those of files may begin at another. normals: what was estimated about, float32,
    a row each: of vertices the mean of their corners' normals, weighted by angle; of corners their own, or
    their triangle's. Where a vertex has no triangle, or a triangle no area, normals are 0 and so are estimates.
    """

    def __init__(self, made: Dict[str, Any], corners: bool, given: Any = None) -> None:
        self._bake = made["bake"]
        self.corners = corners
        self.vertices: Any = result(made["vertices"], "float64", (-1, 3))
        self.faces: Any = result(made["faces"], "uint32", (-1, 3))
        shape = (-1, 3) if corners else (-1,)
        self.normals: Any = result(made["normals"], "float32", (*shape, 3))
        self.properties: Dict[str, Any] = {
            name: result(data, "float32", shape) for name, data in made["properties"]
        }
        self._layers = dict(made["layers"])
        if given is not None:
            self._turn(given)

    def _turn(self, given: Any) -> None:
        """nook begins a triangle where it suits the tracer; arrays come back as they were given."""
        import numpy as np

        faces, normals = self.faces.copy(), self.normals.copy()
        ours = faces[: len(given)]
        turn = (np.argmax(ours == given[:, :1], axis=1)[:, None] + np.arange(3)) % 3
        faces[: len(given)] = np.take_along_axis(ours, turn, 1)
        self.faces = faces
        if not self.corners:
            return
        normals[: len(given)] = np.take_along_axis(normals[: len(given)], turn[:, :, None], 1)
        self.normals = normals
        for name, values in self.properties.items():
            turned = values.copy()
            turned[: len(given)] = np.take_along_axis(values[: len(given)], turn, 1)
            self.properties[name] = turned

    def __getitem__(self, name: str) -> Any:
        return layer(name, self._layers, self.properties, "_", "bake")

    def save(self, file: Union[str, "os.PathLike[str]"]) -> None:
        """Writes a PLY file, as `nook bake` does: the vertices (or every corner as a vertex of its own) with
        normals and properties, and the triangles. Raises OutputError."""
        if os.path.splitext(os.fspath(file))[1].lower() not in ("", ".ply"):
            from ._errors import UsageError

            raise UsageError(f"{os.fspath(file)}: not a format that is written here (.ply)")
        _core.save_bake(self._bake, file)

    def __repr__(self) -> str:
        what = f"{len(self.faces)} x 3 corners" if self.corners else f"{len(self.vertices)} vertices"
        return f"<nook.Bake of {what}: {', '.join(self._layers)}>"
