"""What is wrong with a scene, as exceptions and data."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Tuple


@dataclass(frozen=True)
class Place:
    """A place in a text. Lines and columns count from 1, columns in characters; the end is one past the last."""

    file: str
    line: int
    column: int
    end_line: int
    end_column: int


@dataclass(frozen=True)
class Diagnostic:
    """One thing that is wrong or doubtful; docs/diagnostics.md of the project explains the codes."""

    severity: str
    """`"error"` or `"warning"`."""
    code: str
    """`"E0301"`; codes never change."""
    message: str
    path: str
    """The field, `"objects[2].radius"`; empty where there is none."""
    place: Optional[Place]
    """In the scene. Of a dictionary this is its text as JSON."""
    expected: str
    hint: str
    labels: Tuple[Tuple[Optional[Place], str], ...]
    """Other places that have to do with it, and what they are."""
    elsewhere: Optional[Tuple[str, int]]
    """A file that the scene names and its line (0: the whole file), where that is at fault."""
    edit: Optional[Tuple[Place, str]]
    """A change of the text that mends it, where one is certain: the place, and what to write there."""

    def __str__(self) -> str:
        where = f"{self.place.file}:{self.place.line}:{self.place.column}: " if self.place else ""
        return f"{where}{self.severity} {self.code}: {self.message}"


class SceneError(ValueError):
    """A scene is wrong. It prints as `tracer check` does, with excerpts of the scene.

    `diagnostics` has all that is wrong, warnings among them; the other attributes are those of the first error.

    >>> import tracer
    >>> try:
    ...     tracer.render({"background": 1, "objects": [{"Sphere": {"center": [0, 0, 0], "radius": -1}}]})
    ... except tracer.SceneError as error:
    ...     print(error.code, error.path)
    E0301 objects[0].radius
    """

    def __init__(self, diagnostics: List[Diagnostic], text: str) -> None:
        super().__init__(text)
        self.diagnostics = diagnostics
        errors = [diagnostic for diagnostic in diagnostics if diagnostic.severity == "error"]
        first = (errors or diagnostics)[0]
        self.code: str = first.code
        self.message: str = first.message
        self.path: str = first.path
        self.expected: str = first.expected
        self.hint: str = first.hint
        self.file: Optional[str] = first.place.file if first.place else None
        self.line: Optional[int] = first.place.line if first.place else None
        self.column: Optional[int] = first.place.column if first.place else None
        self._text = text

    def __str__(self) -> str:
        return "\n" + self._text.rstrip()

    def __reduce__(self) -> Tuple[Any, ...]:
        return (SceneError, (self.diagnostics, self._text))


class SceneWarning(UserWarning):
    """Something of a scene is probably not what was meant; the picture is made all the same."""


def diagnostics(lines: str) -> List[Diagnostic]:
    """Diagnostics of their JSON, a line each."""
    return [_diagnostic(json.loads(line)) for line in lines.splitlines()]


def _place(found: Optional[Dict[str, Any]]) -> Optional[Place]:
    if not found or "start" not in found:
        return None
    start, end = found["start"], found["end"]
    return Place(found["file"], start["line"], start["column"], end["line"], end["column"])


def _diagnostic(found: Dict[str, Any]) -> Diagnostic:
    elsewhere, edit = found.get("elsewhere"), found.get("edit")
    edited = _place(edit)
    return Diagnostic(
        severity=found["severity"],
        code=found["code"],
        message=found["message"],
        path=found.get("path") or "",
        place=_place(found),
        expected=found.get("expected") or "",
        hint=found.get("hint") or "",
        labels=tuple((_place(label), label["message"]) for label in found.get("labels") or ()),
        elsewhere=(elsewhere["file"], elsewhere["line"]) if elsewhere else None,
        edit=(edited, edit["replacement"]) if edit and edited else None,
    )
