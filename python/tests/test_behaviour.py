"""Errors, threads, signals, forks: what a program around nook meets."""

import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import nook
from conftest import FACES, VERTICES, points_beside

NAN = float("nan")


@pytest.fixture(scope="module")
def scene():
    return nook.Scene(vertices=VERTICES, faces=FACES)


@pytest.mark.parametrize(
    "points, normals, says",
    [
        ([[0, 0, NAN]], [[0, 1, 0]], "points: row 0 is not finite"),
        ([[0, 0, 0], [0, 1e39, 0]], [[0, 1, 0]] * 2, "points: row 1 is not finite"),
        ([[0, 0]], [[0, 1, 0]], r"points: an array of shape \(n, 3\) is needed, not \(1, 2\)"),
        ([[0, 0, 0]], [[0, 1, 0]] * 2, "normals: 2 rows, and 1 points"),
        ([[0, 0, 0]] * 2, [[0, 1, 0], [0, 0, 0]], "normals: row 1 is zero"),
        ([["a", "b", "c"]], [[0, 1, 0]], "points: an array of numbers is needed"),
        (np.zeros((0, 3)), np.zeros((0, 3)), "points: there are no points"),
    ],
)
def test_wrong_points(scene, points, normals, says):
    with pytest.raises(ValueError, match=says):
        scene.ao(points, normals)


@pytest.mark.parametrize(
    "vertices, faces, says",
    [
        (VERTICES, [[0, 1, 9]], "faces: row 0 names a vertex outside 0 to 8"),
        (VERTICES, [[0, 1, 2], [0, -1, 2]], "faces: row 1 names a vertex"),
        (VERTICES, [[0.0, 1, 2]], "faces: an array of integers"),
        (VERTICES, np.zeros((0, 3), int), "faces: there is no triangle"),
        ([[0, 0, 0], [1, NAN, 0], [1, 0, 0]], [[0, 1, 2]], "vertices: row 1 is not finite"),
        (VERTICES, None, "faces: are missing"),
    ],
)
def test_wrong_meshes(vertices, faces, says):
    with pytest.raises(ValueError, match=says):
        nook.Scene(vertices=vertices, faces=faces)


@pytest.mark.parametrize(
    "settings, says",
    [
        ({"smapler": "sobol"}, "unknown key 'smapler' in a scene, did you mean 'sampler'"),
        ({"sampler": "sobl"}, "unknown sampler 'sobl', did you mean 'sobol'"),
        ({"spp": 0}, "spp must be an integer from 1 to"),
        ({"spp": 1.5}, "spp must be an integer"),
        ({"exponent": 3}, "exponent: the scene has no effect of type ro"),
        ({"spp": 2, "error": 0.1}, "spp and error or time exclude one another"),
        ({"error": 0.1, "sampler": "zorder"}, "error: works with sampler"),
        ({"max_distance": -1}, "max_distance must be a distance of at least 0"),
        ({"cutouts": True}, "unknown key 'cutouts'"),
        ({"weight": "uniform", "sampling_type": "cosine"}, "weight: \"uniform\" needs"),
        ({"up": [0, 0, 0], "eye": [1, 1, 1]}, "up is zero"),
    ],
)
def test_wrong_settings_are_told_as_a_scene_file_s(scene, settings, says):
    with pytest.raises(nook.Error, match=says):
        scene.render(**settings)


def test_errors_have_places(tmp_path):
    (tmp_path / "bad.toml").write_text('[input]\nobjfile = "x.obj"\n[renderer]\n  tpye = "ao"\n')
    with pytest.raises(nook.SceneError, match=r"bad.toml:4:3: unknown key 'tpye'") as caught:
        nook.Scene(tmp_path / "bad.toml")
    assert caught.value.file == str(tmp_path / "bad.toml")
    assert (caught.value.row, caught.value.column) == (4, 3)
    with pytest.raises(nook.DeviceError):
        nook.Scene(vertices=VERTICES, faces=FACES, device="no such device").ao([[0, 0, 0]], [[0, 1, 0]])
    with pytest.raises(nook.OutputError):
        nook.Scene(vertices=VERTICES, faces=FACES).render(width=8, height=8).save("/proc/none/x.exr")


def test_meshes_warnings_are_pythons(tmp_path):
    (tmp_path / "bow.obj").write_text("v 0 0 0\nv 1 0 1\nv 1 0 0\nv 0 0 1\nf 1 2 3 4\n")
    with pytest.warns(nook.SceneWarning, match="bow.obj:5"):
        nook.Scene(tmp_path / "bow.obj")


def test_closed(scene):
    with nook.Scene(vertices=VERTICES, faces=FACES) as inside:
        inside.ao([[0, 0, 2]], [[0, 1, 0]], samples=1)
    with pytest.raises(nook.UsageError, match="closed"):
        inside.ao([[0, 0, 2]], [[0, 1, 0]])


def test_a_pickled_scene_is_made_again(folder, scene):
    points, normals = points_beside(9)
    for made in (scene, nook.Scene(folder / "scene.toml", seed=5)):
        again = pickle.loads(pickle.dumps(made))
        assert again.to_toml() == made.to_toml()
        assert np.array_equal(again.ao(points, normals, samples=32).value, made.ao(points, normals, samples=32).value)


def test_progress_is_told_and_can_end_it(scene):
    points, normals = points_beside(20000)
    told = []
    scene.ao(points, normals, samples=256, progress=lambda *now: told.append(now))
    assert told and told[-1][0] <= told[-1][1] == 20000 * 256

    def stop(*_):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        scene.ao(points, normals, samples=2048, progress=stop)
    assert scene.ao(points[:2], normals[:2], samples=16).value.shape == (2,)


def test_ctrl_c_ends_an_estimate_soon_and_leaves_the_scene_usable(scene):
    points, normals = points_beside(100000)
    scene.ao(points[:1], normals[:1])
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        scene.ao(points, normals, samples=1 << 16)  # minutes
    assert 0.4 < time.monotonic() - begin < 1.5
    assert scene.ao(points[:2], normals[:2], samples=16).value.shape == (2,)


def test_two_threads(scene):
    points, normals = points_beside(300)
    alone = scene.ao(points, normals, samples=64).value
    results = {}

    def work(number, which):
        results[number] = which.ao(points, normals, samples=64).value

    scenes = [scene, scene, nook.Scene(vertices=VERTICES, faces=FACES)]
    threads = [threading.Thread(target=work, args=each) for each in enumerate(scenes)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(results[i], alone) for i in range(3))


def one_point(made):
    return made.ao([[0, 0, 2]], [[0, 1, 0]], samples=16).value[0]


def test_a_fork_after_opencl_was_used_is_told(scene):
    expected = one_point(scene)
    with multiprocessing.get_context("fork").Pool(1) as pool:
        with pytest.raises(nook.DeviceError, match="spawn.*forkserver"):
            pool.apply_async(one_point, (scene,)).get(timeout=20)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.apply_async(one_point, (scene,)).get(timeout=60) == expected


FORKED_BEFORE = """
import multiprocessing, nook, sys
sys.path.insert(0, {here!r})
from conftest import VERTICES, FACES
scene = nook.Scene(vertices=VERTICES, faces=FACES)
def work(_): return scene.ao([[0, 0, 2]], [[0, 1, 0]], samples=16).value[0]
with multiprocessing.get_context("fork").Pool(2) as pool:
    there = pool.map(work, range(2))
assert there == [work(0)] * 2
"""


def test_a_fork_before_opencl_was_used_works():
    text = FORKED_BEFORE.format(here=os.path.dirname(__file__))
    subprocess.run([sys.executable, "-c", text], check=True, timeout=60)


def test_importing_loads_no_opencl_and_no_numpy():
    text = "import sys, nook; assert 'numpy' not in sys.modules; print(open('/proc/self/maps').read())"
    maps = subprocess.run([sys.executable, "-c", text], check=True, capture_output=True, text=True).stdout
    assert "libOpenCL" not in maps and "_core" in maps


def test_a_wrong_number_of_threads_is_told(folder):
    code = "import nook\ntry: nook.devices()\nexcept nook.UsageError as error: print(error)"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, env={**os.environ, "NOOK_THREADS": "two"}
    )
    assert done.stdout == "NOOK_THREADS: 'two' is not a number of threads\n", done.stderr


def test_processes_started_from_here_have_folders_of_their_own(scene, program, folder):
    one_point(scene)  # sets POCL_CACHE_DIR for this process and, as it seems, for those that it starts
    code = "import nook, ctypes; nook.devices(); g = ctypes.CDLL(None).getenv; g.restype = ctypes.c_char_p; " \
           "print(g(b'POCL_CACHE_DIR'))"
    shown = {subprocess.run([sys.executable, "-c", code], check=True, capture_output=True).stdout for _ in range(2)}
    import ctypes

    getenv = ctypes.CDLL(None).getenv
    getenv.restype = ctypes.c_char_p
    assert len(shown) == 2 and repr(getenv(b"POCL_CACHE_DIR")).encode() + b"\n" not in shown


def test_devices():
    assert all({"selector", "name", "type"} <= device.keys() for device in nook.devices())
