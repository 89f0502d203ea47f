"""Scenes in Python: the path of a scene file, or a dict with its keys and with meshes as numpy arrays."""

from __future__ import annotations

import contextlib
import datetime
import difflib
import os
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Union

import numpy as np
import tomli_w

from . import _core
from ._errors import refuse
from ._options import path, refuse_masked, text

Scene = Union[str, "os.PathLike[str]", Mapping[str, Any]]

_MESH_KEYS = ("vertices", "triangles", "optics", "organ", "plant", "rank")
_PART_KEYS = ("up", "scale", "heading", "at", "positions", "role", "split", "instances")
_UNNAMED = "unnamed"  # the material of triangles without one, for patterns of optics
_DICT_NAME = "scene"  # name in messages of a scene that is not a file


class SceneSource:
    """A scene in parts: text for the reader, meshes, and the folder in which files are looked up."""

    def __init__(self, scene: Scene, folder: Union[str, "os.PathLike[str]", None] = None) -> None:
        self.meshes: dict[str, Any] = {}
        self._tables: Union[dict[str, Any], None] = None
        self._content: Union[bytes, None] = None
        if isinstance(scene, Mapping):
            if not scene:
                refuse("scene: {}", "is empty", "give its tables, such as plot, band, optics and geometry")
            self.file = Path(path(folder or ".", "folder")) / _DICT_NAME
            self._absolute = self.file.absolute()
            with _refusing_depth():
                self._tables = self._take_meshes(scene)
                self.text: Union[str, None] = _toml(self._tables)
            return
        if not isinstance(scene, (str, os.PathLike)):
            refuse(f"scene: {type(scene).__name__}", "must be the path of a scene file or a dict with its keys", "give either")
        if folder is not None:
            refuse("folder", "a scene file has its own folder", "leave it out")
        self.file = Path(path(scene, "scene"))
        self._absolute = self.file.absolute()
        self.text = None

    @property
    def present_file(self) -> Path:
        """The file by its name as given or, once the current folder has changed, by its absolute name."""
        return self.file if self.file.absolute() == self._absolute else self._absolute

    def entry_at(self, line: int) -> str:
        """Returns the entry of `geometry` at a line of the text: geometry[3] of several, geometry of a single one."""
        lines = (self.text or "").splitlines()
        entries = [number for number, words in enumerate(lines, start=1) if words == "[[geometry]]"]
        if not entries and "geometry = [" in lines:  # short entries stand in lines of their own
            first = lines.index("geometry = [") + 2
            entries = list(range(first, lines.index("]", first) + 1))
        return f"geometry[{sum(number <= line for number in entries) - 1}]" if len(entries) > 1 else "geometry"

    def keep(self, content: bytes) -> None:
        """Keeps the content of a scene file, so that changes of the file do not reach a scene that was read before."""
        self._content = content

    @property
    def tables(self) -> dict[str, Any]:
        """The keys of the scene. A file is read unless its content was kept; raises InputError if Python cannot parse it."""
        if self._tables is None:
            self._tables = _parsed(self._absolute.read_bytes() if self._content is None else self._content, self.file)
        return self._tables

    def text_with(self, changes: Mapping[str, Any]) -> str:
        """Returns the text with other tables of light and optics; None removes a table."""
        tables = {key: value for key, value in self.tables.items() if key != "geometry"}
        with _refusing_depth():
            for key, value in changes.items():
                if value is None:
                    tables.pop(key, None)
                elif key in ("optics", "soil"):
                    tables[key] = {**tables.get(key, {}), **_plain(value, key)}
                else:
                    tables[key] = _plain(value, key)
            return _toml(tables)

    def _take_meshes(self, scene: Mapping[str, Any]) -> dict[str, Any]:
        tables = {}
        for key, value in scene.items():
            if key == "geometry":
                parts = [value] if isinstance(value, Mapping) else value
                if not isinstance(parts, Sequence) or isinstance(parts, str):
                    refuse("geometry", "must be a list of dicts", "put the dict into [ ]")
                tables[key] = [self._take_mesh(part, number) for number, part in enumerate(parts)]
            else:
                tables[text(str(key), "a key of the scene")] = _plain(value, str(key))
        return tables

    def _take_mesh(self, part: Any, number: int) -> dict[str, Any]:
        place = f"geometry[{number}]"
        if not isinstance(part, Mapping):
            refuse(f"{place}: {type(part).__name__}", "must be a dict", "give file, generator or vertices and triangles")
        if "vertices" not in part:
            near = difflib.get_close_matches("vertices", [str(key) for key in part], 1)
            if near or "triangles" in part:
                refuse(f"{place}.vertices", "is missing", f"did you mean it by {near[0]}?" if near else "give it beside triangles")
            return _plain(part, place)
        unknown = sorted(set(part) - set(_MESH_KEYS) - set(_PART_KEYS))
        if unknown:
            refuse(f"{place}.{unknown[0]}", "unknown key next to vertices", f"use {', '.join(_MESH_KEYS + _PART_KEYS)}")
        name = f"mesh{number}"
        self.meshes[name] = _mesh(part, place)
        keys = _PART_KEYS + (("optics",) if isinstance(part.get("optics"), Mapping) else ())
        return {"mesh": name, **_plain({key: part[key] for key in keys if key in part}, place)}


def refuse_unknown_optics(names: Iterable[str], known: Iterable[str]) -> None:
    """Raises InputError for a name that no surface of a scene can have, which would change nothing."""
    words = {word.lower(): word for word in known}
    for name in names:
        if text(str(name), "a key of optics") in words.values():
            continue
        near = difflib.get_close_matches(str(name).lower(), words, 1)
        cure = f"did you mean {words[near[0]]}?" if near else f"use one of {', '.join(sorted(words.values()))}"
        refuse(f"optics.{name}", "the scene has no optics of that name, so that nothing would change", cure)


def _parsed(content: bytes, file: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(content.decode("utf-8-sig"))  # editors of Windows begin files with a byte order mark
    except (UnicodeDecodeError, tomllib.TOMLDecodeError, RecursionError) as error:
        refuse(f"{file}: not a TOML file that Python can read", str(error), "correct it, or give the scene as a dict")


def _toml(tables: Mapping[str, Any]) -> str:
    return tomli_w.dumps(dict(tables))


@contextlib.contextmanager
def _refusing_depth() -> Iterator[None]:
    try:
        yield
    except RecursionError:
        refuse("scene", "dicts or lists are nested too deeply, or contain themselves", "flatten them")


def _plain(value: Any, place: str) -> Any:
    """Converts numpy's numbers and arrays, tuples and paths to TOML's types."""
    if isinstance(value, Mapping):
        keys = {key: text(str(key), f"a key of {place}") for key in value}
        return {name: _plain(value[key], f"{place}.{name}") for key, name in keys.items() if value[key] is not None}
    if isinstance(value, str):
        text(value, place)
    if isinstance(value, np.datetime64):
        value = value.astype("datetime64[us]").item()
        value = value.replace(tzinfo=datetime.timezone.utc) if value is not None else "NaT"
    if isinstance(value, (bool, int, float, str, datetime.datetime)):
        return _moment(value, place) if place.endswith(".time") else value
    if isinstance(value, np.generic):
        return _plain(value.item(), place)
    if isinstance(value, np.ndarray):
        return _plain(value.tolist(), place)
    if isinstance(value, (list, tuple)):
        return [_plain(item, f"{place}[{number}]") for number, item in enumerate(value)]
    if isinstance(value, os.PathLike):
        return text(os.fspath(value), place)
    refuse(f"{place}: {type(value).__name__}", "must be a number, string, time, list or dict", "convert it")


def _moment(value: Any, place: str) -> Any:
    """Returns a time as a datetime, in UTC if its offset has seconds, which TOML does not know; reads strings as ISO 8601."""
    if isinstance(value, str):
        try:
            value = datetime.datetime.fromisoformat(value)
        except ValueError:
            refuse(f'{place} = "{value}"', "must be a date and time", "write 2002-08-08T10:10:00+08:00")
    offset = value.utcoffset() if isinstance(value, datetime.datetime) else None
    return value.astimezone(datetime.timezone.utc) if offset and offset.total_seconds() % 60 else value


def _array(value: Any, name: str, kinds: str, wanted: str) -> np.ndarray:
    refuse_masked(value, name)
    try:
        array = np.asarray(value)
    except ValueError:
        refuse(name, "its rows differ in length", "give rows of the same length")
    if array.dtype.kind not in kinds:
        refuse(f"{name}: dtype {array.dtype}", f"must be {wanted}", f"convert it, e.g. with numpy.asarray({name.split('.')[-1]}, ...)")
    return array


def _vertices(value: Any, place: str) -> np.ndarray:
    array = _array(value, f"{place}.vertices", "fiu", "numbers, metres")
    if array.ndim not in (2, 3) or array.shape[-1] != 3 or (array.ndim == 3 and array.shape[1] != 3):
        refuse(f"{place}.vertices: shape {array.shape}", "must be (n, 3), or (m, 3, 3) for the corners of m triangles", "reshape it")
    bad = np.argwhere(~np.isfinite(array).reshape(-1, 3).all(axis=1))
    if bad.size:
        refuse(f"{place}.vertices: NaN or infinity at vertex {bad[0, 0]}", "must be finite", "remove or repair it")
    return array


def _triangles(part: Mapping[str, Any], vertices: np.ndarray, place: str) -> np.ndarray:
    name = f"{place}.triangles"
    if "triangles" not in part:
        if vertices.ndim != 3:
            refuse(name, "is missing", "give vertex numbers of shape (m, 3), or vertices of shape (m, 3, 3)")
        return np.arange(3 * len(vertices), dtype=np.uint32).reshape(-1, 3)
    array = _array(part["triangles"], name, "iu", "whole numbers")
    if array.ndim != 2 or array.shape[1] != 3:
        refuse(f"{name}: shape {array.shape}", "must be (m, 3)", "give three vertex numbers per triangle")
    count = vertices.size // 3
    if array.size and (array.min() < 0 or array.max() >= count):
        worst = array.min() if array.min() < 0 else array.max()
        refuse(f"{name}: vertex number {worst}", f"there are {count} vertices, counted from 0", "correct the triangles")
    return np.ascontiguousarray(array, dtype=np.uint32)


def _numbers(part: Mapping[str, Any], key: str, fallback: int, count: int, place: str) -> np.ndarray:
    """Returns a whole number per triangle, given one for all or one each."""
    name = f"{place}.{key}"
    array = _array(part.get(key, fallback), name, "iu", "whole numbers")
    if array.ndim > 1 or (array.ndim == 1 and len(array) != count):
        refuse(f"{name}: shape {array.shape}", f"must be one number, or one for each of {count} triangles", "correct its length")
    if array.size and (array.min() < 0 or array.max() > 2**31 - 1):
        refuse(f"{name}: {array.min() if array.min() < 0 else array.max()}", "must lie in 0..2147483647", "number from 0 or 1 on")
    return np.broadcast_to(array, (count,))


def _distinct(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the distinct items or rows in order of first appearance and, for each of `values`, the index of its own."""
    found, first, inverse = np.unique(values, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first, kind="stable")
    number = np.empty(len(order), dtype=np.uint32)
    number[order] = np.arange(len(order), dtype=np.uint32)
    return found[order], number[inverse.reshape(-1)]


def _names(part: Mapping[str, Any], key: str, fallback: Any, count: int, place: str) -> tuple[list[str], np.ndarray]:
    """Returns the distinct names and, per triangle, the index of its name, given one name for all or one each."""
    name = f"{place}.{key}"
    value = part.get(key, fallback)
    if value is None:
        refuse(name, "is missing", "give the name of an [optics] table for all triangles, or one name for each")
    if isinstance(value, str):
        return [text(value, name)], np.zeros(count, dtype=np.uint32)
    array = _array(value, name, "UO", "names")
    if array.shape != (count,):
        refuse(f"{name}: shape {array.shape}", f"must be one name, or one for each of {count} triangles", "correct its length")
    if not all(isinstance(item, str) for item in array.tolist()):
        refuse(f"{name}: an item that is not a string", "must be names", "give a list of str")
    names, number = _distinct(array.astype(str))
    return [text(str(item), name) for item in names], number


def _mesh(part: Mapping[str, Any], place: str) -> Any:
    vertices = _vertices(part["vertices"], place)
    triangles = _triangles(part, vertices, place)
    count = len(triangles)
    if count == 0:
        refuse(f"{place}.triangles: none", "a mesh needs at least one triangle", "add triangles, or leave this geometry out")
    patterned = isinstance(part.get("optics"), Mapping)
    optics_names, optics = _names({"optics": _UNNAMED} if patterned else part, "optics", None, count, place)
    kind_names, kinds = (optics_names, optics) if "organ" not in part else _names(part, "organ", None, count, place)
    plants = _numbers(part, "plant", 1, count, place)
    ranks = _numbers(part, "rank", 0, count, place)
    keys = np.stack([plants.astype(np.int64), kinds.astype(np.int64), ranks.astype(np.int64)], axis=1)
    found, number = _distinct(keys)
    organs = [(int(plant), kind_names[kind], int(rank)) for plant, kind, rank in found]
    flat = np.ascontiguousarray(vertices.reshape(-1, 3), dtype=np.float64)
    return _core.Mesh(flat, triangles, optics, optics_names, number, organs, "plant" in part)
