"""What rays against each kind of shape cost, against as many spheres: `python bench/shapes.py [KIND ..]`, after `cargo build --release`.

A thousand shapes that fill a cube, each within a ball of the same size and turned its own way (planes: four, against four spheres), seen by the
camera under a white sky: every sample is one ray and whatever its hit needs, black and without a light. What counts is the time of the processor in user mode that one
thread takes for SAMPLES samples more, the least of REPEATS (5); the last column is what is left once rays into nothing are taken off.
Then a hundred thousand boxes and cylinders, and the same as triangles in a file, twelve each.
"""

import os
import pathlib
import random
import resource
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TRACER = os.environ.get("TRACER", str(ROOT / "target/release/tracer"))
REPEATS = int(os.environ.get("REPEATS", "5"))
SAMPLES = int(os.environ.get("SAMPLES", "24"))
SIZE = 256
COUNT = 1000


def kinds(p, r):
    """Each kind of shape about a point, of a size of about a radius."""
    x, y, z = p
    ends = f"from: ({x - 0.7 * r}, {y}, {z}), to: ({x + 0.7 * r}, {y}, {z})"
    at = f"center: ({x}, {y}, {z})"
    half = 0.5 * r
    path = f"[({x - 0.7 * r}, {y - half}, {z}), ({x}, {y + half}, {z + half}), ({x + 0.7 * r}, {y - half}, {z - half})]"
    return {
        "Sphere": f"Sphere({at}, radius: {r}",
        "Rectangle": f"Rectangle({at}, size: {1.4 * r}",
        "Disk": f"Disk({at}, radius: {r}",
        "Box": f"Box({at}, size: {1.15 * r}",
        "Cylinder": f"Cylinder({ends}, radius: {0.7 * r}",
        "Cone": f"Cone({ends}, radius: {0.7 * r}",
        "Capsule": f"Capsule({ends.replace('0.7', '0.5')}, radius: {half}",
        "Torus": f"Torus({at}, radius: {0.7 * r}, tube_radius: {0.3 * r}",
        "Tube": f"Tube(points: {path}, radius: {0.2 * r}, curve: CatmullRom",
        "Difference": f"Difference(objects: [Box({at}, size: {1.15 * r}), Sphere({at}, radius: {0.7 * r})]",
        "Union": f"Union(objects: [Cylinder({ends}, radius: {0.4 * r}), Sphere({at}, radius: {half})]",
    }


def scene(objects):
    return f"""Scene(
        camera: Camera(position: (0, 0, 36), look_at: (0, 0, 0), fov: 24),
        image: Image(width: {SIZE}, height: {SIZE}), render: Render(max_bounces: 0, integrator: Path), background: 1,
        objects: [{objects}],
    )"""


def crowd(kind, count):
    random.seed(1)
    items = []
    for _ in range(count):
        p = [random.uniform(-5, 5) for _ in range(3)]
        axis = tuple(random.gauss(0, 1) for _ in range(3))
        turn = "" if kind == "Sphere" else f", transform: [Rotate(axis: {axis}, degrees: {random.uniform(0, 360)}, about: {tuple(p)})]"
        items.append(kinds(p, 0.45)[kind] + turn + ")")
    return ", ".join(items)


def planes(kind):
    """Four of them behind each other, met by every ray at the last."""
    if kind == "Plane":
        return ", ".join(f"Plane(point: (0, 0, {-k}), normal: (0, 0.01, 1))" for k in range(4))
    return ", ".join(f"Sphere(center: (0, 0, {-300 - k}), radius: 300)" for k in range(4))


def user_time(file, samples):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    command = [TRACER, "render", str(file), "-o", str(file.with_suffix(".png")), "--samples", str(samples), "--threads", "1", "--quiet"]
    subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def nanoseconds(folder, name, text):
    """Of a ray."""
    file = pathlib.Path(folder) / f"{name}.ron"
    file.write_text(text)
    best = min(user_time(file, 1 + SAMPLES) - user_time(file, 1) for _ in range(REPEATS))
    return 1e9 * best / (SAMPLES * SIZE * SIZE)


def prisms(folder, count):
    """Boxes and cylinders of words, and a file with as many boxes and prisms of four sides."""
    random.seed(2)
    words, points, faces = [], [], []
    for k in range(count):
        x, y, z = (random.uniform(-5, 5) for _ in range(3))
        if k % 2:
            words.append(f"Box(center: ({x}, {y}, {z}), size: 0.08)")
        else:
            words.append(f"Cylinder(from: ({x}, {y - 0.04}, {z}), to: ({x}, {y + 0.04}, {z}), radius: 0.04)")
        first = len(points)
        points += [(x + 0.04 * a, y + 0.04 * b, z + 0.04 * c) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
        for a, b, c, d in ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)):
            faces += [(first + a, first + b, first + c), (first + a, first + c, first + d)]
    with open(pathlib.Path(folder) / "prisms.obj", "w") as out:
        out.writelines(f"v {x} {y} {z}\n" for x, y, z in points)
        out.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces)
    return ", ".join(words), 'Mesh(file: "prisms.obj")'


def main():
    wanted = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        nothing = nanoseconds(folder, "nothing", scene("Sphere(center: (0, 0, 900), radius: 1)"))
        print(f"a ray into nothing: {nothing:.0f} ns")
        for of_planes in (True, False):
            names = ["Sphere", "Plane"] if of_planes else list(kinds((0, 0, 0), 1))
            spheres = None
            for name in names:
                if name != "Sphere" and wanted and name not in wanted:
                    continue
                objects = planes(name) if of_planes else crowd(name, COUNT)
                time = nanoseconds(folder, name, scene(objects))
                spheres = spheres or time
                count = 4 if of_planes else COUNT
                share = (spheres - nothing) / max(time - nothing, 0.1)
                print(f"{count:5} {name:10} {time:7.0f} ns, {spheres / time:.2f} of the spheres' speed, {share:.2f} without what nothing costs", flush=True)
        if not wanted or "many" in wanted:
            words, mesh = prisms(folder, 100_000)
            a, b = (nanoseconds(folder, name, scene(text)) for name, text in (("words", words), ("mesh", mesh)))
            print(f"100000 boxes and cylinders {a:.0f} ns, the same as 1.2 million triangles {b:.0f} ns: {b / a:.2f}")


if __name__ == "__main__":
    main()
