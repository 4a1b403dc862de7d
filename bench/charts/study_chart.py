#!/usr/bin/env python3
"""Draws studies as one chart, error against seconds, a panel a study and a line a method; prints what an error of .01 costs.

study_chart.py CHART.png STUDY.json...   (docs/images/what_accuracy_costs.png is that of bench/studies; see bench/studies.sh)
"""
import json
import math
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

# What is drawn of a study, the best distribution first: the front page shows what matters. "{best}" is cosine for AO, lobe for RO.
LINES = {
    "sphere independent": ("#8c6d1f", 1.8, "sphere, independent"),
    "hemisphere independent": ("#56b4e9", 1.8, "hemisphere, independent"),
    "{other} independent": ("#56b4e9", 1.8, "cosine, independent (RO)"),
    "{best} independent": ("#0072b2", 1.8, "cosine (RO: lobe), independent"),
    "adaptive independent": ("#9aa3b2", 1.8, "adaptive, counts"),
    "adaptive sobol": ("#444b59", 1.8, "adaptive, Sobol"),
    "{best} halton": ("#009e73", 1.8, "cosine (lobe), Halton"),
    "{best} sobol": ("#cc79a7", 2.6, "cosine (lobe), Sobol"),
    "{best} sobol x16": ("#d55e00", 2.6, "cosine (lobe), Sobol, 16 directions a camera ray"),
}
ERROR = 0.01


def facts_of(study):
    return {fact["name"]: fact["text"] for fact in study["facts"]}


def lines_of(study):
    reflected = facts_of(study)["effect"].startswith("ro")
    names = {"best": "lobe" if reflected else "cosine", "other": "cosine" if reflected else "none"}
    return {pattern.format(**names): style for pattern, style in LINES.items()}


def draw(axes, study):
    facts, lines = facts_of(study), lines_of(study)
    for method in study["methods"]:
        if method["name"] not in lines:
            continue
        colour, width, label = lines[method["name"]]
        points = [p for p in method["points"] if p["rmse"] > 0 and p["wall_seconds"] > 0]
        dashes = (4, 2) if method["family"] == "adaptive" else (None, None)
        axes.plot([p["wall_seconds"] for p in points], [p["rmse"] for p in points], "o-", color=colour, lw=width, ms=3, label=label, dashes=dashes)
        banded = [p for p in points if p["runs"] > 2 and p["rmse_low"] > 0]
        axes.fill_between([p["wall_seconds"] for p in banded], [p["rmse_low"] for p in banded], [p["rmse_high"] for p in banded], color=colour, alpha=0.18, lw=0)
    axes.set(xscale="log", yscale="log", xlabel=f"seconds for {facts['size']} pixels", ylabel="RMSE")
    axes.set_title(facts["scene"].removesuffix(".toml"), loc="left", fontweight="bold")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(numticks=6))
        axis.set_minor_formatter(NullFormatter())
        axis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
    axes.grid(which="major", color="#e6e9ef")


def say(study):
    """Which method reaches ERROR first, and how much longer others take."""
    seconds = {}
    for method in study["methods"]:
        for cost in method["seconds_to"]:
            if method["family"] != "ssao" and math.isclose(cost["error"], ERROR) and cost["seconds"] is not None:
                seconds[method["name"]] = cost["seconds"]
    name = facts_of(study)["scene"]
    if not seconds:
        print(f"{name}: no method reaches {ERROR}")
        return
    best = min(seconds, key=seconds.get)
    print(f"{name}: RMSE {ERROR} in {seconds[best]:.3g} s ({best})")
    for other in ("sphere independent", "cosine independent", "lobe independent", "adaptive independent", "adaptive sobol"):
        if other in seconds:
            print(f"  {other}: {seconds[other]:.3g} s, {seconds[other] / seconds[best]:.1f} times")
        elif any(method["name"] == other for method in study["methods"]):
            print(f"  {other}: not within four times its longest run")


def main(chart_file, study_files):
    studies = []
    for study_file in study_files:
        with open(study_file, encoding="utf-8") as file:
            studies.append(json.load(file))
    plt.rcParams.update({"font.family": "DejaVu Sans", "font.size": 10, "axes.spines.top": False, "axes.spines.right": False})
    columns = min(2, len(studies))
    rows = math.ceil(len(studies) / columns)
    figure, panels = plt.subplots(rows, columns, figsize=(5.2 * columns, 4.1 * rows + 1), dpi=130, squeeze=False)
    handles = {}
    for axes, study in zip(panels.flat, studies):
        draw(axes, study)
        handles.update({label: handle for handle, label in zip(*axes.get_legend_handles_labels())})
        say(study)
    for axes in panels.flat[len(studies):]:
        axes.remove()
    figure.suptitle("What accuracy costs", x=0.02, ha="left", fontweight="bold", fontsize=14)
    legend_rows = math.ceil(len(handles) / columns)
    figure.legend(handles.values(), handles.keys(), frameon=False, fontsize=9.5, loc="lower left", ncols=columns)
    figure.tight_layout(rect=(0, 0.055 * legend_rows / rows, 1, 1))
    figure.savefig(chart_file)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
