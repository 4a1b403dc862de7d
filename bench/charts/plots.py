#!/usr/bin/env python3
"""Draws the plots and writes the tables from the JSON lines of the benchmarks.

plots.py [RESULTS_FOLDER]   (default: the folder `results` of bench)

Plots go into that folder, and the tables into its tables.md; with the default the tables replace those of README.md, between
its lines `<!-- begin NAME -->` and `<!-- end NAME -->`. Of lines that measure the same thing the last one counts.
"""
import json
import pathlib
import sys
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter, NullLocator

OURS, THEIRS, GREY = "#0072b2", "#d55e00", "#444b59"
plt.rcParams.update({"font.family": "DejaVu Sans", "font.size": 10, "axes.spines.top": False, "axes.spines.right": False})


def read(folder, name, key):
    """The last line of each key, in the order in which the keys first appear."""
    lines = {}
    file = folder / f"{name}.jsonl"
    if file.exists():
        for text in file.read_text(encoding="utf-8").splitlines():
            line = json.loads(text)
            lines[key(line)] = line
    return list(lines.values())


def save(figure, folder, name):
    figure.tight_layout()
    figure.savefig(folder / f"{name}.png")
    plt.close(figure)


def occlusion_name(line):
    rays = {"ao": "AO", "ro": f"RO n={line.get('exponent', 30):g}", "own": "own origins", "primary": "primary"}
    name = f"{line['scene']}, {rays.get(line['rays'], line['rays'])}"
    if line.get("defines"):
        name += ", " + " ".join(line["defines"]).replace("TRAVERSAL_PORTABLE=1", "portable")
    return name + (", 1 thread" if line["threads"] == 1 else "")


def bars(folder, name, labels, lines, title, values="ratios", low_is_good=False):
    """A horizontal bar for each line: its median, with the spread of the rounds; 1 is Embree."""
    if not lines:
        return
    figure, axes = plt.subplots(figsize=(8.4, 0.9 + 0.3 * len(lines)), dpi=130)
    for y, (label, line) in enumerate(zip(labels, lines)):
        ratios = sorted(line[values])
        n = len(ratios)
        middle = ratios[n // 2] if n % 2 else 0.5 * (ratios[n // 2 - 1] + ratios[n // 2])
        good = middle <= 1 if low_is_good else middle >= 1
        axes.barh(y, middle, color=OURS if good else THEIRS, height=0.62)
        axes.plot([ratios[0], ratios[-1]], [y, y], color=GREY, lw=1.4, solid_capstyle="butt")
        axes.text(max(middle, ratios[-1]) + 0.03, y, f"{middle:.2f}", va="center", fontsize=9)
    axes.axvline(1, color=GREY, lw=0.9)
    axes.margins(x=0.12)
    axes.set_yticks(range(len(lines)), labels)
    axes.invert_yaxis()
    axes.set_title(title, loc="left", fontweight="bold")
    save(figure, folder, name)


def occlusion(folder):
    lines = read(folder, "occlusion", lambda l: (l["scene"], l["rays"], l.get("exponent"), tuple(l["defines"]), l["threads"]))
    bars(folder, "occlusion", [occlusion_name(l) for l in lines], lines, "Rays a second, Embree's best variant = 1")
    return lines


def tree(folder):
    lines = read(folder, "tree", lambda l: (l["scene"], l["refined"], l["threads"]))
    labels = [f"{l['scene']}, {'refined, ' if l['refined'] else ''}{l['threads']} threads" for l in lines]
    bars(folder, "tree", labels, lines, "Seconds to build the tree, rtcCommitScene MEDIUM = 1", "time_ratios", True)
    return lines


def end_to_end_name(line):
    return f"{line['scene']}, x{line['spp'] * line['directions']}, {line['cache']}"


def end_to_end(folder):
    lines = read(folder, "end_to_end", lambda l: (l["scene"], l["spp"], l["directions"], l["cache"], l["threads"]))
    bars(folder, "end_to_end", [end_to_end_name(l) for l in lines], lines, "Whole processes, the Embree program = 1")
    return lines


AXES = {
    "triangles": "triangles (512 x 512 pixels x 16 directions)",
    "pixels": "pixels (1 million triangles, 16 directions)",
    "rays": "directions a pixel (1 million triangles, 512 x 512)",
    "threads": "threads (1 million triangles, 512 x 512 x 64)",
}


def scaling(folder):
    lines = read(folder, "scaling", lambda l: (l["axis"], l["value"]))
    if not lines:
        return lines
    figure, grid = plt.subplots(2, 2, figsize=(9.2, 7), dpi=130)
    for axes, (axis, label) in zip(grid.flat, AXES.items()):
        points = sorted((l for l in lines if l["axis"] == axis), key=lambda l: l["value"])
        x = [p["value"] for p in points]
        axes.plot(x, [p["seconds"] for p in points], "o-", color="black", lw=2, ms=4, label="whole process")
        # The stages are the wall clock's: beside CPU seconds they would mislead.
        for stage, colour in () if any(p["clock"] == "cpu" for p in points) else (("load", "#8c6d1f"), ("bvh", THEIRS), ("render", OURS), ("write", "#009e73")):
            axes.plot(x, [p["stages"][stage] for p in points], "o-", color=colour, lw=1.2, ms=3, label={"bvh": "tree"}.get(stage, stage))
        axes.set(xscale="log", yscale="log", xlabel=label, ylabel="seconds")
        axes.grid(which="major", color="#e6e9ef")
        axes.set_xticks(x, [f"{v:g}" if v < 1e4 else f"$2^{{{v.bit_length() - 1}}}$" if axis == "pixels" else f"$10^{len(str(v)) - 1}$" for v in map(int, x)])
        memory = axes.twinx()
        memory.plot(x, [p["peak_bytes"] * 1e-6 for p in points], "s:", color=GREY, lw=1, ms=3)
        memory.set(yscale="log", ylabel="MB resident (dotted)")
        memory.set_ylim(100, 2 * max(l["peak_bytes"] for l in lines) * 1e-6)
        axes.xaxis.set_minor_locator(NullLocator())
        low, high = axes.get_ylim()
        axes.set_ylim(low / 1.5, high * 1.5)
        for y in (axes.yaxis, memory.yaxis):
            y.set_major_locator(LogLocator(subs=(1, 2, 5)))
            y.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
            y.set_minor_formatter(NullFormatter())
    grid[0][0].legend(frameon=False, fontsize=8.5)
    save(figure, folder, "scaling")
    return lines


def options(folder):
    lines = [l for l in read(folder, "options", lambda l: l["option"]) if l["option"] != "base"]
    bars(folder, "options", [l["option"] for l in lines], lines, "Time with an option, 1 million triangles; without = 1", "time_ratios", True)
    return lines


def micro(folder):
    file = folder / "micro.json"
    if not file.exists():
        return []
    runs = json.loads(file.read_text(encoding="utf-8"))["benchmarks"]
    chosen = [r for r in runs if r.get("aggregate_name") == "median"]
    figure, axes = plt.subplots(figsize=(8.4, 0.9 + 0.26 * len(chosen)), dpi=130)
    values = [1e9 / r["items_per_second"] for r in chosen]
    axes.barh(range(len(chosen)), values, color=OURS, height=0.62)
    axes.set_yticks(range(len(chosen)), [r["run_name"].removesuffix("/real_time") for r in chosen], fontsize=8.5)
    axes.invert_yaxis()
    axes.set(xscale="log")
    axes.set_title("Nanoseconds an item", loc="left", fontweight="bold")
    save(figure, folder, "micro")
    return chosen


def table(head, rows):
    if not rows:
        return ""
    return "\n".join(["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + ["| " + " | ".join(r) + " |" for r in rows]) + "\n"


def spread(values, digits=2):
    return f"[{min(values):.{digits}f}, {max(values):.{digits}f}]"


def main(folder):
    text = {}
    lines = occlusion(folder)
    text["occlusion"] = table(
        ["scene, rays", "ours, million rays a second", "Embree's best", "its variant", "ratio [least, greatest]", "clock"],
        [[occlusion_name(l), f"{l['mrays_per_s']:.1f}", f"{l['embree_mrays_per_s']:.1f}", l["embree_variant"], f"{l['ratio']:.2f} {spread(l['ratios'])}", l["clock"]] for l in lines])
    text["tree"] = table(
        ["scene", "threads", "seconds", "rtcCommitScene", "its time x [least, greatest]", "bytes a triangle", "clock"],
        [[l["scene"] + (", refined" if l["refined"] else ""), str(l["threads"]), f"{l['seconds']:.3f}", f"{l['embree_seconds']:.3f}", f"{l['time_ratio']:.2f} {spread(l['time_ratios'])}", f"{l['bytes_per_triangle']:.1f}", l["clock"]] for l in tree(folder)])
    text["end to end"] = table(
        ["scene, rays a pixel, kernel cache", "nook, seconds", "Embree program", "ratio [least, greatest]", "load / tree / render / write", "RMSE between the pictures", "MB, nook and Embree", "clock"],
        [[end_to_end_name(l), f"{l['seconds']:.2f}", f"{l['embree_seconds']:.2f}", f"{l['ratio']:.2f} {spread(l['ratios'])}",
          " / ".join(f"{l['stages'][s]:.2f}" for s in ("load", "bvh", "render", "write")), f"{l['rmse']:.4f}", f"{l['peak_bytes'] * 1e-6:.0f}, {l['embree_peak_bytes'] * 1e-6:.0f}", l["clock"]] for l in end_to_end(folder)])
    overhead = read(folder, "overhead", lambda l: l["threads"])
    text["overhead"] = table(
        ["threads", "ms before the first ray [least, greatest]", "ms, whole process", "ms of CPU time"],
        [[str(l["threads"]), f"{1e3 * l['seconds_before_first_ray']:.0f} {spread([1e3 * v for v in l['seconds_before_first_ray_each']], 0)}", f"{1e3 * l['seconds']:.0f}", f"{1e3 * l['cpu_seconds']:.0f}"] for l in overhead])
    text["scaling"] = table(
        ["along", "value", "seconds", "load", "tree", "render", "write", "MB", "clock"],
        [[l["axis"], f"{l['value']:.0f}", f"{l['seconds']:.2f}"] + [f"{l['stages'][s]:.3f}" for s in ("load", "bvh", "render", "write")] + [f"{l['peak_bytes'] * 1e-6:.0f}", l["clock"]] for l in scaling(folder)])
    text["options"] = table(
        ["option", "seconds", "time / without [least, greatest]", "clock"],
        [[l["option"], f"{l['seconds']:.3f}", f"{l['time_ratio']:.2f} {spread(l['time_ratios'])}", l["clock"]] for l in options(folder)])
    text["micro"] = table(
        ["benchmark", "ns an item"], [[r["run_name"].removesuffix("/real_time"), f"{1e9 / r['items_per_second']:.2f}"] for r in micro(folder)])
    text["effects"] = table(
        ["against plain AO", "time [95 % of the median]", "rays", "clock"],
        [[l["case"], f"{l['ratio']:.2f} {spread(l.get('interval', [l['least'], l['greatest']]))}", f"{l['rays'] / l['rays_of_plain']:.2f}", "cpu" if l["cpu_time"] else "wall"] for l in read(folder, "effects", lambda l: l["case"])])
    text["instances"] = table(
        ["oaks", "kept as", "MB", "load", "tree", "kernels", "CPU seconds in all"],
        [[str(l["instances"]), l["kept_as"], f"{l['peak_bytes'] * 1e-6:.0f}"] + [f"{l[k]:.2f}" for k in ("load_seconds", "tree_seconds", "device_seconds", "cpu_seconds")] for l in read(folder, "instances", lambda l: (l["instances"], l["kept_as"]))])
    machine = folder / "machine.txt"
    if machine.exists():
        text["machine"] = textwrap.fill(machine.read_text(encoding="utf-8"), 100, break_on_hyphens=False) + "\n"
    return {name: body for name, body in text.items() if body}


def put_into(readme, text):
    page = readme.read_text(encoding="utf-8")
    for name, body in text.items():
        begin, end = f"<!-- begin {name} -->\n", f"<!-- end {name} -->"
        if begin in page:
            before, rest = page.split(begin, 1)
            page = before + begin + "\n" + body + "\n" + end + rest.split(end, 1)[1]
    readme.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) > 2 or sys.argv[1:] in (["-h"], ["--help"]):
        sys.exit(__doc__)
    here = pathlib.Path(__file__).parent.parent
    if len(sys.argv) == 2:
        tables = main(pathlib.Path(sys.argv[1]))
        page = "".join(f"## {name[0].upper() + name[1:]}\n\n{body}\n" for name, body in tables.items())
        pathlib.Path(sys.argv[1], "tables.md").write_text(page, encoding="utf-8")
    else:
        put_into(here / "README.md", main(here / "results"))
