"""Random arguments end in a result or in a documented exception. NOOK_TEST_ARGUMENTS: how many sets (300)."""

import os
import warnings

import numpy as np
import pytest

hypothesis = pytest.importorskip("hypothesis")
from hypothesis import HealthCheck, given, settings, strategies as st  # noqa: E402

import nook  # noqa: E402
from conftest import FACES, VERTICES  # noqa: E402

COUNT = int(os.environ.get("NOOK_TEST_ARGUMENTS", "300"))
KEYS = sorted({key["name"] for key in nook._core.keys()} | {"effects", "ground", "shift", "size", "nonsense"})
EXPECTED = (nook.Error, ValueError, TypeError)

numbers = st.one_of(
    st.integers(-3, 70), st.sampled_from([2**31, 2**32, 2**63, -(2**63), 2**80]), st.floats(width=32), st.floats()
)
words = st.sampled_from(
    "ao ro bent ssao depth sobol halton independent zorder cosine sphere lobe uniform auto none all self material "
    "inside viewer linear front z white #123 tinyrender".split()
) | st.text(max_size=5)
plain = st.none() | st.booleans() | numbers | words
shapes = st.tuples(st.integers(0, 4), st.integers(0, 4)) | st.sampled_from([(3,), (2, 3), (1, 3), (4, 2), ()])
dtypes = st.sampled_from(["f8", "f4", "f2", "i8", "u1", "i2", "b1", "c8", "U2", "O"])


@st.composite
def arrays(draw):
    shape, dtype = draw(shapes), draw(dtypes)
    values = draw(st.lists(st.sampled_from([0, 1, -1, 0.5, 2, 1e-30, 1e30, 1e300, np.nan, np.inf]), min_size=16, max_size=16))
    with np.errstate(all="ignore"), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        array = np.resize(np.array(values), shape)
        if dtype[0] in "iub":
            array = np.nan_to_num(array, posinf=3, neginf=0) % 5
        array = array.astype(dtype)
    return array[::-1] if draw(st.booleans()) and array.ndim else array


good = st.just(np.array([[0.0, 0, 2], [1.5, 0, 0.5]]))
vectors = st.one_of(good, good, good, arrays(), plain, st.lists(numbers, max_size=4))
values = st.one_of(plain, plain, arrays(), st.lists(plain, max_size=4), st.dictionaries(words, plain, max_size=2))
keywords = st.dictionaries(st.sampled_from(KEYS), values, max_size=3)
limits = dict(max_examples=COUNT, deadline=None, suppress_health_check=list(HealthCheck), database=None)


def end_well(call):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return call()
        except EXPECTED as error:
            assert not isinstance(error, nook.InternalError), error
            assert str(error) and "\n" not in str(error)


@pytest.fixture(scope="module")
def scene():
    return nook.Scene(vertices=VERTICES, faces=FACES, width=8, height=6)


@settings(**limits)
@given(vectors, vectors, vectors, st.sampled_from(["ao", "ro", "bent"]), st.none() | st.integers(0, 64) | plain, keywords)
def test_points(scene, points, normals, views, kind, samples, more):
    arguments = (points, normals, views) if kind == "ro" else (points, normals)
    made = end_well(lambda: getattr(scene, kind)(*arguments, **{"samples": samples, **more}))
    if made is not None:
        assert np.isfinite(made.value).all()


@settings(**{**limits, "max_examples": COUNT // 3})
@given(vectors, arrays() | st.just(FACES[2:, ::-1] % 2) | plain, st.none() | vectors, keywords)
def test_scenes(vertices, faces, normals, more):
    made = end_well(lambda: nook.Scene(vertices=vertices, faces=faces, normals=normals, **more))
    if made is not None:
        assert made.info["triangles"] > 0 and made.to_toml()


def small(more):
    """Nothing that takes long: a picture of few pixels and samples."""
    return {key: value for key, value in more.items() if key not in ("width", "height", "spp", "directions", "time", "error", "max_spp")}


@settings(**{**limits, "max_examples": COUNT // 6})
@given(keywords, st.sampled_from(["render", "bake"]), st.lists(words, max_size=2) | plain)
def test_pictures_and_bakes(scene, more, what, aovs):
    if what == "render":
        made = end_well(lambda: scene.render(**{"aovs": aovs, **small(more)}))
    else:
        made = end_well(lambda: scene.bake(**{"to": aovs, "directions": 8, **small(more)}))
    if made is not None:
        assert all(np.asarray(made[name]).size for name in made)
