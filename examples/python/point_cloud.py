"""AO map of a point cloud with normals: ./nook python examples/python/point_cloud.py [CLOUD.csv] -o cloud.png

A cloud has no surface that could occlude anything, so each point becomes a small square about its normal, wide
enough to touch its neighbours; what is nearer than two such squares does not count, since neighbours on a curved
surface cut each other. CLOUD.csv has x, y, z, nx, ny, nz in a row, as open3d's arrays do side by side:

    cloud = open3d.io.read_point_cloud("x.pcd"); cloud.estimate_normals()
    points, normals = np.asarray(cloud.points), np.asarray(cloud.normals)
"""

import argparse

import numpy as np
from matplotlib.figure import Figure

import nook


def bowl_and_ball(count=40000, seed=1):
    """A ball in a bowl: points and normals."""
    random = np.random.default_rng(seed)
    directions = random.normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    bowl, ball = directions[directions[:, 2] < -0.1], 0.35 * directions[::4] - [0, 0, 0.6]
    points = np.concatenate([bowl, ball])
    return points, np.concatenate([-bowl, directions[::4]])


def spacing_of(points, some=500):
    """How far neighbours are apart, about: the median distance to the nearest of the points, of some of them."""
    chosen = points[:: max(1, len(points) // some)]
    squares = (points**2).sum(1) + (chosen**2).sum(1)[:, None] - 2 * chosen @ points.T
    return 2 * np.median(np.sqrt(np.maximum(np.partition(squares, 1, axis=1)[:, 1], 0)))


def squares_about(points, normals, width):
    """A square of two triangles at each point: vertices and faces."""
    normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    least = np.eye(3)[np.abs(normals).argmin(1)]
    u = np.cross(normals, least)
    u *= 0.5 * width / np.linalg.norm(u, axis=1, keepdims=True)
    v = np.cross(normals, u)
    vertices = np.stack([points - u - v, points + u - v, points + u + v, points - u + v], 1).reshape(-1, 3)
    first = 4 * np.arange(len(points))[:, None]
    return vertices, np.concatenate([first + [0, 1, 2], first + [0, 2, 3]])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cloud", nargs="?")
    parser.add_argument("-o", "--output", default="cloud.png")
    parser.add_argument("--samples", type=int, default=256)
    options = parser.parse_args()
    if options.cloud:
        table = np.loadtxt(options.cloud, delimiter=",")
        points, normals = table[:, :3], table[:, 3:6]
    else:
        points, normals = bowl_and_ball()
    width = spacing_of(points)
    vertices, faces = squares_about(points, normals, width)
    with nook.Scene(vertices=vertices, faces=faces, max_distance="none", min_distance=2 * width) as scene:
        ao = scene.ao(points, normals, samples=options.samples, progress=True)
    print(f"{len(points)} points, AO {ao.value.min():.3f} to {ao.value.max():.3f}, error {ao.standard_error.mean():.4f}")
    axes = Figure(figsize=(7, 6), facecolor="#4c6072").add_axes((0, 0, 1, 1), projection="3d")
    axes.scatter(*points.T, c=ao.value, cmap="gray", vmin=0, vmax=1, s=9, linewidths=0, depthshade=False)
    axes.set_box_aspect(np.ptp(points, axis=0))
    axes.set_axis_off()
    axes.set_facecolor("none")
    axes.view_init(elev=60)
    axes.figure.savefig(options.output, dpi=100)


if __name__ == "__main__":
    main()
