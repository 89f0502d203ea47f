"""CARIBU's interface (Chelle and Andrieu 1998; alinea.caribu of OpenAlea) on sunfleck's engine: change one import.

    from sunfleck.caribu import CaribuScene

    scene = CaribuScene({"leaf": [[(0, 0, 1), (1, 0, 1), (0, 1, 1)]]}, light=[(100, (0, 0, -1))], pattern=(0, 0, 1, 1),
                        opt={"par": (0.10, 0.05)})
    raw, aggregated = scene.run(direct=False, infinite=True)
    aggregated["par"]["Eabs"]["leaf"]

Axes are CARIBU's: z up, y north, x east. Instead of projections and nested radiosity it computes what `sunfleck run` computes,
with the same errors; an infinite canopy really is infinite.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Optional, Union

import numpy as np

from ._caribu_input import (
    Light, Material, both_faces, checked_lights, checked_material, checked_pattern, checked_scene, descent_deg, four,
)  # fmt: skip
from ._errors import refuse
from ._options import bound, real
from ._progress import Progress
from ._result import Result
from ._simulation import Simulation

_METRES = {"mm": 0.001, "cm": 0.01, "dm": 0.1, "m": 1.0, "dam": 10.0, "hm": 100.0, "km": 1000.0}
_BOUNDED = {"canopy": "canopy", "primitive": "organ", "triangle": "triangle"}  # what `error` bounds, and the scene's word for it
_LEAST_SHARE_OF_EXTENT = 1e-3  # gives a canopy that is a line or a point from above a plot


class CaribuScene:
    """Triangles under lights.

    scene: {primitive: [triangle, ...]}, where a triangle is three points (x, y, z).
    light: [(energy, (x, y, z)), ...]: the irradiance of a horizontal plane, and the direction in which the light travels, at least
        0.01 degrees downwards (z < 0).
    pattern: (xmin, ymin, xmax, ymax), or ((xmin, ymin), (xmax, ymax)): the domain that an infinite canopy repeats.
    opt: {band: {primitive: material}} or {band: material}, where a material is (reflectance,) for an opaque surface, (reflectance,
        transmittance), or (reflectance_sup, transmittance_sup, reflectance_inf, transmittance_inf).
    soil_reflectance: {band: reflectance} with every band of opt, or one number for all bands.
    soil_mesh: anything but None and -1 adds soil under a canopy that is not infinite; an infinite one always has soil.
    z_soil: height of the soil (default: 0, or the lowest point if that is below 0).
    scene_unit: unit of the points and the pattern: mm, cm, dm, m, dam, hm or km. Energies are per square metre.

    Raises InputError (a ValueError) for any other input.
    """

    default_light: Light = (1.0, (0.0, 0.0, -1.0))
    default_material: Material = (0.06, 0.07)
    default_soil_reflectance = 0.15
    default_band = "default_band"
    units = dict(_METRES)

    def __init__(
        self,
        scene: Mapping[Any, Sequence[Any]],
        light: Optional[Sequence[Light]] = None,
        pattern: Optional[Sequence[Any]] = None,
        opt: Optional[Mapping[str, Any]] = None,
        soil_reflectance: Union[float, Mapping[str, float], None] = None,
        soil_mesh: Any = None,
        z_soil: Optional[float] = None,
        scene_unit: str = "m",
    ) -> None:
        if not isinstance(scene_unit, str) or scene_unit not in _METRES:
            refuse(f"scene_unit = {scene_unit!r}", "unknown unit", f"use {', '.join(_METRES)}")
        self.scene_unit = scene_unit
        self.scene = checked_scene(scene)
        self.light = checked_lights(light) or [self.default_light]
        self.pattern = checked_pattern(pattern)
        bands = self._bands(opt, soil_reflectance)
        self.material = {band: self._materials(opt[band] if opt else self.default_material, band) for band in bands}
        self.soil_reflectance = {band: self._soil_of(soil_reflectance, band) for band in bands}
        self.soil_mesh = soil_mesh
        self.z_soil = None if z_soil is None else real(z_soil, "z_soil")
        self.soil_aggregated: dict[str, dict[str, float]] = {}
        self.result: Optional[Result] = None

    def run(
        self,
        direct: bool = True,
        infinite: bool = False,
        d_sphere: float = 0.5,
        layers: int = 10,
        height: Optional[float] = None,
        screen_size: int = 1536,
        screen_resolution: Optional[float] = None,
        sensors: Any = None,
        split_face: bool = False,
        simplify: bool = False,
        *,
        error: float = 0.01,
        of: str = "canopy",
        max_seconds: Optional[float] = None,
        max_rays: Optional[int] = None,
        seed: int = 1,
        device: str = "auto",
        threads: int = 0,
        progress: Progress = None,
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Returns the light on every triangle and on every primitive: (raw, aggregated).

        direct: True counts only the first landing, False scattered light too. infinite: repeats the pattern without end.
        d_sphere, layers, height, screen_size, screen_resolution, split_face: accepted for CARIBU's own methods and ignored.
        simplify: leaves out the level of bands if there is only one.
        error: relative error bound of what `of` names: "canopy", the light that the whole canopy and the soil absorb; "primitive",
            that of every primitive, which takes hundreds of times as long where there are thousands of them; or "triangle".
            With "canopy" a single primitive is less exact, as its Eabs_error says.
        max_seconds, max_rays, seed, device, threads, progress: as in sunfleck.run. result.complete is False if a limit cut the
            simulation short.

        raw[band][quantity][primitive] is a list by triangle; aggregated[band][quantity][primitive] is the mean weighted by area,
        or the sum for area. Quantities: area (m2, one-sided), Eabs, Ei, Ei_sup, Ei_inf (absorbed, incident on both faces, on the
        upper and on the lower face, per area of one face, in the lights' unit), and Eabs_error, the half-width of the 95 %
        confidence interval of Eabs (NaN if there are too few rays). The upper face is the one from which the corners run
        counter-clockwise. Sets soil_aggregated, and result to the simulation's own result.
        """
        if sensors is not None:
            refuse("sensors", "not supported here", "give the whole scene to sunfleck.run, with [[sensor]] or [[plane]]")
        if infinite and self.pattern is None:
            refuse("pattern", "an infinite canopy needs one to repeat", "give (xmin, ymin, xmax, ymax)")
        error = bound(error, "error")
        if not isinstance(of, str) or of not in _BOUNDED:
            refuse(f"of = {of!r}", "unknown", f"use {', '.join(_BOUNDED)}")
        with tempfile.TemporaryDirectory(prefix="sunfleck") as folder:
            tables = self._tables(direct, infinite, Path(folder))
            tables["accuracy"] = {"of": _BOUNDED[of]}
            simulation = Simulation(tables, folder=folder, device=device, threads=threads)
        self.result = simulation.run(error=error, max_seconds=max_seconds, max_rays=max_rays, seed=seed, progress=progress)
        of_triangles = {band: self._columns(band, number, direct) for number, band in enumerate(self.material)}
        raw = {band: self._raw(columns) for band, columns in of_triangles.items()}
        aggregated = {}
        for number, band in enumerate(self.material):
            half_widths = self._half_widths(band, number, direct)
            aggregated[band] = self._aggregated(of_triangles[band], half_widths)
        self._book_soil(direct, infinite)
        if simplify and len(raw) == 1:
            return next(iter(raw.values())), next(iter(aggregated.values()))
        return raw, aggregated

    def _bands(self, opt: Any, soil_reflectance: Any) -> list[str]:
        if opt is not None and not isinstance(opt, Mapping):
            refuse(f"opt: {type(opt).__name__}", "must be a dict of bands", "give {band: material}")
        if opt:
            return list(opt)
        if not isinstance(soil_reflectance, Mapping):
            return [self.default_band]
        if not soil_reflectance:
            refuse("soil_reflectance", "has no band", "give {band: reflectance}, or one number for all bands")
        return list(soil_reflectance)

    def _materials(self, given: Any, band: str) -> dict[Any, Material]:
        if not isinstance(given, Mapping):
            return dict.fromkeys(self.scene, checked_material(given, f"opt[{band!r}]"))
        fallback = given.get("default")
        materials = {}
        for primitive in self.scene:
            material = given.get(primitive, fallback)
            if material is None:
                refuse(f"opt[{band!r}]", f"primitive {primitive!r} has no material", "give its material, or a 'default'")
            materials[primitive] = checked_material(material, f"opt[{band!r}][{primitive!r}]")
        return materials

    def _soil_of(self, given: Union[float, Mapping[str, float], None], band: str) -> float:
        if given is None:
            return self.default_soil_reflectance
        if isinstance(given, Mapping) and band not in given:
            refuse("soil_reflectance", f"band {band!r} has no reflectance", "give it, or one number for all bands")
        value = given[band] if isinstance(given, Mapping) else given
        reflectance = real(value, f"soil_reflectance[{band!r}]")
        if not 0.0 <= reflectance <= 1.0:
            refuse(f"soil_reflectance[{band!r}] = {value}", "must lie in 0..1", "give a fraction")
        return reflectance

    def _has_soil(self, infinite: bool) -> bool:
        no_mesh = self.soil_mesh is None or (np.isscalar(self.soil_mesh) and self.soil_mesh == -1)
        return infinite or not no_mesh

    def _tables(self, direct: bool, infinite: bool, folder: Path) -> dict[str, Any]:
        unit = _METRES[self.scene_unit]
        corners = unit * np.concatenate([triangles for triangles in self.scene.values()])
        x_lo, y_lo, x_hi, y_hi = self._domain(corners, unit)
        lowest = float(corners[..., 2].min())
        z_soil = min(0.0, lowest) if self.z_soil is None else unit * self.z_soil
        counts = self._counts()
        tables: dict[str, Any] = {
            "title": "CARIBU scene",
            "plot": {"size": [y_hi - y_lo, x_hi - x_lo], "periodic": infinite},
            "geometry": [
                {
                    "vertices": corners,
                    "optics": np.repeat(self._optics_names(direct), counts),
                    "organ": "leaf",
                    "plant": np.repeat(np.arange(1, len(counts) + 1), counts),
                    "up": "z",
                    "at": [[y_hi, -z_soil, x_hi]],
                }
            ],
        }
        bands = self._band_names(direct)
        tables["optics"] = {name: _surface(materials, bands) for name, materials in self._optics(direct).items()}
        if self._has_soil(infinite):
            reflectance = [0.0] if direct else list(self.soil_reflectance.values())
            tables["soil"] = {"reflectance": dict(zip(bands, reflectance))}
        tables.update(self._light_tables(bands, folder))
        return tables

    def _domain(self, corners: np.ndarray, unit: float) -> tuple[float, float, float, float]:
        if self.pattern is not None:
            return four(unit * edge for edge in self.pattern)
        lo, hi = corners.reshape(-1, 3).min(axis=0), corners.reshape(-1, 3).max(axis=0)
        least = max(_LEAST_SHARE_OF_EXTENT * float((hi - lo).max()), 1e-6)
        spare = np.maximum(0.5 * (least - (hi - lo)), 0.0)
        return four(float(edge) for edge in (*(lo - spare)[:2], *(hi + spare)[:2]))

    def _band_names(self, direct: bool) -> list[str]:
        """Returns band names valid in tables. Without scattered light one band represents all."""
        return ["b0"] if direct else [f"b{number}" for number in range(len(self.material))]

    def _optics(self, direct: bool) -> dict[str, list[Material]]:
        """Returns the distinct materials by the name of their table: one for each band."""
        if direct:
            return {"black": [(0.0,)]}
        return {f"m{number}": list(materials) for number, materials in enumerate(self._distinct())}

    def _distinct(self) -> list[tuple[Material, ...]]:
        return list(dict.fromkeys(self._of_all_bands(primitive) for primitive in self.scene))

    def _of_all_bands(self, primitive: Any) -> tuple[Material, ...]:
        return tuple(self.material[band][primitive] for band in self.material)

    def _optics_names(self, direct: bool) -> list[str]:
        if direct:
            return ["black"] * len(self.scene)
        number = {materials: f"m{index}" for index, materials in enumerate(self._distinct())}
        return [number[self._of_all_bands(primitive)] for primitive in self.scene]

    def _light_tables(self, bands: list[str], folder: Path) -> dict[str, Any]:
        shining = [(energy, way) for energy, way in self.light if energy > 0.0]
        if len(shining) > 1:
            lines = [f"{energy!r} {x!r} {y!r} {z!r}\n" for energy, (x, y, z) in shining]
            (folder / "lights.light").write_text("".join(lines))
            total = math.fsum(energy for energy, _ in shining)
            return {
                "sky": {"model": "lights", "file": "lights.light"},
                "band": [{"name": band, "diffuse": total} for band in bands],
            }
        if not shining:
            return {"band": [{"name": band} for band in bands]}
        energy, (x, y, z) = shining[0]
        elevation = descent_deg((x, y, z))
        azimuth = math.degrees(math.atan2(-x, -y)) % 360.0
        return {
            "sun": {"elevation": elevation, "azimuth": azimuth},
            "band": [{"name": band, "direct": energy} for band in bands],
        }

    def _columns(self, band: str, number: int, direct: bool) -> dict[str, np.ndarray]:
        """Returns each quantity by triangle."""
        assert self.result is not None
        name = "b0" if direct else f"b{number}"
        column = self.result.triangles
        upper = column[f"{name}_direct_upper"] + column[f"{name}_indirect_upper"]
        lower = column[f"{name}_direct_lower"] + column[f"{name}_indirect_lower"]
        absorbed, half_width = column[f"{name}_absorbed"], column[f"{name}_absorbed_error"]
        if direct:
            counts = self._counts()
            faces = np.array([_absorptances(self.material[band][primitive]) for primitive in self.scene])
            upper_share, lower_share = np.repeat(faces, counts, axis=0).T
            absorbed = upper * upper_share + lower * lower_share
            half_width = half_width * np.maximum(upper_share, lower_share)
        return {
            "area": column["area_m2"], "Eabs": absorbed, "Ei": upper + lower, "Ei_sup": upper, "Ei_inf": lower,
            "Eabs_error": half_width,
        }  # fmt: skip

    def _raw(self, columns: Mapping[str, np.ndarray]) -> dict[str, dict[Any, list[float]]]:
        """Returns lists by primitive. Lists are cut, since cutting an array a hundred thousand times takes seconds."""
        ends = np.cumsum(self._counts()).tolist()
        begins = [0, *ends]
        raw = {}
        for quantity, values in columns.items():
            numbers = values.tolist()
            raw[quantity] = {primitive: numbers[begin:end] for primitive, begin, end in zip(self.scene, begins, ends)}
        return raw

    def _counts(self) -> list[int]:
        return [len(triangles) for triangles in self.scene.values()]

    def _half_widths(self, band: str, number: int, direct: bool) -> np.ndarray:
        """Returns the half-width of what each primitive absorbs per area, NaN for one without triangles."""
        assert self.result is not None
        name, organs = "b0" if direct else f"b{number}", self.result.organs
        of_organs = organs[f"{name}_absorbed_error"]
        half_widths = np.full(len(self.scene), np.nan)
        half_widths[organs["plant"].astype(int) - 1] = of_organs
        if direct:
            half_widths *= np.array([max(_absorptances(self.material[band][primitive])) for primitive in self.scene])
        return half_widths

    def _aggregated(self, columns: Mapping[str, np.ndarray], half_widths: np.ndarray) -> dict[str, dict[Any, float]]:
        """Returns sums of area and means weighted by area, by primitive."""
        number = np.repeat(np.arange(len(self.scene)), self._counts())
        area = columns["area"]

        def total(values: np.ndarray) -> np.ndarray:
            return np.bincount(number, values, minlength=len(self.scene))

        areas = total(area)
        has_area = areas > 0.0

        def mean(values: np.ndarray) -> np.ndarray:
            weighted = total(np.where(area > 0.0, area * values, 0.0))
            return np.divide(weighted, areas, out=np.zeros_like(areas), where=has_area)

        sums = {quantity: mean(values) for quantity, values in columns.items()}
        sums["area"], sums["Eabs_error"] = areas, np.where(has_area, half_widths, 0.0)
        return {quantity: dict(zip(self.scene, values.tolist())) for quantity, values in sums.items()}

    def _book_soil(self, direct: bool, infinite: bool) -> None:
        self.soil_aggregated = {}
        if not self._has_soil(infinite) or self.result is None:
            return
        area = self.result.summary["plot_area_m2"]
        for number, band in enumerate(self.material):
            reflectance = self.soil_reflectance[band]
            if direct:
                incident = _on_soil(self.result, "b0", 0.0)
                absorbed = (1.0 - reflectance) * incident
            else:
                incident = _on_soil(self.result, f"b{number}", reflectance)
                absorbed = self.result.bands[f"b{number}"]["absorbed_soil"]
            self.soil_aggregated[band] = {"area": area, "Ei": incident, "Eabs": absorbed}


def _on_soil(result: Result, band: str, reflectance: float) -> float:
    """Returns the light that falls on soil of that reflectance."""
    if reflectance < 1.0:
        return result.bands[band]["absorbed_soil"] / (1.0 - reflectance)
    return float(result.profile[f"{band}_up"][0])  # white soil reflects all of it


def _absorptances(material: Material) -> tuple[float, float]:
    """Returns the absorptances of the upper and the lower face."""
    reflectance_up, transmittance_up, reflectance_down, transmittance_down = both_faces(material)
    return 1.0 - reflectance_up - transmittance_up, 1.0 - reflectance_down - transmittance_down


def _surface(materials: list[Material], bands: list[str]) -> dict[str, Any]:
    """Returns an [optics] table from one material per band."""
    faces = [both_faces(material) for material in materials]
    side = lambda first: {  # noqa: E731
        "reflectance": {band: face[first] for band, face in zip(bands, faces)},
        "transmittance": {band: face[first + 1] for band, face in zip(bands, faces)},
    }
    return {"upper": side(0), "lower": side(2)}
