"""Plans, infos and studies: what the commands print, as dicts and arrays; and pictures that say how to make
them again."""

import csv
import json
import subprocess

import numpy as np
import pytest

import nook
from conftest import FACES, VERTICES


def test_plan_and_info_are_the_commands(program, folder):
    scene = nook.Scene(folder / "scene.toml")
    assert scene.plan == json.loads(program("plan", folder / "scene.toml", "--json"))
    info = scene.info
    assert info == json.loads(program("info", folder / "scene.toml", "--json"))
    assert info["triangles"] == 6 and info["bounds"] == [[-3, 0, -3], [3, 1.5, 3]] and info["spp"] == 4
    assert [effect["name"] for effect in info["effects"]] == ["ao", "gloss", "bent"]
    assert info["effects"][1]["max_distance"] is None and info["effects"][0]["max_distance"] > 0
    text = program("info", folder / "scene.toml")
    assert "triangles         6\n" in text and "effect            gloss: " in text
    arrays = nook.Scene(vertices=VERTICES + 1e6, faces=FACES)
    assert arrays.info["bounds"][0] == [1e6 - 3, 1e6, 1e6 - 3] and "frame" in arrays.info
    assert arrays.plan["triangles"] == 6


def test_plan_and_info_load_no_opencl():
    import os
    import sys

    here = os.path.dirname(__file__)
    code = (
        f"import sys; sys.path.insert(0, {here!r}); import nook; from conftest import *\n"
        "scene = nook.Scene(vertices=VERTICES, faces=FACES); scene.plan; scene.info\n"
        "assert 'libOpenCL' not in open('/proc/self/maps').read()"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("keywords", [{}, {"error": 0.02, "type": "ao"}, {"aovs": ["normal", "variance"]}])
def test_saved_pictures_can_be_made_again(program, folder, keywords):
    picture = nook.Scene(folder / "scene.toml").render(seed=3, **keywords)
    picture.save(folder / "first.exr")
    program("render", folder / "first.exr", "-o", folder / "again.exr", "--no-png")
    program("compare", folder / "first.exr", folder / "again.exr", "--fail", "0")


def test_a_framed_picture_can_be_made_again(program, folder):
    nook.Scene(folder / "pyramid.obj", ground=True, view="left").render(width=40, height=30, spp=2).save(folder / "f.exr")
    program("render", folder / "f.exr", "-o", folder / "again.exr", "--no-png")
    program("compare", folder / "f.exr", folder / "again.exr", "--fail", "0")


def test_a_picture_of_arrays_says_why_it_cannot(folder):
    import os

    nook.Scene(vertices=VERTICES, faces=FACES).render(width=8, height=6, spp=1).save(folder / "arrays.exr")
    done = subprocess.run(
        [os.environ["NOOK_PROGRAM"], "render", folder / "arrays.exr", "-o", folder / "x.exr"],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 3 and "its mesh was given as arrays" in done.stderr
    assert done.stderr.count("\n") == 1


@pytest.fixture(scope="module")
def study(folder):
    scene = nook.Scene(folder / "scene.toml")
    told = []
    made = nook.study(
        scene, 3, samplers=["sobol", "independent"], samplings="cosine", max_spp=16, width=32, height=24,
        folder=folder / "study", gallery=False, progress=lambda *now: told.append(now),
    )  # fmt: skip
    assert told and all(now[0] <= now[1] for now in told)
    return made


def test_a_study_is_its_table(study, folder):
    with open(folder / "study" / "study.csv") as table:
        rows = list(csv.DictReader(table))
    assert study.columns["method"].tolist() == [row["method"] for row in rows]
    assert np.allclose(study.columns["rmse"], [float(row["rmse"]) for row in rows])
    assert study.columns["directions"].dtype == np.int64 and len({len(each) for each in study.columns.values()}) == 1
    # How many of them the budget allows depends on the machine.
    assert {"sobol", "independent", ""} >= set(study.columns["sampler"]) and set(study.columns["sampling"]) <= {"cosine", ""}
    assert {method["name"] for method in study.data["methods"]} >= {"cosine sobol", "cosine independent"}
    assert (folder / "study" / "index.html").stat().st_size > 10000
    assert 0 < study.columns["rmse"][0] < 1 and study.columns["wall_seconds"].min() > 0


def test_a_study_without_a_folder_writes_nothing(folder, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    made = nook.study(nook.Scene(vertices=VERTICES, faces=FACES), 1, samplers="sobol", max_spp=2, width=16, height=16)
    assert len(made.columns["level"]) and not list(tmp_path.iterdir())


def test_a_study_shows_itself(study):
    pytest.importorskip("matplotlib")
    axes = study.plot()
    assert axes.get_xscale() == axes.get_yscale() == "log"
    assert {line.get_label() for line in axes.lines} <= set(study.methods) and len(axes.lines)
    first = study.columns["method"] == axes.lines[0].get_label()
    assert np.array_equal(axes.lines[0].get_ydata(), study.columns["rmse"][first])
    assert study.png()[:4] == b"\x89PNG" and "data:image/png" in study._repr_html_()
    assert study.plot(cost="rays").get_xlabel() == "rays a picture"
    with pytest.raises(nook.UsageError, match="cost: "):
        study.plot(cost="money")


def test_without_matplotlib_one_clear_error(study, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(ImportError, match="needs matplotlib"):
        study.plot()
    shown = study._repr_html_()
    assert "<table>" in shown and "<img" not in shown


@pytest.mark.parametrize(
    "keywords, says",
    [
        ({"spp": 4}, "spp: a study has its own"),
        ({"budget": 0}, "budget: 0 is not from"),
        ({"samplers": ["sobl"]}, "samplers: unknown value 'sobl'"),
        ({"samplings": ["lobe"]}, "samplings: lobe needs an RO scene"),
        ({"samplers": [3]}, "samplers: a list of names"),
        ({"reference": "/none.exr"}, "/none.exr"),
    ],
)
def test_wrong_studies(keywords, says):
    with pytest.raises(nook.Error, match=says):
        nook.study(nook.Scene(vertices=VERTICES, faces=FACES), **{"budget": 1, "width": 8, "height": 8, **keywords})
