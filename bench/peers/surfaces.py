"""Surfaces as points on a fine grid, from their formulas: what Mitsuba is given of the shapes that it has not."""

import math

import numpy as np


def unit(v):
    v = np.asarray(v, dtype=float)
    return v / np.linalg.norm(v)


def frame(n):
    """Right and up on a surface with this normal, as the manual says."""
    n = unit(n)
    s = np.array([1.0, 0, 0]) if abs(n[1]) > 0.9999 else unit(np.cross((0, 1, 0), n))
    return s, np.cross(n, s), n


def patch(f, nu, nv):
    """Points of f(u, v), u and v from 0 to 1, on a grid, with normals by differences: vertices, normals, triangles."""
    u, v = np.meshgrid(np.linspace(0, 1, nu + 1), np.linspace(0, 1, nv + 1), indexing="ij")
    u, v = u.ravel(), v.ravel()
    points = f(u, v)
    # Not at tips and poles themselves, where a side has no length.
    h, inside = 1e-5, np.clip(v, 1e-3, 1 - 1e-3)
    du = f(u + h, inside) - f(u - h, inside)
    dv = f(u, inside + h) - f(u, inside - h)
    normals = np.cross(du, dv)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.where(length > 0, normals / np.maximum(length, 1e-300), (0, 0, 1))
    k = (np.arange(nu)[:, None] * (nv + 1) + np.arange(nv)[None, :]).ravel()
    a, b, c, d = k, k + nv + 1, k + nv + 2, k + 1
    faces = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    return points, normals, faces


def flat(corners):
    """A convex polygon."""
    points = np.array(corners, dtype=float)
    n = unit(np.cross(points[1] - points[0], points[2] - points[0]))
    faces = np.array([[0, k, k + 1] for k in range(1, len(points) - 1)])
    return points, np.tile(n, (len(points), 1)), faces


def joined(parts):
    points, normals, faces, count = [], [], [], 0
    for p, n, f in parts:
        points.append(p)
        normals.append(n)
        faces.append(f + count)
        count += len(p)
    return np.concatenate(points), np.concatenate(normals), np.concatenate(faces)


def moved(part, matrix):
    """Under a 4x4 matrix."""
    p, n, f = part
    m = np.asarray(matrix, dtype=float)
    normals = n @ np.linalg.inv(m[:3, :3])
    return p @ m[:3, :3].T + m[:3, 3], normals / np.linalg.norm(normals, axis=1, keepdims=True), f


def along(a, b):
    """From a cylinder's coordinates (about z, from 0 to 1) to those of one from a to b: right, up, axis and length."""
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    s, t, n = frame(b - a)
    return a, s, t, n, np.linalg.norm(b - a)


def cone(a, b, first, last, caps):
    """Radius `first` at a, `last` at b."""
    a, s, t, n, length = along(a, b)

    def at(phi, r, z):
        phi = 2 * math.pi * phi[:, None]
        return a + r[:, None] * (np.cos(phi) * s + np.sin(phi) * t) + z[:, None] * n

    parts = [patch(lambda u, v: at(u, first + (last - first) * v, length * v), 1024, 1)]
    if caps and first > 0:
        parts.append(patch(lambda u, v: at(-u, first * v, 0 * v), 1024, 1))
    if caps and last > 0:
        parts.append(patch(lambda u, v: at(u, last * v, length + 0 * v), 1024, 1))
    return joined(parts)


def ball():
    """Of radius one about the origin."""

    def f(u, v):
        phi, theta = 2 * math.pi * u, math.pi * (v - 0.5)
        return np.stack([np.cos(theta) * np.cos(phi), np.cos(theta) * np.sin(phi), np.sin(theta)], 1)

    return patch(f, 512, 256)


def capsule(a, b, radius):
    a, s, t, n, length = along(a, b)

    def f(u, v):
        # Below: a half sphere, then the side, then the other half sphere, a third of v each.
        phi = 2 * math.pi * u[:, None]
        low, high = np.minimum(3 * v, 1), np.maximum(3 * v - 2, 0)
        side = np.clip(3 * v - 1, 0, 1)
        theta = (low - 1 + high) * math.pi / 2
        r, z = radius * np.cos(theta), radius * np.sin(theta) + side * length
        return a + r[:, None] * (np.cos(phi) * s + np.sin(phi) * t) + z[:, None] * n

    return patch(f, 512, 384)


def torus(center, axis, radius, tube):
    s, t, n = frame(axis)

    def f(u, v):
        phi, psi = 2 * math.pi * u[:, None], 2 * math.pi * v[:, None]
        outwards = np.cos(phi) * s + np.sin(phi) * t
        return np.asarray(center) + (radius + tube * np.cos(psi)) * outwards + tube * np.sin(psi) * n

    return patch(f, 512, 256)


def ring(center, normal, radius, inner):
    s, t, _ = frame(normal)

    def f(u, v):
        phi = 2 * math.pi * u[:, None]
        return np.asarray(center) + (inner + (radius - inner) * v)[:, None] * (np.cos(phi) * s + np.sin(phi) * t)

    return patch(f, 1024, 1)


def turned(profile):
    """Straight lines between points (radius, height), turned about the y axis."""
    parts = []
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):

        def f(u, v, r0=r0, y0=y0, r1=r1, y1=y1):
            phi = 2 * math.pi * u
            r, y = r0 + (r1 - r0) * v, y0 + (y1 - y0) * v
            return np.stack([r * np.cos(phi), y, r * np.sin(phi)], 1)

        parts.append(patch(f, 1024, 1))
    return joined(parts)


def box(center, size):
    parts = []
    for axis in range(3):
        for sign in (-1, 1):
            n = np.zeros(3)
            n[axis] = sign
            s, t, n = frame(n)
            half = np.asarray(size, dtype=float) / 2
            middle = np.asarray(center) + n * half
            a, b = s * half, t * half
            parts.append(flat([middle - a - b, middle + a - b, middle + a + b, middle - a + b]))
    return joined(parts)


def pushed(ring_of_points, depth, holes=()):
    """A star-shaped outline about its mean, or one whose hole has as many corners, pushed along z from 0."""
    outer = np.array(ring_of_points, dtype=float)
    parts = []
    for points in [outer, *[np.array(h, dtype=float) for h in holes]]:
        for p, q in zip(points, np.roll(points, -1, axis=0)):
            parts.append(flat([(*p, 0), (*q, 0), (*q, depth), (*p, depth)]))
    inner = np.array(holes[0], dtype=float) if holes else np.tile(outer.mean(axis=0), (len(outer), 1))
    for z in (0, depth):
        for k in range(len(outer)):
            j = (k + 1) % len(outer)
            corners = [(*outer[k], z), (*outer[j], z), (*inner[j], z), (*inner[k], z)]
            parts.append(flat(corners if holes else corners[:3]))
    return joined(parts)


def swept(points, radius):
    """Capsules from point to point."""
    return joined([capsule(a, b, radius) for a, b in zip(points, points[1:])])


def landscape(heights, size, center):
    """Two triangles between four pixels: heights from 0 to 1, first row at -z; flat."""
    rows, columns = heights.shape
    x = center[0] + size[0] * (np.arange(columns) / (columns - 1) - 0.5)
    z = center[2] + size[2] * (np.arange(rows) / (rows - 1) - 0.5)
    at = lambda i, j: (x[j], center[1] + size[1] * heights[i, j], z[i])
    parts = []
    for i in range(rows - 1):
        for j in range(columns - 1):
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            parts += [(a, b, c), (a, c, d)]
    return joined([flat(p) for p in parts])


def ply(file, part):
    """As binary PLY."""
    p, n, f = part
    with open(file, "wb") as out:
        head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(p)}\n"
        head += "".join(f"property float {c}\n" for c in ("x", "y", "z", "nx", "ny", "nz"))
        out.write((head + f"element face {len(f)}\nproperty list uchar int vertex_indices\nend_header\n").encode())
        out.write(np.concatenate([p, n], 1).astype("<f4").tobytes())
        faces = np.zeros(len(f), dtype=[("count", "u1"), ("of", "<i4", 3)])
        faces["count"], faces["of"] = 3, f
        out.write(faces.tobytes())


# Patterns, as numbers t of the mapped coordinates.
PERMUTATION = (
    "151 160 137 91 90 15 131 13 201 95 96 53 194 233 7 225 140 36 103 30 69 142 8 99 37 240 21 10 23 190 6 148 247 120 234 75 0 26 197 62 94 "
    "252 219 203 117 35 11 32 57 177 33 88 237 149 56 87 174 20 125 136 171 168 68 175 74 165 71 134 139 48 27 166 77 146 158 231 83 111 229 122 "
    "60 211 133 230 220 105 92 41 55 46 245 40 244 102 143 54 65 25 63 161 1 216 80 73 209 76 132 187 208 89 18 169 200 196 135 130 116 188 159 "
    "86 164 100 109 198 173 186 3 64 52 217 226 250 124 123 5 202 38 147 118 126 255 82 85 212 207 206 59 227 47 16 58 17 182 189 28 42 223 183 "
    "170 213 119 248 152 2 44 154 163 70 221 153 101 155 167 43 172 9 129 22 39 253 19 98 108 110 79 113 224 232 178 185 112 104 218 246 97 228 "
    "251 34 242 193 238 210 144 12 191 179 162 241 81 51 145 235 249 14 239 107 49 192 214 31 181 199 106 157 184 84 204 176 115 121 50 45 127 4 "
    "150 254 138 236 205 93 222 114 67 29 24 72 243 141 128 195 78 66 215 61 156 180"
)


def perlin(p):
    """Improved noise (Perlin 2002), from -1 to 1; p: (..., 3)."""
    table = np.array([int(k) for k in PERMUTATION.split()] * 2)
    whole = np.floor(p).astype(int)
    x, y, z = np.moveaxis(p - whole, -1, 0)
    i, j, k = np.moveaxis(whole & 255, -1, 0)
    fade = lambda t: t * t * t * (t * (t * 6 - 15) + 10)

    def corner(di, dj, dk):
        h = table[table[table[(i + di) & 255] + ((j + dj) & 255)] + ((k + dk) & 255)] & 15
        a, b, c = x - di, y - dj, z - dk
        u = np.where(h < 8, a, b)
        v = np.where(h < 4, b, np.where((h == 12) | (h == 14), a, c))
        return np.where(h & 1, -u, u) + np.where(h & 2, -v, v)

    mix = lambda t, a, b: a + t * (b - a)
    u, v, w = fade(x), fade(y), fade(z)
    planes = [
        mix(v, mix(u, corner(0, 0, d), corner(1, 0, d)), mix(u, corner(0, 1, d), corner(1, 1, d))) for d in (0, 1)
    ]
    return mix(w, *planes)


def octaves(p, count, turbulence, lacunarity=2.0, gain=0.5):
    """Fbm from -1 to 1, or turbulence from 0 to 1."""
    values = [gain**i * perlin(p * lacunarity**i) for i in range(count)]
    weights = sum(gain**i for i in range(count))
    return sum(np.abs(v) if turbulence else v for v in values) / weights
