"""What CaribuScene is given: checks that name the place of a mistake, and what materials and directions of light mean."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Optional

import numpy as np

from ._errors import refuse
from ._options import real, refuse_masked

Light = tuple[float, Sequence[float]]
Material = tuple[float, ...]  # one, two or four fractions

_LEAST_DESCENT_DEG = 0.01  # lower light is biased by percents at 0.001 degrees, and lost at 0.0001


def both_faces(material: Material) -> tuple[float, float, float, float]:
    """Returns reflectance and transmittance of the upper face, then of the lower one."""
    if len(material) == 1:
        return material[0], 0.0, material[0], 0.0
    return four(material if len(material) == 4 else (*material, *material))


def four(numbers: Iterable[float]) -> tuple[float, float, float, float]:
    """Returns four numbers as a tuple."""
    a, b, c, d = numbers
    return a, b, c, d


def descent_deg(way: Sequence[float]) -> float:
    """Returns the elevation from which light of this direction of travel comes."""
    x, y, z = way
    return math.degrees(math.atan2(-z, math.hypot(x, y)))


def checked_scene(scene: Any) -> dict[Any, np.ndarray]:
    """Returns the corners of each primitive's triangles."""
    if isinstance(scene, (str, os.PathLike)):
        refuse("scene", "is a file", "run it with `sunfleck run STAND.can --optics ... --light ... --domain ...`, or convert it")
    if not isinstance(scene, Mapping) or not scene:
        refuse(f"scene: {type(scene).__name__}", "must be a dict with at least one primitive", "give {name: [triangle, ...]}")
    checked = {}
    for primitive, triangles in scene.items():
        refuse_masked(triangles, f"scene[{primitive!r}]")
        try:
            array = np.asarray(triangles, dtype=float)
        except (TypeError, ValueError):
            array = np.empty(())
        if array.shape == (0,):
            array = np.empty((0, 3, 3))
        if array.ndim != 3 or array.shape[1:] != (3, 3):
            refuse(f"scene[{primitive!r}]: shape {array.shape}", "must be a list of triangles of three points (x, y, z)", "reshape it")
        if not np.isfinite(array).all():
            refuse(f"scene[{primitive!r}]", "contains NaN or infinity", "remove or repair these triangles")
        checked[primitive] = array
    if not any(len(array) for array in checked.values()):
        refuse("scene", "has no triangles", "give at least one")
    return checked


def checked_lights(lights: Any) -> list[Light]:
    """Returns the lights, none for None."""
    try:
        given = [] if lights is None else list(lights)
    except TypeError:
        refuse(f"light: {type(lights).__name__}", "must be a list of (energy, (x, y, z))", "put the light into a list")
    return [_checked_light(light, number) for number, light in enumerate(given)]


def _checked_light(light: Any, number: int) -> Light:
    place = f"light[{number}]"
    try:
        energy, (x, y, z) = light
    except (TypeError, ValueError):
        refuse(place, "must be (energy, (x, y, z))", "give the irradiance of a horizontal plane and the direction of travel")
    energy, way = real(energy, f"{place} energy"), tuple(real(value, f"{place} direction") for value in (x, y, z))
    if energy < 0.0:
        refuse(f"{place} energy = {energy}", "must not be negative", "give an irradiance")
    if way[2] >= 0.0:
        refuse(f"{place} direction = {way}", "light must travel downwards, z < 0", "reverse its sign")
    if descent_deg(way) < _LEAST_DESCENT_DEG:
        refuse(f"{place} direction = {way}", f"must descend by {_LEAST_DESCENT_DEG} degrees or more", "leave this light out")
    return energy, way


def checked_pattern(pattern: Any) -> Optional[tuple[float, float, float, float]]:
    """Returns xmin, ymin, xmax and ymax, or None for None."""
    if pattern is None:
        return None
    refuse_masked(pattern, "pattern")
    flat = np.asarray(pattern, dtype=object).ravel().tolist()
    if len(flat) != 4:
        refuse(f"pattern: {len(flat)} numbers", "must be (xmin, ymin, xmax, ymax)", "give four numbers")
    x_lo, y_lo, x_hi, y_hi = (real(value, "pattern") for value in flat)
    if not (x_lo < x_hi and y_lo < y_hi):
        refuse(f"pattern = {tuple(flat)}", "has no area", "give (xmin, ymin, xmax, ymax)")
    return x_lo, y_lo, x_hi, y_hi


def checked_material(material: Any, place: str) -> Material:
    """Returns one, two or four fractions."""
    if not isinstance(material, Sequence) or isinstance(material, str) or len(material) not in (1, 2, 4):
        refuse(
            f"{place} = {material!r}", "must be (reflectance,), (reflectance, transmittance) or both pairs by face", "give a tuple"
        )
    checked = tuple(real(value, place) for value in material)
    for reflectance, transmittance in (both_faces(checked)[:2], both_faces(checked)[2:]):
        if reflectance < 0.0 or transmittance < 0.0 or reflectance + transmittance > 1.0:
            refuse(f"{place} = {material!r}", "reflectance and transmittance are fractions, together at most 1", "correct them")
    return checked
