"""The examples run, and their pictures show something."""

import runpy
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")
EXAMPLES = Path(__file__).resolve().parent.parent.parent / "examples" / "python"


def run(monkeypatch, name, *arguments):
    monkeypatch.setattr(sys, "argv", [name, *map(str, arguments)])
    runpy.run_path(str(EXAMPLES / name), run_name="__main__")


def picture(file):
    from matplotlib.image import imread

    return imread(file)[..., :3]


@pytest.mark.parametrize(
    "name, arguments",
    [
        ("vertex_colours.py", ["--directions", 16]),
        ("point_cloud.py", ["--samples", 16]),
        ("compare_samplers.py", ["SCENE", "--budget", 1, "--samplers", "sobol", "--max-spp", 2]),
    ],
)
def test_examples_draw(monkeypatch, folder, tmp_path, capsys, name, arguments):
    arguments = [folder / "scene.toml" if each == "SCENE" else each for each in arguments]
    run(monkeypatch, name, *arguments, "-o", tmp_path / "out.png")
    drawn = picture(tmp_path / "out.png")
    assert drawn.std() > 0.02 and len(np.unique(drawn)) > 20
    assert capsys.readouterr().out
    if name == "vertex_colours.py":
        assert (tmp_path / "out.ply").stat().st_size > 7200 * 15
