"""How soon the noise goes: tracer with everything on, its plain path tracer, and Mitsuba 3. See README.md."""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

import cornell
import scenes

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
FULL, PLAIN = "Full", "Path"
# The share of the pixels that trimming leaves out, those of the largest error.
TRIM = 0.001


class Tracer:
    """tracer on one scene file."""

    def __init__(self, arguments, file, folder, integrator):
        self.command = [arguments.tracer, "render", file, "--quiet", "--threads", str(arguments.threads)]
        for field in (f"integrator={integrator}", "reuse=Blocks", "caustics=Photons"):
            self.command += ["--set", "render." + field]
        self.folder = folder

    def render(self, samples, seed, size=None):
        """Linear radiance, row by row from the top, and the seconds of rendering."""
        picture, report = os.path.join(self.folder, "p.pfm"), os.path.join(self.folder, "p.json")
        command = self.command + ["-o", picture, "--report", report, "--samples", str(samples), "--seed", str(seed)]
        if size:
            command += ["--set", f"image.width={size[0]}", "--set", f"image.height={size[1]}"]
        subprocess.run(command, check=True)
        with open(report) as f:
            return read_pfm(picture), json.load(f)["seconds"]["render"]


class Mitsuba:
    """Mitsuba on one scene, its kernels compiled and its scene loaded beforehand."""

    def __init__(self, mi, description, size):
        what = description.mitsuba(mi, size)
        what["sensor"]["sampler"] = {"type": "multijitter"}
        self.mi, self.scene = mi, mi.load_dict(what)
        self.render(4, 0)

    def render(self, samples, seed, size=None):
        start = time.perf_counter()
        picture = np.array(self.mi.render(self.scene, spp=samples, seed=seed), dtype=np.float64)
        return picture, time.perf_counter() - start


def read_pfm(file):
    with open(file, "rb") as f:
        assert f.readline().strip() == b"PF"
        width, height = map(int, f.readline().split())
        assert float(f.readline()) < 0
        rows = np.frombuffer(f.read(), dtype="<f4").reshape(height, width, 3)
    return rows[::-1].astype(np.float64)


def blurred(picture, sigma):
    """Convolved with a Gaussian of `sigma` pixels; beyond the edge lies the edge."""
    if sigma == 0:
        return picture
    reach = int(np.ceil(4 * sigma))
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    weights /= weights.sum()
    for axis in (0, 1):
        padded = np.pad(picture, [(reach, reach) if a == axis else (0, 0) for a in range(3)], mode="edge")
        n = picture.shape[axis]
        picture = sum(w * np.take(padded, range(k, k + n), axis=axis) for k, w in enumerate(weights))
    return picture


class Reference:
    """Two long renderings with seeds of their own.

    (x - r1)(x - r2) has the mean (x - truth)^2: the references' own noise drops out, for it is independent in the two.
    """

    def __init__(self, tracer, samples, size=None):
        self.pair = [tracer.render(samples, seed, size)[0] for seed in (90001, 90002)]

    def error(self, picture, sigma=0.0):
        """relMSE: mean of (x - r)^2 / (r^2 + 0.01) over pixels and channels, without the worst 0.1 % of the pixels."""
        a, b = (blurred(r, sigma) for r in self.pair)
        x = blurred(picture, sigma)
        each = ((x - a) * (x - b) / ((0.5 * (a + b)) ** 2 + 0.01)).mean(axis=2).ravel()
        kept = np.sort(each)[: len(each) - int(len(each) * TRIM)]
        return max(kept.mean(), 1e-9)

    def mean(self):
        return 0.5 * (self.pair[0] + self.pair[1]).mean()


def measure(renderer, reference, marks, seeds, blurs=(0.0,), size=None):
    """Rows (samples, seconds, errors with each blur), means over the seeds; the seconds are the least."""
    rows = []
    for samples in marks:
        pictures = [renderer.render(samples, seed, size) for seed in seeds]
        errors = [np.mean([reference.error(p, sigma) for p, _ in pictures]) for sigma in blurs]
        rows.append((samples, min(t for _, t in pictures), errors))
    return rows


def seconds_to(rows, error, column=0):
    """Seconds to an error: between marks along a straight line in logarithms; beyond them as one over the time, and marked so."""
    points = [(t, e[column]) for _, t, e in rows]
    if points[0][1] <= error:
        return points[0][0], "≤"
    for (t0, e0), (t1, e1) in zip(points, points[1:]):
        if e1 <= error:
            return float(np.exp(np.interp(-np.log(error), [-np.log(e0), -np.log(e1)], [np.log(t0), np.log(t1)]))), ""
    return points[-1][0] * points[-1][1] / error, "*"


def error_at(rows, seconds, column=0):
    """The error after so many seconds, by the same rule (both ways beyond the marks as one over the time)."""
    points = sorted((t, e[column]) for _, t, e in rows)
    times, errors = np.log([t for t, _ in points]), np.log([e for _, e in points])
    x = np.log(seconds)
    if x <= times[0]:
        return float(np.exp(errors[0] + times[0] - x))
    if x >= times[-1]:
        return float(np.exp(errors[-1] + times[-1] - x))
    return float(np.exp(np.interp(x, times, errors)))


def peers(arguments):
    import drjit as dr
    import mitsuba as mi

    mi.set_variant(arguments.variant)
    dr.set_thread_count(arguments.threads)
    size, blurs = arguments.size, (0.0, 1.5, 4.0)
    aims = [(0.01, 0), (0.002, 0), (0.001, 1), (0.0002, 2)]
    print("| scene | contestant | relMSE at " + " / ".join(map(str, arguments.marks)) + " samples | seconds at the last | "
          "s to 0.01 | s to 0.002 | blurred 1.5 px: s to 0.001 | blurred 4 px: s to 0.0002 | mean |")
    print("|---|---|---|---:|---:|---:|---:|---:|---:|", flush=True)
    for description in scenes.noise_scenes(arguments.work) + cornell.scenes(arguments.work):
        if arguments.scene not in description.name:
            continue
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "scene.ron")
            with open(file, "w") as f:
                f.write(description.ron(size))
            full, plain = (Tracer(arguments, file, folder, i) for i in (FULL, PLAIN))
            reference = Reference(full, arguments.reference)
            contestants = [("tracer", full), ("plain", plain)]
            if not description.ours_only:
                contestants.append(("Mitsuba", Mitsuba(mi, description, size)))
            table = {}
            for name, renderer in contestants:
                marks = [n for n in arguments.marks if name != "Mitsuba" or n >= 4]
                rows = measure(renderer, reference, marks, arguments.seeds, blurs)
                mean = renderer.render(marks[-1], 77)[0].mean() / reference.mean()
                table[name] = [seconds_to(rows, *aim) for aim in aims]
                errors = " / ".join(f"{e[0]:.3g}" for _, _, e in rows)
                times = " | ".join(f"{mark}{t:.3g}" for t, mark in table[name])
                print(f"| {description.name} | {name} | {errors} | {rows[-1][1]:.2f} | {times} | {mean:.4f} |", flush=True)
            for name in table:
                if name != "tracer":
                    ratios = " | ".join(f"**{b / a:.1f}x**" for (a, _), (b, _) in zip(table["tracer"], table[name]))
                    print(f"| | {name} over tracer | | | {ratios} | |", flush=True)
    print(f"\n{size}x{size}, {arguments.threads} threads, rendering only; Mitsuba {mi.__version__} {mi.variant()}, `multijitter`; "
          f"reference: 2 x {arguments.reference} samples of tracer.")


def plain(arguments):
    print("| scene | relMSE, plain | seconds | relMSE, all on | seconds | plain's error at equal time over ours, "
          "early | late |\n|---|---:|---:|---:|---:|---:|---:|", flush=True)
    early, late = arguments.marks[-2:]
    worse = []
    with tempfile.TemporaryDirectory() as folder:
        for name, file, size in scenes.plain_scenes(folder, arguments.work, arguments.size):
            if arguments.scene not in name:
                continue
            full, path = (Tracer(arguments, file, folder, i) for i in (FULL, PLAIN))
            reference = Reference(full, arguments.reference, size)
            rows = measure(full, reference, [early, late], arguments.seeds, size=size)
            others = measure(path, reference, [early, late, 4 * late], arguments.seeds, size=size)
            gains = [error_at(others, t) / e[0] for _, t, e in rows]
            (_, t, e), (_, u, d) = others[1], rows[1]
            print(f"| {name} | {e[0]:.3g} | {t:.2f} | {d[0]:.3g} | {u:.2f} | {gains[0]:.2f}x | {gains[1]:.2f}x |", flush=True)
            if min(gains) < 0.95:
                worse.append(name)
    print(f"\n{late} samples (early: {early}), {arguments.threads} threads, rendering only, means of {len(arguments.seeds)} seeds.")
    if worse:
        sys.exit(f"plain path tracing is ahead in: {', '.join(worse)}")


def pictures(arguments):
    """Montages at equal time, rows 0.5, 2 and 8 seconds, columns tracer, plain, Mitsuba; and their errors, grey where there is none."""
    import drjit as dr
    import mitsuba as mi

    mi.set_variant(arguments.variant)
    dr.set_thread_count(arguments.threads)
    os.makedirs(arguments.out, exist_ok=True)
    for description in scenes.noise_scenes(arguments.work):
        if arguments.scene not in description.name or description.ours_only:
            continue
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "scene.ron")
            with open(file, "w") as f:
                f.write(description.ron(arguments.size))
            full, path = (Tracer(arguments, file, folder, i) for i in (FULL, PLAIN))
            reference = Reference(full, arguments.reference)
            truth = 0.5 * (reference.pair[0] + reference.pair[1])
            seen, errors = [], []
            for wanted in (0.5, 2.0, 8.0):
                row = []
                for name, renderer in (("tracer", full), ("plain", path), ("Mitsuba", Mitsuba(mi, description, arguments.size))):
                    samples = 8
                    for _ in range(2):
                        seconds = renderer.render(samples, 61)[1]
                        samples = max(1, round(samples * wanted / seconds))
                    picture, seconds = renderer.render(samples, 62)
                    row.append(picture)
                    print(f"{description.name}: {name}, {wanted} s: {samples} samples in {seconds:.2f} s, "
                          f"relMSE {reference.error(picture):.3g}", flush=True)
                seen.append(np.concatenate(row, axis=1))
                # A grey of a fifth, half a stop of the truth up and down.
                relative = [(p - truth).mean(axis=2) / (truth.mean(axis=2) + 0.1) for p in row]
                errors.append(np.concatenate([np.clip(0.2 + 0.5 * e, 0, 1)[..., None].repeat(3, axis=2) for e in relative], axis=1))
            word = description.name.replace(",", "").replace(" ", "-")
            for kind, rows in (("", seen), ("-error", errors)):
                bitmap = mi.Bitmap(np.concatenate(rows, axis=0).astype(np.float32))
                bitmap = bitmap.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.UInt8, srgb_gamma=True)
                bitmap.write(os.path.join(arguments.out, word + kind + ".jpg"), quality=88)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("command", choices=["peers", "plain", "pictures"],
                        help="against Mitsuba on five scenes; against our plain path tracer on many; pictures at equal time")
    parser.add_argument("--tracer", default=os.path.join(ROOT, "target", "release", "tracer"))
    parser.add_argument("--variant", default="llvm_ad_rgb", help="Mitsuba's variant")
    parser.add_argument("--scene", default="", help="only scenes whose names contain this")
    parser.add_argument("--size", type=int, default=256, help="pixels along a side")
    parser.add_argument("--marks", type=int, nargs="+", default=[1, 4, 16, 64, 256], help="samples per pixel to measure at")
    parser.add_argument("--seeds", type=int, nargs="+", default=[61, 62])
    parser.add_argument("--reference", type=int, default=512, help="samples of each of the two references")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--work", default=os.path.join(ROOT, "target", "noise"), help="a folder for a large mesh")
    parser.add_argument("--out", default=os.path.join(ROOT, "docs", "noise"), help="a folder for the pictures")
    arguments = parser.parse_args()
    os.makedirs(arguments.work, exist_ok=True)
    {"peers": peers, "plain": plain, "pictures": pictures}[arguments.command](arguments)


if __name__ == "__main__":
    main()
