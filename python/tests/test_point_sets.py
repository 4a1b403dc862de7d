"""One's own point sets: what their points become is computed here, in double precision."""

import numpy as np
import pytest

import nook

# A wall along x = 1 that reaches far: seen from the origin it hides what leans towards it by less than its
# angle.
HEIGHT = 2.0
WALL = np.array([[1, -1e4, -1e4], [1, 1e4, -1e4], [1, 1e4, HEIGHT], [1, -1e4, HEIGHT]])
WALL_FACES = np.array([[0, 1, 2], [0, 2, 3]])
# Seen over the wall from the origin: (1 + sin(angle to the vertical)) / 2.
TRUTH = 0.5 * (1 + 1 / np.hypot(1, HEIGHT))


@pytest.fixture(scope="module")
def scene():
    return nook.Scene(vertices=WALL, faces=WALL_FACES, max_distance="none")


def sobol(count):
    """The first two dimensions of Sobol's sequence, unscrambled, a power of two of points."""
    bits = int(np.log2(count))
    index = np.arange(count)
    x, y = np.zeros(count, dtype=int), np.zeros(count, dtype=int)
    column = 1 << (bits - 1)
    for b in range(bits):
        bit = index >> b & 1
        x ^= bit << (bits - 1 - b)
        y ^= bit * column
        column ^= column >> 1
    return np.stack([x, y], 1) / count


def directions(points):
    """Shirley and Chiu 1997, lifted to the hemisphere by the cosine, about +z."""
    a, b = 2 * points.T - 1 + 2.0**-24
    leads = np.abs(a) > np.abs(b)
    r = np.where(leads, a, b)
    phi = np.where(leads, np.pi / 4 * b / np.where(leads, a, 1), np.pi / 2 - np.pi / 4 * a / np.where(leads, 1, b))
    x, y = r * np.cos(phi), r * np.sin(phi)
    return np.stack([x, y, np.sqrt(1 - x * x - y * y)], 1)


def open_share(points):
    d = directions(points)
    return np.mean(~((d[:, 0] > 0) & (d[:, 2] < HEIGHT * d[:, 0])))


def test_a_set_as_it_is_gives_what_its_points_give(scene):
    for points in (sobol(256), np.random.default_rng(3).random((777, 2))):
        made = scene.ao([[0, 0, 0]] * 3, [[0, 0, 1]] * 3, sampler=points, shift=False)
        assert np.allclose(made.value, open_share(np.floor(points * 2**24) / 2**24), atol=1.01 / len(points))
        assert (made.value == made.value[0]).all() and np.isnan(made.standard_error).all()
        assert (made.samples == len(points)).all()


def test_a_shifted_set_is_unbiased_and_tells_its_error(scene):
    rows = 4096
    at, normals = np.zeros((rows, 3)), np.tile([0.0, 0, 1], (rows, 1))
    once = scene.ao(at, normals, sampler=sobol(64))
    assert np.isnan(once.standard_error).all() and np.unique(once.value).size > 4
    assert abs(once.value.mean() - TRUTH) < 4 * once.value.std() / np.sqrt(rows)
    often = scene.ao(at, normals, sampler=sobol(64), samples=16 * 64)
    assert (often.samples == 1024).all() and 0.93 < np.mean(
        np.abs(often.value - TRUTH) < 1.96 * often.standard_error
    ) < 0.97
    # Sobol's points, shifted, are as good as those that nook scrambles itself, and better than random ones.
    ours = scene.ao(at, normals, sampler="sobol", samples=64).value.std()
    assert 0.5 < once.value.std() / ours < 2
    random = scene.ao(at, normals, sampler=np.random.default_rng(1).random((64, 2))).value.std()
    assert once.value.std() < 0.6 * random
    assert not np.array_equal(once.value, scene.ao(at, normals, sampler=sobol(64), seed=1).value)


@pytest.mark.parametrize(
    "keywords, says",
    [
        ({"sampler": [[0.5, 1.0]]}, r"sampler: row 0 is not in \[0, 1\)\^2"),
        ({"sampler": [[0.5, -0.1]]}, "sampler: row 0 is not in"),
        ({"sampler": [[0.5, np.nan]]}, "sampler: row 0 is not finite"),
        ({"sampler": np.zeros((0, 2))}, "sampler: there are no points"),
        ({"sampler": np.zeros((4, 3))}, r"sampler: an array of shape \(n, 2\)"),
        ({"sampler": np.zeros((4, 2)), "samples": 6}, "samples: 6 is no multiple of the 4 points"),
        ({"sampler": np.zeros((4, 2)), "samples": 8, "shift": False}, "samples: 8 is not the number of points"),
        ({"shift": False}, "shift: is of an array of points"),
        ({"shift": 1}, "shift: True or False"),
    ],
)
def test_wrong_sets(scene, keywords, says):
    with pytest.raises(nook.UsageError, match=says):
        scene.ao([[0, 0, 0]], [[0, 0, 1]], **keywords)
