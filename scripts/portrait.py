#!/usr/bin/env python3
"""Makes scenes/portrait.glb: a head with skin, eyes that have a white, an iris and a clear cornea, lashes and brows.

Usage: portrait.py SKIN [OUTPUT]. SKIN is the file that the program portrait_skin writes (cmake --build build/release --target
portrait_skin; build/release/scene/gallery/portrait_skin SKIN). Needs Python 3 and nothing beside its standard library. Lengths
are in mm here, and in metres in the file. The cornea and the upper lashes are blended, the lower lashes and the brows are masked.
"""
import json
import math
import os
import random
import struct
import sys
import zlib

EYE = (32.0, 115.0, 73.0)  # the centre of the left one; this and the ball's radius as in scene/gallery/head.cpp
BALL, IRIS, PUPIL = 12.0, 5.9, 2.0  # radii
CORNEA = 7.8  # radius of curvature
SKIN = (0.8, 0.6, 0.5)  # the material's colour, which the vertices' multiply


def add(a, b, scale=1.0):
    return tuple(x + scale * y for x, y in zip(a, b))


def normalize(v):
    length = math.sqrt(sum(c * c for c in v)) or 1.0
    return tuple(c / length for c in v)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


class Mesh:
    def __init__(self):
        self.positions, self.uvs, self.colors, self.indices = [], [], [], []

    def grid(self, columns, rows, place, uv=lambda s, t: (s, t), color=None, wraps=False):
        """place(s, t) for s and t from 0 to 1; faces look to the side from which s grows to the right and t upwards."""
        first = len(self.positions)
        for j in range(rows + 1):
            for i in range(columns + 1):
                s, t = i / columns, j / rows
                self.positions.append(place(s % 1.0 if wraps else s, t))
                self.uvs.append(uv(s, t))
                self.colors.append(color(self.positions[-1]) if color else (255, 255, 255))
        for j in range(rows):
            for i in range(columns):
                a = first + j * (columns + 1) + i
                b = a + columns + 1
                self.indices += [a, a + 1, b + 1, a, b + 1, b]

    def normals(self):
        sums = {}
        key = lambda p: tuple(round(c, 4) for c in p)
        for i in range(0, len(self.indices), 3):
            a, b, c = (self.positions[k] for k in self.indices[i:i + 3])
            face = cross(add(b, a, -1), add(c, a, -1))
            for p in (a, b, c):
                sums[key(p)] = add(sums.get(key(p), (0, 0, 0)), face)
        return [normalize(sums.get(key(p), (0, 0, 1))) for p in self.positions]


class Skin(Mesh):
    """The mesh that portrait_skin wrote."""

    def __init__(self, path):
        super().__init__()
        with open(path, "rb") as file:
            header, _, data = file.read().partition(b"end_header\n")
        vertices, faces = (int(line.split()[-1]) for line in header.split(b"\n") if line.startswith(b"element"))
        self.stored_normals = []
        for row in struct.iter_unpack("<9f", data[:36 * vertices]):
            self.positions.append(row[:3])
            self.stored_normals.append(row[3:6])
            self.colors.append(tuple(round(255 * min(c / whole, 1)) for c, whole in zip(row[6:], SKIN)))
        for row in struct.iter_unpack("<B3I", data[36 * vertices:36 * vertices + 13 * faces]):
            self.indices += row[1:]

    def normals(self):
        return self.stored_normals

    def near(self, center, radius):
        """The triangles with a corner that near."""
        inside = [dot(d, d) < radius * radius for d in (add(p, center, -1) for p in self.positions)]
        corners = (self.indices[i:i + 3] for i in range(0, len(self.indices), 3))
        return [tuple(self.positions[k] for k in three) for three in corners if any(inside[k] for k in three)]


def outermost(triangles, origin, direction):
    """How far along the ray the last of the triangles lies, in lengths of `direction`; 0 where there is none."""
    last = 0.0
    for a, b, c in triangles:
        ab, ac, from_a = add(b, a, -1), add(c, a, -1), add(origin, a, -1)
        across = cross(direction, ac)
        volume = dot(ab, across)
        if abs(volume) < 1e-12:
            continue
        u = dot(from_a, across) / volume
        if u < 0 or u > 1:
            continue
        around = cross(from_a, ab)
        v = dot(direction, around) / volume
        if v >= 0 and u + v <= 1:
            last = max(last, dot(ac, around) / volume)
    return last


def on_ball(radius, u, v):
    """u to the right, v up, in radians."""
    return (radius * math.sin(u) * math.cos(v), radius * math.sin(v), radius * math.cos(u) * math.cos(v))


def lid_edge(triangles, u, upper):
    """Where the lid rises from the ball, in radians."""
    inside, outside = 0.0, math.radians(45 if upper else -45)
    for _ in range(10):
        middle = 0.5 * (inside + outside)
        if outermost(triangles, EYE, on_ball(1, u, middle)) < BALL + 1.3:
            inside = middle
        else:
            outside = middle
    return outside


def lash_strip(triangles, upper, length, rows):
    columns = 32
    inner, outer = math.radians(-40), math.radians(55)  # no lashes in the inner corner
    angles = [inner + (outer - inner) * i / columns for i in range(columns + 1)]
    edges = [lid_edge(triangles, u, upper) for u in angles]

    def place(s, t):
        u, edge = angles[round(s * columns)], edges[round(s * columns)]
        root = on_ball(BALL + 1.2, u, edge)
        out = normalize(on_ball(1, u * 1.25, edge))
        up = (0, 1 if upper else -1, 0)
        reach = length * t * (1 - (0.5 if s < 0.5 else 0.25) * (2 * s - 1)**2)
        curl = 0.6 * t if upper else 0.5 * t
        return add(add(root, out, reach * (1 - 0.45 * t)), up, reach * curl)

    strip = Mesh()
    strip.grid(columns, rows, place, uv=lambda s, t: (2.5 * s, 1 - t))
    return strip


def brow(triangles):
    line = ((10, 131, 90), (24, 137.5, 85), (38, 139.5, 77), (53, 132, 60))

    def place(s, t):
        # A Bézier curve through the ends; the skin is where a ray from the head's axis through it goes out.
        weights = ((1 - s)**3, 3 * s * (1 - s)**2, 3 * s * s * (1 - s), s**3)
        x, y, z = (sum(w * p[i] for w, p in zip(weights, line)) for i in range(3))
        axis = (0, y + (t - 0.5) * 9 * (1 - 0.6 * s**2), 20)
        direction = normalize((x, 0, z - axis[2]))
        return add(axis, direction, outermost(triangles, axis, direction) + 0.2 + 0.8 * t)
    return place


def png(width, height, pixel):
    """RGBA of pixel(x, y), each 0 to 1, in sRGB."""
    rows = b"".join(b"\0" + bytes(min(max(round(255 * c), 0), 255) for x in range(width) for c in pixel(x, y)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def iris_texture(size=128):
    dice = random.Random(3)
    rays = [(dice.random(), dice.random()) for _ in range(90)]

    def pixel(x, y):
        dx, dy = (x + 0.5) / size * 2 - 1, (y + 0.5) / size * 2 - 1
        radius, angle = math.hypot(dx, dy), math.atan2(dy, dx) / (2 * math.pi) % 1
        at = angle * len(rays)
        i, f = int(at) % len(rays), at % 1
        ray = rays[i][0] * (1 - f) + rays[(i + 1) % len(rays)][0] * f
        ring = 0.5 + 0.5 * math.sin(9 * radius + 5 * rays[i][1])
        light = 0.55 + 0.5 * ray * (0.6 + 0.4 * ring)
        color = [light * c for c in (0.34, 0.47, 0.58)]
        amber = max(0.0, 1 - abs(radius - 0.42) / 0.16)
        color = [c + amber * light * a for c, a in zip(color, (0.16, 0.06, -0.08))]
        limbus = min(max((radius - 0.80) / 0.16, 0), 1)
        pupil = min(max((radius - PUPIL / IRIS) / 0.04, 0), 1)
        return [c * (1 - 0.8 * limbus) * pupil for c in color] + [1]
    return png(size, size, pixel)


def sclera_texture(size=96):
    dice = random.Random(5)
    veins = [(dice.random(), dice.random(), 0.012 * (0.5 + dice.random())) for _ in range(26)]

    def pixel(x, y):
        s, t = (x + 0.5) / size, (y + 0.5) / size  # around, and from the iris back
        vein = 0.0
        for angle, phase, width in veins:
            off = abs((s - angle - 0.012 * math.sin(25 * t + 6.3 * phase) + 0.5) % 1 - 0.5)
            vein = max(vein, (1 - off / width) * min(max((t - 0.10) * 6, 0), 1) if off < width else 0)
        limbus = max(0.0, 1 - t / 0.05)
        red = 0.22 * vein + 0.10 * min(max(t - 0.15, 0) * 3, 1)
        return [0.93 * (1 - 0.35 * limbus), 0.90 * (1 - red) * (1 - 0.25 * limbus), 0.88 * (1 - red) * (1 - 0.2 * limbus), 1]
    return png(size, size, pixel)


def hair_texture(width, height, hairs, seed, thickness, lean):
    dice = random.Random(seed)
    strands = [((i + 0.8 * dice.random()) / hairs, lean * (0.6 + 0.8 * dice.random()) * dice.choice((1, 1, -0.3)), 0.7 + 0.3 * dice.random()) for i in range(hairs)]

    def pixel(x, y):
        s, t = (x + 0.5) / width, 1 - (y + 0.5) / height  # t from the root up
        alpha = 0.0
        for root, slant, length in strands:
            if t < length:
                off = abs((s - root - slant * t * t + 0.5) % 1 - 0.5) * width
                thick = thickness * (1 - t / length)**0.6
                alpha = max(alpha, min(max(thick + 0.5 - off, 0), 1))
        return [0.07, 0.05, 0.04, alpha]
    return png(width, height, pixel)


def brow_texture(width, height, hairs, seed):
    """Hairs that start all over and lie down to the temple: s of the texture from the nose on, t up."""
    dice = random.Random(seed)
    alpha = [0.0] * (width * height)
    for _ in range(hairs):
        s, t = 0.92 * dice.random(), 0.1 + 0.55 * dice.random()
        # Upright at the nose, lying at the temple.
        angle = math.radians(62 - 52 * min(s * 1.6, 1) + 18 * (dice.random() - 0.5) - 20 * (t - 0.35))
        length, thick = height * (0.38 + 0.2 * dice.random()), 1.5 + 0.5 * dice.random()
        bend = -0.7 * dice.random()
        x, y, steps = s * width, (1 - t) * height, 60
        for i in range(steps):
            along = i / steps
            x += length / steps * math.cos(angle + bend * along)
            y -= length / steps * math.sin(angle + bend * along)
            half = thick * (1 - along)**0.5
            for row in range(max(int(y - half), 0), min(int(y + half) + 2, height)):
                for column in range(max(int(x - half), 0), min(int(x + half) + 2, width)):
                    cover = half + 0.5 - math.hypot(column + 0.5 - x, row + 0.5 - y)
                    alpha[row * width + column] = max(alpha[row * width + column], min(max(cover, 0), 1))
    return png(width, height, lambda x, y: [0.22, 0.15, 0.11, alpha[y * width + x]])


class File:
    """Binary glTF that is being written."""

    def __init__(self):
        self.bytes = b""
        self.json = {"asset": {"version": "2.0", "generator": "Nacre, scripts/portrait.py"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [],
                     "meshes": [], "materials": [], "textures": [], "images": [], "samplers": [{"wrapS": 10497, "wrapT": 33071}],
                     "accessors": [], "bufferViews": []}

    def view(self, data, target=None):
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        view = {"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.bytes += data
        self.json["bufferViews"].append(view)
        return len(self.json["bufferViews"]) - 1

    def accessor(self, data, component, kind, count, target=34962, **more):
        self.json["accessors"].append({"bufferView": self.view(data, target), "componentType": component, "type": kind, "count": count, **more})
        return len(self.json["accessors"]) - 1

    def texture(self, image):
        self.json["images"].append({"mimeType": "image/png", "bufferView": self.view(image)})
        self.json["textures"].append({"source": len(self.json["images"]) - 1, "sampler": 0})
        return {"index": len(self.json["textures"]) - 1}

    def material(self, name, color, roughness, texture=None, **more):
        pbr = {"baseColorFactor": color, "metallicFactor": 0, "roughnessFactor": roughness}
        if texture:
            pbr["baseColorTexture"] = texture
        self.json["materials"].append({"name": name, "pbrMetallicRoughness": pbr, **more})
        return len(self.json["materials"]) - 1

    def mesh(self, name, mesh, material):
        metres = [add((0, 0, 0), p, 0.001) for p in mesh.positions]
        count = len(metres)
        floats = lambda rows: b"".join(struct.pack("<%df" % len(row), *row) for row in rows)
        low, high = ([f(p[i] for p in metres) for i in range(3)] for f in (min, max))
        bytes_of_normals = b"".join(struct.pack("<3bx", *(round(127 * c) for c in n)) for n in mesh.normals())
        attributes = {"POSITION": self.accessor(floats(metres), 5126, "VEC3", count, min=low, max=high),
                      "NORMAL": self.accessor(bytes_of_normals, 5120, "VEC3", count, normalized=True)}
        if "baseColorTexture" in self.json["materials"][material]["pbrMetallicRoughness"]:
            attributes["TEXCOORD_0"] = self.accessor(floats(mesh.uvs), 5126, "VEC2", count)
        self.json["bufferViews"][self.json["accessors"][attributes["NORMAL"]]["bufferView"]]["byteStride"] = 4
        if any(c != (255, 255, 255) for c in mesh.colors):
            data = b"".join(struct.pack("<4B", *c, 255) for c in mesh.colors)
            attributes["COLOR_0"] = self.accessor(data, 5121, "VEC4", count, normalized=True)
        indices = self.accessor(b"".join(struct.pack("<H", i) for i in mesh.indices), 5123, "SCALAR", len(mesh.indices), 34963)
        self.json["meshes"].append({"name": name, "primitives": [{"attributes": attributes, "indices": indices, "material": material}]})
        return len(self.json["meshes"]) - 1

    def node(self, name, mesh, place=(0, 0, 0), mirrored=False):
        node = {"name": name, "mesh": mesh, "translation": [0.001 * c for c in place]}
        if mirrored:
            node["scale"] = [-1, 1, 1]
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]))
        self.json["nodes"].append(node)

    def write(self, path):
        self.json["buffers"] = [{"byteLength": len(self.bytes)}]
        self.json["extensionsUsed"] = self.json["extensionsRequired"] = ["KHR_mesh_quantization"]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(self.bytes), 0x004E4942) + self.bytes
        with open(path, "wb") as file:
            file.write(struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks)


def make(skin_path, path):
    file = File()
    skin = file.material("skin", [*SKIN, 1], 0.5)
    sclera = file.material("sclera", [1, 1, 1, 1], 0.15, file.texture(sclera_texture()))
    iris = file.material("iris", [1, 1, 1, 1], 0.6, file.texture(iris_texture()))
    cornea = file.material("cornea", [0.1, 0.1, 0.1, 0.04], 0.06, alphaMode="BLEND")
    lashes = file.material("upper lashes", [1, 1, 1, 1], 0.6, file.texture(hair_texture(256, 64, 32, 7, 2.3, 0.16)), alphaMode="BLEND", doubleSided=True)
    lower = file.material("lower lashes", [1, 1, 1, 1], 0.6, file.texture(hair_texture(256, 64, 20, 11, 2.0, 0.14)), alphaMode="MASK", alphaCutoff=0.4,
                          doubleSided=True)
    brows = file.material("brows", [1, 1, 1, 1], 0.7, file.texture(brow_texture(512, 128, 200, 13)), alphaMode="MASK", alphaCutoff=0.4,
                          doubleSided=True)

    head = Skin(skin_path)

    white = Mesh()
    rim = math.asin(IRIS / BALL)

    def ball(s, t):
        angle, polar = 2 * math.pi * s, math.pi - (math.pi - rim) * t
        return (BALL * math.sin(polar) * math.cos(angle), BALL * math.sin(polar) * math.sin(angle), BALL * math.cos(polar))
    white.grid(40, 20, ball, uv=lambda s, t: (s, 1 - t), wraps=True)

    front = math.sqrt(BALL**2 - IRIS**2)
    disc = Mesh()

    def iris_place(s, t):
        angle, radius = 2 * math.pi * s, IRIS * (1 - t)
        depth = 1.0 * min((IRIS - radius) / (IRIS - PUPIL), 1) if radius > PUPIL else 1.0
        return (radius * math.cos(angle), radius * math.sin(angle), front - 0.15 - depth)
    disc.grid(32, 8, iris_place, wraps=True)
    disc.uvs = [(0.5 + 0.5 * p[0] / IRIS, 0.5 - 0.5 * p[1] / IRIS) for p in disc.positions]

    dome = Mesh()
    center = front - math.sqrt(CORNEA**2 - (IRIS + 0.25)**2)

    def cornea_place(s, t):
        angle, polar = 2 * math.pi * s, math.asin((IRIS + 0.25) / CORNEA) * (1 - t)
        return (CORNEA * math.sin(polar) * math.cos(angle), CORNEA * math.sin(polar) * math.sin(angle), center + CORNEA * math.cos(polar))
    dome.grid(32, 10, cornea_place, wraps=True)

    around_eye = head.near(EYE, 20)
    upper_lashes, lower_lashes = lash_strip(around_eye, True, 8, 6), lash_strip(around_eye, False, 4.5, 4)

    file.node("head", file.mesh("head", head, skin))
    parts = {"eye": (white, sclera), "iris": (disc, iris), "cornea": (dome, cornea), "upper lashes": (upper_lashes, lashes),
             "lower lashes": (lower_lashes, lower)}
    for name, (mesh, material) in parts.items():
        index = file.mesh(name, mesh, material)
        for side in (-1, 1):
            file.node(("right " if side < 0 else "left ") + name, index, (side * EYE[0], EYE[1], EYE[2]), mirrored=side < 0)
    hairs = Mesh()
    hairs.grid(24, 4, brow(head.near((32, 135, 75), 35)), uv=lambda s, t: (1.0 * s, 1 - t))
    index = file.mesh("brow", hairs, brows)
    for side in (-1, 1):
        file.node(("right " if side < 0 else "left ") + "brow", index, mirrored=side < 0)
    file.write(path)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit("portrait.py: needs the file that portrait_skin writes, and may have the name of the file to write")
    make(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else os.path.dirname(os.path.dirname(os.path.abspath(__file__))) + "/scenes/portrait.glb")
