#!/usr/bin/env python3
"""Writes the small meshes of the scenes in this folder: plant.obj with leaf.png (cut-outs) and crate.obj (texture coordinates).

Standard library alone; the same bytes every time. The files are kept beside it, so that nobody needs to run it."""
import math
import pathlib
import struct
import zlib

FOLDER = pathlib.Path(__file__).parent


class Mesh:
    """Positions, texture coordinates and faces of an OBJ file, by group and material."""

    def __init__(self, name):
        self.lines = [f"# written by {pathlib.Path(__file__).name}", f"mtllib {name}.mtl"]
        self.positions = self.uvs = 0

    def start(self, group, material):
        self.lines += [f"g {group}", f"usemtl {material}"]

    def face(self, corners, uvs):
        """A polygon, counter-clockwise seen from outside."""
        self.lines += ["v " + " ".join(f"{x:.5f}" for x in p) for p in corners]
        self.lines += ["vt " + " ".join(f"{x:.5f}" for x in uv) for uv in uvs]
        indices = range(len(corners))
        self.lines.append("f " + " ".join(f"{self.positions + i + 1}/{self.uvs + i + 1}" for i in indices))
        self.positions += len(corners)
        self.uvs += len(uvs)

    def write(self, path):
        path.write_text("\n".join(self.lines) + "\n")


def box(mesh, lo, hi, chart):
    """An axis-aligned box; chart(i): the texture's rectangle (u0, v0, u1, v1) of its side i."""
    for side in range(6):
        axis, upper = side // 2, side % 2
        u, v = (axis + 1) % 3, (axis + 2) % 3
        corners = []
        for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
            p = [0.0] * 3
            p[axis] = (hi if upper else lo)[axis]
            p[u] = (hi if a else lo)[u]
            p[v] = (hi if b else lo)[v]
            corners.append(p)
        u0, v0, u1, v1 = chart(side)
        uvs = [(u0, v0), (u1, v0), (u1, v1), (u0, v1)]
        if not upper:
            corners.reverse()
            uvs.reverse()
        mesh.face(corners, uvs)


def crate():
    """A crate of boards: six panels in a frame of twelve bars. Every side of every box has a chart of its own."""
    mesh = Mesh("crate")
    bars = []
    for axis in range(3):
        for a in (0, 1):
            for b in (0, 1):
                lo, hi = [0.0] * 3, [0.0] * 3
                u, v = (axis + 1) % 3, (axis + 2) % 3
                lo[axis], hi[axis] = (0.0, 1.0) if axis == 1 else (0.12, 0.88)
                for direction, far in ((u, a), (v, b)):
                    lo[direction], hi[direction] = (0.88, 1.0) if far else (0.0, 0.12)
                if axis != 1:  # rails between the posts
                    other = u if v == 1 else v
                    lo[1], hi[1] = (0.88, 1.0) if (a if u == 1 else b) else (0.0, 0.12)
                    lo[other], hi[other] = (0.88, 1.0) if (a if u == other else b) else (0.0, 0.12)
                bars.append(("frame", lo, hi))
    panels = [("panels", [0.06] * 3, [0.94] * 3)]
    # The six panels are the sides of one box set back into the frame: large charts; the bars' sides are narrow ones.
    def panel_chart(side):
        x, y = side % 3, side // 3
        return (x / 3 + 0.01, 0.5 + y / 4 + 0.01, x / 3 + 0.32, 0.5 + y / 4 + 0.24)
    for group, lo, hi in panels:
        mesh.start(group, "wood")
        box(mesh, lo, hi, panel_chart)
    mesh.start("frame", "wood")
    for i, (_, lo, hi) in enumerate(bars):
        def bar_chart(side, i=i):
            n = 6 * i + side
            x, y = n % 9, n // 9
            return (x / 9 + 0.01, y / 16 + 0.008, x / 9 + 0.1, y / 16 + 0.0545)
        box(mesh, lo, hi, bar_chart)
    mesh.write(FOLDER / "crate.obj")
    (FOLDER / "crate.mtl").write_text("newmtl wood\nKd 0.6 0.45 0.3\n")


def plant():
    """A stem and four rings of leaves: squares with a leaf cut out of each."""
    mesh = Mesh("plant")
    mesh.start("pot", "clay")
    sides = 16
    def ring(radius, y):
        return [(radius * math.cos(2 * math.pi * i / sides), y, -radius * math.sin(2 * math.pi * i / sides)) for i in range(sides)]
    profile = [(0.0, 0.0), (0.2, 0.0), (0.28, 0.36), (0.24, 0.36), (0.22, 0.3), (0.0, 0.3)]
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        a, b = ring(r0, y0), ring(r1, y1)
        for i in range(sides):
            j = (i + 1) % sides
            corners = [a[i], a[j], b[j], b[i]] if r0 and r1 else ([a[i], b[j], b[i]] if not r0 else [a[i], a[j], b[i]])
            mesh.face(corners, [(0, 0)] * len(corners))
    mesh.start("stem", "stem")
    box(mesh, (-0.015, 0.3, -0.015), (0.015, 1.25, 0.015), lambda side: (0, 0, 0, 0))
    mesh.start("leaves", "leaf")
    for level in range(5):
        for k in range(7):
            angle = 2 * math.pi * (k + 0.5 * level) / 7 + 0.3 * level
            lift = 0.25 + 0.22 * level
            size = 0.52 - 0.05 * level
            out = (math.cos(angle) * math.cos(lift), math.sin(lift), math.sin(angle) * math.cos(lift))
            side = (-math.sin(angle), 0.0, math.cos(angle))
            base = (0.02 * math.cos(angle), 0.5 + 0.17 * level, 0.02 * math.sin(angle))
            def at(along, across):
                bend = -0.35 * along * along * size
                return tuple(base[i] + size * (along * out[i] + across * 0.55 * side[i]) + (bend if i == 1 else 0) for i in range(3))
            steps = 4
            for s in range(steps):
                t0, t1 = s / steps, (s + 1) / steps
                mesh.face([at(t0, -0.5), at(t0, 0.5), at(t1, 0.5), at(t1, -0.5)][::-1], [(0, t0), (1, t0), (1, t1), (0, t1)][::-1])
    mesh.write(FOLDER / "plant.obj")
    (FOLDER / "plant.mtl").write_text(
        "newmtl clay\nKd 0.7 0.4 0.3\nnewmtl stem\nKd 0.3 0.4 0.2\nnewmtl leaf\nKd 0.2 0.5 0.2\nmap_d leaf.png\n")


def leaf(size=128):
    """The outline of a leaf with teeth, base at the bottom: white where the leaf is."""
    rows = []
    for y in range(size):
        t = 1 - (y + 0.5) / size  # along the leaf
        row = bytearray([0])
        for x in range(size):
            across = abs((x + 0.5) / size - 0.5)
            width = 0.47 * math.sin(math.pi * min(1.0, t * 1.02) ** 0.75) ** 0.8 if 0 < t < 0.98 else 0.0
            width *= 0.86 + 0.14 * (1 - (t * 14) % 1)
            if t < 0.08:
                width = max(width, 0.03)
            soft = (width - across) * size
            row.append(max(0, min(255, int(127.5 + 127.5 * soft))))
        rows.append(bytes(row))
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 0, 0, 0, 0))
    png += chunk(b"IDAT", zlib.compress(b"".join(rows), 9)) + chunk(b"IEND", b"")
    (FOLDER / "leaf.png").write_bytes(png)


crate()
plant()
leaf()
