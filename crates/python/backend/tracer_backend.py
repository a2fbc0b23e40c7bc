"""Builds the wheel: the program first, which goes into it beside the module, then maturin does the rest.

Both are built from the workspace that this folder is in, by its profile `release`, so that nothing is compiled twice.
"""

import json
import os
import shutil
import subprocess
from pathlib import Path

import maturin

HERE = Path(__file__).resolve().parent.parent


def _program() -> None:
    """The program, where maturin looks for what goes into the folder of programs."""
    command = ["cargo", "build", "--release", "--locked", "--package", "tracer"]
    subprocess.run(command, cwd=HERE, check=True)
    asked = ["cargo", "metadata", "--format-version", "1", "--no-deps", "--locked"]
    found = json.loads(subprocess.run(asked, cwd=HERE, check=True, stdout=subprocess.PIPE).stdout)
    name = "tracer.exe" if os.name == "nt" else "tracer"
    scripts = HERE / "program" / "scripts"
    scripts.mkdir(parents=True, exist_ok=True)
    made, here = Path(found["target_directory"]) / "release" / name, scripts / name
    shutil.copy2(made, here)
    # What debuggers want is four fifths of it.
    if shutil.which("strip") and os.name != "nt":
        subprocess.run(["strip", "--strip-debug", str(here)], check=True)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    _program()
    return maturin.build_wheel(wheel_directory, config_settings, metadata_directory)


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    _program()
    return maturin.build_editable(wheel_directory, config_settings, metadata_directory)


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    (HERE / "program").mkdir(exist_ok=True)
    return maturin.prepare_metadata_for_build_wheel(metadata_directory, config_settings)


prepare_metadata_for_build_editable = prepare_metadata_for_build_wheel


def get_requires_for_build_wheel(config_settings=None):
    return maturin.get_requires_for_build_wheel(config_settings)


get_requires_for_build_editable = get_requires_for_build_wheel
