"""Sixty small scenes, the rest of them: lights, cameras, materials, patterns. See words.py."""

import os

import numpy as np

import correlated
import surfaces as of
from words import RED, TILT, Word, area, at, diffuse, matrix, mesh, rectangle, sky, spin, t3

BALL = "Sphere(center: (0.2, -0.3, 0), radius: 0.7, material: Diffuse(albedo: (0.7, 0.4, 0.3)))"
CUBE = "Box(center: (-1, -0.6, 0.4), size: 0.8, material: Diffuse(albedo: 0.8))"
BLACK = {"type": "diffuse", "reflectance": {"type": "rgb", "value": [0, 0, 0]}}


def things(folder, g=1.0):
    return {
        "ball": {"type": "sphere", "center": [0.2, -0.3, 0], "radius": 0.7, "bsdf": diffuse(RED)},
        "cube": mesh(folder, "cube", of.box((-1, -0.6, 0.4), (0.8, 0.8, 0.8)), (0.8, 0.8, 0.8), smooth=False),
    }


def lights(mi, folder, g):
    """On a ball, a cube and a floor."""
    seen = things(folder)
    both = f"{BALL}, {CUBE}"

    def one(name, text, shape, lights="", background="0", **more):
        return Word(name, f"{both}, {text}" if text else both, seen, lights=lights, background=background, emitters=shape, **more)

    ball = {"type": "sphere", "center": [1, 2.5, 1], "radius": 0.5, "bsdf": BLACK, "emitter": area((20, 15, 10))}
    yield one("SphereLight", "", {"l": ball}, lights=f"SphereLight(center: (1, 2.5, 1), radius: {0.5 * g}, radiance: (20, 15, 10))")
    yield one("Emissive sphere", f"Sphere(center: (1, 2.5, 1), radius: {0.5 * g}, material: Emissive(radiance: (20, 15, 10)))", {"l": ball})
    power = 3.14159265358979 * 20 * 4 * 3.14159265358979 * 0.25
    yield one("Emissive sphere, power", f"Sphere(center: (1, 2.5, 1), radius: 0.5, material: Emissive(power: {power * g * g}))",
              {"l": {**ball, "emitter": area(20)}})
    square = matrix(mi, *rectangle((0.8, 2.4, 0.5), (-0.3, -1, 0), (1.2, 0.8)))
    lamp = {"type": "rectangle", "to_world": square, "bsdf": BLACK, "emitter": area(15)}
    text = f"Rectangle(center: (0.8, 2.4, 0.5), normal: (-0.3, -1, 0), size: ({1.2 * g}, {0.8 * g}), material: Emissive(radiance: 15%s))"
    yield one("Emissive rectangle", text % "", {"l": lamp})
    low = text.replace("2.4", "0.6")
    s, t, n, c = rectangle((0.8, 0.6, 0.5), (-0.3, -1, 0), (1.2, 0.8))
    # Apart by a hair: two in one place would hide each other.
    ways = (("down", (s, t, n, c + 1e-4 * n)), ("up", (s, -t, -n, c - 1e-4 * n)))
    faces = {k: {**lamp, "to_world": matrix(mi, *way)} for k, way in ways}
    yield one("Emissive rectangle, two sides", low % ", two_sided: true", faces)
    glowing = of.moved(of.box((0, 0, 0), (0.5, 0.7, 0.4)), at(1.1, 0.6, 0.3) @ spin((0, 1, 0), 25))
    yield one("Emissive box", f"Box(size: {t3(g * x for x in (0.5, 0.7, 0.4))}, transform: [Rotate(axis: (0, 1, 0), degrees: 25), "
              "Translate((1.1, 0.6, 0.3))], material: Emissive(radiance: 9))",
              {"l": mesh(folder, "glowing-box", glowing, (0, 0, 0), smooth=False, emitter=area(9))})
    pyramid = of.joined([of.flat(p) for p in pyramids()])
    corners = ", ".join(t3(of_centre(p, g)) for face in pyramids() for p in face)
    faces = ", ".join(str([3 * k, 3 * k + 1, 3 * k + 2]) for k in range(4))
    yield one("Emissive mesh", f"Mesh(points: [{corners}], faces: [{faces}], material: Emissive(radiance: 9))",
              {"l": mesh(folder, "pyramid", pyramid, (0, 0, 0), smooth=False, emitter=area(9))})
    yield one("Background alone", "", {"sky": sky(0.7)}, background=f"{0.7 * g}")
    # Fine, for Mitsuba's first and last rows lie at the poles and ours half a row away.
    v, u = (np.mgrid[0:1024, 0:2048] + 0.5) / 32
    picture = 0.3 + 0.2 * np.sin(2 * np.pi * u / 64) + 0.2 * np.cos(np.pi * v / 32)
    picture = np.stack([picture, picture**2, 0.5 * picture], 2)
    picture[8 * 32 : 11 * 32, 40 * 32 : 43 * 32] = 30.0
    file = os.path.join(folder, "sky.exr")
    mi.Bitmap(picture.astype(np.float32)).write(file)
    turned = mi.ScalarTransform4f(spin((0, 1, 0), 40 + 180))
    yield one("Environment", "", {"sky": {"type": "envmap", "filename": file, "to_world": turned, "scale": 1.0}},
              background=f'Environment(file: "{file}", rotation: 40, scale: {g})')
    yield one("Environment and a lamp", "", {"sky": {"type": "envmap", "filename": file, "to_world": turned, "scale": 0.3}, "l": ball},
              lights=f"SphereLight(center: (1, 2.5, 1), radius: {0.5 * g}, radiance: (20, 15, 10))",
              background=f'Environment(file: "{file}", rotation: 40, scale: 0.3)')
    many = [(np.cos(k), 1.2 + 0.5 * np.sin(3 * k), np.sin(k)) for k in range(20)]
    many = [tuple(float(2.2 * x) if j != 1 else float(x) for j, x in enumerate(p)) for p in many]
    text = ", ".join(f"SphereLight(center: {t3(p)}, radius: {0.1 * g}, radiance: {10 + k})" for k, p in enumerate(many))
    yield one("Twenty lamps", "", {f"l{k}": {"type": "sphere", "center": list(p), "radius": 0.1, "bsdf": BLACK, "emitter": area(10 + k)}
                                   for k, p in enumerate(many)}, lights=text)


def of_centre(p, g):
    middle = np.array((1.1, 0.6, 0.3))
    return middle + g * (np.array(p) - middle)


def pyramids():
    a = [(1.1, 1.1, 0.3), (1.5, 0.3, 0.6), (0.7, 0.3, 0.6), (1.1, 0.3, -0.2)]
    return [[a[0], a[2], a[1]], [a[0], a[1], a[3]], [a[0], a[3], a[2]], [a[1], a[2], a[3]]]


def cameras(mi, folder, g):
    """What is to be noticed here is one per cent of the field of view."""
    seen = things(folder)
    both = f"{BALL}, {CUBE}"
    eye = "position: (0.5, 0.6, 5), look_at: (0, -0.2, 0)"
    look = mi.ScalarTransform4f().look_at(origin=[0.5, 0.6, 5], target=[0, -0.2, 0], up=[0, 1, 0])
    wide, tall = (64, 40), (40, 64)

    def one(name, camera, sensor, size=wide, effects="antialiasing: Box, depth_of_field: None"):
        sensor = {"to_world": look, **sensor}
        return Word(name, both, seen, camera=camera, sensor=sensor, size=size, effects=effects)

    for axis, theirs, size in (
        ("Vertical", "y", wide), ("Horizontal", "x", wide), ("Diagonal", "diagonal", wide), ("Smaller", "smaller", tall), ("Larger", "larger", tall),
    ):
        yield one(f"fov, {axis}", f"{eye}, fov: {36 * g}, fov_axis: {axis}", {"fov": 36, "fov_axis": theirs}, size)
    yield one("focal_length", f"{eye}, focal_length: {50 / g}", {"fov": float(np.degrees(2 * np.arctan(18 / 50))), "fov_axis": "x"})
    yield one("Orthographic", f"{eye}, projection: Orthographic(height: {3 * g})",
              {"type": "orthographic", "to_world": look @ mi.ScalarTransform4f().scale([1.5 * 64 / 40, 1.5 * 64 / 40, 1])})
    yield one("shift", f"{eye}, fov: {36 * g}, shift: (0.2, -0.3)",
              {"principal_point_offset_x": 0.2 * 40 / 64, "principal_point_offset_y": 0.3})
    yield one("near", f"{eye}, fov: {36 * g}, near: 4.9", {"near_clip": 4.9})
    m = spin((0, 1, 0), 10) @ spin((1, 0, 0), -8) @ at(0, 0, 5)
    rows = ", ".join(t3(row) for row in m[:3])
    yield one("matrix", f"fov: {36 * g}, matrix: ({rows})", {"to_world": mi.ScalarTransform4f(m @ spin((0, 1, 0), 180))})
    yield one("ThinLens", f"{eye}, fov: {36 * g}", {"type": "thinlens", "aperture_radius": 0.15, "focus_distance": 4.4},
              effects="antialiasing: Box, depth_of_field: ThinLens(aperture: 0.3, focus_distance: 4.4)")


def materials(mi, folder, g):
    """On a ball before a floor; what is to be noticed is its size."""
    where = f"center: (0, -0.1, 0), radius: {0.85 * g}"
    shape = {"type": "sphere", "center": [0, -0.1, 0], "radius": 0.85}

    def one(name, material, bsdf, **more):
        return Word(name, f"Sphere({where}, material: {material}), {CUBE}",
                    {"it": {**shape, "bsdf": bsdf}, "cube": things(folder)["cube"]}, bounces=4, **more)

    mirror = {"type": "conductor", "material": "none", "specular_reflectance": {"type": "rgb", "value": [0.9, 0.8, 0.7]}}
    yield one("Mirror", "Mirror(reflectance: (0.9, 0.8, 0.7))", mirror)
    yield one("Transparent", "Transparent(ior: 1.5)", {"type": "dielectric", "int_ior": 1.5, "ext_ior": 1.0})
    eta, k = (0.2, 0.9, 1.4), (3.9, 2.4, 1.6)
    metal = {"type": "conductor", "eta": {"type": "rgb", "value": list(eta)}, "k": {"type": "rgb", "value": list(k)}}
    yield one("Conductor", f"Conductor(ior: {t3(eta)}, k: {t3(k)})", metal)
    # Mitsuba's own `roughconductor` is darker at grazing angles, noticeably so from a roughness of 0.7.
    for r in (0.3, 0.7):
        yield one(f"Conductor, roughness {r}", f"Conductor(ior: {t3(eta)}, k: {t3(k)}, roughness: {r}, multiple_scattering: false)",
                  correlated.of(r * r, eta, k))


def patterns(mi, folder, g):
    """On a square that faces the camera, some degrees turned; what is to be noticed is the pattern's size."""
    n = 2048
    u, v = np.meshgrid((np.arange(n) + 0.5) / n, 1 - (np.arange(n) + 0.5) / n)
    a, b = np.array((0.2, 0.3, 0.6)), np.array((0.8, 0.6, 0.3))
    s, t, normal = of.frame(TILT)
    to_world = matrix(mi, *rectangle((0, 0, 0), TILT, (1.8, 1.8)))
    place = (u[..., None] - 0.5) * 1.8 * s + (v[..., None] - 0.5) * 1.8 * t

    def one(name, texture, colours, **more):
        file = os.path.join(folder, name.replace(" ", "-").replace(",", "") + ".exr")
        # Row 0 of ours is v = 1, of theirs v = 0.
        mi.Bitmap(colours[::-1].astype(np.float32)).write(file)
        bitmap = {"type": "bitmap", "filename": file, "raw": True, "filter_type": "nearest"}
        text = f"Rectangle(normal: {t3(TILT)}, size: 1.8, material: Diffuse(albedo: {texture}))"
        return Word(name, text, {"it": {"type": "rectangle", "to_world": to_world, "bsdf": diffuse(bitmap)}}, **more)

    def mixed(t):
        return a + (b - a) * np.asarray(t, dtype=float)[..., None]

    colours = f"a: {t3(a)}, b: {t3(b)}"
    turn = np.radians(20)

    def mapped(x, y, scale):
        x, y = scale[0] * x, scale[1] * y
        return np.cos(turn) * x - np.sin(turn) * y + 0.3, np.sin(turn) * x + np.cos(turn) * y + 0.1

    x, y = mapped(u, v, (5, 3))
    uv = f"mapping: Uv(scale: ({5 * g}, {3 * g}), rotation: 20, offset: (0.3, 0.1))"
    yield one("Checkerboard", f"Checkerboard({colours}, {uv})", mixed((np.floor(x) + np.floor(y)) % 2))
    near = lambda z, w: np.abs(z - np.round(z)) <= w / 2
    yield one("Lines", f"Lines({colours}, width: 0.3, {uv})", mixed(~(near(x, 0.3) | near(y, 0.3))))
    yield one("Dots", f"Dots({colours}, radius: 0.35, {uv})", mixed(np.hypot(x % 1 - 0.5, y % 1 - 0.5) < 0.35))
    x1, y1 = mapped(u, v, (1.2, 0.9))
    uv1 = f"mapping: Uv(scale: ({1.2 * g}, {0.9 * g}), rotation: 20, offset: (0.3, 0.1))"
    yield one("Gradient, Y", f"Gradient({colours}, {uv1})", mixed(np.clip(y1, 0, 1)), times=4)
    yield one("Gradient, Radial", f"Gradient({colours}, axis: Radial, {uv1})", mixed(np.clip(np.hypot(x1, y1), 0, 1)), times=4)
    p = 3 * place + (0.3, 0.2, 0.7)
    solid = f"mapping: Object(scale: {3 * g}, offset: (0.3, 0.2, 0.7))"
    yield one("Checkerboard of cubes", f"Checkerboard({colours}, {solid})", mixed(np.floor(p).sum(axis=2) % 2))
    yield one("Noise, Perlin", f"Noise({colours}, kind: Perlin, {solid})", mixed(0.5 + 0.5 * of.perlin(p)))
    yield one("Noise, Fbm", f"Noise({colours}, octaves: 4, {solid})", mixed(0.5 + 0.5 * of.octaves(p, 4, False)))
    yield one("Noise, Turbulence", f"Noise({colours}, kind: Turbulence, octaves: 4, {solid})", mixed(of.octaves(p, 4, True)))
    yield one("Wood", f"Wood({colours}, distortion: 0.3, {solid})",
              mixed(0.5 - 0.5 * np.cos(2 * np.pi * (np.hypot(p[..., 0], p[..., 2]) + 0.3 * of.octaves(p, 4, False)))))
    yield one("Marble", f"Marble({colours}, distortion: 0.8, {solid})",
              mixed(0.5 - 0.5 * np.cos(2 * np.pi * (p[..., 0] + 0.8 * of.octaves(p, 6, True)))))
