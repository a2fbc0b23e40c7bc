"""What a scene names and Python has in memory: arrays where a scene has files."""

from __future__ import annotations

import json
import os
from typing import Any, Dict, List, Mapping, Optional, Tuple, Union

import numpy as np

Asset = Dict[str, Any]


class Mesh:
    """A mesh of arrays. It stands where a scene names a mesh file.

    `points`: n x 3. `faces`: m x 3 numbers of points, or m x k for faces of k corners. `normals` (n x 3) and `uvs` (n x 2,
    u to the right, v upwards) belong to the points, and so do `colors` (n x 3 or, alpha ignored, n x 4), which a `VertexColor`
    shows: uint8 is sRGB, floats from 0 to 1 are linear.

    >>> import numpy as np, tracer
    >>> square = tracer.Mesh(points=[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], faces=[[0, 1, 2, 3]])
    >>> scene = {"background": 1, "objects": [{"Mesh": {"file": square}}]}
    >>> tracer.render(scene, size=(8, 8), samples=1).shape
    (8, 8, 3)
    """

    def __init__(self, points: Any, faces: Any, normals: Any = None, uvs: Any = None, colors: Any = None) -> None:
        self.points = _rows("points", points, 3)
        faces = np.asarray(faces)
        if faces.ndim != 2 or faces.shape[1] < 3:
            raise ValueError(f"faces is an array of m x 3 numbers of points (or m x k), not of shape {faces.shape}")
        if faces.dtype.kind not in "iu":
            raise TypeError(f"faces is an array of whole numbers, not of {faces.dtype}")
        if faces.size and (faces.min() < 0 or faces.max() > 0xFFFFFFFF):
            raise ValueError(f"faces has the number {faces.min() if faces.min() < 0 else faces.max()}; points count from 0")
        self.faces = np.ascontiguousarray(faces, dtype=np.uint32)
        self.normals = None if normals is None else _rows("normals", normals, 3)
        self.uvs = None if uvs is None else _rows("uvs", uvs, 2)
        self.colors = None if colors is None else _colors(colors)

    def __repr__(self) -> str:
        return f"<tracer.Mesh of {len(self.points)} points and {len(self.faces)} faces>"

    def _asset(self) -> Asset:
        none = b""
        return {
            "kind": "mesh",
            "points": self.points.tobytes(),
            "faces": self.faces.tobytes(),
            "corners": self.faces.shape[1],
            "normals": none if self.normals is None else self.normals.tobytes(),
            "uvs": none if self.uvs is None else self.uvs.tobytes(),
            "colors": none if self.colors is None else self.colors.tobytes(),
            "color_bytes": int(self.colors is not None and self.colors.dtype == np.uint8),
        }


def _rows(name: str, values: Any, width: int) -> "np.ndarray[Any, Any]":
    array = np.asarray(values)
    if array.ndim != 2 or array.shape[1] != width:
        raise ValueError(f"{name} is an array of n x {width} numbers, not of shape {array.shape}")
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name} is an array of numbers, not of {array.dtype}")
    return np.ascontiguousarray(array, dtype=np.float64)


def _colors(values: Any) -> "np.ndarray[Any, Any]":
    array = np.asarray(values)
    if array.ndim != 2 or array.shape[1] not in (3, 4):
        raise ValueError(f"colors is an array of n x 3 or n x 4 numbers, not of shape {array.shape}")
    if array.dtype != np.uint8 and array.dtype.kind != "f":
        raise TypeError(f"colors is an array of uint8 (sRGB) or of floats (linear), not of {array.dtype}")
    array = array[:, :3]
    if array.dtype == np.uint8:
        return np.ascontiguousarray(array)
    wrong = ~((array >= 0) & (array <= 1)).all(axis=1)
    if wrong.any():
        k = int(wrong.argmax())
        raise ValueError(f"colors[{k}] is {array[k].tolist()}; floats are from 0 to 1, and colours of 0 to 255 are uint8")
    return np.ascontiguousarray(array, dtype=np.float32)


def _pixels(name: str, array: "np.ndarray[Any, Any]") -> Asset:
    """A picture: uint8 and uint16 are sRGB, as in PNG files, floats are linear."""
    if array.ndim == 2:
        array = array[:, :, None]
    if array.ndim != 3 or not 1 <= array.shape[2] <= 4:
        raise ValueError(
            f"{name}: a picture is an array of height x width, or height x width x 1 to 4, not of shape {array.shape}"
        )
    if array.dtype in (np.uint8, np.uint16):
        kind = array.dtype.name
    elif array.dtype.kind == "f":
        kind, array = "float32", array.astype(np.float32)
    else:
        raise TypeError(f"{name}: a picture is of uint8 or uint16 (sRGB) or of floats (linear), not of {array.dtype}")
    height, width, channels = array.shape
    values = np.ascontiguousarray(array).tobytes()
    return {"kind": kind, "width": width, "height": height, "channels": channels, "values": values}


def asset(name: str, value: Any) -> Asset:
    """An entry of `assets`: a mesh, a picture, or the bytes of a file."""
    if isinstance(value, Mesh):
        made = value._asset()
    elif isinstance(value, np.ndarray):
        made = _pixels(f"asset {name!r}", value)
    elif isinstance(value, (bytes, bytearray, memoryview)):
        made = {"kind": "file", "bytes": bytes(value)}
    elif isinstance(value, Mapping) and "points" in value:
        made = Mesh(**value)._asset()
    elif hasattr(value, "vertices") and hasattr(value, "faces"):
        # trimesh, and what is like it.
        made = Mesh(value.vertices, value.faces)._asset()
    elif hasattr(value, "__array__"):
        # Pillow, torch, and what else is an array at heart.
        made = _pixels(f"asset {name!r}", np.asarray(value))
    else:
        raise TypeError(
            f"asset {name!r} is of type {type(value).__name__}: it is a tracer.Mesh, an array (a picture), or the bytes of a file"
        )
    return {"name": name, **made}


class _Walk:
    """A scene of dictionaries on its way to JSON: arrays where files stand become assets."""

    def __init__(self) -> None:
        self.assets: List[Asset] = []

    def name_of(self, value: Any) -> str:
        name = f"array-{len(self.assets) + 1}"
        self.assets.append(asset(name, value))
        return name

    def plain(self, value: Any, key: Optional[str], path: str) -> Any:
        if value is None or isinstance(value, (bool, str, int, float)):
            return value
        if isinstance(value, Mapping):
            if key == "file" and "points" in value:
                return self.name_of(value)
            return self._fields(value, key, path)
        if key == "file" and not isinstance(value, os.PathLike):
            return self.name_of(value)
        if isinstance(value, Mesh):
            raise TypeError(f"{path} is a tracer.Mesh; it stands where a scene names a file: {{'Mesh': {{'file': mesh, ..}}}}")
        if isinstance(value, (list, tuple)):
            return [self.plain(item, None, f"{path}[{k}]") for k, item in enumerate(value)]
        if isinstance(value, os.PathLike):
            return os.fspath(value)
        if isinstance(value, np.generic):
            return value.item()
        if isinstance(value, np.ndarray):
            return value.tolist()
        raise TypeError(f"{path or 'the scene'} is of type {type(value).__name__}, which no scene can hold")

    def _fields(self, value: Mapping[Any, Any], key: Optional[str], path: str) -> Dict[str, Any]:
        for field in value:
            if not isinstance(field, str):
                raise TypeError(f"{path or 'the scene'} has the key {field!r}; keys are texts")
        value = dict(value)
        points, faces = value.get("points"), value.get("faces")
        if key == "Mesh" and "file" not in value and isinstance(points, np.ndarray) and isinstance(faces, np.ndarray):
            # As a file would be: numbers, and not their text.
            arrays = {name: value.pop(name) for name in ("points", "faces", "normals", "uvs", "colors") if name in value}
            value = {"file": self.name_of(Mesh(**arrays)), **value}
        return {
            field: self.plain(item, field, f"{path}.{field}" if path else field) for field, item in value.items()
        }


def to_json(scene: Mapping[str, Any]) -> Tuple[str, List[Asset]]:
    """The text of a scene of dictionaries, and what of it is in memory."""
    walk = _Walk()
    try:
        plain = walk.plain(scene, None, "")
    except RecursionError:
        raise ValueError("the scene holds itself, or is nested too deeply") from None
    return _text(plain), walk.assets


_WIDTH = 100
"""What fits a line of so many characters stands in one, so that an excerpt shows what was meant."""

_DEEP = 64
"""Below so many levels nothing is laid out any more."""


def _text(value: Any, indent: int = 0) -> str:
    """JSON, laid out."""
    plain = json.dumps(value, ensure_ascii=False)
    fits = len(plain) + indent <= _WIDTH
    if fits or indent >= _DEEP or not isinstance(value, (dict, list)) or _is_numbers(value):
        return plain
    inner = " " * (indent + 1)
    if isinstance(value, dict):
        parts = [f"{inner}{json.dumps(key, ensure_ascii=False)}: {_text(item, indent + 1)}" for key, item in value.items()]
        return "{\n" + ",\n".join(parts) + "\n" + " " * indent + "}"
    parts = [inner + _text(item, indent + 1) for item in value]
    return "[\n" + ",\n".join(parts) + "\n" + " " * indent + "]"


def _is_numbers(value: Any) -> bool:
    """Whether it is a list of numbers or of vectors, which nobody reads: written line by line it would be long."""
    if not isinstance(value, list) or not value:
        return False
    first = value[0][0] if isinstance(value[0], list) and value[0] else value[0]
    return isinstance(first, (int, float))
