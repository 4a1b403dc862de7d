#!/bin/bash
# A flat face in the shape of an E (12 corners, area 13), in an OBJ file and in a PLY file.
#
# One would guess: its surface area is 13 in each program, or at least the same from both files.
# What happens: MeshLab (pymeshlab) has 13 from the OBJ file and 29 from the PLY file; trimesh has 29 from both. MeshLab cuts a face of
#   OBJ within its outline, and makes that of PLY a fan from the first corner, as trimesh does both: it covers what lies outside the
#   outline, much of it several times. Neither says a word.
# Who is bitten: whoever measures areas, bakes, or traces rays at meshes with concave n-gons (Blender, CAD, architecture), and whoever
#   takes PLY and OBJ of one mesh for the same.
#
# Installs pinned packages into a temporary folder, and fails (exit code 1) if any of this changes.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install -q numpy==2.4.6 trimesh==5.2.0 pymeshlab==2025.7.post1
cat >measure.py <<'PY'
import sys

import pymeshlab
import trimesh

outline = [(0, 0), (4, 0), (4, 1), (1, 1), (1, 2), (3, 2), (3, 3), (1, 3), (1, 4), (4, 4), (4, 5), (0, 5)]
points = "".join("%d %d 0\n" % p for p in outline)
with open("e.obj", "w") as out:
    out.write("".join("v " + line + "\n" for line in points.splitlines()))
    out.write("f " + " ".join(str(i + 1) for i in range(12)) + "\n")
with open("e.ply", "w") as out:
    out.write("ply\nformat ascii 1.0\nelement vertex 12\nproperty float x\nproperty float y\nproperty float z\n")
    out.write("element face 1\nproperty list uchar int vertex_indices\nend_header\n")
    out.write(points + "12 " + " ".join(str(i) for i in range(12)) + "\n")


def by_meshlab(name):
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(name)
    return meshes.get_geometric_measures()["surface_area"]


doubled = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(outline, outline[1:] + outline[:1]))
seen = {"exact": doubled / 2,
        "MeshLab OBJ": by_meshlab("e.obj"), "MeshLab PLY": by_meshlab("e.ply"),
        "trimesh OBJ": float(trimesh.load("e.obj", force="mesh").area),
        "trimesh PLY": float(trimesh.load("e.ply", force="mesh").area)}
print("trimesh", trimesh.__version__, seen)
expected = {"exact": 13, "MeshLab OBJ": 13, "MeshLab PLY": 29, "trimesh OBJ": 29, "trimesh PLY": 29}
sys.exit(any(abs(seen[name] - area) > 1e-6 for name, area in expected.items()))
PY
venv/bin/python measure.py
