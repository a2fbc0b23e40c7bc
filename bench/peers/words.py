"""Sixty small scenes, one for each word of the language that Mitsuba 3 can be asked about, said on both sides.

A scene is a function of g, by which the size of what it is about is multiplied: `every_word.py` shows with 1.01 that it would notice."""

import math
import os
from dataclasses import dataclass, field

import numpy as np

import surfaces as of

LATHE = [(0.0, -0.9), (0.8, -0.8), (0.25, 0.0), (0.6, 0.8), (0.0, 0.9)]
STAR = [(0.9 * math.cos(0.4 * k), 0.9 * math.sin(0.4 * k)) for k in ()]
STAR = [((0.9, 0.4)[k % 2] * math.sin(math.pi * k / 5), (0.9, 0.4)[k % 2] * math.cos(math.pi * k / 5)) for k in range(10)]
HOLE = [(0.5 * x, 0.5 * y) for x, y in STAR]
ZIGZAG = [(-0.9, -0.6, 0.2), (0.7, -0.2, -0.3), (-0.6, 0.5, 0.1), (0.9, 0.8, 0.0)]
TILT = (0.4, 0.3, 1.0)
RED = (0.7, 0.4, 0.3)


@dataclass
class Word:
    """A scene: for tracer the text of what is in it, for Mitsuba a dictionary."""

    name: str
    objects: str
    theirs: dict
    camera: str = "position: (0, 0.4, 5), look_at: (0, 0, 0), fov: 36"
    sensor: dict = None
    lights: str = "SphereLight(center: (2.5, 4, 3), radius: 0.8, radiance: 12)"
    background: str = "0.5"
    effects: str = "antialiasing: Box, depth_of_field: None"
    floor: bool = True
    bounces: int = 2
    size: tuple = (48, 48)
    assets: dict = field(default_factory=dict)
    emitters: dict = None
    # How many times as many samples as others: what it is about shows in few pixels, or hardly.
    times: int = 1

    def ron(self):
        floor = "Rectangle(center: (0, -1, 0), size: 7, material: Diffuse(albedo: (0.5, 0.6, 0.4)))," if self.floor else ""
        width, height = self.size
        return (
            f"Scene(camera: Camera({self.camera}), image: Image(width: {width}, height: {height}), "
            f"render: Render(max_bounces: {self.bounces}), effects: Effects({self.effects}), background: {self.background}, "
            f"lights: [{self.lights}], objects: [{floor} {self.objects}])"
        )

    def mitsuba(self, mi):
        t = mi.ScalarTransform4f
        width, height = self.size
        film = {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"}, "component_format": "float32"}
        eye = t().look_at(origin=[0, 0.4, 5], target=[0, 0, 0], up=[0, 1, 0])
        sensor = {"type": "perspective", "to_world": eye, "near_clip": 0.001, **(self.sensor or {})}
        if sensor["type"] != "orthographic":
            sensor = {"fov": 36, "fov_axis": "y", **sensor}
        sensor = {**sensor, "film": film, "sampler": {"type": "multijitter", "sample_count": 64}}
        scene = {"type": "scene", "integrator": {"type": "path", "max_depth": self.bounces + 2, "rr_depth": 100}, "sensor": sensor}
        if self.floor:
            to_world = matrix(mi, *rectangle((0, -1, 0), (0, 1, 0), (7, 7)))
            scene["floor"] = {"type": "rectangle", "to_world": to_world, "bsdf": diffuse((0.5, 0.6, 0.4))}
        emitters = self.emitters
        if emitters is None:
            lamp = {"type": "sphere", "center": [2.5, 4, 3], "radius": 0.8, "bsdf": diffuse((0, 0, 0))}
            emitters = {"lamp": {**lamp, "emitter": area(12)}, "sky": sky(0.5)}
        return {**scene, **emitters, **self.theirs}


def diffuse(albedo):
    reflectance = albedo if isinstance(albedo, dict) else {"type": "rgb", "value": list(albedo)}
    return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": reflectance}}


def area(radiance):
    value = [radiance] * 3 if np.isscalar(radiance) else list(radiance)
    return {"type": "area", "radiance": {"type": "rgb", "value": value}}


def sky(radiance):
    return {"type": "constant", "radiance": {"type": "rgb", "value": [radiance] * 3}}


def rectangle(center, normal, size):
    """Columns of the matrix from the square from -1 to 1."""
    s, t, n = of.frame(normal)
    return s * size[0] / 2, t * size[1] / 2, n, np.asarray(center, dtype=float)


def matrix(mi, *columns):
    m = np.eye(4)
    m[:3, :4] = np.stack(columns, 1)
    return mi.ScalarTransform4f(m)


def t3(v):
    return "(" + ", ".join(f"{float(x):.9g}" for x in v) + ")"


def points(list_of):
    return "[" + ", ".join(t3(p) for p in list_of) + "]"


def spin(axis, degrees):
    a, c, s = of.unit(axis), math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    k = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    m = np.eye(4)
    m[:3, :3] = np.eye(3) + s * k + (1 - c) * k @ k
    return m


def scaled(x, y, z):
    return np.diag([x, y, z, 1.0])


def at(x, y, z):
    m = np.eye(4)
    m[:3, 3] = x, y, z
    return m


def mesh(folder, name, part, albedo=RED, smooth=True, **more):
    file = os.path.join(folder, f"{name}.ply")
    of.ply(file, part)
    return {"type": "ply", "filename": file, "face_normals": not smooth, "bsdf": diffuse(albedo), **more}


def shapes(mi, folder, g):
    """Shapes as such: each is red, on a green floor."""
    m = f"material: Diffuse(albedo: {t3(RED)})"

    def by_mesh(name, text, part, smooth=True, **more):
        return Word(name, text, {"it": mesh(folder, name.replace(" ", "-"), part, smooth=smooth)}, **more)

    def native(name, text, shape):
        return Word(name, text, {"it": {**shape, "bsdf": diffuse(RED)}})

    yield native("Sphere", f"Sphere(center: (0.2, 0, 0), radius: {0.9 * g}, {m})",
                 {"type": "sphere", "center": [0.2, 0, 0], "radius": 0.9})
    ellipsoid = spin((0, 0, 1), 30) @ scaled(0.5, 1.1, 0.8)
    yield by_mesh("Sphere, scaled and turned",
                  f"Sphere(center: (0, 0, 0), radius: {g}, transform: [Scale(factor: (0.5, 1.1, 0.8)), "
                  f"Rotate(axis: (0, 0, 1), degrees: 30)], {m})",
                  of.moved(of.ball(), ellipsoid))
    yield native("Rectangle", f"Rectangle(center: (0.1, 0, 0.2), normal: {t3(TILT)}, size: ({1.4 * g}, {0.9 * g}), {m})",
                 {"type": "rectangle", "to_world": matrix(mi, *rectangle((0.1, 0, 0.2), TILT, (1.4, 0.9)))})
    yield native("Disk", f"Disk(center: (0.1, 0, 0.2), normal: {t3(TILT)}, radius: {0.9 * g}, {m})",
                 {"type": "disk", "to_world": matrix(mi, *rectangle((0.1, 0, 0.2), TILT, (1.8, 1.8)))})
    yield by_mesh("Disk with a hole", f"Disk(center: (0.1, 0, 0.2), normal: {t3(TILT)}, radius: 0.9, inner_radius: {0.5 * g}, {m})",
                  of.ring((0.1, 0, 0.2), TILT, 0.9, 0.5))
    corners = [(x, y, 0.1) for x, y in STAR]
    star = of.joined([of.flat([(0, 0, 0.1), p, q]) for p, q in zip(corners, corners[1:] + corners[:1])])
    yield by_mesh("Polygon", f"Polygon(points: {points([(x * g, y * g, z) for x, y, z in corners])}, {m})", star)
    yield by_mesh("Box", f"Box(center: (0, -0.1, 0), size: ({1.1 * g}, {1.5 * g}, {0.8 * g}), "
                  f"transform: [Rotate(axis: (0, 1, 0), degrees: 30, about: (0, 0, 0))], {m})",
                  of.moved(of.box((0, -0.1, 0), (1.1, 1.5, 0.8)), spin((0, 1, 0), 30)), smooth=False)
    a, b = (-0.6, -0.7, 0.1), (0.5, 0.7, 0.3)
    ends = f"from: {t3(a)}, to: {t3(b)}"
    yield by_mesh("Cylinder", f"Cylinder({ends}, radius: {0.5 * g}, {m})", of.cone(a, b, 0.5, 0.5, True))
    yield native("Cylinder, open", f"Cylinder({ends}, radius: {0.5 * g}, caps: false, {m})",
                 {"type": "cylinder", "p0": list(a), "p1": list(b), "radius": 0.5})
    yield by_mesh("Cone", f"Cone({ends}, radius: {0.7 * g}, {m})", of.cone(a, b, 0.7, 0, True))
    yield by_mesh("Cone, cut", f"Cone({ends}, radius: {0.4 * g}, tip_radius: {0.7 * g}, {m})", of.cone(a, b, 0.4, 0.7, True))
    yield by_mesh("Cone, open", f"Cone({ends}, radius: {0.7 * g}, tip_radius: {0.3 * g}, caps: false, {m})",
                  of.cone(a, b, 0.7, 0.3, False))
    yield by_mesh("Capsule", f"Capsule({ends}, radius: {0.4 * g}, {m})", of.capsule(a, b, 0.4))
    yield by_mesh("Torus", f"Torus(axis: {t3(TILT)}, radius: 0.7, tube_radius: {0.25 * g}, {m})",
                  of.torus((0, 0, 0), TILT, 0.7, 0.25))
    yield by_mesh("Tube", f"Tube(points: {points(ZIGZAG)}, radius: {0.2 * g}, curve: Linear, segments: 512, {m})",
                  of.swept(ZIGZAG, 0.2))
    axis = np.array(b) - np.array(a)
    neck = np.array(b) - of.unit(axis) * 0.72
    arrow = of.joined([of.cone(a, neck, 0.12, 0.12, True), of.cone(neck, b, 0.3, 0, True)])
    yield by_mesh("Arrow", f"Arrow({ends}, radius: {0.12 * g}, head_radius: {0.3 * g}, head_length: 0.72, segments: 512, {m})", arrow)
    yield by_mesh("Lathe", f"Lathe(profile: {points([(r * g, y) for r, y in LATHE])}, segments: 1024, {m})", of.turned(LATHE))
    turn = "transform: [Rotate(axis: (0, 1, 0), degrees: 40, about: (0, 0, 0))]"
    yield by_mesh("Extrude", f"Extrude(outline: [{points([(x * g, y * g) for x, y in STAR])}], depth: 0.5, {turn}, {m})",
                  of.moved(of.pushed(STAR, 0.5), spin((0, 1, 0), 40)), smooth=False)
    yield by_mesh("Extrude with a hole",
                  f"Extrude(outline: [{points(STAR)}, {points([(x * g, y * g) for x, y in HOLE])}], depth: 0.5, {turn}, {m})",
                  of.moved(of.pushed(STAR, 0.5, [HOLE]), spin((0, 1, 0), 40)), smooth=False, times=4)
    heights = (np.add.outer(np.arange(9) * 3, np.arange(9) * 5) % 16) / 15.0
    picture = os.path.join(folder, "heights.exr")
    mi.Bitmap(np.repeat(heights[:, :, None], 3, 2).astype(np.float32)).write(picture)
    yield by_mesh("HeightField",
                  f'HeightField(file: "{picture}", size: (2.2, {0.5 * g}, 2), center: (0, -0.8, 0), smooth: false, {m})',
                  of.landscape(heights, (2.2, 0.5, 2), (0, -0.8, 0)), smooth=False)
    tetrahedron = [(0, 0.9, 0), (0.8, -0.6, 0.5), (-0.8, -0.6, 0.5), (0, -0.6, -0.9)]
    sides = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    part = of.joined([of.flat([tetrahedron[k] for k in side]) for side in sides])
    grown = [tuple(g * x for x in p) for p in tetrahedron]
    faces = "[" + ", ".join(str(list(side)) for side in sides) + "]"
    yield by_mesh("Mesh of points and faces", f"Mesh(points: {points(grown)}, faces: {faces}, {m})", part, smooth=False)
    sphere = of.torus((0, 0, 0), TILT, 0.6, 0.3)
    file = os.path.join(folder, "ours.ply")
    of.ply(file, sphere)
    about = f"transform: [Scale(factor: {g}, about: (0, 0, 0))]"
    yield by_mesh("Mesh from PLY, smooth", f'Mesh(file: "{file}", shading: Smooth, {about}, {m})', sphere)


def arrangements(mi, folder, g):
    """Ways to put things somewhere."""
    m = f"material: Diffuse(albedo: {t3(RED)})"
    half = (0.5, 0.4, 0.3)

    def boxes(name, text, matrices):
        parts = of.joined([of.moved(of.box((0, 0, 0), half), x) for x in matrices])
        return Word(name, text, {"it": mesh(folder, name.replace(" ", "-"), parts, smooth=False)})

    box = f"Box(size: {t3(g * x for x in half)}, {m}"
    grid = [at(0.8 * i, 0.7 * j, 0.9 * k) for i in (-1, 0, 1) for j in (-0.5, 0.5) for k in (-0.5, 0.5)]
    yield boxes("Grid", f"{box}, placements: Grid(count: (3, 2, 2), spacing: (0.8, 0.7, 0.9)))", grid)
    ring = [spin((0, 0, 1), 360 * k / 7 + 20) @ at(0.9, 0, 0) for k in range(7)]
    # The circle about +z begins where (0, 1, 0) x z points: at +x.
    yield boxes("Ring", f"{box}, placements: Ring(count: 7, radius: 0.9, axis: (0, 0, 1), start: 20))", ring)
    shear = np.array([[1, 0.5, 0, 0.2], [0, 1.2, 0.3, 0.1], [0.2, 0, 0.9, 0], [0, 0, 0, 1]])
    rows = ", ".join(t3(row) for row in shear[:3])
    yield boxes("Matrix", f"{box}, transform: [Scale(factor: 2), Matrix(rows: ({rows}))])", [shear @ scaled(2, 2, 2)])
    aligned = np.eye(4)
    aligned[:3, :3] = turn_to((0, 1, 0), (1, 1, 0.5))
    yield boxes("Align", f"{box}, transform: [Scale(factor: (1, 3, 1)), Align(to: (1, 1, 0.5))])", [aligned @ scaled(1, 3, 1)])
    yield boxes("FitTo, DropTo", f"Box(size: {t3(half)}, {m}, transform: [FitTo(width: {1.6 * g}), DropTo(-1)])",
                [at(0, -1 + 0.4 * 3.2 / 2, 0) @ scaled(3.2, 3.2, 3.2)])
    inner = spin((0, 1, 0), 30) @ at(0.6, 0, 0)
    group = f"Group(objects: [{box}, transform: [Translate((0.6, 0, 0))]), {box}, transform: [Translate((-0.6, 0.3, 0))])]"
    yield boxes("Group", f"{group}, transform: [Rotate(axis: (0, 1, 0), degrees: 30, about: (0, 0, 0))], "
                "placements: [[], [Translate((0, 0.7, 0))]])",
                [up @ spin((0, 1, 0), 30) @ x for up in (np.eye(4), at(0, 0.7, 0)) for x in (at(0.6, 0, 0), at(-0.6, 0.3, 0))])
    yield boxes("Repeat", "Repeat(count: 5, items: [Box(size: " + t3(g * x for x in half)
                + f', {m}, transform: [Translate(("=0.5*i-1", "=0.3*i-0.6", "=-0.2*i"))])])',
                [at(0.5 * i - 1, 0.3 * i - 0.6, -0.2 * i) for i in range(5)])
    del inner


def turn_to(a, b):
    a, b = of.unit(a), of.unit(b)
    v, c = np.cross(a, b), float(a @ b)
    k = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return np.eye(3) + k + k @ k / (1 + c)


def all_words(mi, folder, g=1.0):
    from seen import cameras, lights, materials, patterns

    for of_kind in (shapes, arrangements, lights, cameras, materials, patterns):
        yield from of_kind(mi, folder, g)
