"""A line that says how far an estimate is, in terminals and notebooks."""

from __future__ import annotations

import sys
import time
from contextlib import contextmanager
from typing import Any, Callable, Iterator, Optional, TextIO, Union

from ._errors import UsageError

Progress = Union[bool, Callable[[int, int, int, float, float], Any], None]


def _in_notebook() -> bool:
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return shell is not None and "ZMQ" in type(shell).__name__


class Bar:
    """Called with samples, total, rays, error and share done, it rewrites its line a few times a second."""

    def __init__(self, what: str, out: Optional[TextIO] = None) -> None:
        notebook = out is None and _in_notebook()
        self._out = out or (sys.stdout if notebook else sys.stderr)
        self._shown = out is not None or notebook or self._out.isatty()
        self._what = what
        self._start = time.monotonic()
        self._last = self._start - 1
        self._width = 0

    def __call__(self, samples: int, total: int, rays: int, error: float, share: float) -> None:
        now = time.monotonic()
        if not self._shown or now - self._last < 0.2:
            return
        self._last = now
        done = min(1.0, samples / total)
        taken = now - self._start
        text = f"{self._what} {'#' * int(20 * done):<20} {100 * done:3.0f} %"
        if done > 0.02:
            text += f", {taken * (1 - done) / done:.0f} s left"
        if rays > 0 and taken > 0:
            text += f", {rays / taken * 1e-6:.1f} Mrays/s"
        if error > 0:
            text += f", error {error:.2g}"
        self._write("\r" + text.ljust(self._width))
        self._width = len(text)

    def end(self) -> None:
        """Leaves an empty line to whoever writes next."""
        if self._width:
            self._write("\r" + " " * self._width + "\r")

    def _write(self, text: str) -> None:
        self._out.write(text)
        self._out.flush()


@contextmanager
def told(progress: Progress, what: str) -> Iterator[Any]:
    """What is to be called with the progress: a bar of True, nothing of None and False."""
    if isinstance(progress, bool):
        bar = Bar(what) if progress else None
        try:
            yield bar
        finally:
            if bar:
                bar.end()
        return
    if progress is not None and not callable(progress):
        raise UsageError(f"progress: True or a function is needed, not {progress!r}")
    yield progress
