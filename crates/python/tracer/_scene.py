"""Scenes, and pictures of them."""

from __future__ import annotations

import json
import os
import warnings
from difflib import get_close_matches
from functools import wraps
from typing import TYPE_CHECKING, Any, Callable, Dict, List, Literal, Mapping, Optional, Sequence, Tuple, TypeVar, Union, overload

import numpy as np

from . import _native
from ._assets import asset, to_json
from ._errors import Diagnostic, SceneError, SceneWarning, diagnostics

if TYPE_CHECKING:
    import numpy.typing as npt

    from .words import SceneDict

    Floats = npt.NDArray[np.float32]
    Bytes = npt.NDArray[np.uint8]
    SceneLike = Union["Scene", SceneDict, Mapping[str, Any], str, os.PathLike[str]]
    Progress = Callable[[float], Optional[bool]]

_OF_SCENE = ("set", "assets", "base_dir", "syntax", "frame", "camera")
_OF_RENDER = ("layers", "size", "samples", "seed", "denoise", "crop", "exposure", "noise", "time", "threads", "progress")

_OF_OTHERS = {
    "width": "size=(width, height)",
    "height": "size=(width, height)",
    "resolution": "size=(width, height)",
    "spp": "samples",
    "output": "Scene(..).render(..).save(path)",
    "frames": "frame, one at a time",
    "view": "camera",
}
"""What other programs, or people, call it."""

_Call = TypeVar("_Call", bound=Callable[..., Any])


def _refuse(call: str, given: Sequence[str], own: Sequence[str]) -> None:
    """Says what was meant by the first setting that is not one of its own."""
    unknown = [name for name in given if name not in own]
    if not unknown:
        return
    name, of_others = unknown[0], _OF_OTHERS.get(unknown[0])
    near = [of_others] if of_others and of_others.partition("=")[0].split(",")[0] in own else get_close_matches(name, own, 1)
    if name in _OF_SCENE:
        tip = f"; it belongs to Scene(.., {name}=..)"
    elif name in _OF_RENDER:
        tip = f"; it belongs to Scene(..).render({name}=..)"
    elif near:
        tip = f"; did you mean {near[0]}?"
    else:
        tip = f"; there are {', '.join(own)}"
    raise TypeError(f"{call} has no setting {name!r}{tip}")


def _with_tips(call: str, own: Sequence[str]) -> Callable[[_Call], _Call]:
    """A call that tells what was meant by a setting that it has not."""

    def wrapped(function: _Call) -> _Call:
        @wraps(function)
        def inner(*args: Any, **settings: Any) -> Any:
            _refuse(call, list(settings), own)
            return function(*args, **settings)

        return inner  # type: ignore[return-value]

    return wrapped


_SHOWN = 512
"""Pixels along the longer side of what a notebook shows of a scene, at most."""

_SHOWN_SECONDS = 2.0
"""A notebook shows a scene after this time at the latest, however few samples it has then."""


class Picture:
    """A picture, as numbers. `numpy.asarray(picture)` is `picture.linear`; a notebook shows it as it is meant to look."""

    def __init__(self, made: Dict[str, Any]) -> None:
        shape = (made["height"], made["width"], made["channels"])
        self.linear: Floats = np.frombuffer(made["linear"], np.float32).reshape(shape)
        """Linear light, exposed, not clipped: height x width x 3, or x 4 where the scene's `output` makes the background
        clear (premultiplied, then)."""
        self.display: Bytes = np.frombuffer(made["display"], np.uint8).reshape(shape)
        """What a screen shows: tone-mapped, sRGB."""
        self.layers: Dict[str, Floats] = {
            name: _layer(np.frombuffer(values, np.float32), shape[0], shape[1], channels)
            for name, channels, values in made["layers"]
        }
        """Layers by name: height x width, or x 3 (x 2) where they have several numbers a pixel. Where the scene says
        `"output": {"light_groups": True}`, what each group of lights brings, too: `light.key`, `light.rest`."""
        self.samples: Tuple[int, int] = made["samples"]
        """The fewest and the most samples that pixels have."""
        self.noise: Optional[float] = made["noise"]
        """The relative noise, 0.01 is one percent; `None` where nobody knows yet."""
        self.seed: int = made["seed"]
        self.stopped: bool = made["stopped"]
        """Whether `progress` has ended it early."""
        self._encode, self._save = made["encode"], made["save"]

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> "npt.NDArray[Any]":
        if copy is False and dtype is not None and np.dtype(dtype) != np.float32:
            raise ValueError("the picture is of float32; another type is a copy")
        array = self.linear if dtype is None else self.linear.astype(dtype, copy=False)
        return array.copy() if copy else array

    @property
    def shape(self) -> Tuple[int, ...]:
        return self.linear.shape

    def encode(self, format: str = "png", bits: int = 8) -> bytes:
        """The bytes of a file: `"png"` (of 8 or 16 bits), `"exr"` (with all layers), `"hdr"` or `"pfm"`."""
        made: bytes = self._encode(format, bits)
        return made

    def save(self, path: "Union[str, os.PathLike[str]]", bits: int = 8) -> None:
        """Writes a file, whole or not at all; its extension says which kind: png, exr, hdr, pfm."""
        self._save(os.fspath(path), bits)

    def _repr_png_(self) -> bytes:
        return self.encode("png")

    def __repr__(self) -> str:
        height, width, channels = self.linear.shape
        layers = "".join(f", {name}" for name in self.layers)
        return f"<tracer.Picture of {width} x {height} pixels, {self.samples[0]} samples{layers}>"


def _layer(values: "Floats", height: int, width: int, channels: int) -> "Floats":
    return values.reshape((height, width) if channels == 1 else (height, width, channels))


class Scene:
    """A scene, read, checked and ready to be rendered, as often as one likes. A notebook shows it as a picture.

    `scene` is a dictionary, a path, or the text of a scene. A text is told from a path by its brackets, `=` or line breaks;
    `syntax="ron"` (or `"toml"`, `"json"`) says that it is a text, a `pathlib.Path` that it is a path.

    `set` changes fields, as `--set` of the program does: `set={"camera.fov": 30}`. `frame` is the frame of the scene's
    `animation`, from 0, and `camera` the name of one of its `cameras`; a scene is of one frame and one camera. `assets` has what the scene names as files
    and is in memory: arrays (pictures), `tracer.Mesh`, bytes of files. `base_dir` is where other files of a dictionary or a
    text are, else the current folder.

    >>> import numpy as np, tracer
    >>> text = '''Scene(background: 1, objects: [Rectangle(
    ...     center: (0, 0, 0), normal: (0, 0, 1), size: 2, material: Diffuse(albedo: Texture(file: "grey")),
    ... )])'''
    >>> scene = tracer.Scene(text, assets={"grey": np.full((4, 4), 0.5, np.float32)})
    >>> picture = scene.render(size=(16, 16), samples=2, layers=["depth"])
    >>> picture.layers["depth"][8, 8].item()
    5.0

    Raises `SceneError` where the scene is wrong, `FileNotFoundError` where there is none. What is doubtful is a
    `SceneWarning`, and in `warnings`.
    """

    @_with_tips("Scene()", ("scene", *_OF_SCENE))
    def __init__(
        self,
        scene: "SceneLike",
        *,
        set: Optional[Mapping[str, Any]] = None,
        assets: Optional[Mapping[str, Any]] = None,
        base_dir: "Union[str, os.PathLike[str], None]" = None,
        syntax: Optional[str] = None,
        frame: Optional[int] = None,
        camera: Optional[str] = None,
    ) -> None:
        request, found = _request(scene, syntax)
        if base_dir is not None:
            if "path" in request:
                raise ValueError("the files of a scene that is a file start from its own folder; leave base_dir out")
            request["base_dir"] = os.fspath(base_dir)
        request["set"] = [f"{field}={_written(value)}" for field, value in (set or {}).items()]
        # They count more than `set`, as the program's own options do.
        if camera is not None:
            if not isinstance(camera, str):
                raise TypeError(f"camera is the name of one of the scene's cameras, and not {camera!r}")
            request["set"].append(f"camera={json.dumps(camera, ensure_ascii=False)}")
        if frame is not None:
            request["set"].append(f"animation.frame={_whole('frame', frame, 0, 999_999)}")
        given = [asset(os.fspath(name), value) for name, value in (assets or {}).items()]
        request["assets"] = found + given
        made = _native.load(request)
        _raise(made, [str(name) for name in assets or ()])
        self.warnings: List[Diagnostic] = diagnostics(made["warnings"])
        """What is doubtful."""
        self.size: Tuple[int, int] = made["size"]
        """Width and height of its pictures."""
        self.samples: int = made["samples"]
        self.files: List[str] = made["files"]
        """The files that it is made of."""
        self._render = made["render"]
        self._shown: Optional[bytes] = None
        if self.warnings:
            warnings.warn(made["text"].strip(), SceneWarning, stacklevel=_outside())
        if made["unused"]:
            names = ", ".join(map(repr, made["unused"]))
            warnings.warn(f"the scene does not name the assets {names}", SceneWarning, stacklevel=_outside())

    @_with_tips("render()", _OF_RENDER)
    def render(
        self,
        *,
        size: Optional[Tuple[int, int]] = None,
        samples: Optional[int] = None,
        seed: Optional[int] = None,
        layers: Sequence[str] = (),
        denoise: "Union[bool, Literal['oidn']]" = False,
        crop: Optional[Tuple[int, int, int, int]] = None,
        exposure: Optional[float] = None,
        noise: Optional[float] = None,
        time: Optional[float] = None,
        threads: int = 0,
        progress: "Optional[Progress]" = None,
    ) -> Picture:
        """Renders it. What is left out is as the scene says.

        size: width and height of the picture.
        samples: samples per pixel.
        seed: of all random choices.
        layers: names among `tracer.LAYERS`, for `Picture.layers`.
        denoise: filters the noise; the layer `noisy` is the picture without that. `"oidn"` has Open Image Denoise do it, where the
            machine has that: `TRACER_OIDN` in `os.environ` names its library or the folder of that.
        crop: x, y, width and height of the part of the picture to render, from the upper left.
        exposure: stops.
        noise: ends as soon as the relative noise is no more than this; 0.01 is one percent.
        time: ends after so many seconds, but not before every pixel has a sample.
        threads: how many; 0: one per core. The picture does not depend on them.
        progress: called with the part that is done, 0 to 1, some twenty times a second, in this thread. Where it gives
            `False`, the picture is what there is by then.

        Other threads of Python run meanwhile. Ctrl-C ends it with `KeyboardInterrupt`.
        """
        if isinstance(layers, str):
            raise TypeError(f"layers is a list of names: layers=[{layers!r}]")
        settings = {
            "size": size,
            "samples": samples,
            "seed": seed,
            "layers": list(layers),
            "denoise": denoise,
            "crop": crop,
            "exposure": exposure,
            "noise": noise,
            "time": time,
            "threads": threads,
        }
        made = self._render(_checked(settings), progress)
        _raise(made)
        if made["note"]:
            warnings.warn(made["note"], SceneWarning, stacklevel=_outside())
        return Picture(made)

    def _repr_png_(self) -> bytes:
        if self._shown is None:
            shrink = min(1.0, _SHOWN / max(self.size))
            size = (max(1, round(self.size[0] * shrink)), max(1, round(self.size[1] * shrink)))
            self._shown = self.render(size=size, time=_SHOWN_SECONDS).encode("png")
        return self._shown

    def __repr__(self) -> str:
        return f"<tracer.Scene of {self.size[0]} x {self.size[1]} pixels, {self.samples} samples>"


@overload
def render(scene: "SceneLike", *, layers: Sequence[str], **settings: Any) -> "Tuple[Floats, Dict[str, Floats]]": ...


@overload
def render(scene: "SceneLike", **settings: Any) -> "Floats": ...


def render(scene: "SceneLike", *, layers: Optional[Sequence[str]] = None, **settings: Any) -> Any:
    """Renders a scene: an array of linear light, height x width x 3 (x 4 where the scene makes its background clear), float32.

    With `layers`, a list of names, it is the array and a dictionary of the layers. Settings are those of `Scene` (`set`,
    `assets`, `base_dir`, `syntax`, `frame`, `camera`) and of `Scene.render` (`size`, `samples`, `seed`, `denoise`, `crop`, `exposure`, `noise`,
    `time`, `threads`, `progress`).

    >>> import tracer
    >>> ball = {"background": 1, "objects": [{"Sphere": {"center": [0, 0, 0], "radius": 1}}]}
    >>> picture, layers = tracer.render(ball, layers=["normal"], size=(9, 9), samples=4, set={"camera.fov": 30})
    >>> picture.shape, layers["normal"].shape
    ((9, 9, 3), (9, 9, 3))
    """
    of_scene = {name: settings.pop(name) for name in _OF_SCENE if name in settings}
    _refuse("render()", list(settings), (*_OF_SCENE, *_OF_RENDER))
    if isinstance(scene, Scene):
        if of_scene:
            raise TypeError(f"{', '.join(of_scene)} belongs to Scene(..): this one is made already")
        made = scene
    else:
        made = Scene(scene, **of_scene)
    picture = made.render(layers=layers or (), **settings)
    return picture.linear if layers is None else (picture.linear, picture.layers)


def _request(scene: "SceneLike", syntax: Optional[str]) -> Tuple[Dict[str, Any], List[Dict[str, Any]]]:
    if isinstance(scene, Mapping):
        text, assets = to_json(scene)
        return {"source": text, "syntax": "json", "name": "<scene>"}, assets
    if isinstance(scene, str) and (syntax is not None or any(c in scene for c in "\n({[=")):
        return {"source": scene, "syntax": syntax, "name": "<scene>"}, []
    if isinstance(scene, (str, os.PathLike)):
        return {"path": os.fspath(scene)}, []
    if isinstance(scene, bytes):
        raise TypeError("a scene is a text, not bytes: decode it first, as utf-8")
    raise TypeError(f"a scene is a dictionary, a path or a text, not of type {type(scene).__name__}")


def _written(value: Any) -> str:
    """A value as `--set` reads it."""
    if isinstance(value, str):
        return value
    return to_json({"value": value})[0][len('{"value": ') : -1]


_WHOLE = {"samples": (1, 2**32 - 1), "seed": (0, 2**32 - 1), "threads": (0, 2**16 - 1)}


def _checked(settings: Dict[str, Any]) -> Dict[str, Any]:
    """The settings, where they are of the right kinds; their ranges are those of the language."""
    for name, (least, most) in _WHOLE.items():
        settings[name] = _whole(name, settings[name], least, most)
    for name, count in (("size", 2), ("crop", 4)):
        value = settings[name]
        if value is not None:
            what = "(width, height)" if count == 2 else "(x, y, width, height)"
            if isinstance(value, (str, bytes)) or not hasattr(value, "__len__") or len(value) != count:
                raise TypeError(f"{name} is {what}, and not {value!r}")
            settings[name] = tuple(_whole(f"each number of {name}", part, 0, 2**32 - 1) for part in value)
    for name in ("exposure", "noise", "time"):
        value = settings[name]
        if value is not None:
            if isinstance(value, (str, bytes)) or not hasattr(value, "__float__"):
                raise TypeError(f"{name} is a number, and not {value!r}")
            settings[name] = float(value)
            if not np.isfinite(settings[name]):
                raise ValueError(f"{name} is a finite number, and not {value!r}")
    denoise = settings["denoise"]
    if isinstance(denoise, str) and denoise != "oidn":
        raise ValueError(f'denoise is True, False or "oidn", and not {denoise!r}')
    settings["denoise"] = (denoise if isinstance(denoise, str) else "on") if denoise else None
    return settings


def _whole(name: str, value: Any, least: int, most: int) -> Optional[int]:
    if value is None:
        return None
    try:
        number = value.__index__()
    except AttributeError:
        raise TypeError(f"{name} is a whole number, and not {value!r}") from None
    if not least <= number <= most:
        raise ValueError(f"{name} is {number}; it is from {least} to {most}")
    return int(number)


def _raise(made: Dict[str, Any], assets: Sequence[str] = ()) -> None:
    if "faults" not in made:
        return
    found, text = diagnostics(made["faults"]), made["text"]
    for diagnostic in found:
        # That a file is not there: it may be in memory, by nearly this name.
        missing = diagnostic.message.rpartition(" ")[2] if diagnostic.code == "E0501" else ""
        near = get_close_matches(missing, assets, 1) if missing else []
        if near:
            text = f"{text.rstrip()}\n\nnote: `assets` has {near[0]!r}, and the scene names {missing!r}\n"
    raise SceneError(found, text)


def _outside() -> int:
    """How many frames lie between a warning and who called this package, so that it names their line."""
    import sys

    level, frame = 1, sys._getframe(1)
    while frame is not None and frame.f_globals.get("__name__", "").split(".")[0] == __package__:
        level, frame = level + 1, frame.f_back  # type: ignore[assignment]
    return level
