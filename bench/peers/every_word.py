"""Sixty small scenes of all shapes, lights, cameras, materials and patterns that Mitsuba 3 can be asked about, pixel by pixel. See README.md."""

import argparse
import os
import subprocess
import sys
import tempfile

import mitsuba as mi
import numpy as np
from scipy.stats import t as student

import words
from compare import ROOT

# Chance of a false alarm in a scene.
FALSE_ALARM = 1e-4


def ours(arguments, word, folder, seeds):
    file = os.path.join(folder, "scene.ron")
    with open(file, "w") as out:
        out.write(word.ron())
    pictures = []
    for seed in seeds:
        picture = os.path.join(folder, "ours.exr")
        command = [arguments.tracer, "render", file, "-o", picture, "--samples", str(arguments.samples * word.times), "--seed", str(seed)]
        subprocess.run(command + ["--quiet", "--threads", str(arguments.threads)], check=True)
        bitmap = mi.Bitmap(picture).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, srgb_gamma=False)
        pictures.append(np.array(bitmap, dtype=np.float64))
    return np.array(pictures)


def contrast(picture):
    """Of each pixel and its eight neighbours: the largest difference."""
    padded = np.pad(picture, ((1, 1), (1, 1), (0, 0)), mode="edge")
    rows, columns = picture.shape[:2]
    around = np.array([padded[i : i + rows, j : j + columns] for i in range(3) for j in range(3)])
    return around.max(axis=0) - around.min(axis=0)


def against(a, b, samples):
    """p of Welch's t in each pixel and channel, two-sided, by Sidak's correction for all of them; and the ratio of the means."""
    # Where an edge crosses a pixel, stratified samples often give the same count for all seeds, and no variance: it is
    # taken to be that of one sample more or less at least.
    edge = contrast(b.mean(axis=0))
    va, vb = (np.maximum(x.var(axis=0, ddof=1), (edge / n) ** 2) / len(x) for x, n in zip((a, b), samples))
    # Pictures in single precision, and light that comes over the borders of Mitsuba's facets.
    rounding = (2e-4 * np.abs(b.mean(axis=0)) + 1e-6) ** 2
    v = va + vb + rounding
    freedom = v**2 / ((va**2) / (len(a) - 1) + (vb**2) / (len(b) - 1) + rounding**2 / 1e6)
    z = (a.mean(axis=0) - b.mean(axis=0)) / np.sqrt(v)
    p = 2 * student.sf(np.abs(z), freedom)
    least = p.min()
    return -np.expm1(p.size * np.log1p(-min(least, 0.5))), np.abs(z).max(), np.sqrt(np.mean(z**2)), a.mean() / b.mean()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tracer", default=os.path.join(ROOT, "target", "release", "tracer"))
    parser.add_argument("--variant", default="llvm_ad_rgb", help="Mitsuba's variant")
    parser.add_argument("--scene", default="", help="only scenes whose names contain this")
    parser.add_argument("--from", dest="first", type=int, default=0, help="leave out so many scenes")
    parser.add_argument("--seeds", type=int, default=16)
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--peer-samples", type=int, default=256)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--pictures", help="a folder for pictures: tracer, Mitsuba, eight times the difference")
    arguments = parser.parse_args()
    mi.set_variant(arguments.variant)
    import drjit as dr
    import correlated

    correlated.register()

    dr.set_thread_count(arguments.threads)
    counts = (arguments.samples, arguments.peer_samples)
    bad, count = [], 0
    print("| scene | mean, tracer over Mitsuba | RMS z of the pixels | largest | p | p with 1 % more |")
    print("|---|---:|---:|---:|---:|---:|", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        grown = {word.name: word for word in words.all_words(mi, folder, 1.01)}
        for word in list(words.all_words(mi, folder, 1.0))[arguments.first :]:
            if arguments.scene not in word.name:
                continue
            scene = mi.load_dict(word.mitsuba(mi))
            b = np.array([np.array(mi.render(scene, spp=arguments.peer_samples * word.times, seed=1000 + k))[:, :, :3] for k in range(arguments.seeds)], dtype=np.float64)
            a = ours(arguments, word, folder, range(arguments.seeds))
            larger = ours(arguments, grown[word.name], folder, range(arguments.seeds))
            if arguments.pictures:
                save(arguments.pictures, word.name, a.mean(axis=0), b.mean(axis=0))
            each = [count * word.times for count in counts]
            p, z, rms, ratio = against(a, b, each)
            seen, *_ = against(larger, b, each)
            wrong = p < FALSE_ALARM or abs(ratio - 1) > 0.005
            blind = seen >= FALSE_ALARM
            mark = " **differs**" if wrong else " **would not notice**" if blind else ""
            print(f"| {word.name} | {ratio:.5f} | {rms:.2f} | {z:.1f} | {p:.2g}{mark} | {seen:.2g} |", flush=True)
            count += 1
            if wrong or blind:
                bad.append(word.name)
    print(f"\n{count} scenes, {arguments.seeds} seeds of {arguments.samples} samples (tracer) and {arguments.peer_samples} "
          f"(Mitsuba {mi.__version__}, {mi.variant()}).")
    if bad:
        sys.exit(f"differ, or would not notice: {', '.join(bad)}")


def save(folder, name, a, b):
    os.makedirs(folder, exist_ok=True)
    side = np.concatenate([a, b, np.abs(a - b) * 8], axis=1).astype(np.float32)
    bitmap = mi.Bitmap(side).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.UInt8, srgb_gamma=True)
    bitmap.write(os.path.join(folder, name.replace(" ", "-").replace(",", "") + ".png"))


if __name__ == "__main__":
    main()
