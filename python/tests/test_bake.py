"""Bakes: those of `nook bake`, bit by bit; and a corner's value is that of its own triangle."""

import numpy as np
import pytest

import nook
from conftest import FACES, VERTICES

BOX = """v 0 0 0
v 1 0 0
v 1 0 1
v 0 0 1
v 0 1 0
v 1 1 0
vt 0.1 0.1
vt 0.4 0.1
vt 0.4 0.4
vt 0.1 0.4
vt 0.6 0.1
vt 0.9 0.1
vt 0.9 0.4
vt 0.6 0.4
f 1/1 4/4 3/3 2/2
f 1/5 2/6 6/7 5/8
"""


def ply(path):
    """Vertices' properties by name, and triangles, of a PLY file as nook writes them."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    lines = head.decode().splitlines()
    count, faces = (int(line.split()[2]) for line in lines if line.startswith("element"))
    names = [line.split()[2] for line in lines if line.startswith("property float")]
    table = np.frombuffer(body, "float32", count * len(names)).reshape(count, len(names))
    rows = np.frombuffer(body[table.nbytes :], [("n", "u1"), ("v", "<u4", 3)], faces)
    return dict(zip(names, table.T)), rows["v"]


@pytest.mark.parametrize("to", ["vertices", "corners"])
def test_bakes_are_those_of_the_command(program, folder, to):
    program("bake", folder / "scene.toml", "--to", to, "-o", folder / "command.ply", "--spp", 2, "--directions", 64)
    table, triangles = ply(folder / "command.ply")
    made = nook.Scene(folder / "scene.toml").bake(to, spp=2, directions=64)
    assert tuple(made) == ("ao", "bent") and set(made.properties) == set(table) - set("x y z nx ny nz".split())
    for name, values in made.properties.items():
        assert np.array_equal(values.ravel(), table[name]), name
    assert np.array_equal(made.normals.reshape(-1, 3), np.stack([table["nx"], table["ny"], table["nz"]], 1))
    made.save(folder / "here.ply")
    assert (folder / "here.ply").read_bytes() == (folder / "command.ply").read_bytes()
    assert made["ao"].shape == ((6, 3) if to == "corners" else (9,)) and made["bent"].shape == made["ao"].shape + (3,)
    assert np.array_equal(np.asarray(made), made["ao"])
    assert np.array_equal(np.sort(made.faces), np.sort(FACES))
    assert np.array_equal(made.vertices, VERTICES)
    arrays = nook.Scene(vertices=VERTICES, faces=FACES).bake(to, spp=2, directions=64, type="ao")
    assert np.array_equal(arrays.faces, FACES) and arrays["ao"].sum() == made["ao"].sum()
    if to == "corners":
        assert arrays["ao"][2, 1] == arrays["ao"][2].max() and arrays["ao"].argmax(1)[2:].tolist() == [1] * 4
        assert np.array_equal(triangles.ravel(), np.arange(18))


def test_a_corner_is_of_its_own_triangle(folder):
    scene = nook.Scene(vertices=VERTICES, faces=FACES)
    made = scene.bake("corners", directions=4096, max_distance="none")
    flat = np.cross(VERTICES[FACES[:, 1]] - VERTICES[FACES[:, 0]], VERTICES[FACES[:, 2]] - VERTICES[FACES[:, 0]])
    flat /= np.linalg.norm(flat, axis=1, keepdims=True)
    assert np.allclose(made.normals, flat[:, None, :].repeat(3, 1), atol=1e-6)
    # What lies beside the corner, inside its triangle, sees the same.
    corners = VERTICES[made.faces]
    inside = corners + 1e-5 * (corners.mean(1, keepdims=True) - corners)
    beside = scene.ao(inside.reshape(-1, 3), made.normals.reshape(-1, 3), samples=4096, max_distance="none")
    assert np.abs(made["ao"].ravel() - beside.value).max() < 0.01
    # The pyramid's foot has one value on each side; their mean would be on neither.
    assert made["ao"][2:].max() < 1 and np.ptp(made["ao"]) > 0.1
    # In a dihedral corner half of what a flat surface sees is left, of both its faces.
    (folder / "box.obj").write_text(BOX)
    box = nook.Scene(folder / "box.obj").bake("corners", directions=4096, max_distance="none")
    foot = [box["ao"][t, k] for t in range(4) for k in range(3) if box.faces[t, k] in (0, 1)]
    vertex = nook.Scene(folder / "box.obj").bake("vertices", directions=4096, max_distance="none")
    assert max(foot) < 0.8 and len(foot) == 6 and vertex["ao"].shape == (6,)


def test_a_texture_is_that_of_the_command(program, folder):
    (folder / "box.obj").write_text(BOX)
    exr = folder / "texture.exr"
    program("bake", folder / "box.obj", "--to", "texture", "--size", 32, "--dilation", 2, "--spp", 64, "-o", exr)
    made = nook.Scene(folder / "box.obj").bake("texture", size=32, dilation=2, spp=64)
    made.save(folder / "texture_here.exr")
    program("compare", exr, folder / "texture_here.exr", "--fail", "0")
    assert made["ao"].shape == (32, 32) and 0 < made["A"].mean() < 0.5
    assert (made["ao"] > 0).sum() > (made["A"] > 0).sum()


@pytest.mark.parametrize(
    "keywords, kind, says",
    [
        ({"to": "faces"}, ValueError, "to: vertices, corners or texture"),
        ({"size": 8}, ValueError, "size, dilation, aovs: are of textures"),
        ({"to": "texture", "size": 0}, ValueError, "size: 0 is not from 1 to 16384"),
        ({"to": "texture"}, nook.SceneError, "no triangle has texture coordinates"),
        ({"to": "texture", "aovs": ["depth"]}, ValueError, "a texture has normal, position"),
        ({"type": "ro"}, nook.SceneError, "a bake needs an effect of type ao or bent"),
        ({"side": "viewer"}, nook.SceneError, "a bake has no viewer"),
    ],
)
def test_wrong_bakes(keywords, kind, says):
    scene = nook.Scene(vertices=VERTICES, faces=FACES)
    with pytest.raises(kind, match=says):
        scene.bake(**keywords)
    assert scene.bake("vertices", directions=8)["ao"].shape == (9,)


def test_a_bake_is_written_as_ply_alone(folder):
    made = nook.Scene(vertices=VERTICES, faces=FACES).bake("vertices", directions=8)
    with pytest.raises(nook.UsageError, match="x.obj: not a format"):
        made.save(folder / "x.obj")
    with pytest.raises(nook.OutputError):
        made.save("/proc/none/x.ply")
