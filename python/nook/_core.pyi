"""The module in C++ (python/core/module.cpp). Arrays are given by the buffer protocol and come back as bytes."""

import os
from typing import Any, Callable, Dict, List, Optional, Tuple, Union

_File = Union[str, "os.PathLike[str]", None]
_Progress = Optional[Callable[[int, int, int, float, float], Any]]

def open(file: _File, vertices: Any, faces: Any, normals: Any, settings: str, device: str) -> Any: ...
def estimate(
    workspace: Any,
    type: str,
    points: Any,
    normals: Any,
    views: Any,
    samples: int,
    point_set: Any,
    shift: bool,
    settings: str,
    progress: _Progress,
) -> Dict[str, Any]: ...
def render(workspace: Any, settings: str, aovs: str, progress: _Progress) -> Dict[str, Any]: ...
def bake(workspace: Any, to: str, settings: str, progress: _Progress) -> Dict[str, Any]: ...
def bake_texture(
    workspace: Any, size: int, dilation: int, aovs: str, settings: str, progress: _Progress
) -> Dict[str, Any]: ...
def save_bake(bake: Any, file: _File) -> None: ...
def save(picture: Any, file: _File) -> None: ...
def toml(workspace: Any) -> str: ...
def plan(workspace: Any) -> str: ...
def info(workspace: Any) -> str: ...
def study(
    workspace: Any,
    settings: str,
    budget: float,
    samplers: str,
    samplings: str,
    max_spp: int,
    own_size: bool,
    folder: _File,
    reference: _File,
    gallery: bool,
    name: str,
    progress: _Progress,
) -> Tuple[str, str]: ...
def devices() -> List[Dict[str, Any]]: ...
def keys() -> List[Dict[str, Any]]: ...
def wait() -> None: ...
