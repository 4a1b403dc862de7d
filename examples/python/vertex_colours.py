"""AO of a mesh as vertex colours: ./nook python examples/python/vertex_colours.py [MESH] -o knot.png

Bakes AO to the vertices, writes a PLY file with colours beside the picture, and draws the mesh with them. Without
a MESH it makes a knot. nook takes meshes by their arrays, whichever library they are from:

    mesh = trimesh.load("x.glb", force="mesh")             vertices, faces = mesh.vertices, mesh.faces
    mesh = open3d.io.read_triangle_mesh("x.ply")           np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    mesh = meshio.read("x.vtu")                            mesh.points, mesh.cells_dict["triangle"]
    mesh = pyvista.read("x.vtp").triangulate()             mesh.points, mesh.regular_faces
"""

import argparse
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

import nook


def knot(rings=300, sides=24):
    """A tube along a trefoil knot: vertices and faces."""
    t = np.linspace(0, 2 * np.pi, rings, endpoint=False)
    path = np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], 1)
    along = np.roll(path, -1, 0) - np.roll(path, 1, 0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    across = np.cross(along, [0.0, 0, 1])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    up = np.cross(across, along)
    angle = np.linspace(0, 2 * np.pi, sides, endpoint=False)[:, None]
    vertices = path[:, None] + 0.55 * (np.cos(angle) * across[:, None] + np.sin(angle) * up[:, None])
    ring, side = np.meshgrid(np.arange(rings), np.arange(sides), indexing="ij")
    a, b = ring * sides + side, ring * sides + (side + 1) % sides
    c, d = (ring + 1) % rings * sides + side, (ring + 1) % rings * sides + (side + 1) % sides
    faces = np.concatenate([np.stack([a, d, b], -1), np.stack([a, c, d], -1)]).reshape(-1, 3)
    return vertices.reshape(-1, 3), faces


def write_ply(file, vertices, faces, grey):
    """With colours, which most viewers show."""
    rows = np.empty(len(vertices), [("xyz", "<f4", 3), ("rgb", "u1", 3)])
    rows["xyz"], rows["rgb"] = vertices, grey[:, None]
    corners = np.empty(len(faces), [("n", "u1"), ("v", "<u4", 3)])
    corners["n"], corners["v"] = 3, faces
    names = [*(f"property float {axis}" for axis in "xyz"), *(f"property uchar {c}" for c in ("red", "green", "blue"))]
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(rows)}", *names]
    head += [f"element face {len(faces)}", "property list uchar uint vertex_indices", "end_header", ""]
    file.write_bytes("\n".join(head).encode() + rows.tobytes() + corners.tobytes())


def draw(file, vertices, faces, values):
    axes = Figure(figsize=(7, 6)).add_axes((0, 0, 1, 1), projection="3d")
    shade = np.clip(values[faces].mean(1), 0, 1)[:, None] * [1.0, 0.97, 0.92]
    axes.add_collection3d(Poly3DCollection(vertices[faces], facecolors=shade, edgecolors=shade, linewidths=0.3))
    center, half = (vertices.max(0) + vertices.min(0)) / 2, (vertices.max(0) - vertices.min(0)).max() / 2
    axes.set(xlim=center[0] + [-half, half], ylim=center[1] + [-half, half], zlim=center[2] + [-half, half])
    axes.set_axis_off()
    axes.view_init(elev=55, azim=-60)
    axes.figure.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mesh", nargs="?")
    parser.add_argument("-o", "--output", type=Path, default=Path("knot.png"))
    parser.add_argument("--directions", type=int, default=256)
    options = parser.parse_args()
    if options.mesh:
        scene = nook.Scene(options.mesh)
    else:
        vertices, faces = knot()
        scene = nook.Scene(vertices=vertices, faces=faces)
    # The scene's own distance limit is half its bounding sphere's radius; here everything counts.
    baked = scene.bake("vertices", directions=options.directions, max_distance="none")
    values = baked["ao"]
    print(f"{values.size} vertices, AO {values.min():.3f} to {values.max():.3f}")
    grey = (255 * np.clip(values, 0, 1) ** (1 / 2.2) + 0.5).astype("uint8")
    write_ply(options.output.with_suffix(".ply"), baked.vertices, baked.faces, grey)
    draw(options.output, baked.vertices, baked.faces, values)


if __name__ == "__main__":
    main()
