"""What Python gets is what the commands give, bit by bit."""

import io

import numpy as np
import pytest

import nook
from conftest import FACES, VERTICES, points_beside


def probed(program, scene, points, normals, views=None, *flags):
    rows = np.hstack([points, normals] if views is None else [points, normals, views])
    text = io.StringIO()
    np.savetxt(text, rows, delimiter=",", fmt="%r")
    out = program("probe", scene, "--points", "-", *flags, input=text.getvalue())
    return np.loadtxt(io.StringIO(out), delimiter=",", skiprows=1, ndmin=2)


def assert_same(estimates, table):
    # Nine digits of a double are rounded once more to a float: its last bit may differ.
    np.testing.assert_array_almost_equal_nulp(estimates.value, table[:, 0].astype("float32"), 1)
    np.testing.assert_array_almost_equal_nulp(estimates.standard_error, table[:, 1].astype("float32"), 1)
    assert np.array_equal(estimates.samples, table[:, 2].astype("uint32"))


@pytest.mark.parametrize("sampler", ["sobol", "independent", "halton"])
def test_points_are_those_of_probe(program, folder, sampler):
    points, normals = points_beside(37)
    scene = nook.Scene(folder / "scene.toml")
    asked = scene.ao(points, normals, samples=128, sampler=sampler, seed=3)
    flags = ["--samples", 128, "--sampler", sampler, "--seed", 3]
    assert asked.value.dtype == np.float32 and 0.5 < asked.value.min() < asked.value.max() <= 1
    assert_same(asked, probed(program, folder / "scene.toml", points, normals, None, *flags))
    # The second call finds everything ready, and other settings between leave no trace.
    scene.ao(points, normals, samples=1, sampler=sampler)
    again = scene.ao(points, normals, samples=128, sampler=sampler, seed=3)
    assert all(np.array_equal(a, b) for a, b in zip(asked, again))


def test_reflections_are_those_of_probe(program, folder):
    points, normals = points_beside(20)
    views = np.tile([1.0, 2, 3], (20, 1))
    asked = nook.Scene(folder / "scene.toml").ro(points, normals, views, samples=64)
    # The scene's second effect has the exponent 50.
    flags = ["--effect", "ro", "--samples", 64]
    assert_same(asked, probed(program, folder / "scene.toml", points, normals, views, *flags))
    other = nook.Scene(folder / "scene.toml").ro(points, normals, views, samples=64, exponent=5)
    assert not np.array_equal(asked.value, other.value)


def test_arrays_are_the_files_mesh(folder):
    points, normals = points_beside(50)
    of_file = nook.Scene(folder / "pyramid.obj").ao(points, normals, samples=64)
    for vertices in (VERTICES, VERTICES.astype("float32"), np.asfortranarray(VERTICES), VERTICES.tolist()):
        for faces in (FACES, FACES.astype("uint8"), FACES[:, ::-1][:, ::-1]):
            of_arrays = nook.Scene(vertices=vertices, faces=faces).ao(points, normals, samples=64)
            assert np.array_equal(of_arrays.value, of_file.value)


def test_coordinates_of_maps_keep_their_digits():
    points, normals = points_beside(200)
    near = nook.Scene(vertices=VERTICES, faces=FACES).ao(points, normals)
    far = nook.Scene(vertices=VERTICES + 1e6, faces=FACES).ao(points + 1e6, normals)
    assert np.abs(near.value - far.value).max() < 0.001


def test_bent_normals_lean_away(folder):
    made = nook.Scene(folder / "scene.toml").bent([[1.2, 0, 0], [-1.2, 0, 0]], [[0, 2, 0]] * 2)
    assert made.direction.shape == (2, 3) and np.allclose(np.linalg.norm(made.direction, axis=1), 1, atol=1e-6)
    assert made.direction[0, 0] > 0.1 and made.direction[1, 0] < -0.1
    assert (made.half_angle < 90).all() and (made.value < 1).all()


def test_a_picture_is_that_of_render(program, folder):
    exr = folder / "command.exr"
    program("render", folder / "scene.toml", "-o", exr, "--no-png", "--aov", "normal,variance")
    scene = nook.Scene(folder / "scene.toml")
    for _ in range(2):
        picture = scene.render(aovs=["normal", "variance"])
        picture.save(folder / "python.exr")
        out = program("compare", exr, folder / "python.exr", "--fail", "0")
        assert "RMSE" in out
        assert picture.complete and picture.layers == ("ao", "gloss", "bent")
    assert picture["ao"].shape == (30, 40) and picture["ao"].dtype == np.float32
    assert picture["bent"].shape == picture["N"].shape == (30, 40, 3)
    assert np.array_equal(picture["ao"], picture["R"])
    assert picture["gloss"].max() > 0
    wider = scene.render(width=60, effects=[{"type": "normal"}, {"type": "depth"}])
    assert wider["normal"].shape == (30, 60, 3) and wider["depth"].shape == (30, 60)


def test_a_framed_picture_and_its_png(program, folder):
    mesh, command = folder / "pyramid.obj", folder / "framed.exr"
    program("render", mesh, "-o", command, "--size", "40x30", "--up", "z", "--view", "left", "--ground", "none", "--png")
    scene = nook.Scene(mesh, up=[0, 0, 1], view="left", max_distance="none", side="viewer", background="transparent")
    picture = scene.render(width=40, height=30)
    picture.save(folder / "framed_here.exr")
    program("compare", command, folder / "framed_here.exr", "--fail", "0")
    picture.save(folder / "framed_here.png")
    assert (folder / "framed_here.png").read_bytes() == command.with_suffix(".png").read_bytes()
    with pytest.raises(nook.UsageError, match="framed.jpg: not a format"):
        picture.save(folder / "framed.jpg")
    assert not (folder / "framed.jpg").exists()


def test_a_picture_to_an_error(program, folder):
    file = folder / "error.toml"
    file.write_text((folder / "scene.toml").read_text().split("[[effect]]")[0].replace("spp = 4", "error = 0.02"))
    picture = nook.Scene(file).render()
    assert picture.complete
    picture.save(folder / "error.exr")
    program("render", file, "-o", folder / "command_error.exr", "--no-png")
    program("compare", folder / "command_error.exr", folder / "error.exr", "--fail", "0")


def test_png(folder):
    picture = nook.Scene(folder / "scene.toml").render()
    picture.save(folder / "picture.png")
    assert (folder / "picture.png").read_bytes()[:4] == b"\x89PNG"
    assert picture._repr_png_()[:4] == b"\x89PNG"


def test_points_to_an_error():
    points, normals = points_beside(200)
    scene = nook.Scene(vertices=VERTICES, faces=FACES)
    for error in (0.02, 0.002):
        made = scene.ao(points, normals, error=error)
        truth = scene.ao(points, normals, samples=1 << 15, seed=9).value
        assert made.standard_error.max() <= error and set(made.samples) <= {256, 1024, 4096, 16384, 65536}
        assert np.mean(np.abs(made.value - truth) < 1.96 * made.standard_error) > 0.9
    assert len(set(made.samples)) > 1 and made.samples.min() < made.samples.max()
    # The first round is that of 256 samples.
    first, few = scene.ao(points, normals, samples=256), made.samples == 256
    assert np.array_equal(made.value[few], first.value[few])
    bent = scene.bent(points, normals, error=0.01)
    assert bent.direction.shape == (200, 3) and np.allclose(np.linalg.norm(bent.direction, axis=1), 1, atol=1e-6)
    for wrong, says in (({"error": 0}, "error: 0.0 is not"), ({"error": 0.1, "samples": 4}, "error: decides itself")):
        with pytest.raises(nook.UsageError, match=says):
            scene.ao(points, normals, **wrong)
    with pytest.warns(nook.SceneWarning, match=r"error: [12] of 2 points have a larger one after 262144 directions"):
        nook.Scene(vertices=VERTICES, faces=FACES).ao(points[:2], normals[:2], error=1e-4, sampler="independent")
