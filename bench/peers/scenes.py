"""Scenes described once: each becomes a `.ron` for tracer and a dictionary for Mitsuba 3."""

import math
import os
import random
from dataclasses import dataclass, field

ASSETS = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "assets"))


# Materials.
@dataclass
class Diffuse:
    albedo: tuple

    def ron(self):
        return f"Diffuse(albedo: {triple(self.albedo)})"

    def mitsuba(self):
        return two_sided({"type": "diffuse", "reflectance": rgb(self.albedo)})


@dataclass
class Textured:
    file: str

    def ron(self):
        return f"Diffuse(albedo: Texture(file: {quoted(self.file)}))"

    def mitsuba(self):
        texture = {"type": "bitmap", "filename": os.path.join(ASSETS, self.file), "filter_type": "bilinear"}
        return two_sided({"type": "diffuse", "reflectance": {**texture, "wrap_mode": "repeat"}})


@dataclass
class Mirror:
    reflectance: tuple

    def ron(self):
        return f"Mirror(reflectance: {triple(self.reflectance)})"

    def mitsuba(self):
        # The material `none` reflects everything.
        return two_sided({"type": "conductor", "material": "none", "specular_reflectance": rgb(self.reflectance)})


@dataclass
class Glass:
    ior: float
    transmittance: tuple = (1.0, 1.0, 1.0)

    def ron(self):
        return f"Transparent(ior: {self.ior}, transmittance: {triple(self.transmittance)})"

    def mitsuba(self):
        glass = {"type": "dielectric", "int_ior": self.ior, "ext_ior": 1.0}
        return {**glass, "specular_transmittance": rgb(self.transmittance)}


@dataclass
class BlinnPhong:
    """Only of tracer: Mitsuba has no such material."""

    albedo: tuple
    specular: float
    exponent: float

    def ron(self):
        return f"BlinnPhong(albedo: {triple(self.albedo)}, specular: {self.specular}, exponent: {self.exponent})"


# Shapes.
@dataclass
class Sphere:
    center: tuple
    radius: float
    material: object

    def ron(self):
        return f"Sphere(center: {triple(self.center)}, radius: {self.radius}, material: {self.material.ron()})"

    def mitsuba(self, mi):
        shape = {"type": "sphere", "center": list(self.center), "radius": self.radius}
        return {**shape, "bsdf": self.material.mitsuba()}


@dataclass
class Mesh:
    """An OBJ file of assets/, scaled about the origin, turned about the y axis and then moved."""

    file: str
    material: object
    scale: float = 1.0
    degrees: float = 0.0
    move: tuple = (0.0, 0.0, 0.0)
    smooth: bool = False

    def ron(self):
        steps = [
            f"Scale(factor: {self.scale}, about: (0, 0, 0))",
            f"Rotate(axis: (0, 1, 0), degrees: {self.degrees}, about: (0, 0, 0))",
            f"Translate({triple(self.move)})",
        ]
        return (
            f"Mesh(file: {quoted(self.file)}, material: {self.material.ron()}, "
            f"shading: {'Smooth' if self.smooth else 'Flat'}, transform: [{', '.join(steps)}])"
        )

    def mitsuba(self, mi):
        t = mi.ScalarTransform4f
        to_world = t().translate(list(self.move)).rotate([0, 1, 0], self.degrees).scale(self.scale)
        shape = {"type": "obj", "filename": os.path.join(ASSETS, self.file), "to_world": to_world}
        return {**shape, "face_normals": not self.smooth, "bsdf": self.material.mitsuba()}


@dataclass
class Light:
    center: tuple
    radius: float
    radiance: tuple
    # What is to be lit lies in it: Mitsuba's spheres emit to one side only.
    around: bool = False

    def ron(self):
        return f"SphereLight(center: {triple(self.center)}, radius: {self.radius}, radiance: {triple(self.radiance)})"

    def mitsuba(self, mi):
        shape = {"type": "sphere", "center": list(self.center), "radius": self.radius, "flip_normals": self.around}
        black = {"type": "diffuse", "reflectance": rgb((0, 0, 0))}
        return {**shape, "bsdf": black, "emitter": {"type": "area", "radiance": rgb(self.radiance)}}


@dataclass
class Scene:
    name: str
    objects: list
    lights: list = field(default_factory=list)
    background: tuple = None
    bounces: int = 5
    eye: tuple = (0.0, 0.0, 55.0)
    look_at: tuple = (0.0, 0.0, 0.0)
    fov: float = 60.0
    # Diameter of the lens, distance of the plane of focus.
    lens: tuple = None
    # Blinn-Phong has no counterpart in Mitsuba.
    ours_only: bool = False

    def ron(self, size):
        lens = f"ThinLens(aperture: {self.lens[0]}, focus_distance: {self.lens[1]})" if self.lens else "None"
        return (
            "Scene(\n"
            f"  camera: Camera(position: {triple(self.eye)}, look_at: {triple(self.look_at)}, fov: {self.fov}),\n"
            f"  image: Image(width: {size}, height: {size}),\n"
            f"  render: Render(max_bounces: {self.bounces}),\n"
            f"  effects: Effects(antialiasing: Box, depth_of_field: {lens}),\n"
            f"  background: {triple(self.background or (0, 0, 0))},\n"
            f"  lights: [{', '.join(light.ron() for light in self.lights)}],\n"
            f"  objects: [\n    {(',' + chr(10) + '    ').join(o.ron() for o in self.objects)}\n  ],\n)\n"
        )

    def mitsuba(self, mi, size):
        t = mi.ScalarTransform4f
        sensor = {
            "type": "thinlens" if self.lens else "perspective",
            "fov": self.fov,
            "fov_axis": "y",
            "near_clip": 1e-3,
            "far_clip": 1e6,
            "to_world": t().look_at(origin=list(self.eye), target=list(self.look_at), up=[0, 1, 0]),
            "film": {
                "type": "hdrfilm",
                "width": size,
                "height": size,
                "pixel_format": "rgb",
                "component_format": "float32",
                "rfilter": {"type": "box"},
            },
            "sampler": {"type": "independent"},
        }
        if self.lens:
            sensor |= {"aperture_radius": self.lens[0] / 2, "focus_distance": self.lens[1]}
        # max_bounces counts scatterings after the first hit, max_depth the vertices of a path, eye and light among them.
        scene = {"type": "scene", "integrator": {"type": "path", "max_depth": self.bounces + 2}, "sensor": sensor}
        if self.background:
            scene["background"] = {"type": "constant", "radiance": rgb(self.background)}
        for k, part in enumerate(self.objects + self.lights):
            scene[f"part{k}"] = part.mitsuba(mi)
        return scene


def rgb(color):
    return {"type": "rgb", "value": list(map(float, color))}


def two_sided(bsdf):
    return {"type": "twosided", "bsdf": bsdf}


def triple(v):
    return "(" + ", ".join(repr(float(x)) for x in v) + ")"


def quoted(file):
    return '"' + os.path.join(ASSETS, file).replace("\\", "\\\\") + '"'


def room():
    """The report's room: six huge balls whose near sides are walls."""
    r = 10000.0
    walls = [
        ((0, -20 - r, 0), (1, 1, 1)),
        ((0, 50 + r, 0), (1, 0.01, 0.01)),
        ((0, 0, -50 - r), (0.01, 1, 1)),
        ((0, 0, 100 + r), (1, 0.01, 1)),
        ((-50 - r, 0, 0), (0.01, 1, 0.01)),
        ((50 + r, 0, 0), (0.01, 0.01, 1)),
    ]
    return [Sphere(center, r, Diffuse(albedo)) for center, albedo in walls]


def lamp():
    return Light((-10, 20, 40), 5, (50.6,) * 3)


def row(y, materials):
    return [Sphere((x, y, -20), 10, m) for x, m in zip((-20, 0, 20), materials)]


def floor(albedo=(0.7, 0.65, 0.6)):
    return Sphere((0, -1000, 0), 1000, Diffuse(albedo))


def three_balls():
    return [
        Sphere((-20, -10, -20), 10, Diffuse((1, 0.05, 0.05))),
        Sphere((10, 10, 20), 10, Diffuse((0.1, 1, 0.3))),
        Sphere((0, 0, 0), 10, Diffuse((0.1, 0.3, 1))),
    ]


def on_floor(name, cat, **more):
    """The cat on a floor under a lamp and a pale sky."""
    view = dict(eye=(30, 45, 110), look_at=(0, 18, 0), fov=32.0)
    lights = [Light((40, 90, 60), 12, (18.0, 17.0, 15.0))]
    return Scene(name, [floor(), cat], lights, background=(0.35, 0.45, 0.6), **{**view, **more})


def scenes():
    balls = [Diffuse((0.8, 0.5, 0.2)), Mirror((0.9, 0.8, 0.7)), Glass(1.5)]
    ring = [
        Sphere((8 * math.cos(a), 8 * math.sin(a), 0), 3.5, m)
        for a, m in zip((0.3, 2.4, 4.5), balls)
    ]
    return [
        Scene("diffuse balls in the room", room() + three_balls(), [lamp()]),
        Scene("mirrors in the room", room() + row(-10, [Mirror((r,) * 3) for r in (1, 0.5, 0.1)]), [lamp()]),
        Scene("water, glass, diamond in the room", room() + row(10, [Glass(n) for n in (1.33, 1.52, 2.42)]), [lamp()]),
        Scene("a lens", room() + three_balls(), [lamp()], lens=(4.0, 55.0)),
        Scene(
            "two lights, one bounce",
            room() + three_balls(),
            [Light((-25, 30, 20), 3, (90, 60, 30)), Light((30, -5, 10), 6, (5, 10, 20))],
            bounces=1,
        ),
        Scene("within a light", ring, [Light((0, 0, 0), 60, (0.9, 0.7, 0.5), around=True)], bounces=8, eye=(0, 5, 30)),
        Scene(
            "a light within glass, coloured glass",
            [floor(), Sphere((-6, 6, 0), 6, Glass(1.4)), Sphere((7, 5, 0), 5, Glass(1.6, (0.9, 0.6, 0.4)))],
            [Light((-6, 6, 0), 4, (6, 5, 4))],
            background=(0.3, 0.4, 0.5),
            bounces=9,
            eye=(0, 14, 40),
            look_at=(0, 5, 0),
            fov=35.0,
        ),
        on_floor("a textured cat", Mesh("cat.obj", Textured("cat.png"), 0.9, -40.0), bounces=3),
        on_floor("a smooth cat of 60000 triangles", Mesh("cat_60k.obj", Diffuse((0.8, 0.6, 0.5)), 0.9, 35.0, smooth=True)),
        on_floor("a mirror cat, flat", Mesh("cat.obj", Mirror((0.9, 0.85, 0.8)), 0.8, 150.0, (5, 2, 0))),
        on_floor("a glass cat, flat", Mesh("cat.obj", Glass(1.5), 0.9, -40.0, (0, 1, 0)), bounces=12),
    ]


def figure_4(middle):
    balls = row(-10, [Mirror((r,) * 3) for r in (1, 0.5, 0.1)]) + row(10, middle)
    return room() + balls + row(30, [Glass(n) for n in (1.33, 1.52, 2.42)])


BLUE_GREEN_RED = ((0.1, 0.1, 1), (0.1, 1, 0.1), (1, 0.1, 0.1))


def timed_scenes(work):
    """What both are timed with; Mitsuba has no Blinn-Phong material, so figure 4's glossy balls are matt."""
    return [scene for scene in noise_scenes(work) if not scene.ours_only]


FUR = Diffuse((0.8, 0.6, 0.5))


def statues(size=0.6):
    """Three cats of 60000 triangles, a mirror, matt and of glass."""
    materials = (Mirror((0.9,) * 3), FUR, Glass(1.5))
    return [Mesh("cat_60k.obj", m, size, -30.0, (x, -19.9, 0), smooth=True) for x, m in zip((-26, 0, 26), materials)]


def noise_scenes(work):
    """What noise is compared on with Mitsuba. The last has about a million triangles, made in the folder `work`."""
    glossy = [BlinnPhong(c, 0.2, e) for c, e in zip(BLUE_GREEN_RED, (10, 100, 1000))]
    million = Mesh(subdivided("cat_60k.obj", work), FUR, 0.9, -40.0, (0, -20, 0), smooth=True)
    return [
        Scene("figure 4, matt middle row", figure_4([Diffuse(c) for c in BLUE_GREEN_RED]), [lamp()]),
        Scene("figure 4", figure_4(glossy), [lamp()], ours_only=True),
        Scene("three statues", room() + statues(), [lamp()], bounces=10),
        Scene("a matt mesh", room() + [Mesh("cat_60k.obj", FUR, 0.9, -40.0, (0, -20, 0), smooth=True)], [lamp()]),
        Scene("a matt mesh of a million, a lens", room() + [million], [lamp()], lens=(3.0, 55.0)),
    ]


def subdivided(file, work):
    """A mesh with every triangle cut into four, twice; edges keep their midpoints in common."""
    out = os.path.join(work, "million.obj")
    if os.path.exists(out):
        return out
    points, faces = [], []
    with open(os.path.join(ASSETS, file)) as f:
        for line in f:
            words = line.split()
            if words[:1] == ["v"]:
                points.append(tuple(map(float, words[1:4])))
            elif words[:1] == ["f"]:
                faces.append([int(w.split("/")[0]) - 1 for w in words[1:4]])
    for _ in range(2):
        middle = {}

        def between(a, b):
            key = (min(a, b), max(a, b))
            if key not in middle:
                middle[key] = len(points)
                points.append(tuple((x + y) / 2 for x, y in zip(points[a], points[b])))
            return middle[key]

        finer = []
        for a, b, c in faces:
            ab, bc, ca = between(a, b), between(b, c), between(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = finer
    with open(out + ".part", "w") as f:
        f.writelines("v %.6f %.6f %.6f\n" % p for p in points)
        f.writelines("f %d %d %d\n" % tuple(i + 1 for i in t) for t in faces)
    os.replace(out + ".part", out)
    return out


def plain_scenes(folder, work, size):
    """What tracer is compared on with its own plain path tracer: (name, file, size of the picture)."""
    repository = os.path.join(ASSETS, "..", "scenes")
    for number in range(1, 10):
        yield f"figure {number}", os.path.join(repository, f"fig{number}.ron"), (size, size)
    for name, shape in (("bokeh", 16 / 9), ("cat_planet", 16 / 9), ("cradle", 3 / 2), ("marbles", 4 / 3), ("still_life", 4 / 3)):
        yield f"gallery: {name}", os.path.join(repository, "gallery", name + ".ron"), (size, round(size / shape))
    for scene in scenes() + noise_scenes(work)[2:4] + more_scenes(work):
        file = os.path.join(folder, "scene.ron")
        with open(file, "w") as f:
            f.write(scene.ron(size))
        yield scene.name, file, (size, size)


def more_scenes(work):
    """What the others lack: very many lamps, everything specular, outdoors, rooms with a window, casters whose light goes nowhere, long
    paths, random balls."""
    draw = random.Random(7)
    lamps = [
        Light([draw.uniform(-40, 40), draw.uniform(-15, 45), draw.uniform(-40, 90)], 0.3, [draw.uniform(10, 400) for _ in range(3)])
        for _ in range(1000)
    ]
    mirrors_and_glass = [
        Sphere([draw.uniform(-18, 18), draw.uniform(-18, 18), draw.uniform(-18, 18)], draw.uniform(2, 5), draw.choice([Mirror((0.9,) * 3), Glass(1.5)]))
        for _ in range(40)
    ]
    outdoors = [floor()] + [
        Sphere((10 * x, 4, 10 * z), 4, draw.choice([Diffuse((0.7, 0.4, 0.3)), Mirror((0.8,) * 3), Glass(1.5), BlinnPhong((0.3, 0.5, 0.7), 0.3, 200)]))
        for x in range(-2, 3)
        for z in range(-2, 3)
    ]
    white = [Sphere(s.center, s.radius, Diffuse((0.95,) * 3)) for s in room()]
    sky = (0.6, 0.75, 1.0)
    view = dict(eye=(20, 30, 60), look_at=(0, 4, 0), fov=40.0)
    indoors = [
        Mesh(room_with_a_window(work), Diffuse((0.75, 0.72, 0.65))),
        Sphere((-1.5, -2, -2), 1, Diffuse((0.7, 0.2, 0.15))),
        Sphere((1.5, -2.2, -3), 0.8, Diffuse((0.2, 0.3, 0.7))),
    ]
    within = dict(background=(4, 5, 7), bounces=8, eye=(2, 0, 5.5), look_at=(-0.5, -0.8, -2), fov=60.0)
    return [
        Scene("a thousand lamps in the room", room() + three_balls(), lamps),
        Scene("only mirrors and glass, sky", mirrors_and_glass, background=sky, bounces=20),
        Scene("outdoors, sky alone", outdoors, background=sky, **view),
        Scene("outdoors, sky and sun", outdoors, [Light((300, 500, 200), 12, (9000, 8500, 8000))], background=sky, **view),
        Scene("a room with a window, sky alone", indoors + [Sphere((3, -2, -1), 1, Diffuse((0.6,) * 3))], [], **within),
        Scene("a room with a window, sky and sun", indoors + [Sphere((3, -2, -1), 1, Glass(1.5))], [Light((-40, 30, 0), 2, (2000,) * 3)], **within),
        Scene("a mirror floor under a wide lamp", [Sphere((0, -1000, 0), 1000, Mirror((0.9,) * 3)), *three_balls()], [Light((0, 60, 0), 15, (9,) * 3)]),
        Scene("fifty bounces in a white room", white + row(0, [Glass(1.5), Diffuse((0.95,) * 3), Mirror((0.95,) * 3)]), [lamp()], bounces=50),
        *(random_balls(k) for k in range(4)),
    ]


def room_with_a_window(work):
    """A room of 10x6x12 with an opening of 2.5x4 in its left wall, written to the folder `work`."""

    def corner(x, y, z):
        return 1 + 4 * [-5, 5].index(x) + 2 * [-3, 3].index(y) + [-6, 6].index(z)

    text = "".join(f"v {x} {y} {z}\n" for x in (-5, 5) for y in (-3, 3) for z in (-6, 6))
    text += "".join(f"v -5 {y} {z}\n" for y in (-0.5, 2) for z in (-3, 1))
    a, b, c, d = corner(-5, -3, -6), corner(-5, -3, 6), corner(-5, 3, 6), corner(-5, 3, -6)
    low, low_right, high, high_right = 9, 10, 11, 12
    faces = [corner(x, y, z) for x, y, z in [(5, -3, -6), (5, 3, -6), (5, 3, 6), (5, -3, 6)]], [a, d, corner(5, 3, -6), corner(5, -3, -6)]
    faces += [b, c, corner(5, 3, 6), corner(5, -3, 6)], [a, b, corner(5, -3, 6), corner(5, -3, -6)], [d, c, corner(5, 3, 6), corner(5, 3, -6)]
    # Around the opening.
    faces += [a, b, low_right, low], [b, c, high_right, low_right], [c, d, high, high_right], [d, a, low, high]
    text += "".join(f"f {' '.join(map(str, face))}\n" for face in faces)
    os.makedirs(work, exist_ok=True)
    out = os.path.join(work, "window.obj")
    with open(out, "w") as f:
        f.write(text)
    return out


def random_balls(k):
    """Thirty balls of any material in the room under one to three lamps."""
    draw = random.Random(100 + k)

    def color():
        return tuple(draw.uniform(0.1, 0.95) for _ in range(3))

    def material():
        return draw.choice([Diffuse(color()), Diffuse(color()), Mirror(color()), Glass(draw.uniform(1.2, 2.4)), BlinnPhong(color(), 0.2, 10 ** draw.uniform(0.5, 3.5))])

    balls = [Sphere([draw.uniform(-30, 30), draw.uniform(-18, 30), draw.uniform(-40, 20)], draw.uniform(2, 7), material()) for _ in range(30)]
    lamps = [Light([draw.uniform(-40, 40), draw.uniform(30, 45), draw.uniform(0, 60)], draw.uniform(1, 5), [draw.uniform(30, 90)] * 3) for _ in range(draw.randint(1, 3))]
    return Scene(f"random balls {k}", room() + balls, lamps)
