"""Mattes as other programs read them: by the official OpenEXR, and by a decoder of Cryptomatte that is not ours.

cargo build -p tracer; python crates/tracer/tests/cryptomatte/main.py (cargo xtask prove cryptomatte)
"""

import json
import os
import re
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import cryptomatte_api
import mmh3
import numpy as np
import OpenEXR

ROOT = Path(__file__).resolve().parents[4]
TRACER = Path(os.environ.get("TRACER") or Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "debug" / "tracer")

SCENE = """Scene(
    camera: Camera(position: (0, 1, 8), look_at: (0, 0, 0), fov: 40),
    image: Image(width: 96, height: 64),
    render: Render(samples: 32, max_bounces: 2),
    effects: Effects(antialiasing: Gaussian(sigma: 0.7), depth_of_field: ThinLens(aperture: 0.3, focus_distance: 8)),
    background: 0.4,
    lights: [SphereLight(center: (2, 2.5, 1), radius: 0.4, radiance: 20, name: "lamp")],
    materials: { "red \\"wood\\"": Diffuse(albedo: (0.6, 0.1, 0.05)), "glas \u00fc": Transparent(ior: 1.5) },
    objects: [
        Sphere(center: (-1.2, 0, 0), radius: 1, material: "red \\"wood\\"", name: "ball"),
        Sphere(center: (1.2, -0.3, 0.5), radius: 0.7, material: "glas \u00fc", name: "ball"),
        Rectangle(center: (0, -1, 0), normal: (0, 1, 0), size: 7, material: Diffuse(albedo: 0.5)),
        Repeat(count: 60, items: [Box(center: ("=-3+0.1*i", "=0.8+0.3*(i%3)", -1.5), size: 0.07, name: "boxes")]),
    ],
    output: Output(layers: [Alpha], cryptomatte: [Objects, Materials], masks: ["ball", "lamp"]),
)
"""


def identifier(name):
    """The number of a name after the published specification, by the hash of another library."""
    bits = mmh3.hash(name, signed=False)
    exponent = min(max(bits >> 23 & 255, 1), 254)
    return (bits & 0x807FFFFF) | exponent << 23


def plain_decoder(channels, kind, bits):
    """The share of each pixel that a number covers, by the specification's words alone."""
    share = np.zeros_like(channels[f"{kind}00.R"], dtype=np.float64)
    for layer in range(3):
        for number, covered in ["RG", "BA"]:
            found = channels[f"{kind}{layer:02}.{number}"].view(np.uint32) == bits
            share += np.where(found, channels[f"{kind}{layer:02}.{covered}"], 0)
    return share


def main():
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        (folder / "scene.ron").write_text(SCENE, encoding="utf-8")
        picture = folder / "a.exr"
        subprocess.run([TRACER, "render", folder / "scene.ron", "-q", "-o", picture], check=True)
        with OpenEXR.File(str(picture), separate_channels=True) as file:
            header = dict(file.header())
            channels = {name: channel.pixels.copy() for name, channel in file.channels().items()}

        found = {}
        for key, value in header.items():
            if match := re.fullmatch(r"cryptomatte/([0-9a-f]{7})/(name|hash|conversion|manifest)", key):
                found.setdefault(match[1], {})[match[2]] = value
        assert sorted(of["name"] for of in found.values()) == ["CryptoMaterial", "CryptoObject"], found
        manifests = {}
        for key, of in found.items():
            assert key == f"{mmh3.hash(of['name'], signed=False):08x}"[:7]
            assert (of["hash"], of["conversion"]) == ("MurmurHash3_32", "uint32_to_float32")
            manifest = json.loads(of["manifest"])
            assert all(int(value, 16) == identifier(name) for name, value in manifest.items()), manifest
            manifests[of["name"]] = manifest
        objects = {"ball", "lamp", "boxes", "objects[2] Rectangle"}
        assert set(manifests["CryptoObject"]) == objects, manifests
        materials = {'red "wood"', "glas \u00fc", "objects[2].material", "default"}
        assert set(manifests["CryptoMaterial"]) == materials, manifests

        alpha = channels["alpha.A"].astype(np.float64)
        decoders = {matte.metadata().name(): matte for matte in cryptomatte_api.Cryptomatte.load(str(picture))}
        assert sorted(decoders) == ["CryptoMaterial", "CryptoObject"], decoders
        for kind, manifest in manifests.items():
            total = np.zeros_like(alpha)
            masks = decoders[kind].masks()
            for name in manifest:
                ours = plain_decoder(channels, kind, identifier(name))
                assert np.array_equal(ours.astype(np.float32), np.asarray(masks[name]).astype(np.float32)), name
                assert ours.max() > 0, f"{name} is not seen"
                total += ours
            ranks = np.stack([channels[f"{kind}{layer:02}.{c}"] for layer in range(3) for c in "GA"])
            assert np.all(ranks[:-1] >= ranks[1:]), "not the largest first"
            assert np.all(total <= 1), "more than all of a pixel"
            lamps = channels["mask.lamp.Y"] if kind == "CryptoMaterial" else 0
            assert np.abs(total + lamps - alpha).max() < 1e-5, kind
        for mask in ["ball", "lamp"]:
            of_matte = plain_decoder(channels, "CryptoObject", identifier(mask))
            assert np.abs(of_matte - channels[f"mask.{mask}.Y"]).max() < 1e-6
        edges = np.count_nonzero((channels["mask.ball.Y"] > 0) & (channels["mask.ball.Y"] < 1))
        assert edges > 100, edges
        print(f"{len(channels)} channels, {sum(map(len, manifests.values()))} names, {edges} pixels at edges: all agree")


if __name__ == "__main__":
    sys.exit(main())
