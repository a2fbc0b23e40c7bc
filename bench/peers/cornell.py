"""Cornell's box for `noise.py peers`: lit by a square lamp, and by a glowing mesh of ten thousand triangles."""

import math
import os
from dataclasses import dataclass

import numpy as np

from words import area, diffuse, matrix, rectangle, spin

WHITE, RED, GREEN = (0.73, 0.73, 0.73), (0.61, 0.05, 0.05), (0.12, 0.42, 0.1)
# Centre, normal, albedo of squares with sides of 2.
WALLS = [
    ((0, 0, 0), (0, 1, 0), WHITE),
    ((0, 2, 0), (0, -1, 0), WHITE),
    ((0, 1, -1), (0, 0, 1), WHITE),
    ((-1, 1, 0), (1, 0, 0), RED),
    ((1, 1, 0), (-1, 0, 0), GREEN),
]
# Centre, size, degrees about y.
BOXES = [((-0.35, 0.6, -0.3), (0.6, 1.2, 0.6), 18), ((0.35, 0.3, 0.35), (0.6, 0.6, 0.6), -17)]
SQUARE = ((0, 1.99, 0), (0, -1, 0), (0.5, 0.4))
LIGHT = (17, 12, 4)
BOUNCES = 8


@dataclass
class Cornell:
    """The box; with a file, that mesh glows, instead of the square."""

    name: str
    mesh: str = None
    ours_only: bool = False

    def ron(self, size):
        walls = "".join(
            f"Rectangle(center: {c}, normal: {n}, size: 2, material: Diffuse(albedo: {a})), " for c, n, a in WALLS
        )
        boxes = "".join(
            f"Box(center: {c}, size: {s}, material: Diffuse(albedo: {WHITE}), "
            f"transform: [Rotate(axis: (0, 1, 0), degrees: {degrees})]), "
            for c, s, degrees in BOXES
        )
        glow = f"material: Emissive(radiance: {LIGHT})"
        center, normal, sides = SQUARE
        lamp = f"Rectangle(center: {center}, normal: {normal}, size: {sides}, {glow})"
        if self.mesh:
            lamp = f'Mesh(file: "{self.mesh}", {glow})'
        return (
            "Scene(camera: Camera(position: (0, 1, 3.9), look_at: (0, 1, 0), fov: 38), "
            f"image: Image(width: {size}, height: {size}), render: Render(max_bounces: {BOUNCES}), "
            f"effects: Effects(antialiasing: Box), objects: [{walls}{boxes}{lamp}])"
        )

    def mitsuba(self, mi, size):
        film = {"type": "hdrfilm", "width": size, "height": size, "rfilter": {"type": "box"}, "component_format": "float32"}
        eye = mi.ScalarTransform4f().look_at(origin=[0, 1, 3.9], target=[0, 1, 0], up=[0, 1, 0])
        sensor = {"type": "perspective", "to_world": eye, "near_clip": 0.001, "fov": 38, "fov_axis": "y", "film": film}
        scene = {"type": "scene", "integrator": {"type": "path", "max_depth": BOUNCES + 2}, "sensor": sensor}
        for k, (center, normal, albedo) in enumerate(WALLS):
            to_world = matrix(mi, *rectangle(center, normal, (2, 2)))
            scene[f"wall{k}"] = {"type": "rectangle", "to_world": to_world, "bsdf": diffuse(albedo)}
        for k, (center, sides, degrees) in enumerate(BOXES):
            turned = spin((0, 1, 0), degrees)[:3, :3] * (np.array(sides) / 2)
            # tracer turns a shape about its centre.
            to_world = matrix(mi, *turned.T, np.array(center, dtype=float))
            scene[f"box{k}"] = {"type": "cube", "to_world": to_world, "bsdf": diffuse(WHITE)}
        if self.mesh:
            shape = {"type": "obj", "filename": self.mesh, "face_normals": True}
        else:
            shape = {"type": "rectangle", "to_world": matrix(mi, *rectangle(*SQUARE))}
        scene["lamp"] = {**shape, "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.0}}, "emitter": area(LIGHT)}
        return scene


def glowing_mesh(work):
    """A bumpy ball of 50 x 100 x 2 triangles, less those at the poles, under the lid: about ten thousand."""
    out = os.path.join(work, "bumpy.obj")
    rows, columns = 51, 100
    points, faces = [], []
    for j in range(rows + 1):
        for i in range(columns):
            polar, around = math.pi * j / rows, 2 * math.pi * i / columns
            radius = 0.15 * (1 + 0.2 * math.sin(6 * polar) * math.cos(8 * around))
            y = math.cos(polar)
            points.append((radius * math.sin(polar) * math.cos(around), 1.7 + radius * y, radius * math.sin(polar) * math.sin(around)))
    for j in range(rows):
        for i in range(columns):
            a, b = j * columns + i, j * columns + (i + 1) % columns
            faces += [(a, b, a + columns)] * (j > 0) + [(b, b + columns, a + columns)] * (j + 1 < rows)
    with open(out, "w") as f:
        f.writelines("v %.6f %.6f %.6f\n" % p for p in points)
        f.writelines("f %d %d %d\n" % tuple(i + 1 for i in t) for t in faces)
    return out


def scenes(work):
    return [Cornell("Cornell's box, a square lamp"), Cornell("Cornell's box, a glowing mesh", glowing_mesh(os.path.abspath(work)))]
