#!/usr/bin/env python3
"""Tables and a chart of what nook_bench ssao measured.

ssao_chart.py results/ssao.jsonl CHART.png   (docs/images/ssao_error_time.png; the tables go to stdout as Markdown)

Of several lines for the same case the last counts: for errors the last that has them, for times the last of those under the least load.
"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

SCENES = ["bunny-alone", "bunny", "fence", "cornell", "spaceship", "room"]
RADII = ["0.15", "half"]
IDLE = 2.5  # load average with two drawing threads and nothing else
METHODS = {"point": "#8c6d1f", "gtao": "#0072b2", "march": "#d55e00"}
QUALITIES = {"assigned": "*", "draft": "v", "real-time": "o", "accurate": "s"}


def read(file):
    errors, times, equal = {}, {}, {}
    with open(file, encoding="utf-8") as lines:
        for line in lines:
            r = json.loads(line)
            case = (r["scene"], r["radius_rule"], r["variant"])
            size = (r["width"], r["height"])
            if "errors" in r and size == (1280, 720):
                errors[case] = r["errors"]
            if "equal_time" in r:
                equal[case] = r
            known = times.get(case + size)
            if known is None or r["load"] <= known["load"]:
                times[case + size] = r
    return errors, times, equal


def number(value, digits=4):
    if value is None:
        return "-"
    return f"{value:.{digits}f}".replace("0.", ".", 1) if abs(value) < 1 else f"{value:.{digits}f}"


def ordered_variants(keys):
    return [f"{m}/{q}" for m in METHODS for q in QUALITIES if any(k[2] == f"{m}/{q}" for k in keys)]


def print_errors(errors):
    for radius in RADII:
        present = [s for s in SCENES if any(k[:2] == (s, radius) for k in errors)]
        print(f"\nRMSE (inner, border), radius {radius}\n\n| | " + " | ".join(present) + " |\n|---" + "|---" * len(present) + "|")
        for variant in ordered_variants(errors):
            cells = []
            for scene in present:
                e = errors.get((scene, radius, variant))
                cells.append(f"{number(e['rmse'])} ({number(e['rmse_inner'], 3)}, {number(e['rmse_border'], 3)})" if e else "")
            print(f"| {variant} | " + " | ".join(cells) + " |")


def print_times(times):
    for size in sorted({k[3:] for k in times}):
        present = [s for s in SCENES if any(k[0] == s and k[3:] == size for k in times)]
        print(f"\nCPU milliseconds a frame (frames a second where the machine was idle), {size[0]}x{size[1]}, radius 0.15\n\n| | " + " | ".join(present) + " |\n|---" + "|---" * len(present) + "|")
        for variant in ordered_variants(times):
            cells = []
            for scene in present:
                r = times.get((scene, "0.15", variant) + size)
                if r is None:
                    cells.append("")
                elif r["load"] < IDLE:
                    cells.append(f"{1e3 * r['cpu_seconds']:.0f} ({1 / r['median_seconds']:.1f})")
                else:
                    cells.append(f"{1e3 * r['cpu_seconds']:.0f}")
            print(f"| {variant} | " + " | ".join(cells) + " |")


def print_passes(times):
    print("\nPasses of march/real-time, CPU milliseconds, 1280x720, radius 0.15\n\n| | geometry | occlusion | denoise | upsample | read | load |\n|---|---|---|---|---|---|---|")
    for scene in SCENES:
        r = times.get((scene, "0.15", "march/real-time", 1280, 720))
        if r:
            cells = [f"{1e3 * r['passes'][p]['cpu_seconds']:.1f}" for p in ("geometry", "occlusion", "denoise", "upsample", "read")]
            print(f"| {scene} | " + " | ".join(cells) + f" | {r['load']:.1f} |")


def print_equal(equal):
    print("\n| | filter | SSAO ms | SSAO RMSE | traced directions | traced ms | traced RMSE |\n|---|---|---|---|---|---|---|")
    for (scene, radius, variant), r in equal.items():
        for key, name in (("no_filter", "neither"), ("filter", "both")):
            e = r["equal_time"][key]
            print(f"| {scene} {radius} {variant} | {name} | {1e3 * e['ssao_seconds']:.0f} | {number(e['ssao_rmse'])} | {e['directions']} | {1e3 * e['traced_seconds']:.0f} | {number(e['traced_rmse'])} |")


def draw(errors, times, file):
    plt.rcParams.update({"font.family": "DejaVu Sans", "font.size": 9, "axes.spines.top": False, "axes.spines.right": False})
    shown = [s for s in SCENES if any(k[0] == s for k in errors)]
    figure, grid = plt.subplots(2, len(shown), figsize=(2.6 * len(shown), 6.2), dpi=100, sharex=True)
    for row, radius in enumerate(RADII):
        for axes, scene in zip(grid[row], shown):
            for method, colour in METHODS.items():
                points = []
                for quality, marker in QUALITIES.items():
                    case = (scene, radius, f"{method}/{quality}")
                    if case not in errors or case + (1280, 720) not in times:
                        continue
                    point = (1e3 * times[case + (1280, 720)]["cpu_seconds"], errors[case]["rmse"])
                    axes.plot(*point, marker, color=colour, ms=10 if marker == "*" else 6)
                    if quality != "assigned":
                        points.append(point)
                axes.plot([p[0] for p in points], [p[1] for p in points], "-", color=colour, lw=1.4)
            if not axes.lines or all(len(line.get_xdata()) == 0 for line in axes.lines):
                axes.set_visible(False)  # not measured
                continue
            axes.set_xscale("log")
            axes.set_yscale("log")
            axes.grid(True, which="both", color="#dddddd", lw=0.5)
            axes.set_title(f"{scene}, {'R = 0.15' if radius == '0.15' else 'R = half'}", fontsize=9)
            if row == 1:
                axes.set_xlabel("CPU milliseconds a frame")
        grid[row][0].set_ylabel("RMSE against traced rays")
    handles = [plt.Line2D([], [], color=c, label=m) for m, c in METHODS.items()]
    handles += [plt.Line2D([], [], color="#444444", marker=m, ls="", label=q) for q, m in QUALITIES.items()]
    figure.legend(handles=handles, loc="lower center", ncol=7, frameon=False)
    figure.tight_layout(rect=(0, 0.05, 1, 1))
    figure.savefig(file)


if __name__ == "__main__":
    all_errors, all_times, all_equal = read(sys.argv[1])
    print_errors(all_errors)
    print_times(all_times)
    print_passes(all_times)
    print_equal(all_equal)
    draw(all_errors, all_times, sys.argv[2])
