#!/usr/bin/env python3
"""Makes the pictures of docs/overview.md and docs/scatter.md that show data: a frame's images, and smooth and edge regions.

Usage: doc-pictures.py [NACRE]. NACRE is the command to run; without it, build/release/app/nacre. Needs Python 3 and nothing
beside its standard library.
"""
import math
import os
import struct
import subprocess
import sys
import tempfile
import zlib

from exr import read_exr

FRAME_SIZE = (640, 360)
REGIONS_SIZE = (1920, 1080)
REGIONS_CROP = (1190, 170, 640, 400)  # px: left, top, width, height; the dragon
FIELD_OF_VIEW = 0.30  # rad, vertical: that of the gallery's camera
# The rules that docs/scatter.md states ("Two pipelines"), and their constants (bank_constants.h).
SMOOTH_STEP, HOLE_STEP, CONTINUED_STEP, SEPARATION, MOST_EDGE_PARTS = 3.0, 0.5, 2.0, 6.0, 2
PART = (16, 8)


def read_colors(path):
    images = read_exr(path)
    return [list(zip(*rows)) for rows in zip(images["R"], images["G"], images["B"])]


def read_one(path):
    return next(iter(read_exr(path).values()))


def srgb(value):
    value = min(max(value, 0.0), 1.0)
    return round(255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055))


def write_png(path, rows):
    """Rows of (red, green, blue), 0 to 255."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    pixels = b"".join(b"\0" + bytes(value for pixel in row for value in pixel) for row in rows)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(pixels, 9)) + chunk(b"IEND", b""))


def halved(rows):
    """Each 2x2 pixels' mean."""
    return [[tuple(sum(c) / 4 for c in zip(rows[y][x], rows[y][x + 1], rows[y + 1][x], rows[y + 1][x + 1]))
             for x in range(0, len(rows[0]), 2)] for y in range(0, len(rows), 2)]


def encode(rows, exposure=1.0):
    return [[tuple(srgb(c * exposure / (1 + 0.4 * c * exposure)) for c in pixel) for pixel in row] for row in rows]


def write_frame(folder, images):
    """The images of one frame: what the effect reads, what it writes, and the picture."""
    palette = [(0.01, 0.01, 0.012), (0.8, 0.35, 0.22), (0.1, 0.5, 0.25), (0.65, 0.65, 0.62), (0.85, 0.6, 0.3), (0.35, 0.55, 0.1)]
    depths = images["depth"]
    near, far = 1.4, 2.3  # scene units: the exhibits
    depth = [[(min(max((far - z) / (far - near), 0.0), 1.0) ** 2 if z > 0 else 0.0,) * 3 for z in row] for row in depths]
    material = [[palette[int(i) % len(palette)] for i in row] for row in images["material"]]
    write_png(folder + "/frame-irradiance.png", encode(halved(images["irradiance"]), 0.15))
    write_png(folder + "/frame-depth.png", encode(halved(depth)))
    write_png(folder + "/frame-material.png", encode(halved(material)))
    write_png(folder + "/frame-scattered.png", encode(halved(images["scattered"]), 0.15))
    write_png(folder + "/frame-transmitted.png", encode(halved(images["transmitted"]), 0.5))
    write_png(folder + "/frame-picture.png", encode(halved(images["picture"])))


def stepped_blocks(depths, materials):
    """Which blocks of 2x2 px hold a step to another surface, as pass A decides it."""
    width, height = REGIONS_SIZE
    pixel = 2 * math.tan(0.5 * FIELD_OF_VIEW) / height

    def distance(x, y):
        if not (0 <= x < width and 0 <= y < height) or materials[y][x] == 0:
            return 0.0
        ray = math.hypot(1.0, (x + 0.5 - width / 2) * pixel, (y + 0.5 - height / 2) * pixel)
        return depths[y][x] * ray

    along = [[distance(x - 1, y - 1) for x in range(width + 2)] for y in range(height + 2)]

    def is_stepped(bx, by):
        x, y = 2 * bx + 1, 2 * by + 1
        lines = [[along[y + i][x + k] for k in (-1, 0, 1, 2)] for i in (0, 1)]
        lines += [[along[y + k][x + i] for k in (-1, 0, 1, 2)] for i in (0, 1)]
        own = [along[y + i][x + k] for i in (0, 1) for k in (0, 1)]
        size = max(own) * pixel
        if size == 0.0:
            return False
        has_hole = any(d == 0.0 for line in lines for d in line)
        steps = [[b - a if min(a, b) > 0 else 0.0 for a, b in zip(line, line[1:])] for line in lines]
        longest = max(abs(step) for line in steps for step in line)
        limit = (HOLE_STEP if has_hole else SMOOTH_STEP) * size
        goes_on = not has_hole and longest <= SEPARATION * 2 * size and all(
            max(map(abs, line)) <= max(limit, CONTINUED_STEP * max(min(line), -max(line))) for line in steps)
        present = [d for d in own if d > 0]
        is_two = max(present) - min(present) > SEPARATION * 2 * size
        return is_two or (longest > limit and not goes_on)

    return [[is_stepped(bx, by) for bx in range(width // 2)] for by in range(height // 2)]


def write_regions(path, images):
    """A part of the gallery with its smooth regions in blue, edge regions in orange."""
    width, height = REGIONS_SIZE
    materials, background = images["material"], images["picture"]
    stepped = stepped_blocks(images["depth"], materials)
    columns, rows = math.ceil(width / 32) * 2, math.ceil(height / 16) * 2

    def is_empty(px, py):  # of a part: no pixel of its tile of 16x16 has a material
        top = (py // 2) * 16
        return not any(materials[y][x] for y in range(top, min(top + 16, height)) for x in range(px * 16, min(px * 16 + 16, width)))

    def has_step(px, py):
        return any(stepped[y][x] for y in range(max(4 * py - 1, 0), min(4 * py + 5, height // 2))
                   for x in range(max(8 * px - 1, 0), min(8 * px + 9, width // 2)))

    kinds = {}
    for ry in range(rows // 2):
        for rx in range(columns // 2):
            parts = [(2 * rx + i, 2 * ry + k) for k in (0, 1) for i in (0, 1)]
            used = [part for part in parts if not is_empty(*part)]
            edges = [part for part in used if has_step(*part)]
            for part in used:
                kinds[part] = "edge" if part in edges or len(edges) > MOST_EDGE_PARTS else "smooth"
    tints = {"smooth": (0.1, 0.4, 1.0), "edge": (1.0, 0.35, 0.0)}
    left, top, crop_width, crop_height = REGIONS_CROP
    result = []
    for y in range(top, top + crop_height):
        row = []
        for x in range(left, left + crop_width):
            grey = 0.45 * sum(background[y][x]) / 3
            kind = kinds.get((x // PART[0], y // PART[1]))
            color = (grey,) * 3
            if kind:
                share = 0.45 if x % PART[0] == 0 or y % PART[1] == 0 else 0.16
                color = tuple((1 - share) * grey + share * c for c in tints[kind])
            row.append(tuple(srgb(c) for c in color))
        result.append(row)
    write_png(path, result)
    counts = {kind: sum(k == kind for k in kinds.values()) for kind in tints}
    print("parts of 16x8 px: %d smooth, %d edge" % (counts["smooth"], counts["edge"]))


def main():
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    nacre = sys.argv[1] if len(sys.argv) > 1 else root + "/build/release/app/nacre"
    folder = root + "/docs/images"
    with tempfile.TemporaryDirectory() as work:

        def render(size, aovs, *options):
            command = [nacre, "render", "--size", "%dx%d" % size, "--output", work + "/picture.exr", *options]
            for name in aovs:
                command += ["--aov", "%s=%s/%s.exr" % (name, work, name)]
            subprocess.run(command, check=True)
            images = {name: read_one(work + "/%s.exr" % name) for name in ("depth", "material")}
            for name in ["picture"] + [name for name in aovs if name not in images]:
                images[name] = read_colors(work + "/%s.exr" % name)
            return images

        aovs = ["depth", "material"]
        write_regions(folder + "/bank-regions.png", render(REGIONS_SIZE, aovs, "--light", "front", "--no-scatter", "--no-transmit"))
        aovs += ["irradiance", "scattered", "transmitted"]
        write_frame(folder, render(FRAME_SIZE, aovs, "--light", "both"))


if __name__ == "__main__":
    main()
