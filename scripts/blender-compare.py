#!/usr/bin/env python3
"""Holds `nacre reference` against Cycles, the path tracer of Blender 3.4.

Every case is traced four times: by `nacre reference` with the surface integral and with the random walk, and by Cycles with
BURLEY and RANDOM_WALK, from the same mesh, camera and light, with the same material. A table tells PSNR and energy of Cycles'
picture against ours, how far two seeds of each are apart, and the PSNR that this noise alone would leave.

What a radius means to Cycles is found on the shadow edge of the plane: its radius is scaled until the edge is as wide as
ours, for each channel and method. BURLEY's d is nominally radius / 4 pi. Balls and heads then have that radius.

Needs Blender (Debian: apt-get install --no-install-recommends blender) and nothing beside Python's standard library.
"""
import argparse
import array
import json
import math
import os
import subprocess
import sys

from exr import read_exr

FOLDER = os.path.dirname(os.path.abspath(__file__))
OURS = {"BURLEY": "surface", "RANDOM_WALK": "walk"}
CHANNELS = "RGB"
EDGE_HEIGHT = 14.0  # mm that the picture of the shadow edge is high
MOST_RADIUS_RATIO = 20.0


# ---- Meshes: positions, normals and triangles, in mm.

def box(low, high):
    positions, normals, triangles = [], [], []
    for axis in range(3):
        for side in (0, 1):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            first = len(positions)
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                corner = [0.0, 0.0, 0.0]
                corner[axis] = (low, high)[side][axis]
                corner[u], corner[v] = (low, high)[a][u], (low, high)[b][v]
                positions.append(tuple(corner))
                normals.append(tuple((2.0 * side - 1) if i == axis else 0.0 for i in range(3)))
            order = (0, 1, 2, 0, 2, 3) if side else (0, 2, 1, 0, 3, 2)
            triangles += [tuple(first + order[i + j] for j in range(3)) for i in (0, 3)]
    return positions, normals, triangles


def ball(radius, rings=128):
    positions, normals, triangles = [], [], []
    around = 2 * rings
    for i in range(rings + 1):
        polar = math.pi * i / rings
        for j in range(around):
            turn = 2 * math.pi * j / around
            normal = (math.sin(polar) * math.cos(turn), math.cos(polar), math.sin(polar) * math.sin(turn))
            normals.append(normal)
            positions.append(tuple(radius * value for value in normal))
    for i in range(rings):
        for j in range(around):
            a, b = i * around + j, i * around + (j + 1) % around
            c, d = a + around, b + around
            if i > 0:
                triangles.append((a, b, d))
            if i < rings - 1:
                triangles.append((a, d, c))
    return positions, normals, triangles


def read_ply(path, millimetres):
    """The meshes that `nacre bake thickness` writes; lengths times `millimetres`."""
    with open(path, "rb") as file:
        data = file.read()
    header, body = data.split(b"end_header\n", 1)
    counts = [int(line.split()[2]) for line in header.decode().splitlines() if line.startswith("element")]
    values = array.array("f", body[:28 * counts[0]])
    vertices = [values[7 * i:7 * i + 7] for i in range(counts[0])]
    faces, at = [], 28 * counts[0]
    for i in range(counts[1]):
        faces.append(tuple(array.array("i", body[at + 13 * i + 1:at + 13 * i + 13])))
    return [tuple(millimetres * x for x in v[0:3]) for v in vertices], [tuple(v[3:6]) for v in vertices], faces


def gallery_head(nacre, folder):
    """The head of skin of Nacre's gallery, about its middle."""
    path = os.path.join(folder, "head.ply")
    if not os.path.exists(path):
        run([nacre, "bake", "thickness", "--surface", "head", "--neutral", "--rays", "1", "-o", path])
    positions, normals, triangles = read_ply(path, 1000.0)
    low = [min(p[i] for p in positions) for i in range(3)]
    high = [max(p[i] for p in positions) for i in range(3)]
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    return [tuple(a - b for a, b in zip(p, middle)) for p in positions], normals, triangles


# ---- Cases.

def make_case(name, nacre, folder):
    if name == "plane":
        # A wall beside the picture, lit at 45 degrees, whose shadow ends at x = 0.
        return {"bodies": [box((-60, -30, -60), (60, 0, 60))], "walls": [box((-21, 0.05, -60), (-20, 20, 60))],
                "camera": {"position": [0, 100, 0], "target": [0, 0, 0], "up": [0, 0, -1],
                           "orthographicHeight": EDGE_HEIGHT},
                "light": [1, -1, 0]}
    if name == "ball":
        return {"bodies": [ball(5)], "walls": [],
                "camera": {"position": [0, 0, 60], "target": [0, 0, 0], "up": [0, 1, 0], "verticalFieldOfView": 11},
                "light": [1, -0.3, -0.2]}
    return {"bodies": [gallery_head(nacre, folder)], "walls": [],
            "camera": {"position": [150, 60, 900], "target": [0, 0, 0], "up": [0, 1, 0], "verticalFieldOfView": 18},
            "light": [0.62, -0.62, -0.75]}


# ---- Programs.

def run(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit("blender-compare: %s ended with %d: %s" % (command[0], done.returncode,
                                                            (done.stderr or done.stdout).strip()[-600:]))
    return done.stdout


def write_obj(path, mesh):
    positions, normals, triangles = mesh
    with open(path, "w") as file:
        for p in positions:
            file.write("v %.9g %.9g %.9g\n" % p)
        for n in normals:
            file.write("vn %.9g %.9g %.9g\n" % n)
        for t in triangles:
            file.write("f " + " ".join("%d//%d" % (i + 1, i + 1) for i in t) + "\n")


def write_array(path, kind, rows):
    with open(path, "wb") as file:
        array.array(kind, [value for row in rows for value in row]).tofile(file)


class Bench:
    """Everything that is written lies in one folder, and is traced once."""

    def __init__(self, options):
        self.options = options
        self.folder = options.folder
        self.material = json.loads(run([options.nacre, "material", "show", options.material, "--json", "-"]))
        if "meanFreePath" not in self.material:
            sys.exit("blender-compare: the material '%s' has layers; Cycles knows mean free paths" % options.material)
        self.cases = {}

    def path(self, name):
        return os.path.join(self.folder, name)

    def case(self, name):
        if name not in self.cases:
            self.cases[name] = make_case(name, self.options.nacre, self.folder)
        return self.cases[name]

    def ours(self, name, method, seed):
        """A picture of `nacre reference`; method "off" is the same without scattering."""
        output = self.path("%s-nacre-%s-%d.exr" % (name, method, seed))
        if os.path.exists(output):
            return output
        case = self.case(name)
        material = dict(self.material, strength=0) if method == "off" else self.material
        models = []
        for kind in ("bodies", "walls"):
            for i, mesh in enumerate(case[kind]):
                obj = "%s-%s-%d.obj" % (name, kind, i)
                write_obj(self.path(obj), mesh)
                looks = {"material": material} if kind == "bodies" else {"surface": {"baseColor": [0, 0, 0]}}
                models.append(dict(looks, model=obj, units="mm"))
        camera = dict(case["camera"])
        if "orthographicHeight" in camera:
            camera["projection"] = "orthographic"
        scene = {"metersPerUnit": 0.001, "models": models, "cameras": [camera],
                 "lights": [{"type": "directional", "direction": case["light"]}], "environment": {"intensity": 0}}
        file = self.path("%s-%s.json" % (name, method))
        with open(file, "w") as out:
            json.dump(scene, out)
        how = "surface" if method == "off" else method
        run([self.options.nacre, "reference", file, "--method", how, "--size", "%dx%d" % self.options.size, "--spp",
             str(self.options.spp), "--seed", str(seed), "--threads", str(self.options.threads), "--restart", "-o", output])
        return output

    def cycles(self, name, method, radius, seed, label=""):
        output = self.path("%s-cycles-%s%s-%d.exr" % (name, method, label, seed))
        if os.path.exists(output):
            return output
        case = self.case(name)
        meshes = []
        for kind in ("bodies", "walls"):
            for i, mesh in enumerate(case[kind]):
                job = {"name": "%s-%s-%d" % (name, kind, i)}
                for part, form, rows in zip(("positions", "normals", "triangles"), "ffi", mesh):
                    job[part] = self.path("%s-%s.bin" % (job["name"], part))
                    write_array(job[part], form, rows)
                job["material"] = ({"method": method, "albedo": self.material["albedo"], "radius": radius}
                                   if kind == "bodies" else {"method": "DIFFUSE", "albedo": [0, 0, 0]})
                meshes.append(job)
        job = {"meshes": meshes, "camera": case["camera"], "light": case["light"], "size": self.options.size,
               "samples": self.options.samples, "seed": seed, "threads": self.options.threads, "output": output}
        file = self.path("job.json")
        with open(file, "w") as out:
            json.dump(job, out)
        said = run([self.options.blender, "-b", "--factory-startup", "--python-exit-code", "1", "--python",
                    os.path.join(FOLDER, "blender_render.py"), "--", file])
        if not os.path.exists(output):
            sys.exit("blender-compare: Blender wrote no picture: " + said.strip()[-600:])
        return output

    def compare(self, test, reference, mask):
        report = json.loads(run([self.options.nacre, "compare", test, reference, "--mask", mask + ":material.ID",
                                 "--json", "-"]))
        return report["psnr"], report["energyRatio"]


# ---- The shadow edge.

def edge_of(path, channel):
    """(mm from the edge, radiance) of every column, the mean of its rows."""
    rows = read_exr(path)[channel]
    columns = len(rows[0])
    pixel = EDGE_HEIGHT / len(rows)
    return [((i + 0.5 - columns / 2) * pixel, sum(row[i] for row in rows) / len(rows)) for i in range(columns)]


def value_at(edge, x):
    step = edge[1][0] - edge[0][0]
    place = (x - edge[0][0]) / step
    i = min(max(int(place), 0), len(edge) - 2)
    share = min(max(place - i, 0.0), 1.0)
    return edge[i][1] + share * (edge[i + 1][1] - edge[i][1])


def width_ratio(theirs, ours):
    """k such that theirs at k x is nearest to ours at x, least squares: theirs is k times as wide."""
    def error(k):
        reach = 0.9 * ours[-1][0] / max(k, 1)
        points = [x for x, _ in ours if abs(x) <= reach]
        return sum((value_at(theirs, k * x) - value_at(ours, x)) ** 2 for x in points) / len(points)

    low, high = -math.log(MOST_RADIUS_RATIO), math.log(MOST_RADIUS_RATIO)
    for _ in range(6):  # finer and finer about the best of 41
        steps = [low + (high - low) * i / 40 for i in range(41)]
        best = min(steps, key=lambda s: error(math.exp(s)))
        reach = (high - low) / 20
        low, high = best - reach, best + reach
    return math.exp(best)


def dipole_albedo(alpha):
    """What the dipole's half space of index 1.4 reflects at this reduced albedo (Jensen et al. 2001)."""
    fresnel = -1.440 / 1.4 ** 2 + 0.710 / 1.4 + 0.668 + 0.0636 * 1.4
    boundary = (1 + fresnel) / (1 - fresnel)
    depth = math.sqrt(3 * (1 - alpha))
    return alpha / 2 * (1 + math.exp(-4 / 3 * boundary * depth)) * math.exp(-depth)


def nominal_radius(method, d, albedo):
    """The radius that Cycles' sources promise: BURLEY divides it by 4 pi; RANDOM_WALK multiplies it by the factor between
    the diffuse and the mean free path that the dipole has at the albedo."""
    if method == "BURLEY":
        return 4 * math.pi * d
    low, high = 0.0, 1.0
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (middle, high) if dipole_albedo(middle) < albedo else (low, middle)
    mean_free_path = d * (1.9 - albedo + 3.5 * (albedo - 0.8) ** 2)
    return mean_free_path / math.sqrt(3 * (1 - low))


def calibrate(bench, method):
    """Cycles' radius [mm] per channel for our material, and by how much it differs from the nominal one."""
    nominal = [nominal_radius(method, d, a) for d, a in zip(bench.material["meanFreePath"], bench.material["albedo"])]
    ours = bench.ours("plane", OURS[method], 1)
    radius = nominal
    for turn in range(2):
        theirs = bench.cycles("plane", method, radius, 1, "-turn%d" % turn)
        ratios = [width_ratio(edge_of(theirs, c), edge_of(ours, c)) for c in CHANNELS]
        radius = [r / k for r, k in zip(radius, ratios)]
    return radius, [r / n for r, n in zip(radius, nominal)]


# ---- The table.

def row(bench, name, ours, cycles, radius):
    mine = [bench.ours(name, ours, seed) for seed in (1, 2)]
    theirs = [bench.cycles(name, cycles, radius, seed) for seed in (1, 2)]
    psnr, energy = bench.compare(theirs[0], mine[0], mine[0])
    noise = [bench.compare(two[1], two[0], mine[0])[0] for two in (mine, theirs)]
    chance = None
    if None not in noise:  # two seeds differ by twice the variance of one picture
        chance = -10 * math.log10(sum(10 ** (-value / 10) for value in noise) / 2)
    cells = [name, ours, cycles, decibels(psnr), decibels(chance)] + ["%+.1f" % (100 * (e - 1)) for e in energy]
    return cells + [decibels(value) for value in noise]


def decibels(value):
    return "same" if value is None else "%.1f" % value


def parse_size(text):
    try:
        width, height = (int(part) for part in text.split("x"))
    except ValueError:
        raise argparse.ArgumentTypeError("'%s' is not WIDTHxHEIGHT" % text)
    if not (16 <= width <= 4096 and 16 <= height <= 4096):
        raise argparse.ArgumentTypeError("%s is outside 16x16 to 4096x4096" % text)
    return width, height


def at_least_one(text):
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError("%s is below 1" % text)
    return value


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="where meshes, scenes and pictures go; what is there already is not traced again")
    parser.add_argument("--nacre", default=os.path.join(FOLDER, "../build/release/app/nacre"), help="the command")
    parser.add_argument("--blender", default="blender", help="Blender's command")
    parser.add_argument("--material", default="skin-burley", help="a preset with mean free paths; default skin-burley")
    parser.add_argument("--cases", nargs="+", choices=("plane", "ball", "head"), default=("plane", "ball", "head"))
    parser.add_argument("--size", type=parse_size, default=(240, 135), metavar="WxH", help="default 240x135")
    parser.add_argument("--spp", type=at_least_one, default=128, help="of nacre reference; default 128")
    parser.add_argument("--samples", type=at_least_one, default=256, help="of Cycles; default 256")
    parser.add_argument("--threads", type=int, default=0, help="0, the default, is all")
    return parser.parse_args()


def main():
    options = parse()
    os.makedirs(options.folder, exist_ok=True)
    options.folder = os.path.abspath(options.folder)
    bench = Bench(options)
    radii = {}
    for method in OURS:
        radii[method], ratios = calibrate(bench, method)
        print("%s: radius %s mm, %s of the nominal one" % (method, " ".join("%.3f" % r for r in radii[method]),
                                                          " ".join("%.3f" % r for r in ratios)), flush=True)
    columns = ["case", "ours", "Cycles", "PSNR, dB", "by noise alone, dB", "R, %", "G, %", "B, %", "our noise, dB", "their noise, dB"]
    print("\n| " + " | ".join(columns) + " |\n|" + "---|" * len(columns))
    for name in options.cases:
        pairs = [("off", "DIFFUSE", [0, 0, 0])] + [(OURS[m], m, radii[m]) for m in OURS]
        for ours, cycles, radius in pairs:
            print("| " + " | ".join(row(bench, name, ours, cycles, radius)) + " |", flush=True)


main()
