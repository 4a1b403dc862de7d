#!/usr/bin/env python3
"""How far off effects are where a triangle is much larger than what is of interest beside it, and from which
ratio on nook warns of it: the table of docs/hard-cases.md.

    docs/proportions.py build/bin/nook [CASE]...

Each case has a closed form. Its triangles' extent is a multiple of a distance of interest of 1 (`ratio`),
upright and in three rotations, of which the worst counts. Ends with 1 if a value is off by more than .001
without a warning.
"""
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

RATIOS = [1e4, 5e4, 1e5, 3e5, 1e6, 1e7, 1e8, 1e9, 3e9, 1e10]
AO = 'type = "ao"\nsampler = "sobol"\n'


def rotation(seed):
    """Upright for 0; else random, from a unit quaternion."""
    if seed == 0:
        return [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    rng = random.Random(seed)
    q = [rng.gauss(0, 1) for _ in range(4)]
    w, x, y, z = (c / math.sqrt(sum(v * v for v in q)) for c in q)
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]


class Trial:
    """A scene of quads in a folder, rotated, and what nook makes of it."""

    def __init__(self, nook, folder, turn):
        self.nook, self.folder, self.turn = nook, pathlib.Path(folder), turn
        self.quads = []

    def placed(self, p):
        return [sum(a * b for a, b in zip(row, p)) for row in self.turn]

    def quad(self, *corners):
        self.quads.append([self.placed(c) for c in corners])

    def plane(self, height, extent):
        """About the y-axis, but with its middle elsewhere: rounding leaves a symmetric one's plane."""
        a, b, c, d = -.37 * extent, .63 * extent, -.435 * extent, .565 * extent
        self.quad((a, height, c), (a, height, d), (b, height, d), (b, height, c))

    def scene(self, renderer, camera=""):
        corners = [p for quad in self.quads for p in quad]
        lines = ["v %.17g %.17g %.17g" % tuple(p) for p in corners]
        lines += ["f %d %d %d %d" % tuple(range(4 * i + 1, 4 * i + 5)) for i in range(len(self.quads))]
        (self.folder / "mesh.obj").write_text("\n".join(lines) + "\n")
        (self.folder / "scene.toml").write_text(
            f'[input]\nobjfile = "mesh.obj"\n{camera}[film]\nwidth = 16\nheight = 16\n[renderer]\n{renderer}\n')

    def run(self, *arguments, text=""):
        """Its stdout, and whether it warned."""
        done = subprocess.run([self.nook, arguments[0], self.folder / "scene.toml", *arguments[1:]], input=text,
                              capture_output=True, text=True, check=True)
        return done.stdout, "warning: " in done.stderr

    def probe(self, *vectors):
        row = ",".join("%.17g" % x for v in vectors for x in self.placed(v))
        out, warned = self.run("probe", "--points", "-", "--samples", "65536", text=row + "\n")
        return float(out.splitlines()[1].split(",")[0]), warned

    def render(self, file):
        return self.run("render", "-o", self.folder / file, "--no-png")[1]

    def mean_difference(self, file, reference):
        done = subprocess.run([self.nook, "compare", self.folder / file, self.folder / reference, "--json"],
                              capture_output=True, text=True)
        return json.loads(done.stdout)["channels"][0]["mean_difference"]


def ceiling(trial, ratio):
    """A ceiling 1 above a point, max_distance 2."""
    trial.plane(1, 2 * ratio)
    trial.scene(AO + "max_distance = 2.0")
    value, warned = trial.probe((0, 0, 0), (0, 1, 0))
    return value - .25, warned


def corridor(trial, ratio, renderer=AO + 'max_distance = "none"', exact=math.sqrt(.5), view=()):
    """A floor between walls at x = -1 and 1 of height 1, AO."""
    half = ratio / 2
    for x in (-1, 1):
        trial.quad((x, 0, -half), (x, 0, half), (x, 1, half), (x, 1, -half))
    trial.scene(renderer)
    value, warned = trial.probe((0, 0, 0), (0, 1, 0), *view)
    return value - exact, warned


def reflection(trial, ratio):
    """The same, RO of exponent 1, the mirror direction 20 degrees off the normal."""
    t = math.radians(20)
    return corridor(trial, ratio, 'type = "ro"\nsampler = "sobol"\nexponent = 1', .76896,
                    [(-math.sin(t), math.cos(t), 0)])


def small(trial, ratio):
    """A square lid over a point of a floor, AO; the lid's extent is 1."""
    trial.plane(0, ratio)
    trial.quad((-.5, .5, -.5), (.5, .5, -.5), (.5, .5, .5), (-.5, .5, .5))
    trial.scene(AO + 'max_distance = "none"')
    value, warned = trial.probe((0, 0, 0), (0, 1, 0))
    return value - (1 - 4 * math.sqrt(.5) * math.atan(math.sqrt(.5)) / math.pi), warned


def rendered(trial, ratio):
    """A floor with a ceiling .5 above it, max_distance 1, seen from .25 above the floor; .25 at any ratio."""
    eye, at, up = (trial.placed(v) for v in ((0, .25, 0), (5, -4.75, 1.5), (0, 1, 0)))
    for extent, file in ((100, "reference.exr"), (ratio, "picture.exr")):
        trial.quads.clear()
        trial.plane(0, extent)
        trial.plane(.5, extent)
        trial.scene(AO + "max_distance = 1.0\nspp = 64\ndirections = 16",
                    f"[camera]\neye = {eye}\nat = {at}\nup = {up}\nfov = 40\n")
        warned = trial.render(file)
    return trial.mean_difference("picture.exr", "reference.exr"), warned


CASES = {c.__name__: c for c in (ceiling, corridor, reflection, small, rendered)}


def main():
    nook, names = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:] or list(CASES)
    silent = 0
    print("| case | " + " | ".join("%.0e" % ratio for ratio in RATIOS) + " |")
    print("|---|" + "---:|" * len(RATIOS))
    for name in names:
        for label, seeds in (("upright", [0]), ("turned", [1, 2, 3])):
            cells = []
            for ratio in RATIOS:
                worst, warnings = 0, 0
                for seed in seeds:
                    with tempfile.TemporaryDirectory() as folder:
                        bias, warned = CASES[name](Trial(nook, folder, rotation(seed)), ratio)
                    worst, warnings = max(worst, abs(bias)), warnings + warned
                    silent += abs(bias) > .001 and not warned
                cells.append(("%.4f" % worst)[1:] + (" w" if warnings == len(seeds) else " (w)" if warnings else ""))
            print(f"| {name}, {label} | " + " | ".join(cells) + " |", flush=True)
    return 1 if silent else 0


if __name__ == "__main__":
    sys.exit(main())
