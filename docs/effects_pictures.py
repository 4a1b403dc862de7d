#!/usr/bin/env python3
"""Makes docs/images/effects: the pictures of docs/effects.md, from scenes/effects by nook itself.

    docs/effects_pictures.py build/bin/nook

Needs numpy, matplotlib. Each layer is the preview of a scene that
has its effect alone; depth, which no preview can show as it is, goes from white at the nearest surface to black."""
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zlib

import matplotlib
matplotlib.use("Agg")
import matplotlib.image
import numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ROOT / "scenes" / "effects"
OUT = ROOT / "docs" / "images" / "effects"


def effects_of(text):
    """The scene's head, and its [[effect]] tables."""
    head, *tables = re.split(r"^\[\[effect\]\]\n", text, flags=re.M)
    return head, tables


def first_channel(file):
    """The first channel of an EXR as nook writes them: scan lines, floats, ZIP in blocks of 16 lines."""
    data = file.read_bytes()
    place, header = 8, {}
    while data[place]:
        name, kind = data[place:place + 512].split(b"\0", 2)[:2]
        place += len(name) + len(kind) + 2
        size = struct.unpack_from("<i", data, place)[0]
        header[name] = data[place + 4:place + 4 + size]
        place += 4 + size
    x0, y0, x1, y1 = struct.unpack("<4i", header[b"dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    channels = len(re.findall(rb"[^\0]+\0.{16}", header[b"channels"][:-1], re.S))
    offsets = struct.unpack_from(f"<{(height + 15) // 16}q", data, place + 1)
    lines = []
    for offset in offsets:
        y, size = struct.unpack_from("<2i", data, offset)
        count = min(16, y1 - y + 1)
        block = numpy.frombuffer(data, numpy.uint8, size, offset + 8)
        if size < count * channels * width * 4:
            # Each byte was stored as the difference from the one before, plus 128; even bytes first, then odd ones.
            steps = numpy.frombuffer(zlib.decompress(block), numpy.uint8).astype(numpy.int64)
            steps[1:] -= 128
            block = (numpy.cumsum(steps) & 255).astype(numpy.uint8)
            block = numpy.dstack([block[:block.size // 2], block[block.size // 2:]]).ravel()
        lines.append(block.view("<f4").reshape(count, channels, width)[:, 0])
    return numpy.vstack(lines)


class Maker:
    def __init__(self, nook, folder):
        self.nook, self.folder, self.count = nook, folder, 0

    def render(self, text, arguments=()):
        """The picture of a scene's text, as an array."""
        self.count += 1
        # Beside the others, so that its mesh names mean the same; removed at once.
        scene = SCENES / f"picture-{self.count}.toml"
        scene.write_text(text)
        try:
            exr = self.folder / f"{self.count}.exr"
            subprocess.run([self.nook, "render", scene, "-o", exr, "--quiet", *arguments], check=True)
            return self.read(exr.with_suffix(".png"))
        finally:
            scene.unlink()

    @staticmethod
    def read(png):
        image = matplotlib.image.imread(png)
        return numpy.dstack([image] * 3) if image.ndim == 2 else image[:, :, :3]

    def depth(self):
        """The depth of the scene that was rendered last, as a picture."""
        values = first_channel(self.folder / f"{self.count}.exr")
        hit = numpy.isfinite(values)
        near, far = values[hit].min(), values[hit].max()
        gray = numpy.where(hit, (far - numpy.where(hit, values, far)) / (far - near), 0)
        return numpy.dstack([gray] * 3)

    def each_effect(self, name, arguments=()):
        head, tables = effects_of((SCENES / f"{name}.toml").read_text())
        return [self.render(f"{head}[[effect]]\n{table}", arguments) for table in tables]


def save(name, pictures, columns=None):
    """Pictures of one size beside each other, a white line between."""
    columns = columns or len(pictures)
    rows = []
    for first in range(0, len(pictures), columns):
        row = []
        for picture in pictures[first:first + columns]:
            row += [picture, numpy.ones((picture.shape[0], 4, 3))]
        rows += [numpy.hstack(row[:-1]), numpy.ones((4, numpy.hstack(row[:-1]).shape[1], 3))]
    image = (numpy.vstack(rows[:-1]) * 255 + 0.5).astype(numpy.uint8)
    matplotlib.image.imsave(OUT / f"{name}.png", image)
    print(OUT / f"{name}.png", image.shape[1], "x", image.shape[0])


def main():
    OUT.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        maker = Maker(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(folder))
        small = ["--size", "320x240"]
        save("falloff", maker.each_effect("falloff", small), 2)
        save("directions", maker.each_effect("directions", small), 2)
        save("sets", maker.each_effect("sets", small), 2)
        save("bent", maker.each_effect("bent", small))
        save("cutouts", [maker.render((SCENES / "cutouts.toml").read_text().replace("cutouts = true", f"cutouts = {on}"),
                                      ["--size", "320x320"]) for on in ("false", "true")])
        save("instances", [maker.render((SCENES / "instances.toml").read_text())])
        save("forest", [maker.render((SCENES / "forest.toml").read_text())])
        ground = (SCENES / "ground.toml").read_text()
        save("ground", [maker.render(ground.replace("[ground]\n", ""), small), maker.render(ground, small)])
        wide = ["--size", "320x180"]
        save("ro", maker.each_effect("ro", wide))
        normal, position, _ = maker.each_effect("surface", wide)
        save("surface", [normal, position, maker.depth()])
        denoise = (SCENES / "denoise.toml").read_text()
        plain = denoise.replace("denoise = true\n", "")
        save("denoise", [maker.render(plain, small), maker.render(denoise, small), maker.render(plain, small + ["--spp", "1024"])])
        texture = maker.folder / "bake.png"
        subprocess.run([maker.nook, "bake", SCENES / "bake.toml", "--to", "texture", "--size", "360", "--spp", "256", "-o", texture],
                       check=True)
        save("bake", [maker.render((SCENES / "bake.toml").read_text(), ["--size", "360x360"]), maker.read(texture)])


main()
