"""Arrays as nook takes them, checked: what is wrong is said by argument and row."""

from __future__ import annotations

from typing import Any, Optional, Sequence, Tuple

from ._errors import UsageError


def numbers(name: str, value: Any, dtypes: Tuple[str, ...] = ("float64",), columns: int = 3) -> Any:
    """An array of shape (n, columns), in one piece, of the first of `dtypes` that it is not already."""
    import numpy as np

    array = np.asarray(value)
    if array.dtype.kind not in "fiu" and not (array.dtype.kind == "b" and array.size == 0):
        raise UsageError(f"{name}: an array of numbers is needed, not of {array.dtype}")
    if array.ndim == 1 and array.shape[0] == columns:
        array = array.reshape(1, columns)
    if array.ndim != 2 or array.shape[1] != columns:
        raise UsageError(f"{name}: an array of shape (n, {columns}) is needed, not {array.shape}")
    if str(array.dtype) not in dtypes:
        array = array.astype(dtypes[0])
    array = np.ascontiguousarray(array)
    # The sum is finite unless some number is not, or together they overflow.
    with np.errstate(all="ignore"):
        suspect = not np.isfinite(array.sum(dtype="float64")) or np.abs(array).max(initial=0) > 3.4e38
    if suspect:
        with np.errstate(all="ignore"):
            wrong = np.flatnonzero(~np.isfinite(array.astype("float32")).all(axis=1))
        if wrong.size:
            raise UsageError(f"{name}: row {wrong[0]} is not finite: {array[wrong[0]].tolist()}")
    return array


def indices(name: str, value: Any, count: int) -> Any:
    """Triangles of vertices 0 to count - 1, as uint32."""
    import numpy as np

    array = np.asarray(value)
    if array.dtype.kind not in "iu":
        raise UsageError(f"{name}: an array of integers is needed, not of {array.dtype}")
    if array.ndim != 2 or array.shape[1] != 3:
        raise UsageError(f"{name}: an array of shape (n, 3) is needed, not {array.shape}")
    if array.shape[0] == 0:
        raise UsageError(f"{name}: there is no triangle")
    if array.min() < 0 or array.max() >= count:
        wrong = np.flatnonzero(((array < 0) | (array >= count)).any(axis=1))[0]
        raise UsageError(f"{name}: row {wrong} names a vertex outside 0 to {count - 1}: {array[wrong].tolist()}")
    return np.ascontiguousarray(array, dtype="uint32")


def same_rows(name: str, array: Any, of: str, rows: int) -> None:
    if array.shape[0] != rows:
        raise UsageError(f"{name}: {array.shape[0]} rows, and {rows} {of}")


def result(data: Any, dtype: str, shape: Optional[Tuple[int, ...]] = None) -> Any:
    import numpy as np

    array = np.frombuffer(data, dtype=dtype)
    return array if shape is None else array.reshape(shape)


def array_of(values: Sequence[Any], dtype: str) -> Any:
    import numpy as np

    return np.array([float(value) for value in values] if dtype == "int64" else values).astype(dtype)


def unit_points(name: str, value: Any) -> Any:
    """Points of [0,1)^2, shape (n, 2), rounded down to multiples of 2^-24, as the kernels take them."""
    import numpy as np

    array = numbers(name, value, columns=2)
    if array.shape[0] == 0:
        raise UsageError(f"{name}: there are no points")
    outside = np.flatnonzero(((array < 0) | (array >= 1)).any(axis=1))
    if outside.size:
        raise UsageError(f"{name}: row {outside[0]} is not in [0, 1)^2: {array[outside[0]].tolist()}")
    return np.ascontiguousarray(np.floor(array * 2**24) * 2**-24, dtype="float32")
