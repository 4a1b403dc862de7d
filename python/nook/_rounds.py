"""Estimates at points to a standard error: rounds of more directions where they are needed."""

from __future__ import annotations

import warnings
from typing import Any, Callable, Dict

from ._arrays import result
from ._errors import SceneWarning, UsageError

FIRST, MOST = 256, 1 << 18

_dtypes = {"samples": "uint32"}
_columns = {"direction": 3}


def wanted(error: Any) -> float:
    if isinstance(error, bool) or not isinstance(error, (int, float)) and not hasattr(error, "__float__"):
        raise UsageError(f"error: a standard error is needed, not {error!r}")
    number = float(error)
    if not 1e-4 <= number <= 1:
        raise UsageError(f"error: {number} is not a standard error from 1e-4 to 1")
    return number


def to_error(error: float, count: int, estimate: Callable[[Any, int], Dict[str, Any]]) -> Dict[str, Any]:
    """estimate(rows or None for all, directions): bytes by name. Each round has four times the directions of
    the one before, at the points that are not accurate enough yet, and its estimate replaces theirs."""
    import numpy as np

    made: Dict[str, Any] = {}
    rows = np.arange(count)
    directions = FIRST
    while True:
        found = estimate(None if rows.size == count else rows, directions)
        for name, data in found.items():
            shape = (-1, _columns[name]) if name in _columns else (-1,)
            values = result(data, _dtypes.get(name, "float32"), shape)
            if name not in made:
                made[name] = values.copy()
            elif values.size:
                made[name][rows] = values
        rows = np.flatnonzero(made["standard_error"] > error)
        if not rows.size:
            return made
        if directions == MOST:
            warnings.warn(
                f"error: {rows.size} of {count} points have a larger one after {MOST} directions, "
                f"up to {made['standard_error'].max():.2g}",
                SceneWarning,
                stacklevel=4,
            )
            return made
        directions *= 4
