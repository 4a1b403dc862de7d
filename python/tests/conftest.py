"""What the tests share: the program beside the module, and a small scene."""

import os
import subprocess

import numpy as np
import pytest

SCENE = """
[input]
objfile = "pyramid.obj"
[camera]
eye = [3, 3, 4]
at = [0, 0.5, 0]
[film]
width = 40
height = 30
[renderer]
spp = 4
[[effect]]
type = "ao"
[[effect]]
type = "ro"
name = "gloss"
exponent = 50
[[effect]]
type = "bent"
"""

# A floor and a pyramid on it.
VERTICES = np.array(
    [[-3, 0, -3], [3, 0, -3], [3, 0, 3], [-3, 0, 3], [-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1], [0, 1.5, 0]],
    dtype="float64",
)
FACES = np.array([[0, 3, 2], [0, 2, 1], [4, 8, 5], [5, 8, 6], [6, 8, 7], [7, 8, 4]])


def write_obj(path):
    rows = ["v %r %r %r\n" % tuple(map(float, v)) for v in VERTICES]
    rows += ["f %d %d %d\n" % tuple(f + 1) for f in FACES]
    path.write_text("".join(rows))


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("scene")
    write_obj(made / "pyramid.obj")
    (made / "scene.toml").write_text(SCENE)
    return made


@pytest.fixture(scope="session")
def program():
    def run(*arguments, **keywords):
        done = subprocess.run(
            [os.environ["NOOK_PROGRAM"], *map(str, arguments)], capture_output=True, text=True, **keywords
        )
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run


def points_beside(count, seed=1):
    """Points of the floor around the pyramid."""
    random = np.random.default_rng(seed)
    points = np.zeros((count, 3))
    points[:, 0] = random.uniform(1.05, 2.5, count) * random.choice([-1, 1], count)
    points[:, 2] = random.uniform(-2.5, 2.5, count)
    return points, np.tile([0.0, 1, 0], (count, 1))
