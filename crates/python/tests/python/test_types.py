"""What a type checker says of the package, and of what is written with it."""

import subprocess
import sys

import tracer.words

RIGHT = '''
import numpy as np
import tracer
from tracer.words import SceneDict

scene: SceneDict = {
    "background": 1,
    "camera": {"position": [0, 1, 5], "fov": "=40"},
    "materials": {"red": {"Diffuse": {"albedo": [1, 0, 0]}}},
    "objects": [
        {"Sphere": {"center": (0, 0, 0), "radius": 1, "material": "red", "transform": [{"Translate": [0, 1, 0]}]}},
        {"Mesh": {"points": np.zeros((3, 3)), "faces": np.array([[0, 1, 2]])}},
        {"Mesh": {"file": tracer.Mesh(np.zeros((3, 3)), [[0, 1, 2]])}},
        {"Repeat": {"count": 3, "items": [{"Sphere": {"center": ["=i", 0, 0], "radius": 1}}]}},
    ],
}
picture = tracer.render(scene, samples=4)
both, layers = tracer.render(scene, layers=["depth"])
depth = layers["depth"].mean()
shown: bytes = tracer.Scene(scene).render(size=(3, 4))._repr_png_()
'''


def mypy(folder, *arguments):
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(folder / "cache"), *arguments]
    return subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout


def test_the_package_is_typed(tmp_path):
    assert "Success" in (out := mypy(tmp_path, "-p", "tracer")), out


def test_what_is_right_passes_and_what_is_wrong_does_not(tmp_path):
    (tmp_path / "right.py").write_text(RIGHT)
    assert "Success" in (out := mypy(tmp_path, "right.py")), out
    for right, wrong in [('"radius": 1,', '"radus": 1,'), ('"Diffuse"', '"Difuse"'), ('"fov": "=40"', '"fov": [1]')]:
        (tmp_path / "wrong.py").write_text(RIGHT.replace(right, wrong))
        assert "error" in (out := mypy(tmp_path, "wrong.py")), (wrong, out)


def test_types_are_there_when_a_program_runs():
    assert {"Sphere", "Mesh", "Scale"} <= set(vars(tracer.words))
    assert set(tracer.words.Sphere.__required_keys__) == {"radius"}
    assert set(tracer.words.Torus.__required_keys__) == {"radius", "tube_radius"}
