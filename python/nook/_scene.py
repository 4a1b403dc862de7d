"""Scenes: what is estimated, of what."""

from __future__ import annotations

import json
import os
from typing import Any, Dict, NamedTuple, Optional, Sequence, Tuple, Union

from . import _core
from ._arrays import indices, numbers, result, same_rows, unit_points
from ._bake import Bake
from ._errors import UsageError
from ._picture import Picture
from ._progress import Progress, told
from ._rounds import to_error, wanted
from ._settings import lines


class Estimates(NamedTuple):
    """Estimates at n points: arrays of n float32, n float32 and n uint32."""

    value: Any
    """The estimate."""
    standard_error: Any
    """Its standard error, widened so that value +- 1.96 of it holds the true value in 95 of 100 cases."""
    samples: Any
    """The directions behind it."""


class BentEstimates(NamedTuple):
    """Bent normals at n points."""

    direction: Any
    """(n, 3) float32: the mean unoccluded direction, unit length; 0 where no direction is open."""
    half_angle: Any
    """n float32: of the cone about it, degrees."""
    value: Any
    """n float32: ambient occlusion."""
    standard_error: Any
    """n float32: of value."""
    samples: Any
    """n uint32: the directions behind it."""


class Scene:
    """What is estimated, of what: a scene file, a mesh file, or arrays.

    Scene("room.toml"), Scene("model.obj")
    Scene(vertices=V, faces=F[, normals=N])

    vertices: (n, 3) numbers, world units. faces: (m, 3) integers, the vertices of each triangle,
    counter-clockwise seen from the front. normals: (n, 3), of any length; without them surfaces are flat.
    float64 coordinates far from 0 keep their digits: they are recentred before they are rounded to float32.

    device: as `nook devices` names it ("cpu", "gpu", "0:0", a part of a name); by default NOOK_DEVICE, or
    any. progress: see render(). Every key of a scene file is a keyword too, with its name and default there,
    and ground=True or ground={"height": 0}. effects=[{"type": "ao", "name": "contact"}, ...] asks for several.

    The mesh is read at once; OpenCL is loaded by the first estimate. A scene can be pickled: its description
    is sent, and it is made again. One thread at a time works with a scene, others wait; two scenes work in
    two threads. Ctrl-C ends an estimate and leaves the scene usable.

    Raises SceneError with file, row and column, UsageError (a ValueError) for arguments, DeviceError.
    """

    def __init__(
        self,
        file: Union[str, "os.PathLike[str]", None] = None,
        *,
        vertices: Any = None,
        faces: Any = None,
        normals: Any = None,
        device: Optional[str] = None,
        **settings: Any,
    ) -> None:
        self._workspace: Any = None
        if (file is None) == (vertices is None):
            raise UsageError("a scene is made of a file, or of vertices and faces")
        if file is not None and (faces is not None or normals is not None):
            raise UsageError("faces and normals go with vertices")
        if file is None:
            vertices = numbers("vertices", vertices, ("float64", "float32"))
            if faces is None:
                raise UsageError("faces: are missing")
            faces = indices("faces", faces, vertices.shape[0])
            if normals is not None:
                normals = numbers("normals", normals, ("float32",))
                same_rows("normals", normals, "vertices", vertices.shape[0])
        self._description: Dict[str, Any] = dict(
            file=file, vertices=vertices, faces=faces, normals=normals, device=device, **settings
        )
        if device is None:
            device = os.environ.get("NOOK_DEVICE", "")
        self._workspace = _core.open(file, vertices, faces, normals, lines(settings), device)

    def ao(
        self, points: Any, normals: Any, *, samples: Optional[int] = None, progress: Progress = None, **settings: Any
    ) -> Estimates:
        """Ambient occlusion at points: 1 where everything is open, 0 where nothing is.

        A(p, N) = 1/pi int V(p, w) N.w dw over the hemisphere of unit directions w with N.w > 0: V is 1 if a
        ray from p along w hits nothing within max_distance, else 0; dw is solid angle, so the weight N.w / pi
        integrates to 1. With falloff, weight, cone_angle and side the integral is another; docs/effects.md has
        them all, docs/estimators.md the estimators and their variances.

        points: (n, 3), world units, on a surface or anywhere. normals: (n, 3), of any length but 0. samples:
        directions at each point, 1 to 2^30 (1024). error: instead of samples, the standard error that each point
        is to have, 1e-4 to 1: 256 directions everywhere, then four times as many where that was not enough, and so
        on to 2^18; a SceneWarning counts the points that need more.

        Returns Estimates: value, standard_error and samples, n each. Standard errors are from 8 to 16
        randomisations of the point sequence (Owen 1997, "Monte Carlo variance of scrambled net quadrature").
        The same seed gives the same bits as `nook probe --samples`; a point's random numbers follow from its
        row.

        sampler: a name, or an array of points of [0,1)^2, shape (m, 2): one's own point set. Each point takes
        all of it, shifted by a random vector of its own, modulo 1 (Cranley and Patterson 1976); samples, m by
        default, may be a multiple of m: then the set is taken so often, shifted anew each time, and the spread
        of these means is the standard error, which is nan for a set that is taken once. shift=False takes the
        set as it is at every point: it has m samples, and nothing of it is random. Points become directions by
        Shirley and Chiu's map of the square to the disk (1997) and onto the hemisphere, by the density of
        `sampling`: docs/estimators.md.

        progress: True shows a bar in terminals and notebooks; a function is called meanwhile, as
        progress(samples, total, rays, error, share_done). Raises UsageError (a
        ValueError) that names the argument and the first bad row, SceneError, DeviceError.
        """
        made, n = self._estimate("ao", points, normals, None, samples, progress, settings)
        return Estimates(*_common(made, n))

    def ro(
        self,
        points: Any,
        normals: Any,
        views: Any,
        *,
        samples: Optional[int] = None,
        progress: Progress = None,
        **settings: Any,
    ) -> Estimates:
        """Reflection occlusion at points: how much of a Phong lobe about the mirrored view is open.

        R(p, N, v) = (k+1)/(2 pi) int V(p, w) max(0, r.w)^k dw over the directions w with N.w > 0, dw solid
        angle; r is v mirrored about N, k the exponent (0 to 1e7, default 30); V as for ao(), by default
        without a distance limit. See docs/effects.md and docs/estimators.md.

        views: (n, 3), from each point towards the viewer, of any length but 0. All else as in ao().
        """
        if views is None:
            raise UsageError("views: RO needs the directions to the viewer")
        made, n = self._estimate("ro", points, normals, views, samples, progress, settings)
        return Estimates(*_common(made, n))

    def bent(
        self, points: Any, normals: Any, *, samples: Optional[int] = None, progress: Progress = None, **settings: Any
    ) -> BentEstimates:
        """Bent normals at points: the mean unoccluded direction, and a cone about it.

        B(p, N) = int V(p, w) w N.w dw / int V(p, w) N.w dw, dw solid angle, V as for ao(); the direction is
        B / |B|. The cone about a normal whose open directions have a mean as long as B has the half-angle. See
        docs/effects.md.

        Returns BentEstimates. All else as in ao().
        """
        made, n = self._estimate("bent", points, normals, None, samples, progress, settings)
        value, standard_error, count = _common(made, n)
        direction = result(made["direction"], "float32", (n, 3))
        return BentEstimates(direction, result(made["half_angle"], "float32"), value, standard_error, count)

    def render(
        self, *, aovs: Sequence[str] = (), progress: Progress = None, **settings: Any
    ) -> Picture:
        """The scene's picture: every effect that it asks for, as `nook render` makes it, to the same bits.

        Keywords are keys of the scene: spp=16, error=.01, time=10, width=640, type="ro". aovs: more channels:
        normal, position, depth, variance, samples, alpha.

        Where an error or time target is missed, picture.complete is False. Raises as ao().
        """
        with told(progress, "render") as call:
            return Picture(_core.render(self._open(), lines(settings), _names("aovs", aovs), call))

    def bake(
        self,
        to: str = "vertices",
        *,
        size: Optional[int] = None,
        dilation: Optional[int] = None,
        aovs: Sequence[str] = (),
        progress: Progress = None,
        **settings: Any,
    ) -> Union[Bake, Picture]:
        """Estimates of the scene's ao and bent effects on the mesh itself, as `nook bake` makes them, to the
        same bits; spp x directions directions each.

        to: "vertices" or "corners" (of the triangles, each with its own normal, so that hard edges stay hard):
        a Bake; "texture": a Picture of the square texture that the mesh's texture coordinates cover, with the
        layer "A", 1 where the mesh is. size: texels on a side (1024). dilation: rings of texels around charts
        that repeat their nearest (8). aovs: more channels: normal, position, variance, samples.

        Other keywords are keys of the scene. Raises SceneError (no texture coordinates, an effect that needs a
        viewer), and as ao().
        """
        if to not in ("vertices", "corners", "texture"):
            raise UsageError(f"to: vertices, corners or texture, not {to!r}")
        workspace = self._open()
        if to == "texture":
            size = _whole("size", 1024 if size is None else size, 1, 16384)
            dilation = _whole("dilation", 8 if dilation is None else dilation, 0, 1024)
            with told(progress, "bake") as call:
                names = _names("aovs", aovs)
                return Picture(_core.bake_texture(workspace, size, dilation, names, lines(settings), call))
        if size is not None or dilation is not None or aovs:
            raise UsageError("size, dilation, aovs: are of textures")
        with told(progress, "bake") as call:
            made = _core.bake(workspace, to, lines(settings), call)
        return Bake(made, to == "corners", self._description["faces"])

    @property
    def plan(self) -> Dict[str, Any]:
        """What a render of the scene will do, what it leaves out and why, as `nook plan --json` says it."""
        return json.loads(_core.plan(self._open()))  # type: ignore[no-any-return]

    @property
    def info(self) -> Dict[str, Any]:
        """What is in the mesh, and what the scene's numbers resolve to, as `nook info --json` says it."""
        return json.loads(_core.info(self._open()))  # type: ignore[no-any-return]

    def to_toml(self) -> str:
        """The scene as a scene file, every key that its effects read with its value."""
        return _core.toml(self._open())

    def close(self) -> None:
        """Lets go of mesh and device at once; nothing else can be asked of the scene."""
        self._workspace = None

    def __enter__(self) -> "Scene":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __reduce__(self) -> Tuple[Any, Tuple[Dict[str, Any]]]:
        return _made_again, (self._description,)

    def __repr__(self) -> str:
        return f"<nook.Scene {self._name()}>"

    def _name(self) -> str:
        file = self._description["file"]
        return str(os.fspath(file)) if file is not None else "of arrays"

    def _open(self) -> Any:
        if self._workspace is None:
            raise UsageError("the scene is closed")
        return self._workspace

    def _estimate(
        self,
        kind: str,
        points: Any,
        normals: Any,
        views: Any,
        samples: Optional[int],
        progress: Progress,
        settings: Dict[str, Any],
    ) -> Tuple[Dict[str, Any], int]:
        workspace = self._open()
        points = numbers("points", points)
        normals = numbers("normals", normals)
        same_rows("normals", normals, "points", points.shape[0])
        if views is not None:
            views = numbers("views", views)
            same_rows("views", views, "points", points.shape[0])
        point_set = None
        sampler = settings.get("sampler")
        shift = settings.pop("shift", True)
        if sampler is not None and not isinstance(sampler, str):
            point_set = unit_points("sampler", sampler)
            del settings["sampler"]
        error = settings.pop("error", None)
        if error is not None and (samples is not None or point_set is not None):
            raise UsageError(f"error: decides itself how many {'samples' if point_set is None else 'points'} are taken")
        directions = _directions(samples, point_set, shift)
        if points.shape[0] == 0:
            raise UsageError("points: there are no points")
        text = lines(settings)

        def estimate(rows: Any, count: int) -> Dict[str, Any]:
            p, n, v = (each if each is None or rows is None else each[rows] for each in (points, normals, views))
            return _core.estimate(workspace, kind, p, n, v, count, point_set, shift, text, call)

        with told(progress, kind) as call:
            if error is not None:
                return to_error(wanted(error), points.shape[0], estimate), points.shape[0]
            return estimate(None, directions), points.shape[0]


def _whole(name: str, value: Any, least: int, most: int) -> int:
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise UsageError(f"{name}: an integer is needed, not {value!r}")
    number = int(value.__index__())
    if not least <= number <= most:
        raise UsageError(f"{name}: {number} is not from {least} to {most}")
    return number


def _names(argument: str, names: Any) -> str:
    names = [names] if isinstance(names, str) else list(names)
    for name in names:
        if not isinstance(name, str) or not name or " " in name:
            raise UsageError(f"{argument}: a list of names is needed, not {names!r}")
    return " ".join(names)


def _directions(samples: Optional[int], point_set: Any, shift: Any) -> int:
    if not isinstance(shift, bool):
        raise UsageError(f"shift: True or False is needed, not {shift!r}")
    if point_set is None:
        if not shift:
            raise UsageError("shift: is of an array of points as sampler")
        return _whole("samples", 1024 if samples is None else samples, 1, 1 << 30)
    count = int(point_set.shape[0])
    directions = count if samples is None else _whole("samples", samples, 1, 1 << 30)
    if directions % count:
        raise UsageError(f"samples: {directions} is no multiple of the {count} points of sampler")
    if not shift and directions != count:
        raise UsageError(f"samples: {directions} is not the number of points of sampler, {count}: they are not shifted")
    return directions


def _made_again(description: Dict[str, Any]) -> Scene:
    return Scene(description.pop("file"), **description)


_of_each = (("value", "float32"), ("standard_error", "float32"), ("samples", "uint32"))


def _common(made: Dict[str, Any], n: int) -> Tuple[Any, Any, Any]:
    return tuple(result(made[name], dtype) for name, dtype in _of_each)  # type: ignore[return-value]
