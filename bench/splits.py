"""What cutting triangles for the tree brings (spatial splits): triangles that are long, large or aslant, by two builds.

Prints how many parts there are, how much larger the tree is, and the time over that of OTHER, a build of another commit, medians of ROUNDS
taken in turns. Needs `cargo build --release` in the root.

    python splits.py OTHER [ROUNDS]
"""

import json
import math
import random
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

TRACER = Path(__file__).parent.parent / "target/release/tracer"
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


def cylinders(count):
    """Of 24 facets and one lid, leaning all ways."""
    rng = random.Random(5)
    triangles = []
    for _ in range(count):
        center = [rng.uniform(-8, 8) for _ in range(3)]
        angles = [rng.uniform(-8, 8) for _ in range(3)]
        radius, half = rng.uniform(0.3, 1), rng.uniform(2, 6)

        def place(p):
            return tuple(a + b for a, b in zip(turned(p, angles), center))

        rims = [
            [place((side * half, radius * math.cos(k * math.pi / 12), radius * math.sin(k * math.pi / 12))) for k in range(25)]
            for side in (-1, 1)
        ]
        lid = place((half, 0, 0))
        for k in range(24):
            (a, b), (c, d) = (rim[k : k + 2] for rim in rims)
            triangles += [(a, b, c), (b, d, c), (c, d, lid)]
    return triangles


def soup(count):
    """Large triangles of all shapes."""
    rng = random.Random(3)
    triangles = []
    for _ in range(count):
        center = [rng.uniform(-8, 8) for _ in range(3)]
        triangles.append(tuple(tuple(a + rng.uniform(-3, 3) for a in center) for _ in range(3)))
    return triangles


def write(triangles, folder):
    """A scene of these triangles."""
    folder.mkdir()
    with open(folder / "mesh.obj", "w") as out:
        for t in triangles:
            out.writelines("v %.6f %.6f %.6f\n" % p for p in t)
        out.writelines(f"f {3 * k + 1} {3 * k + 2} {3 * k + 3}\n" for k in range(len(triangles)))
    (folder / "scene.ron").write_text(SCENE)


def render(program, folder):
    """The report of rendering the scene there."""
    report = folder / "report.json"
    command = [program, "render", folder / "scene.ron", "-o", folder / "out.png", "--threads", "1", "-q", "--report", report]
    subprocess.run(command, check=True)
    return json.loads(report.read_text())


def main():
    other = Path(sys.argv[1]).resolve()
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 5
    scenes = {
        "3000 thin beams": beams(3000),
        "300 thin beams": beams(300),
        "60 leaning cylinders": cylinders(60),
        "a building": building((0, 0, 0)),
        "a building, turned": building((0.5, 0.4, 0.3)),
        "5000 large triangles": soup(5000),
    }
    print("| scene | triangles | parts | tree | time |")
    for name, triangles in scenes.items():
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place) / "scene"
            write(triangles, folder)
            # In turns, so that what slows the machine slows both.
            pairs = [[render(program, folder) for program in (other, TRACER)] for _ in range(rounds)]
        before, after = (statistics.median(r["seconds"]["render"] for r in reports) for reports in zip(*pairs))
        trees = [report["tree"] for report in pairs[0]]
        growth = trees[1]["bytes"] / trees[0]["bytes"]
        print(f"| {name} | {len(triangles)} | {trees[1]['parts']} | {growth:.2f} | {after / before:.2f} |", flush=True)


if __name__ == "__main__":
    main()
