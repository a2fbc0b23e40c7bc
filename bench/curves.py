"""How processor time grows with the size of a scene: `python bench/curves.py [CURVE ..]`, after `cargo build --release`.

The scenes are those of `benches/curves.rs`. What counts are cycles in user mode of `tracer render`, less those of `tracer info`
(which reads, compiles and renders nothing), per camera sample: on a machine that others use, too, the clock says nothing, and cycles
say something. Needs `perf`; a virtual machine that does not count cycles gives processor time. Each entry is the least of REPEATS (3); each curve is told relative to one of its entries.
"""

import math
import os
import pathlib
import random
import resource
import struct
import subprocess
import sys
import tempfile
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
TRACER = os.environ.get("TRACER", str(ROOT / "target/release/tracer"))
REPEATS = int(os.environ.get("REPEATS", "3"))
SIZE = 256
LAMP = "SphereLight(center: (-10, 20, 40), radius: 5, intensity: 3974)"
WALLS = [
    ("(0, -10020, 0)", "(1, 1, 1)"),
    ("(0, 10050, 0)", "(1, 0.01, 0.01)"),
    ("(0, 0, -10050)", "(0.01, 1, 1)"),
    ("(0, 0, 10100)", "(1, 0.01, 1)"),
    ("(-10050, 0, 0)", "(0.01, 1, 0.01)"),
    ("(10050, 0, 0)", "(0.01, 0.01, 1)"),
]


def in_the_room(size, samples, lights, objects):
    walls = "".join(f"Sphere(center: {c}, radius: 10000, material: Diffuse(albedo: {a})),\n" for c, a in WALLS)
    return f"""Scene(version: 1,
        camera: Camera(position: (0, 0, 55), look_at: (0, 0, 0), fov: 60),
        image: Image(width: {size}, height: {size}),
        render: Render(samples: {samples}, max_bounces: 5),
        lights: [{lights}],
        objects: [{walls}{objects}],
    )"""


def spread(k):
    """The k-th point of a sequence that fills the unit cube evenly (Roberts' R3)."""
    return [(0.5 + a * (k + 1)) % 1 for a in (0.819172513396, 0.671043606704, 0.549700477902)]


def balls(size, samples):
    materials = [f"Mirror(reflectance: {r})" for r in (1, 0.5, 0.1)]
    materials += [
        f"BlinnPhong(albedo: {a}, exponent: 1000, specular: {s})"
        for a, s in (("(0.1, 0.1, 1)", 0.01), ("(0.1, 1, 0.1)", 0.05), ("(1, 0.1, 0.1)", 0.1))
    ]
    materials += [f"Transparent(ior: {n})" for n in (1.33, 1.52, 2.42)]
    objects = "".join(
        f"Sphere(center: ({20 * (k % 3 - 1)}, {20 * (k // 3) - 10}, -20), radius: 10, material: {m}),"
        for k, m in enumerate(materials)
    )
    return in_the_room(size, samples, LAMP, objects), {}


def off(vertices, faces):
    lines = [f"OFF\n{len(vertices)} {len(faces)} 0"]
    lines += ["%.6f %.6f %.6f" % v for v in vertices] + ["3 %d %d %d" % f for f in faces]
    return "\n".join(lines) + "\n"


def png(side, pixels):
    """A picture of 8 bits a channel, stored as it is."""
    rows = b"".join(b"\0" + pixels[3 * side * y :][: 3 * side] for y in range(side))
    chunk = lambda name, data: struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    header = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
    parts = (b"IHDR", header), (b"IDAT", zlib.compress(rows, 1)), (b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunk(*part) for part in parts)


def hills(triangles, size, samples):
    side = max(1, math.ceil(math.sqrt(triangles / 2)))
    vertices, faces = [], []
    for j in range(side + 1):
        for i in range(side + 1):
            x, z = i / side, j / side
            y = 0.08 * math.sin(9 * x) * math.cos(7 * z) + 0.004 * math.sin(170 * x) * math.sin(190 * z)
            vertices.append((x - 0.5, y, z - 0.5))
    for j in range(side):
        for i in range(side):
            a = j * (side + 1) + i
            faces += [(a, a + side + 1, a + 1), (a + 1, a + side + 1, a + side + 2)]
    mesh = """Mesh(file: "hills.off", material: Diffuse(albedo: 0.7), shading: Smooth,
        transform: [Scale(factor: 90, about: (0, 0, 0)), Translate((0, -12, 0))])"""
    return in_the_room(size, samples, LAMP, mesh), {"hills.off": off(vertices, faces)}


def copies(count, size, samples):
    rows, columns = 16, 32
    vertices, faces = [], []
    for j in range(rows + 1):
        for i in range(columns):
            polar, around = math.pi * j / rows, 2 * math.pi * i / columns
            vertices.append((math.sin(polar) * math.cos(around), math.cos(polar), math.sin(polar) * math.sin(around)))
    for j in range(rows):
        for i in range(columns):
            a, b = j * columns + i, j * columns + (i + 1) % columns
            faces += [(a, b, a + columns)] * (j > 0) + [(b, b + columns, a + columns)] * (j + 1 < rows)
    radius = 20 / count ** (1 / 3)
    lines = ("%.4f %.4f %.4f %.5f" % (*(60 * u - 30 for u in spread(k)), radius) for k in range(count))
    mesh = 'Mesh(file: "ball.off", material: Diffuse(albedo: 0.7), placements: "placements.txt")'
    files = {"ball.off": off(vertices, faces), "placements.txt": "\n".join(lines) + "\n"}
    return in_the_room(size, samples, LAMP, mesh), files


def meshes(count, size, samples):
    """So many files, each another hill of its own: none is shared."""
    text, files = "", {}
    side = math.ceil(math.sqrt(count))
    for k in range(count):
        points = [((i % 21) / 20, (i // 21) / 20) for i in range(441)]
        heights = [0.3 * math.sin(9 * x + k) * math.cos(7 * z - k) for x, z in points]
        vertices = [(x - 0.5, y, z - 0.5) for (x, z), y in zip(points, heights)]
        corners = [21 * j + i for j in range(20) for i in range(20)]
        files[f"{k}.off"] = off(vertices, [f for a in corners for f in ((a, a + 21, a + 1), (a + 1, a + 21, a + 22))])
        at = (90 * ((k % side + 0.5) / side - 0.5), -12, 90 * ((k // side + 0.5) / side - 0.5))
        text += f'Mesh(file: "{k}.off", material: Diffuse(albedo: 0.7), transform: [Scale({90 / side}), Translate({at})]),'
    return in_the_room(size, samples, LAMP, text), files


def textures(side, size, samples):
    """A ground with a picture of side x side pixels; of one pixel where side is 1."""
    pixels = random.Random(1).randbytes(3 * side * side)
    ground = """Rectangle(center: (0, -12, 0), size: 90, material: Diffuse(albedo: Texture(file: "ground.png")))"""
    return in_the_room(size, samples, LAMP, ground), {"ground.png": png(side, pixels)}


def lamps(count, size, samples):
    lights = ""
    for x, y, z in map(spread, range(count)):
        center = "(%.3f, %.3f, %.3f)" % (80 * x - 40, 30 + 15 * y, 90 * z - 40)
        lights += f"SphereLight(center: {center}, radius: 0.3, power: {120000 / count:.4f}),"
    objects = "".join(f"Sphere(center: ({18 * k - 36}, -10, 0), radius: 8)," for k in range(5))
    return in_the_room(size, samples, lights, objects), {}


LARGEST = 7 if "BENCH_LARGE" in os.environ else 6
# Name: entries, the scene of an entry, its size and samples, and the entry that the others are told by.
CURVES = {
    "resolution": ([64, 128, 256, 512, 1024, 2048], lambda x: balls(x, 4), lambda x: (x, 4), 256),
    "samples": ([1, 4, 16, 64, 256], lambda x: balls(SIZE, x), lambda x: (SIZE, x), 16),
    "triangles": ([10**k for k in range(3, LARGEST + 1)], lambda x: hills(x, SIZE, 4), lambda x: (SIZE, 4), 1000),
    "copies": ([10**k for k in range(6)], lambda x: copies(x, SIZE, 4), lambda x: (SIZE, 4), 1),
    "meshes": ([10**k for k in range(4)], lambda x: meshes(x, SIZE, 4), lambda x: (SIZE, 4), 1),
    "textures": ([1, 256, 1024, 4096, 8192], lambda x: textures(x, SIZE, 4), lambda x: (SIZE, 4), 1),
    "lamps": ([10**k for k in range(5)], lambda x: lamps(x, SIZE, 4), lambda x: (SIZE, 4), 1),
}


def cycles(*arguments):
    """Millions of cycles in user mode, the least of some runs; where the machine does not count them, milliseconds."""
    command = ["perf", "stat", "-x", ",", "-e", "cycles:u", TRACER, *arguments]
    least = math.inf
    for _ in range(REPEATS):
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        run = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=True)
        milliseconds = 1e3 * (resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before)
        told = next(line for line in run.stderr.splitlines() if "cycles" in line).split(",")[0]
        least = min(least, float(told) / 1e6 if told.isdigit() else milliseconds)
    return least


def main():
    for name in sys.argv[1:] or CURVES:
        entries, scene, shape, base = CURVES[name]
        per_sample = {}
        for entry in entries:
            with tempfile.TemporaryDirectory() as folder:
                text, files = scene(entry)
                for file, content in {**files, "scene.ron": text}.items():
                    pathlib.Path(folder, file).write_bytes(content if isinstance(content, bytes) else content.encode())
                path = str(pathlib.Path(folder, "scene.ron"))
                start = cycles("info", path)
                whole = cycles("render", path, "--quiet", "-o", str(pathlib.Path(folder, "out.pfm")))
            size, samples = shape(entry)
            per_sample[entry] = 1e6 * (whole - start) / (size * size * samples)
            print(f"{name} {entry}: {per_sample[entry]:.0f} cycles a sample (or ns), {start:.0f} million before (or ms)", flush=True)
        for entry in entries:
            print(f"{name} {entry}: speed {per_sample[base] / per_sample[entry]:.3f}", flush=True)


if __name__ == "__main__":
    main()
