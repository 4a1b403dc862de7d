"""Layers of pictures and bakes: arrays of one channel, or of three."""

from __future__ import annotations

from typing import Any, Dict, Iterator, List, Mapping


def layer(name: str, layers: Dict[str, List[str]], channels: Dict[str, Any], between: str, of: str) -> Any:
    """The channel or channels of `name`: of a layer, of a channel, or of three that end in X, Y and Z."""
    names = layers.get(name)
    if names is None and name in channels:
        names = [name]
    if names is None:
        names = [f"{name}{between}{axis}" for axis in ("XYZ" if between == "." else "xyz")]
        if not all(each in channels for each in names):
            known = ", ".join([*layers, *(each for each in channels if each not in layers)])
            raise KeyError(f"{name!r} is not in this {of}; there are {known}")
    if len(names) == 1:
        return channels[names[0]]
    import numpy as np

    return np.stack([channels[each] for each in names], axis=-1)


class Layers(Mapping[str, Any]):
    """What was asked for by name; as an array, the first of it."""

    _layers: Dict[str, List[str]]

    def __iter__(self) -> Iterator[str]:
        return iter(self._layers)

    def __len__(self) -> int:
        return len(self._layers)

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
        import numpy as np

        return np.array(self[next(iter(self))], dtype=dtype)
