"""Ambient, reflection and screen-space occlusion as arrays, without a GPU or a display.

    import nook
    scene = nook.Scene(vertices=V, faces=F)
    r = scene.ao(points, normals)          # r.value, r.standard_error, r.samples
    picture = scene.render(spp=16)         # picture["ao"]; picture.save("ao.exr")

See docs/python.md.
"""

import atexit
from typing import Any, Dict, List

from . import _core, _keys
from ._errors import (
    DeviceError,
    Error,
    IncompleteError,
    InternalError,
    OutputError,
    SceneError,
    SceneWarning,
    UsageError,
)
from ._bake import Bake
from ._picture import Picture
from ._scene import BentEstimates, Estimates, Scene
from ._study import Study, study

__all__ = [
    "Bake",
    "BentEstimates",
    "DeviceError",
    "Error",
    "Estimates",
    "IncompleteError",
    "InternalError",
    "OutputError",
    "Picture",
    "Scene",
    "SceneError",
    "SceneWarning",
    "Study",
    "UsageError",
    "devices",
    "study",
]

_keys.document(Scene)

# An estimate that Ctrl-C ended may still be in a launch: the process must not end under it.
atexit.register(_core.wait)


def devices() -> List[Dict[str, Any]]:
    """The OpenCL devices, a dict each: selector, type, name, platform, driver, compute_units, memory (bytes)."""
    return _core.devices()
