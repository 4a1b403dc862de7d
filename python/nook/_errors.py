"""What nook raises. Each class is an ErrorKind of host/base/error.hpp."""

from __future__ import annotations

from typing import Optional


class Error(Exception):
    """An error with the user's file and place in its message, and in file, row and column (from 1) or None."""

    file: Optional[str] = None
    row: Optional[int] = None
    column: Optional[int] = None


class UsageError(Error, ValueError):
    """An argument that is wrong, or that contradicts another."""


class SceneError(Error):
    """A scene file, mesh or material that cannot be used."""


class DeviceError(Error):
    """OpenCL or OpenGL."""


class OutputError(Error, OSError):
    """A file that could not be written."""


class IncompleteError(Error):
    """Something of a picture is missing."""


class InternalError(Error):
    """A defect in nook."""


class SceneWarning(UserWarning):
    """What nook mended or left out of a scene, a mesh or an estimate."""
