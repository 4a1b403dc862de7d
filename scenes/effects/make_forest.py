#!/usr/bin/env python3
"""Writes forest.toml: oaks and firs, each mesh placed hundreds of times on a ground.

Standard library alone; the same bytes every time. The scene is kept beside it, so that nobody needs to run it."""
import math
import pathlib
import random

FOLDER = pathlib.Path(__file__).parent
ROWS, COLUMNS, STEP = 20, 20, 1.55

HEAD = """# Two trees placed {count} times, written by make_forest.py: nook keeps each mesh once, and a tree of boxes over the places.
instance = [
"""

TAIL = """]

[ground]
height = 0.0
reach = 60.0

[camera]
eye = [ 1.5, 7.5, 13.0 ]
at = [ 0.0, 0.6, 0.0 ]
up = [ 0.0, 1.0, 0.0 ]
fov = 42.0

[film]
width = 640
height = 400

[renderer]
type = "ao"
spp = 64
max_distance = 4.0
side = "viewer"
"""


def placed(rng, row, column):
    """One line, or none in the clearing."""
    x, z = ((i - n / 2 + 0.5 + rng.uniform(-0.35, 0.35)) * STEP for i, n in ((column, COLUMNS), (row, ROWS)))
    firs = 0.5 + 0.5 * math.sin(0.35 * x + 1.0) * math.cos(0.3 * z)
    name = "fir" if rng.random() < firs else "oak"
    turn, size, height = rng.uniform(0, 360), rng.uniform(0.7, 1.15), rng.uniform(0.85, 1.2)
    if math.hypot(x - 1.0, z - 4.0) < 2.6:
        return None
    mirror = -1 if rng.random() < 0.5 else 1
    return (f'  {{ objfile = "../generated/{name}.obj", translate = [{x:.2f}, 0.0, {z:.2f}], rotate = [0.0, {turn:.0f}.0, 0.0], '
            f"scale = [{mirror * size:.2f}, {size * height:.2f}, {size:.2f}] }},")


def main():
    rng = random.Random(2016)
    lines = [line for row in range(ROWS) for column in range(COLUMNS) if (line := placed(rng, row, column))]
    (FOLDER / "forest.toml").write_text(HEAD.format(count=len(lines)) + "\n".join(lines) + "\n" + TAIL)


main()
