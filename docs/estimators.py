#!/usr/bin/env python3
"""Figures and tables of docs/estimators.md from the measurements of nook_bench_estimators.

    build/bin/nook_bench_estimators | docs/estimators.py

writes docs/images/estimators_*.png, and the tables in Markdown to stdout. Needs matplotlib (python3-matplotlib).
"""
import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

images = pathlib.Path(__file__).parent / "images"
lines = [json.loads(line) for line in sys.stdin]


def of(key, value):
    return [line for line in lines if line.get(key) == value]


def save(figure, name):
    images.mkdir(exist_ok=True)
    figure.savefig(images / name, dpi=80, bbox_inches="tight")
    plt.close(figure)


def draw_samplers():
    entries = of("figure", "samplers")
    figure, axes = plt.subplots(1, len(entries), figsize=(3 * len(entries), 3.3))
    for axis, entry in zip(axes, entries):
        axis.plot(*zip(*entry["points"]), ".", markersize=3, color="#204080")
        axis.set(title=entry["sampler"], xlim=(0, 1), ylim=(0, 1), xticks=[], yticks=[], aspect="equal")
    save(figure, "estimators_samplers.png")


def draw_warps():
    entries = of("figure", "warps")
    figure, axes = plt.subplots(1, len(entries), figsize=(3 * len(entries), 3.3))
    for axis, entry in zip(axes, entries):
        above = [p for p in entry["points"] if p[2] >= 0]
        below = [p for p in entry["points"] if p[2] < 0]
        axis.add_patch(plt.Circle((0, 0), 1, fill=False, color="#a0a0a0"))
        axis.plot([p[0] for p in above], [p[1] for p in above], ".", markersize=3, color="#204080")
        axis.plot([p[0] for p in below], [p[1] for p in below], ".", markersize=3, color="#d08040")
        axis.set(title=entry["warp"], xlim=(-1.05, 1.05), ylim=(-1.05, 1.05), xticks=[], yticks=[], aspect="equal")
    save(figure, "estimators_warps.png")


def draw_convergence():
    figure, axis = plt.subplots(figsize=(6.5, 4.5))
    entries = of("figure", "convergence")
    for sampler in dict.fromkeys(entry["sampler"] for entry in entries):
        chosen = [entry for entry in entries if entry["sampler"] == sampler]
        x, y = [entry["samples"] for entry in chosen], [entry["variance"] for entry in chosen]
        logs = [(math.log2(a), math.log2(b)) for a, b in zip(x, y) if 16 <= a <= 1024]
        mean_x = sum(a for a, _ in logs) / len(logs)
        slope = sum((a - mean_x) * b for a, b in logs) / sum((a - mean_x) ** 2 for a, _ in logs)
        axis.loglog(x, y, "o-", markersize=3, label=f"{sampler}, slope {slope:.2f}", base=2)
    axis.set(xlabel="camera rays a pixel, one direction each", ylabel="variance of the pixel")
    axis.legend()
    axis.grid(alpha=0.3)
    save(figure, "estimators_convergence.png")


def number(value):
    return "" if value is None else f"{value:.5f}" if value < 10 else f"{value:.2f}"


def print_table(name, row_of, row_title, samplings):
    entries = of("table", name)
    print(f"| {row_title} | value | " + " | ".join(samplings) + " |")
    print("|---|---|" + "---|" * len(samplings))
    for row in dict.fromkeys(row_of(entry) for entry in entries):
        chosen = {entry["sampling"]: entry for entry in entries if row_of(entry) == row}
        cells = [f"{number(chosen[s]['variance'])} ({number(chosen[s]['predicted'])})" for s in samplings]
        print(f"| {row} | {number(chosen[samplings[0]]['value'])} | " + " | ".join(cells).replace(" ()", "") + " |")
    print()


draw_samplers()
draw_warps()
draw_convergence()
print_table("ambient", lambda e: e["case"], "scene", ["cosine", "hemisphere", "sphere"])
print_table("reflection", lambda e: f"n = {e['exponent']:g}, {e['degrees']:g}°", "exponent, angle of the mirror direction",
            ["lobe", "mixture", "cosine", "hemisphere", "sphere"])
