"""Plots of a result with matplotlib."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Optional

import numpy as np

from ._columns import optional
from ._errors import refuse
from ._options import whole


def _axes(ax: Any) -> Any:
    return optional("matplotlib.pyplot", "plot").subplots(layout="constrained")[1] if ax is None else ax


def _column(columns: Mapping[str, Any], name: str, usable: list[str]) -> np.ndarray:
    if name not in usable:
        refuse(f"quantity = {name!r}", "no such column to plot", f"use one of {', '.join(usable)}")
    return columns[name]


def profile(columns: Mapping[str, Any], units: Mapping[str, str], quantity: str, ax: Any) -> Any:
    """Draws a column of the profile against height, with its errors as bars."""
    usable = [name for name in columns if name != "height_m" and not name.endswith("_error")]
    values, height = _column(columns, quantity, usable), columns["height_m"]
    ax = _axes(ax)
    half_width = columns.get(f"{quantity}_error")
    ax.errorbar(values, height, xerr=None if half_width is None else np.nan_to_num(half_width), capsize=2.0)
    unit = units.get(quantity, "1")
    ax.set_xlabel(quantity if unit == "1" else f"{quantity} ({unit})")
    ax.set_ylabel("height (m)")
    return ax


def plane_map(plane: Mapping[str, Any], quantity: str, unit: str, ax: Any) -> Any:
    """Draws a map of a plane, each cell at its place."""
    usable = [name for name, values in plane.items() if np.ndim(values) == 2]
    values = _column(plane, quantity, usable)
    across = "z_m" if "z_m" in plane else "y_m"
    ax = _axes(ax)
    drawn = ax.pcolormesh(plane["x_m"], plane[across], values, shading="nearest")
    ax.set_aspect("equal")
    ax.set_xlabel("x (m)")
    ax.set_ylabel(f"{across[0]} (m)")
    ax.set_title(f"{plane['height_m']:g} m above the ground")
    ax.figure.colorbar(drawn, ax=ax, label=f"{quantity} ({unit})" if unit else quantity)
    return ax


def draw(result: Any, kind: str, quantity: Optional[str], band: Optional[str], plane: int, ax: Any) -> Any:
    """Draws what Result.plot describes."""
    if band is not None and band not in result.bands:
        refuse(f"band = {band!r}", "no such band", f"use one of {', '.join(result.bands)}")
    band = band or next(iter(result.bands))
    if kind == "profile":
        units = {name: unit for name, (unit, _) in result.describe("profile.csv").items()}
        return profile(result.profile, units, quantity or f"{band}_down", ax)
    if kind != "map":
        refuse(f"kind = {kind!r}", "no such plot", "use profile or map")
    if whole(plane, "plane", 0, 2**31 - 1) >= len(result.planes):
        refuse(f"plane = {plane}", f"the scene has {len(result.planes)} [[plane]]", "add one to the scene, or give another number")
    quantity = quantity or f"{band}_total"
    return plane_map(result.planes[plane], quantity, "W m-2" if quantity.startswith(tuple(f"{name}_" for name in result.bands)) else "", ax)
