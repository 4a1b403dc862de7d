"""Keyword arguments as lines of TOML, which nook reads as it reads a scene file."""

from __future__ import annotations

import json
import os
from typing import Any, Mapping

# Names of arguments where a key's name has another meaning in Python.
_renamed = {"effects": "effect"}


def _text(name: str, value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, os.PathLike):
        return _text(name, os.fspath(value))
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(key)} = {_text(key, each)}" for key, each in value.items()) + "}"
    if hasattr(value, "tolist"):  # numbers and arrays of NumPy
        listed = value.tolist()
        if listed is not value and not hasattr(listed, "tolist"):
            return _text(name, listed)
    if isinstance(value, int):
        if not -(2**63) <= value < 2**63:
            raise ValueError(f"{name}: {value} is out of range")
        return repr(int(value))
    if isinstance(value, float):
        return repr(float(value))
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_text(name, each) for each in value) + "]"
    raise TypeError(f"{name}: a {type(value).__name__} is no value of a scene")


def _key(name: Any) -> str:
    if not isinstance(name, str):
        raise TypeError(f"{name!r} is no name of a key")
    return json.dumps(name)


def lines(settings: Mapping[str, Any]) -> str:
    """The settings that are not None, a line each; ground=True is a ground with nothing said of it."""
    made = []
    for name, value in settings.items():
        if name == "ground" and isinstance(value, bool):
            value = {} if value else None
        if value is not None:
            made.append(f"{_key(_renamed.get(name, name))} = {_text(name, value)}\n")
    return "".join(made)
