"""Results as they are pickled: the arrays, the short tables and the summary, without the scene, its tree and the device."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._columns import read_only
from ._errors import refuse

_SHORT_TABLES = ("profile.csv", "organs.csv", "plants.csv")
_SENSOR_TABLES = ("sensors.csv", "sensor_means.csv")
_OWN_ARRAYS = ("sensors.csv", "triangles.csv")  # whose columns have methods of their own


def _copied(value: Any) -> Any:
    """Returns an array that owns its memory, or the same in a dict or list."""
    if isinstance(value, np.ndarray):
        return value.copy()
    if isinstance(value, dict):
        return {name: _copied(item) for name, item in value.items()}
    return [_copied(item) for item in value] if isinstance(value, list) else value


def _shared(value: Any) -> Any:
    """Returns read-only views of arrays in new dicts and lists."""
    if isinstance(value, np.ndarray):
        return read_only(value.view())
    if isinstance(value, dict):
        return {name: _shared(item) for name, item in value.items()}
    return [_shared(item) for item in value] if isinstance(value, list) else value


class _Kept:
    """Answers the calls of a compiled result whose answers were kept."""

    def __init__(self, core: Any, arrays: tuple[str, ...], tables: tuple[str, ...], described: tuple[str, ...]) -> None:
        self.complete: bool = core.complete
        self._summary: str = core.summary()
        self._arrays = {name: _copied(getattr(core, name)()) for name in arrays}
        self._tables = {name: core.table(name) for name in tables}
        self._described = {name: core.describe(name) for name in described}
        self._columns = {name: _copied(core.columns(name)) for name in described if name not in _OWN_ARRAYS}

    def summary(self) -> str:
        return self._summary

    def table(self, name: str) -> str:
        if name not in self._tables:
            refuse(name, "no such table in a result that was pickled", f"use {', '.join(self._tables)}")
        return self._tables[name]

    def columns(self, name: str) -> Any:
        return _shared(self._columns[name])

    def describe(self, name: str) -> dict[str, Any]:
        if name not in self._described:
            refuse(name, "not a table of this result", f"use {', '.join(self._described)}")
        return dict(self._described[name])


def _answer(name: str) -> Any:
    """Returns a method that gives the arrays kept under its name."""

    def method(self: _Kept) -> Any:
        return _shared(self._arrays[name])

    return method


class KeptOutcome(_Kept):
    def __init__(self, core: Any) -> None:
        if isinstance(core, KeptOutcome):
            self.__dict__.update(core.__dict__)
            return
        arrays = ("triangles", "planes", "sensors", "corners", "organ_rows")
        tables = (*_SHORT_TABLES, *_SENSOR_TABLES) if core.sensors() else _SHORT_TABLES
        super().__init__(core, arrays, tables, (*tables, "triangles.csv", "balance"))

    def write(self, *_: Any) -> None:
        refuse("save", "a result that was pickled has no scene", "save it before it is pickled")

    def render(self, *_: Any) -> np.ndarray:
        refuse("render", "a result that was pickled has no scene", "render it before it is pickled")

    triangles = _answer("triangles")
    planes = _answer("planes")
    sensors = _answer("sensors")
    corners = _answer("corners")
    organ_rows = _answer("organ_rows")


class KeptDay(_Kept):
    def __init__(self, core: Any) -> None:
        if isinstance(core, KeptDay):
            self.__dict__.update(core.__dict__)
            return
        tables = tuple(core.tables())
        arrays = ("organ_steps", "triangles", "plane_steps") if core.has_triangles else ("organ_steps",)
        super().__init__(core, arrays, tables, tables)
        self.has_triangles: bool = core.has_triangles

    def tables(self) -> list[str]:
        return list(self._tables)

    organ_steps = _answer("organ_steps")
    triangles = _answer("triangles")
    plane_steps = _answer("plane_steps")
