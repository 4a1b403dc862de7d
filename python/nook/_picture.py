"""A finished picture."""

from __future__ import annotations

import os
from typing import Any, Dict, Tuple, Union

from . import _core
from ._arrays import result
from ._layers import Layers, layer


class Picture(Layers):
    """The layers of a rendered scene: picture["ao"] is an array of shape (height, width), float32, row 0 at the
    top; picture["bent"], picture["normal"] and picture["position"] have shape (height, width, 3).

    A layer is named as its effect is, or by its type; `channels` are those of the EXR file ("R", "N.X",
    "AO.variance"), and can be asked for by name as well, three that end in .X, .Y and .Z by what they begin
    with ("N"). numpy.asarray(picture) is the first layer. `complete` is False where an error or time target was missed.
    """

    def __init__(self, made: Dict[str, Any]) -> None:
        self._picture = made["picture"]
        self.width: int = made["width"]
        self.height: int = made["height"]
        self.complete: bool = made["complete"]
        shape = (self.height, self.width)
        self.channels: Dict[str, Any] = {
            name: result(data, dtype, shape) for name, dtype, data in made["channels"]
        }
        self._layers = dict(made["layers"])

    @property
    def layers(self) -> Tuple[str, ...]:
        """The names of what the scene asked for, in its order."""
        return tuple(self._layers)

    def __getitem__(self, name: str) -> Any:
        return layer(name, self._layers, self.channels, ".", "picture")

    def save(self, file: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the picture: an .exr file with every channel, or a .png of R, G, B, clamped to 0 to 1 and sRGB
        encoded, over the scene's background or with alpha. It appears under its name when it is complete. Raises
        OutputError, and UsageError for other extensions."""
        _core.save(self._picture, file)

    def __repr__(self) -> str:
        return f"<nook.Picture {self.width}x{self.height}: {', '.join(self._layers)}>"

    def _repr_png_(self) -> bytes:
        import tempfile

        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "picture.png")
            _core.save(self._picture, file)
            with open(file, "rb") as png:
                return png.read()
