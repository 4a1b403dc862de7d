"""What is installed: types that mypy accepts, a wheel that pip takes."""

import importlib.util
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

import nook

HERE = Path(__file__).resolve().parent.parent
PACKAGE = Path(nook.__file__).parent

CALLS = """
import numpy as np
import nook

scene = nook.Scene(vertices=np.zeros((3, 3)), faces=np.zeros((1, 3), int), up=[0, 0, 1])
made: nook.Estimates = scene.ao(np.zeros((1, 3)), np.ones((1, 3)), samples=16, max_distance=2, progress=True)
picture: nook.Picture = scene.render(spp=4)
picture.save("x.exr")
table: dict[str, object] = nook.study(scene, 30).columns
selectors: list[object] = [device["selector"] for device in nook.devices()]
"""


def test_types(tmp_path):
    mypy = shutil.which("mypy") or pytest.skip("mypy is not installed")
    (tmp_path / "calls.py").write_text(CALLS)
    for wrong, says in ((1, ""), (0, '"samples" to "ao" of "Scene" has incompatible type "str"')):
        text = CALLS if wrong else CALLS.replace("samples=16", 'samples="16"')
        (tmp_path / "calls.py").write_text(text)
        done = subprocess.run(
            [mypy, "--config-file", HERE.parent / "pyproject.toml", "--cache-dir", tmp_path, HERE / "nook", tmp_path / "calls.py"],
            capture_output=True,
            text=True,
        )
        assert (done.returncode == 0) == bool(wrong) and says in done.stdout, done.stdout + done.stderr


def test_everything_public_is_told():
    for name in nook.__all__:
        assert getattr(nook, name).__doc__, name
    told = nook.Scene.ao.__doc__
    for word in ("1/pi int V(p, w) N.w dw", "(n, 3), world units", "solid angle", "Raises UsageError", "Owen 1997"):
        assert word in told, word
    for key in ('max_distance = "auto": How far', 'sampler = "sobol": The point sequence', "cone_angle = 90"):
        assert key in told, key
    assert "exponent = 30" in nook.Scene.ro.__doc__ and "exponent = 30" not in told
    assert "fov = 30: Vertical field of view" in nook.Scene.render.__doc__


def test_a_wheel_can_be_installed(tmp_path):
    spec = importlib.util.spec_from_file_location("nook_wheel", HERE / "backend" / "nook_wheel.py")
    backend = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(backend)
    name = backend.pack(PACKAGE, tmp_path)
    assert name.startswith("nook-0.1.0-cp311-abi3-linux_") and (tmp_path / name).stat().st_size < 10e6
    assert backend.prepare_metadata_for_build_wheel(tmp_path) == "nook-0.1.0.dist-info"
    with zipfile.ZipFile(tmp_path / name) as wheel:
        names = set(wheel.namelist())
    assert {"nook/_core.abi3.so", "nook/__init__.py", "nook/py.typed", "nook/_core.pyi"} <= names
    if subprocess.run([sys.executable, "-m", "pip", "--version"], capture_output=True).returncode:
        pytest.skip("pip is not installed")
    install = [sys.executable, "-m", "pip", "install", "-q", "--no-index", "--no-deps", "--target", tmp_path / "there"]
    subprocess.run([*install, tmp_path / name], check=True)
    code = "import nook; print(nook.__file__)"
    there = subprocess.run([sys.executable, "-c", code], cwd=tmp_path / "there", env={"PYTHONPATH": "."}, check=True, capture_output=True, text=True)
    assert str(tmp_path) in there.stdout

