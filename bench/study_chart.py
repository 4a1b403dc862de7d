#!/usr/bin/env python3
"""Draws a study as one chart: error against seconds, a line per method.

study_chart.py STUDY.json CHART.png   (docs/images/what_accuracy_costs.png is that of studies/cbox_ao_cosine)
"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter

# Method -> (colour, width, label); others are left out: the front page shows what matters.
LINES = {
    "sphere independent": ("#8c6d1f", 1.8, "sphere, independent"),
    "hemisphere independent": ("#56b4e9", 1.8, "hemisphere, independent"),
    "cosine independent": ("#0072b2", 1.8, "cosine, independent"),
    "adaptive": ("#444b59", 1.8, "adaptive"),
    "cosine halton": ("#009e73", 1.8, "cosine, Halton"),
    "cosine sobol": ("#cc79a7", 2.6, "cosine, Sobol"),
    "cosine sobol x16": ("#d55e00", 2.6, "cosine, Sobol, 16 directions a camera ray"),
}


def main(study_file, chart_file):
    with open(study_file, encoding="utf-8") as file:
        study = json.load(file)
    facts = {f["name"]: f["text"] for f in study["facts"]}
    plt.rcParams.update({"font.family": "DejaVu Sans", "font.size": 10.5, "axes.spines.top": False, "axes.spines.right": False})
    figure, axes = plt.subplots(figsize=(8.4, 5.2), dpi=130)
    for method in study["methods"]:
        if method["name"] not in LINES:
            continue
        colour, width, label = LINES[method["name"]]
        points = [p for p in method["points"] if p["rmse"] > 0 and p["wall_seconds"] > 0]
        seconds = [p["wall_seconds"] for p in points]
        axes.plot(seconds, [p["rmse"] for p in points], "o-", color=colour, lw=width, ms=3.5, label=label, dashes=(4, 2) if method["name"] == "adaptive" else (None, None))
        banded = [p for p in points if p["runs"] > 2 and p["rmse_low"] > 0]
        axes.fill_between([p["wall_seconds"] for p in banded], [p["rmse_low"] for p in banded], [p["rmse_high"] for p in banded], color=colour, alpha=0.18, lw=0)
    axes.set(xscale="log", yscale="log", xlabel=f"seconds for {facts['size']} pixels", ylabel="RMSE")
    axes.set_title(f"What accuracy costs: {facts['scene'].removesuffix('.toml')}", loc="left", fontweight="bold")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
    axes.grid(which="major", color="#e6e9ef")
    axes.legend(frameon=False, fontsize=9.5)
    figure.tight_layout()
    figure.savefig(chart_file)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
