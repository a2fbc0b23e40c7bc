"""What spatial splits in the tree could bring: interiors of large triangles, as they are and with their triangles cut.

Those whose boxes are emptiest are cut first, halfway along their longest edge, until there are twice, four and eight times as many. Prints the
time over that of the triangles as they are, medians of ROUNDS. Needs `cargo build --release` in the root.

    python cut_triangles.py [ROUNDS]
"""

import heapq
import json
import math
import random
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

TRACER = Path(__file__).parent.parent / "target/release/tracer"
FACTORS = [1, 2, 4, 8]
SCENE = """Scene(
    camera: Camera(position: (0, 0, 26), look_at: (0, 0, 0), fov: 50),
    image: Image(width: 256, height: 256),
    render: Render(samples: 16, integrator: Path),
    background: (0.7, 0.8, 1),
    objects: [Mesh(file: "mesh.obj", material: Diffuse(albedo: (0.7, 0.7, 0.7)))],
)"""


def turned(p, angles):
    """A point turned about z, y and x."""
    for (i, j), angle in zip(((0, 1), (2, 0), (1, 2)), angles):
        p = list(p)
        p[i], p[j] = p[i] * math.cos(angle) - p[j] * math.sin(angle), p[i] * math.sin(angle) + p[j] * math.cos(angle)
    return tuple(p)


def box(center, half, angles=(0, 0, 0)):
    """The twelve triangles of a box."""
    corners = [turned([(1 if k >> i & 1 else -1) * half[i] for i in range(3)], angles) for k in range(8)]
    v = [tuple(a + b for a, b in zip(p, center)) for p in corners]
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return [t for a, b, c, d in sides for t in ((v[a], v[b], v[c]), (v[a], v[c], v[d]))]


def beams(count):
    """Thin beams at all slants."""
    rng = random.Random(1)
    number = lambda: [rng.uniform(-8, 8) for _ in range(3)]
    return [t for _ in range(count) for t in box(number(), (rng.uniform(2, 5), 0.06, 0.06), number())]


def building(angles):
    """Four floors with columns, stairs and rails."""
    boxes = []
    for y in (-8, -4, 0, 4):
        boxes.append(((0, y, 0), (9, 0.1, 9)))
        boxes += [((3 * i - 7.5, y + 2, 3 * j - 7.5), (0.15, 1.9, 0.15)) for i in range(6) for j in range(6)]
        boxes += [((0.6 * k - 6, y + 0.3 * k, 3), (0.3, 0.05, 1)) for k in range(12)]
        boxes += [((0.35 * k - 7, y + 0.6, 7), (0.02, 0.5, 0.02)) for k in range(40)]
        boxes.append(((0, y + 1.1, 7), (7.2, 0.04, 0.05)))
    return [tuple(turned(p, angles) for p in t) for b in boxes for t in box(*b)]


def emptiness(t):
    """Half the surface of a triangle's box less the triangle's area."""
    x, y, z = (max(p[k] for p in t) - min(p[k] for p in t) for k in range(3))
    u, v = ([b - a for a, b in zip(t[0], q)] for q in t[1:])
    normal = [u[i] * v[j] - u[j] * v[i] for i, j in ((1, 2), (2, 0), (0, 1))]
    return x * y + y * z + z * x - math.hypot(*normal) / 2


def cut(triangles, factor):
    """So many times as many triangles."""
    heap = [(-emptiness(t), k, t) for k, t in enumerate(triangles)]
    heapq.heapify(heap)
    made = len(heap)
    while len(heap) < factor * len(triangles):
        t = heapq.heappop(heap)[2]
        edge = max(range(3), key=lambda k: math.dist(t[k], t[(k + 1) % 3]))
        a, b, c = t[edge], t[(edge + 1) % 3], t[(edge + 2) % 3]
        middle = tuple((x + y) / 2 for x, y in zip(a, b))
        for half in ((a, middle, c), (middle, b, c)):
            made += 1
            heapq.heappush(heap, (-emptiness(half), made, half))
    return [t for *_, t in heap]


def write(triangles, folder):
    """A scene of these triangles."""
    folder.mkdir()
    with open(folder / "mesh.obj", "w") as out:
        for t in triangles:
            out.writelines("v %.6f %.6f %.6f\n" % p for p in t)
        out.writelines(f"f {3 * k + 1} {3 * k + 2} {3 * k + 3}\n" for k in range(len(triangles)))
    (folder / "scene.ron").write_text(SCENE)


def seconds(folder):
    """Of rendering the scene there."""
    report = folder / "report.json"
    command = [TRACER, "render", folder / "scene.ron", "-o", folder / "out.png", "--threads", "1", "-q", "--report", report]
    subprocess.run(command, check=True)
    return json.loads(report.read_text())["seconds"]["render"]


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    scenes = {
        "3000 thin beams": beams(3000),
        "a building": building((0, 0, 0)),
        "a building, turned": building((0.5, 0.4, 0.3)),
    }
    print("| scene | triangles |", " | ".join(f"x{factor}" for factor in FACTORS), "|")
    for name, triangles in scenes.items():
        with tempfile.TemporaryDirectory() as place:
            folders = [Path(place) / str(factor) for factor in FACTORS]
            for factor, folder in zip(FACTORS, folders):
                write(cut(triangles, factor), folder)
            # In turns, so that what slows the machine slows all of them.
            times = zip(*([seconds(folder) for folder in folders] for _ in range(rounds)))
            medians = [statistics.median(t) for t in times]
        ratios = " | ".join(f"{t / medians[0]:.2f}" for t in medians)
        print("|", name, "|", len(triangles), "|", ratios, "|", flush=True)


if __name__ == "__main__":
    main()
