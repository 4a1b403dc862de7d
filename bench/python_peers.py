#!/usr/bin/env python3
"""AO at points, nook beside what else Python has: python bench/python_peers.py MESH [--rounds 5]

20,000 points of the mesh's surface with their triangles' normals, 256 directions each, no distance limit, in turn:

    nook     scene.ao(), on a scene that is made from the arrays: with and without the time to make it
    igl      igl.embree.ambient_occlusion() (pip install libigl)
    embreex  256 cosine-weighted directions a point by NumPy, trimesh's intersects_any() (trimesh, embreex)

Truth is 8,192 directions of nook's from another seed. Prints a JSON line; needs a PYTHONPATH with nook, and is
run in a virtual environment of its own.
"""

import argparse
import json
import time

import numpy as np

import nook

DIRECTIONS = 256


def surface_points(vertices, faces, count, seed=7):
    random = np.random.default_rng(seed)
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    chosen = random.choice(len(faces), count, p=areas / areas.sum())
    u, v = random.random((2, count))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    a, b, c = np.moveaxis(corners[chosen], 1, 0)
    return a + u[:, None] * (b - a) + v[:, None] * (c - a), normals[chosen] / areas[chosen, None]


def by_embreex(mesh, points, normals, size, chunk=2000):
    random = np.random.default_rng(11)
    made = np.empty(len(points))
    for first in range(0, len(points), chunk):
        n = normals[first : first + chunk]
        least = np.eye(3)[np.abs(n).argmin(1)]
        t = np.cross(n, least)
        t /= np.linalg.norm(t, axis=1, keepdims=True)
        b = np.cross(n, t)
        u, phi = random.random((2, len(n), DIRECTIONS))
        r, phi = np.sqrt(u), 2 * np.pi * phi
        local = np.stack([r * np.cos(phi), r * np.sin(phi), np.sqrt(1 - u)], -1)
        d = np.einsum("nij,nkj->nik", local, np.stack([t, b, n], -1))
        o = np.repeat(points[first : first + chunk] + 1e-5 * size * n, DIRECTIONS, 0)
        hit = mesh.ray.intersects_any(o, d.reshape(-1, 3))
        made[first : first + chunk] = 1 - hit.reshape(len(n), DIRECTIONS).mean(1)
    return made


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mesh")
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    import igl
    import igl.embree
    import trimesh

    baked = nook.Scene(options.mesh).bake("vertices", spp=1)
    vertices, faces = baked.vertices, baked.faces.astype("int64")
    points, normals = surface_points(vertices, faces, 20000)
    size = np.ptp(vertices, axis=0).max()
    scene = nook.Scene(vertices=vertices, faces=faces, max_distance="none")
    truth = scene.ao(points, normals, samples=1 << 13, seed=99).value.astype("float64")
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    assert "embree" in type(mesh.ray).__module__ + str(mesh.ray), "trimesh found no embreex"

    def from_arrays():
        with nook.Scene(vertices=vertices, faces=faces, max_distance="none") as fresh:
            return fresh.ao(points, normals, samples=DIRECTIONS).value

    ways = {
        "nook": lambda: scene.ao(points, normals, samples=DIRECTIONS).value,
        "nook with its tree": from_arrays,
        "igl": lambda: 1 - igl.embree.ambient_occlusion(vertices, faces, points, normals, DIRECTIONS),
        "embreex": lambda: by_embreex(mesh, points, normals, size),
    }
    seconds, error = {name: [] for name in ways}, {}
    for turn in range(options.rounds + 1):
        for name, way in ways.items():
            begin = time.perf_counter()
            value = way()
            if turn:
                seconds[name].append(time.perf_counter() - begin)
            error[name] = float(np.sqrt(np.mean((np.asarray(value, "float64").ravel() - truth) ** 2)))
    made = {name: {"median_seconds": float(np.median(seconds[name])), "rmse": error[name]} for name in ways}
    for name in ("igl", "embreex"):
        made[name]["times nook"] = float(np.median(np.array(seconds[name]) / seconds["nook"]))
        made[name]["times nook with its tree"] = float(np.median(np.array(seconds[name]) / seconds["nook with its tree"]))
    versions = {"nook": "0.1.0", "libigl": getattr(igl, "__version__", ""), "trimesh": trimesh.__version__, "numpy": np.__version__}
    print(json.dumps({"bench": "python_peers", "triangles": len(faces), "points": len(points), "versions": versions, **made}))


if __name__ == "__main__":
    main()
