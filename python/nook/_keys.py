"""The keys of a scene in the help of what takes them, from nook's own description of each."""

from __future__ import annotations

import textwrap
from typing import Any, Dict, List

from . import _core

# Of a picture's samples, film and camera: points have none.
_at_points = ("sampler", "seed", "compat")


def _line(key: Dict[str, Any]) -> str:
    default = "" if key["default"] is None else f" = {key['default']}"
    return textwrap.fill(
        f"{key['name']}{default}: {key['help']}", 104, initial_indent=" " * 12, subsequent_indent=" " * 16
    )


def _add(function: Any, keys: List[Dict[str, Any]], said: str) -> None:
    if function.__doc__:  # there is none with python -OO
        lines = "\n".join(map(_line, keys))
        function.__doc__ = f"{function.__doc__.rstrip()}\n\n        {said}\n\n{lines}\n        "


def document(scene: Any) -> None:
    keys = _core.keys()
    for kind in ("ao", "ro", "bent"):
        mine = [key for key in keys if key["of"] == "effect" and kind in key["readers"] and key["name"] != "type"]
        mine += [key for key in keys if key["name"] in _at_points]
        _add(getattr(scene, kind), mine, "Keys of the scene, with their defaults:")
    drawn = [key for key in keys if key["of"] not in ("input", "ground")]
    _add(scene.render, drawn, "Keys of the scene, with their defaults:")
    baked = [key for key in keys if key["of"] == "effect" and {"ao", "bent"} & set(key["readers"])]
    baked += [key for key in keys if key["name"] in ("spp", "directions", *_at_points)]
    _add(scene.bake, baked, "Keys of the scene, with their defaults:")
