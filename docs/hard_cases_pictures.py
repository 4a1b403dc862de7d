#!/usr/bin/env python3
"""Makes docs/images/hard: a picture of each hard case of docs/hard-cases.md, by nook itself.

    docs/hard_cases_pictures.py build/bin/nook

Needs numpy and matplotlib. The meshes are those of tests/render/hard_meshes.cpp."""
import math
import pathlib
import subprocess
import sys
import tempfile

import matplotlib
matplotlib.use("Agg")
import matplotlib.image
import numpy

OUT = pathlib.Path(__file__).resolve().parent / "images" / "hard"
CONTACT = dict(eye=(0, 3, 5), at=(0, .75, 0), fov=32)
BESIDE = dict(eye=(.3, 2.5, 4), at=(0, 0, 0), fov=40)


class Mesh:
    def __init__(self):
        self.vertices, self.normals, self.faces = [], [], []

    def face(self, *corners, normal=None):
        first = len(self.vertices) + 1
        self.vertices += corners
        if normal is not None:
            self.normals.append(normal)
        n = f"//{len(self.normals)}" if normal is not None else ""
        self.faces.append(" ".join(f"{first + i}{n}" for i in range(len(corners))))
        return self

    def moved(self, scale=1.0, offset=0.0):
        self.vertices = [[scale * x + offset for x in v] for v in self.vertices]
        return self

    def text(self):
        lines = ["v " + " ".join(repr(float(x)) for x in v) for v in self.vertices]
        lines += ["vn " + " ".join(repr(float(x)) for x in n) for n in self.normals]
        return "\n".join(lines + ["f " + f for f in self.faces]) + "\n"


def square(half, y=0.0, normal=None, mesh=None):
    corners = (-half, y, -half), (-half, y, half), (half, y, half), (half, y, -half)
    return (mesh or Mesh()).face(*corners, normal=normal)


def sphere(n, centre=(0, 0, 0), radius=lambda i, j: 1.0, smooth=False, mesh=None):
    mesh = mesh or Mesh()
    first = len(mesh.vertices) + 1
    for i in range(n + 1):
        for j in range(2 * n):
            a, b = math.pi * i / n, math.pi * j / n
            r = radius(i, j) if 0 < i < n else radius(i, 0)
            d = math.sin(a) * math.cos(b), math.cos(a), -math.sin(a) * math.sin(b)
            mesh.vertices.append([c + r * x for c, x in zip(centre, d)])
            if smooth:
                mesh.normals.append(d)
    for i in range(n):
        for j in range(2 * n):
            at = [first + 2 * n * (i + p) + (j + q) % (2 * n) for p, q in ((0, 0), (1, 0), (1, 1), (0, 1))]
            corner = [f"{k}//{k - first + 1}" if smooth else f"{k}" for k in at]
            for triangle in ((0, 1, 2), (0, 2, 3)):
                if not (i == 0 and triangle == (0, 2, 3)) and not (i == n - 1 and triangle == (0, 1, 2)):
                    mesh.faces.append(" ".join(corner[k] for k in triangle))
    return mesh


def contact(scale=1.0, offset=0.0):
    return sphere(64, (0, 1, 0), mesh=square(100)).moved(scale, offset)


def star(inner, inwards):
    mesh = sphere(24, radius=lambda i, j: 1.0 if (i + j) % 2 else inner)
    if inwards:
        mesh.faces = [" ".join(reversed(face.split())) for face in mesh.faces]
    return mesh


def wedge(degrees):
    mesh, a = Mesh(), math.radians(degrees)
    for turn in (0, a):
        x, y = 1e2 * math.cos(turn), 1e2 * math.sin(turn)
        plate = (0, 0, 1e2), (0, 0, -1e2), (x, y, -1e2), (x, y, 1e2)
        mesh.face(*(plate if turn else plate[::-1]))  # each faces the other
    return mesh


def box(grid=2):
    """[-1,1]^3 facing inwards."""
    mesh, step = Mesh(), 2 / grid
    for axis in range(3):
        for side in (-1, 1):
            for i in range(grid):
                for j in range(grid):
                    corners = []
                    for p, q in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        c = [0, 0, 0]
                        c[axis], c[(axis + 1) % 3], c[(axis + 2) % 3] = side, (i + p) * step - 1, (j + q) * step - 1
                        corners.append(c)
                    mesh.face(*(corners if side < 0 else corners[::-1]))
    return mesh


def slivers():
    mesh = Mesh()
    for i in range(64):
        x0, x1 = -1 + i / 32, -1 + (i + 1) / 32
        thin = x0 + 2e-5
        for _ in range(2):
            mesh.face((x0, 0, -1), (x0, 0, 1), (thin, 0, 1), (thin, 0, -1))
            mesh.face((thin, 0, -1), (thin, 0, 1), (x1, 0, 1), (x1, 0, -1))
        mesh.face((x0, 0, -1), (thin, 0, -1), (thin, 0, 1), (x0, 0, 1))
        mesh.face((x0, 0, -1), (x0, 0, 0), (x0, 0, 1))
        mesh.face((x0, 0, -.5), (x1, 0, -.5), (x0, 0, .5))
    return mesh


def nested():
    mesh = Mesh()
    for i in range(120):
        s = 2.0**-i
        mesh.face((s, s, s), (2 * s, s, s), (s, 2 * s, s))
    return mesh


def plate(normal):
    return square(1, 1, mesh=square(2, normal=normal))


class Maker:
    def __init__(self, nook, folder):
        self.nook, self.folder, self.count = nook, folder, 0

    def picture(self, mesh, eye, at, fov, keys='type = "ao"\nmax_distance = "none"', up=(0, 1, 0), size=(120, 90)):
        self.count += 1
        stem = self.folder / str(self.count)
        stem.with_suffix(".obj").write_text(mesh.text())
        numbers = lambda v: "[" + ", ".join(repr(float(x)) for x in v) + "]"
        stem.with_suffix(".toml").write_text(
            f'[input]\nobjfile = "{stem.name}.obj"\n[camera]\neye = {numbers(eye)}\nat = {numbers(at)}\n'
            f"up = {numbers(up)}\nfov = {float(fov)}\n[film]\nwidth = {size[0]}\nheight = {size[1]}\n"
            f"[renderer]\nspp = 64\n{keys}\n")
        subprocess.run([self.nook, "render", stem.with_suffix(".toml"), "--quiet"], check=True)
        image = matplotlib.image.imread(stem.with_suffix(".png"))
        return numpy.dstack([image] * 3) if image.ndim == 2 else image[:, :, :3]


def save(name, pictures):
    """Side by side, a line of red between: pictures may be all black or all white."""
    line = numpy.zeros((pictures[0].shape[0], 2, 3))
    line[:, :, 0] = .8
    row = [pictures[0]]
    for picture in pictures[1:]:
        row += [line, picture]
    matplotlib.image.imsave(OUT / f"{name}.png", numpy.clip(numpy.hstack(row), 0, 1))


def main(nook):
    OUT.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        maker = Maker(pathlib.Path(nook).resolve(), pathlib.Path(folder))
        see = maker.picture

        def at(camera, scale=1.0, offset=0.0):
            place = lambda v: tuple(scale * x + offset for x in v)
            return dict(eye=place(camera["eye"]), at=place(camera["at"]), fov=camera["fov"])

        save("contact_scales", [see(contact(s), **at(CONTACT, s)) for s in (1e-6, 1, 1e6)])
        save("contact_powers", [see(contact(s), **at(CONTACT, s)) for s in (2.0**-20, 2.0**20)])
        save("contact_moved", [see(contact(1, d), **at(CONTACT, 1, d)) for d in (1e3, 1e4, 1e6)])
        save("wedges", [see(wedge(d), eye=(5, .5 * math.tan(math.radians(d)) * 5, .3), at=(0, 0, 0), fov=40)
                        for d in (60, 10, 3)])
        save("slivers", [see(slivers(), **BESIDE)])
        save("spikes", [see(star(.4, False), eye=(0, 0, 4), at=(0, 0, 0), fov=32),
                        see(star(.4, True), eye=(.1, .05, .02), at=(1, .3, .2), fov=120)])
        save("axes", [see(box(4), eye=(0, 0, .99), at=(0, 0, -1), fov=90,
                          keys='type = "ao"\nmax_distance = 0.5')])
        save("limits", [see(box(), eye=(0, 0, .5), at=(.2, .1, -1), fov=60,
                            keys=f'type = "ao"\nmax_distance = {d}') for d in ("1e-20", "0.5", "1e38")])
        save("views", [see(contact(), eye=(0, 3, 5), at=(0, .75, 0), fov=f) for f in (.01, 90, 179)])
        save("inside", [see(box(4), eye=e, at=(.1, .2, .3), fov=90, keys='type = "ao"\nmax_distance = 0.5')
                        for e in ((.25, -1, .1), (1, 1, 1))])
        triangle = Mesh().face((-1, -1, 0), (1, -1, 0), (0, 1, 0))
        save("one", [see(triangle, eye=(0, 0, 3), at=(0, 0, 0), fov=50)])
        save("deep", [see(nested(), eye=(1, 1, 6), at=(1, 1, 1), fov=30)])
        save("exponents", [see(contact(), **CONTACT, keys=f'type = "ro"\nexponent = {n}\nmax_distance = "none"')
                           for n in ("0.0", "30.0", "1e3", "1e7")])
        broken = square(2)
        broken.face((-1, .5, 0), (float("nan"), 1, 0), (1, .5, 0)).face((-1, .5, 0), (0, float("inf"), 0), (1, .5, 0))
        save("not_finite", [see(broken.face((-.5, .5, .5), (.5, .5, .5), (0, .5, -.5)), **BESIDE)])
        save("many", [see(wedge(60), eye=(1, .8, .1), at=(1, 0, 0), fov=40)])
        save("leaning", [see(square(100, normal=(math.sin(math.radians(t)), math.cos(math.radians(t)), 0)), **BESIDE)
                         for t in (5, 30, 60, 85)])
        save("terminator", [see(sphere(n, smooth=True), eye=(.3, .4, 4), at=(0, 0, 0), fov=40) for n in (8, 16, 64)])
        save("normals", [see(plate(n), **BESIDE) for n in ((0, 0, 0), (0, 1e-3, 0), (0, -1, 0))])


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
