"""Checks arguments: the numbers that determine how much work is done, texts and paths."""

from __future__ import annotations

import math
import operator
import os
import re
from collections.abc import Iterable, Mapping
from typing import Any, Optional, Union

import numpy as np

from . import _core
from ._errors import refuse


_NO_CHARACTER = re.compile("[\0\ud800-\udfff]")  # NUL ends texts of the compiled part, and lone surrogates have no UTF-8


def text(value: Any, name: str) -> str:
    """Returns the value if it is a text that the compiled part can take."""
    if not isinstance(value, str):
        refuse(f"{name}: {type(value).__name__}", "must be text", "give a str")
    if _NO_CHARACTER.search(value):
        refuse(f"{name} = {value!r}", "contains NUL or a lone surrogate", "remove it")
    return value


def texts(value: Union[str, Iterable[str]], name: str) -> list[str]:
    """Returns the texts in a list, given one or several."""
    if not isinstance(value, (str, Iterable)):
        refuse(f"{name}: {type(value).__name__}", "must be text, or a list of texts", "give a str")
    return [text(item, name) for item in ([value] if isinstance(value, str) else value)]


def path(value: Any, name: str) -> str:
    """Returns a path as text if a file may have it."""
    try:
        content = os.fsencode(value)
    except (TypeError, UnicodeEncodeError):
        refuse(f"{name} = {value!r}", "must be a path", "give a str or a pathlib.Path")
    if b"\0" in content:
        refuse(f"{name} = {value!r}", "contains NUL, which no path may", "remove it")
    return os.fsdecode(content)


def refuse_masked(value: Any, name: str) -> None:
    """Refuses arrays of which some values are masked, since conversions drop the mask."""
    if np.ma.is_masked(value):
        refuse(f"{name}: a masked array", "every value is used", "leave the masked rows out")


def flag(value: Any, name: str) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        refuse(f"{name} = {value!r}", "must be True or False", "give one of them")
    return bool(value)


def real(value: Any, name: str) -> float:
    """Returns the value if it is a finite number."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
        refuse(f"{name}: {type(value).__name__}", "must be a number", "give one")
    if not math.isfinite(value):
        refuse(f"{name} = {value}", "must be finite", "give a number")
    return float(value)


def above_zero(value: Any, name: str) -> float:
    number = real(value, name)
    if number <= 0.0:
        refuse(f"{name} = {value}", "must be above 0", "give a larger number")
    return number


def whole(value: Any, name: str, lo: int, hi: int) -> int:
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    try:
        number = operator.index(value)
    except TypeError:
        refuse(f"{name} = {value!r}", "must be a whole number", f"give one of {lo}..{hi}")
    if isinstance(value, (bool, np.bool_)) or not lo <= number <= hi:
        refuse(f"{name} = {value!r}", f"must lie in {lo}..{hi}", "give another number")
    return number


def bound(value: Any, name: str) -> float:
    number = real(value, name)
    if not 0.0 < number < 1.0:
        refuse(f"{name} = {value}", "must lie between 0 and 1", "give 0.01 for one percent")
    return number


def work_options(work: Mapping[str, Any]) -> Any:
    """Checks the keyword arguments of run() that limit its work, and returns them in the form the compiled part takes."""
    checked = {
        "direct_error": _bound_of(work, "direct_error"),
        "indirect_error": _bound_of(work, "indirect_error"),
        "grid": above_zero(work["grid"], "grid") if work["grid"] is not None else None,
        "passes": whole(work["passes"], "passes", 8, 65536) if work["passes"] is not None else None,
        "max_seconds": above_zero(work["max_seconds"], "max_seconds") if work["max_seconds"] is not None else None,
        "max_rays": whole(work["max_rays"], "max_rays", 1, 2**63 - 1) if work["max_rays"] is not None else None,
        "memory": whole(work["memory"], "memory", 10**6, 10**15) if work["memory"] is not None else None,
        "seed": whole(work["seed"], "seed", 0, 2**64 - 1),
        "triangle_errors": bool(work["triangle_errors"]),
    }
    return _core.WorkRequest(**checked)


def _bound_of(work: Mapping[str, Any], name: str) -> Optional[float]:
    """Returns the bound of that name, or else the one of both passes; an error names the argument that was given."""
    given = next((key for key in (name, "error") if work[key] is not None), None)
    return bound(work[given], given) if given is not None else None
