"""Renders the scenes of scenes.py with Mitsuba 3 and with tracer, and compares. See README.md."""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

import mitsuba as mi
import numpy as np

import scenes

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
TILE = 8


def ours(tracer, file, folder, samples, seed, threads, integrator="Full"):
    """One picture, as linear radiance, and the report of its rendering."""
    picture, report = os.path.join(folder, "ours.exr"), os.path.join(folder, "report.json")
    command = [tracer, "render", file, "-o", picture, "--samples", str(samples), "--seed", str(seed), "--quiet"]
    command += ["--set", f"render.integrator={integrator}"]
    subprocess.run(command + ["--threads", str(threads), "--report", report], check=True)
    bitmap = mi.Bitmap(picture).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, srgb_gamma=False)
    with open(report) as f:
        return np.array(bitmap, dtype=np.float64), json.load(f)


def theirs(scene, samples, seed):
    image = mi.render(scene, spp=samples, seed=seed)
    return np.array(image, dtype=np.float64)


def tiles(image):
    size = image.shape[0] // TILE
    return image.reshape(size, TILE, size, TILE, 3).mean(axis=(1, 3)).ravel()


def welch(a, b):
    """Difference of means in standard errors, per column; rows are seeds. Below a millionth of the mean, pictures of f32 are equal."""
    variance = a.var(axis=0, ddof=1) / len(a) + b.var(axis=0, ddof=1) / len(b)
    rounding = 1e-5 * np.abs(b.mean(axis=0))
    return (a.mean(axis=0) - b.mean(axis=0)) / np.sqrt(variance + rounding**2 + 1e-30)


def compare(arguments):
    rows, bad = [], []
    chosen = [s for s in scenes.scenes() if arguments.scene in s.name]
    print("| scene | mean ratio, red, green, blue | its standard error | z of the means | tiles: RMS z | largest z |")
    print("|---|---|---:|---|---:|---:|", flush=True)
    for description in chosen:
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "scene.ron")
            with open(file, "w") as f:
                f.write(description.ron(arguments.size))
            scene = mi.load_dict(description.mitsuba(mi, arguments.size))
            a, b = [], []
            for seed in range(arguments.seeds):
                picture, _ = ours(arguments.tracer, file, folder, arguments.samples, seed, arguments.threads)
                a.append(picture)
                b.append(theirs(scene, arguments.peer_samples, 1000 + seed))
        if arguments.pictures:
            save(arguments.pictures, description.name, np.mean(a, axis=0), np.mean(b, axis=0))
        means_a, means_b = (np.array([p.mean(axis=(0, 1)) for p in side]) for side in (a, b))
        ratio = means_a.mean(axis=0) / means_b.mean(axis=0)
        error = max(
            np.sqrt(sum((m.std(axis=0, ddof=1) / m.mean(axis=0)) ** 2 / len(m) for m in (means_a, means_b)))
        )
        z = welch(means_a, means_b)
        of_tiles = welch(np.array([tiles(p) for p in a]), np.array([tiles(p) for p in b]))
        ratios = ", ".join(f"{r:.4f}" for r in ratio)
        zs = ", ".join(f"{x:+.1f}" for x in z)
        rms, largest = np.sqrt(np.mean(of_tiles**2)), np.abs(of_tiles).max()
        print(f"| {description.name} | {ratios} | {error:.5f} | {zs} | {rms:.2f} | {largest:.1f} |", flush=True)
        rows.append(description.name)
        if np.abs(ratio - 1).max() > 0.005:
            bad.append(description.name)
    n = len(tiles(np.zeros((arguments.size, arguments.size, 3))))
    print(f"\n{len(rows)} scenes, {arguments.size}x{arguments.size}, {arguments.seeds} seeds of "
          f"{arguments.samples} samples (tracer) and {arguments.peer_samples} (Mitsuba {mi.__version__}, {mi.variant()}); "
          f"{n} tile channels a scene.")
    if bad:
        sys.exit(f"a mean is off by more than 0.5 %: {', '.join(bad)}")


def save(folder, name, a, b):
    os.makedirs(folder, exist_ok=True)
    difference = np.abs(a - b) * 8
    side = np.concatenate([a, b, difference], axis=1).astype(np.float32)
    bitmap = mi.Bitmap(side).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.UInt8, srgb_gamma=True)
    bitmap.write(os.path.join(folder, name.replace(" ", "-").replace(",", "") + ".png"))


def measure(arguments):
    """Camera samples a second, the best of three runs each; Mitsuba's kernels are compiled by a run before. `Path` is the plain path
    tracer, which does what Mitsuba's does; `Full` has photons and sharing pixels, whose samples cost more and tell more."""
    size, samples = 512, arguments.samples
    print("| scene | tracer, `Path` | tracer, `Full` | Mitsuba | `Path` over Mitsuba | `Full` over Mitsuba | means, `Path` over Mitsuba |")
    print("|---|---:|---:|---:|---:|---:|---:|")
    apart = []
    for description in scenes.timed_scenes(arguments.work):
        if arguments.scene not in description.name:
            continue
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "scene.ron")
            with open(file, "w") as f:
                f.write(description.ron(size))
            scene = mi.load_dict(description.mitsuba(mi, size))
            theirs(scene, samples, 0)
            best, means = {"Path": 0.0, "Full": 0.0, "Mitsuba": 0.0}, {"Path": [], "Mitsuba": []}
            for seed in range(1, 4):
                # Side by side in time, so that a busy machine is busy for both.
                for integrator in ("Path", "Full"):
                    picture, report = ours(arguments.tracer, file, folder, samples, seed, arguments.threads, integrator)
                    best[integrator] = max(best[integrator], report["samples"]["per_second"])
                    if integrator == "Path":
                        means["Path"].append(picture.mean())
                start = time.perf_counter()
                picture = theirs(scene, samples, seed)
                best["Mitsuba"] = max(best["Mitsuba"], size * size * samples / (time.perf_counter() - start))
                means["Mitsuba"].append(picture.mean())
        ratio = np.mean(means["Path"]) / np.mean(means["Mitsuba"])
        if abs(ratio - 1) > 0.005:
            apart.append(description.name)
        rates = " | ".join(f"{best[name] / 1e6:.2f} M/s" for name in best)
        over = " | ".join(f"**{best[name] / best['Mitsuba']:.2f}**" for name in ("Path", "Full"))
        print(f"| {description.name} | {rates} | {over} | {ratio:.4f} |", flush=True)
    print(f"\n{size}x{size}, {samples} samples per pixel, {arguments.threads} threads, Mitsuba {mi.__version__} {mi.variant()}, "
          "rendering only.")
    if apart:
        sys.exit("means further apart than 0.5 %: " + ", ".join(apart))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tracer", default=os.path.join(ROOT, "target", "release", "tracer"))
    parser.add_argument("--variant", default="llvm_ad_rgb", help="Mitsuba's variant")
    parser.add_argument("--time", action="store_true", help="time both instead of comparing")
    parser.add_argument("--work", default=os.path.join(ROOT, "target"), help="a folder for a mesh of a million triangles")
    parser.add_argument("--scene", default="", help="only scenes whose names contain this")
    parser.add_argument("--size", type=int, default=128, help="pixels along a side, a multiple of 8")
    parser.add_argument("--seeds", type=int, default=16)
    parser.add_argument("--samples", type=int, default=64, help="of tracer (and of both with --time)")
    parser.add_argument("--peer-samples", type=int, default=128, help="of Mitsuba, whose samples are noisier")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--pictures", help="a folder for pictures: tracer, Mitsuba, eight times the difference")
    arguments = parser.parse_args()
    mi.set_variant(arguments.variant)
    import drjit as dr

    dr.set_thread_count(arguments.threads)
    (measure if arguments.time else compare)(arguments)


if __name__ == "__main__":
    main()
