"""What accuracy costs in time: studies."""

from __future__ import annotations

import csv
import html
import json
import os
from typing import Any, Dict, Optional, Sequence, Union

from . import _core
from ._arrays import array_of
from ._errors import UsageError
from ._progress import Progress, told
from ._scene import Scene
from ._settings import lines

# What a study has its own of.
_own = ("spp", "directions", "sampling", "sampler", "method", "quality", "error", "time", "crop")
_text = ("method", "family", "sampling", "sampler")
_whole = ("directions", "runs", "rays")


class Study:
    """A study: for each method at each level of effort, its error and its cost.

    columns: a dict of arrays, those of study.csv (docs/study.md explains them), a row for each method and
    level; pandas.DataFrame(study.columns) takes it. data: study.json as a dict: facts, the reference, methods
    with their curves, fits and the seconds that errors take.
    """

    def __init__(self, data: str, table: str) -> None:
        self.data: Dict[str, Any] = json.loads(data)
        names, *rows = csv.reader(table.splitlines())
        self.columns: Dict[str, Any] = {
            name: array_of([row[i] for row in rows], "str" if name in _text else "int64" if name in _whole else "float64")
            for i, name in enumerate(names)
        }

    @property
    def methods(self) -> Sequence[str]:
        """The methods that were run, in the study's order."""
        return list(dict.fromkeys(self.columns["method"].tolist()))

    def plot(self, axes: Any = None, *, cost: str = "wall_seconds") -> Any:
        """Draws each method's root mean square error against its cost, both logarithmic; bands are 95 %
        intervals. cost: wall_seconds, device_seconds or rays. Returns the axes of matplotlib, which must be
        installed (ImportError)."""
        if cost not in ("wall_seconds", "device_seconds", "rays"):
            raise UsageError(f"cost: wall_seconds, device_seconds or rays, not {cost!r}")
        try:
            from matplotlib import colormaps
            from matplotlib.figure import Figure
        except ImportError as error:
            raise ImportError("a plot of a study needs matplotlib (python3-matplotlib)") from error
        if axes is None:
            axes = Figure(figsize=(9, 5.5), layout="constrained").add_subplot()
        of = self.columns
        line = {"fixed": "-", "adaptive": "--", "ssao": ":"}
        colors = colormaps["tab20"].colors
        for i, method in enumerate(self.methods):
            rows = (of["method"] == method) & (of["rmse"] > 0) & (of[cost] > 0)
            if not rows.any():
                continue
            x, color = of[cost][rows], colors[i % len(colors)]
            axes.fill_between(x, of["rmse_low"][rows], of["rmse_high"][rows], color=color, alpha=0.15, lw=0)
            family = of["family"][rows][0]
            axes.plot(x, of["rmse"][rows], line[family], marker=".", color=color, label=method)
        axes.set(xscale="log", yscale="log", xlabel=f"{cost.replace('_', ' ')} a picture", ylabel="RMSE")
        axes.grid(True, which="both", alpha=0.2)
        axes.legend(fontsize="small", bbox_to_anchor=(1.01, 1), loc="upper left")
        return axes

    def png(self) -> bytes:
        """plot() as a PNG file. Raises ImportError without matplotlib."""
        import io

        buffer = io.BytesIO()
        self.plot().figure.savefig(buffer, format="png", dpi=100)
        return buffer.getvalue()

    def _repr_html_(self) -> str:
        import base64

        try:
            shown = base64.b64encode(self.png()).decode()
            picture = f'<img src="data:image/png;base64,{shown}" alt="error against time">'
        except ImportError:
            picture = ""
        errors = [each["error"] for each in self.data["methods"][0]["seconds_to"]]
        head = "".join(f"<th>{error:g}</th>" for error in errors)
        rows = ""
        for method in self.data["methods"]:
            cells = "".join(
                f"<td>{'' if each['seconds'] is None else format(each['seconds'], '.3g')}</td>"
                for each in method["seconds_to"]
            )
            rows += f"<tr><td>{html.escape(method['name'])}</td>{cells}</tr>"
        caption = "seconds that an RMSE takes"
        return f"{picture}<table><caption>{caption}</caption><tr><th>method</th>{head}</tr>{rows}</table>"

    def __repr__(self) -> str:
        return f"<nook.Study: {len(self.methods)} methods, {len(self.columns['level'])} points>"


def study(
    scene: Scene,
    budget: float = 30,
    *,
    samplers: Sequence[str] = (),
    samplings: Sequence[str] = (),
    max_spp: int = 1024,
    folder: Union[str, "os.PathLike[str]", None] = None,
    reference: Union[str, "os.PathLike[str]", None] = None,
    gallery: bool = True,
    progress: Progress = None,
    **settings: Any,
) -> Study:
    """Measures what accuracy costs in time, as `nook study` does: every sampler and distribution, rendering to
    an error, and screen-space methods, against a reference, by the scene's first effect.

    budget: seconds, about. samplers, samplings: those to compare, by name; all if none is named. max_spp: the
    most camera rays a pixel. folder: where study.json, study.csv and index.html are written, and a study that
    is there goes on; nothing is written without one. reference: an .exr to measure errors against; rendered if
    there is none. gallery: pictures on the page. The picture's size follows from the budget unless width and height are given.

    Other keywords are keys of the scene. Raises UsageError for what a study has its own of (spp, directions,
    sampling, sampler, ...), and as Scene.render().
    """
    for name in _own:
        if settings.get(name) is not None:
            raise UsageError(f"{name}: a study has its own")
    if not 0.1 <= budget <= 1e6:
        raise UsageError(f"budget: {budget} is not from 0.1 to 1e6 seconds")
    if not 1 <= max_spp <= 1 << 20:
        raise UsageError(f"max_spp: {max_spp} is not from 1 to {1 << 20}")
    own_size = settings.get("width") is not None or settings.get("height") is not None
    with told(progress, "study") as call:
        texts = _core.study(
            scene._open(), lines(settings), float(budget), _words("samplers", samplers), _words("samplings", samplings),
            int(max_spp), own_size, folder, reference, bool(gallery), scene._name(), call,
        )  # fmt: skip
    return Study(*texts)


def _words(argument: str, words: Optional[Sequence[str]]) -> str:
    if words is None:
        return ""
    if isinstance(words, str):
        words = [words]
    if not all(isinstance(word, str) and word and " " not in word for word in words):
        raise UsageError(f"{argument}: a list of names is needed, not {words!r}")
    return " ".join(words)
