"""Columns of tables: texts as arrays, and tables as pandas' DataFrames."""

from __future__ import annotations

import importlib
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ._errors import SunfleckError


def optional(module: str, purpose: str) -> Any:
    """Imports a module that only `purpose` needs. Raises SunfleckError with the cure if it is not installed."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        package = module.split(".")[0]
        message = f"{purpose} ({package} is not installed: {error}); install it, on Debian with apt install python3-{package}"
        raise SunfleckError(message) from None


def text_array(texts: Iterable[str]) -> np.ndarray:
    """Returns texts as a read-only array of fixed width, dtype <U."""
    texts = list(texts)
    return read_only(np.array(texts, dtype=str) if texts else np.empty(0, dtype="<U1"))


def read_only(array: np.ndarray) -> np.ndarray:
    array.flags.writeable = False
    return array


def with_text_arrays(columns: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the columns with arrays in place of lists of texts."""
    return {name: text_array(values) if isinstance(values, list) else values for name, values in columns.items()}


def triangle_columns(core: Any) -> dict[str, Any]:
    """Returns the columns of the triangles of an outcome: names of organ and optics in place of their numbers, and organ_index."""
    given = core.triangles()
    words = {name: text_array(given.pop(f"{name}_name")) for name in ("organ", "optics")}
    columns = {}
    for name, values in given.items():
        columns[name] = read_only(words[name][values]) if name in words else values
        if name == "organ":
            columns["organ_index"] = core.organ_rows()
    return columns


def data_frame(columns: Mapping[str, Any], index: Any, units: Mapping[str, str]) -> Any:
    """Returns a DataFrame with the unit of each column in attrs["units"]. Names become categories, which take little memory."""
    pandas = optional("pandas", "to_dataframe")
    ready = {name: pandas.Categorical(values) if values.dtype.kind == "U" else values for name, values in columns.items()}
    frame = pandas.DataFrame(ready, index=index)
    frame.attrs["units"] = {name: unit for name, unit in units.items() if name in columns}
    return frame


def numbered(name: str, count: int) -> Any:
    """Returns the index 0, 1, ... of that name."""
    return optional("pandas", "to_dataframe").RangeIndex(count, name=name)


def named(name: str, values: Iterable[Any]) -> Any:
    return optional("pandas", "to_dataframe").Index(list(values), name=name)


def crossed(names: list[str], values: list[Iterable[Any]]) -> Any:
    """Returns the index of all combinations, the last varying fastest."""
    return optional("pandas", "to_dataframe").MultiIndex.from_product(values, names=names)
