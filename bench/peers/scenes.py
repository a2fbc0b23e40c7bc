"""Scenes described once: each becomes a `.ron` for tracer and a dictionary for Mitsuba 3."""

import math
import os
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


def timed_scenes():
    """What both are timed with: figure 4, its Blinn-Phong balls diffuse because Mitsuba has no such material, and a diffuse mesh."""
    diffuse = [Diffuse(c) for c in ((0.1, 0.1, 1), (0.1, 1, 0.1), (1, 0.1, 0.1))]
    balls = row(-10, [Mirror((r,) * 3) for r in (1, 0.5, 0.1)]) + row(10, diffuse)
    balls += row(30, [Glass(n) for n in (1.33, 1.52, 2.42)])
    cat = Mesh("cat_60k.obj", Diffuse((0.8, 0.6, 0.5)), 0.9, -40.0, (0, -20, 0), smooth=True)
    return [
        Scene("figure 4", room() + balls, [lamp()]),
        Scene("a diffuse mesh in the room", room() + [cat], [lamp()]),
    ]
