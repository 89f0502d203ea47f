"""Simulation of whole days."""

from __future__ import annotations

import contextlib
import datetime
import functools
import json
import os
import warnings
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import _core
from ._columns import crossed, data_frame, named, optional, with_text_arrays
from ._errors import refuse
from ._kept import KeptDay
from ._options import flag, text, whole, work_options
from ._progress import Progress, reporting
from ._scene import Scene, SceneSource
from ._simulation import of_dict, without_line_numbers

if TYPE_CHECKING:
    import pandas
    import xarray


# The tables of to_dataframe: the name of the second index, and the file that has the units.
_FRAMES = {
    "steps": ("", "day.csv"),
    "sums": ("", "day_sums.csv"),
    "season": ("kind_index", "season.csv"),
    "organs": ("organ_index", "organs_day.csv"),
    "plants": ("plant_index", "plants_day.csv"),
    "organ_steps": ("organ_index", ""),
    "sensors": ("point_index", "sensors_day.csv"),
    "sensor_means": ("sensor_index", "sensor_means_day.csv"),
    "sensor_sums": ("sensor_index", "sensor_day_sums.csv"),
    "planes": ("plane_index", "planes_day.csv"),
    "plane_sums": ("plane_index", "plane_day_sums.csv"),
}


class DayResult:
    """The results of one or more days, as `sunfleck day` gives them; BAND stands for the name of a band. Arrays are read-only: copy
    an array to change it."""

    def __init__(self, core: Any) -> None:
        self._core = core

    @property
    def complete(self) -> bool:
        """Whether all steps were done and reached their bounds, apart from dim ones that shared packets with brighter ones."""
        return self._core.complete

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """The contents of summary.json."""
        return json.loads(self._core.summary())

    @functools.cached_property
    def steps(self) -> dict[str, Any]:
        """The columns of day.csv as arrays of shape (steps,): time (texts: the start of each step with its UTC
        offset), step_s, elevation_deg and azimuth_deg (at the midpoint of the step), BAND_incident, BAND_absorbed_vegetation,
        BAND_absorbed_structure, BAND_absorbed_soil, BAND_reflected, BAND_transmitted (W m-2 of ground) and sunlit_leaf_fraction,
        these with their half-widths _error, and BAND_unshot."""
        return self._columns("day.csv")

    @functools.cached_property
    def sums(self) -> dict[str, np.ndarray]:
        """The columns of day_sums.csv as arrays of shape (dates,): date, steps (their number), BAND_incident_mj_m2 and its fates
        (sums per ground area), with photon units the same in _mol_m2, with their half-widths _error."""
        return self._columns("day_sums.csv")

    @functools.cached_property
    def organs(self) -> dict[str, Any]:
        """The absorption of organs: date; organ and role (names), plant, rank and area_m2 by organ; and arrays
        of shape (dates, organs): BAND_absorbed_mj_m2 (per one-sided area), with photon units BAND_absorbed_mol_m2, with their
        half-widths _error."""
        return self._columns("organs_day.csv")

    @functools.cached_property
    def plants(self) -> dict[str, Any]:
        """The absorption of plants: date; plant, x, y, z, height_m and leaf_area_m2 by plant; and arrays of shape (dates,
        plants): BAND_absorbed_mj (of the whole plant), with photon units BAND_absorbed_mol, with their half-widths _error."""
        return self._columns("plants_day.csv")

    @functools.cached_property
    def season(self) -> dict[str, Any]:
        """The absorption of kinds of organs, the columns of season.csv: date; organ (name of the kind), role, organs (their number),
        area_m2 and area_index (per ground area) by kind; and arrays of shape (dates, kinds): BAND_absorbed_ground_mj_m2 (per ground
        area), BAND_absorbed_share (of what arrived), BAND_absorbed_mj_m2 (per one-sided area), with photon units the same in
        _mol_m2, with their half-widths _error."""
        return self._columns("season.csv")

    @functools.cached_property
    def organ_steps(self) -> dict[str, Any]:
        """What organs absorb at each step, the values of organs_steps.nc: time (texts); organ and role (names), plant, rank and
        area_m2 by organ; and arrays of shape (steps, organs): BAND_absorbed (W m-2, per one-sided area) with their half-widths
        _error."""
        return with_text_arrays(self._core.organ_steps())

    @functools.cached_property
    def sensors(self) -> dict[str, Any]:
        """The readings at each step, the columns of sensors_day.csv: time (texts); sensor (name), point, x, y and z by point, the
        points of all sensors one after the other; and arrays of shape (steps, points): BAND_direct, BAND_sky, BAND_scattered,
        BAND_total (W m-2), with photon units BAND_total_umol_m2_s, with their half-widths _error. Empty without sensors."""
        return self._columns("sensors_day.csv")

    @functools.cached_property
    def sensor_means(self) -> dict[str, Any]:
        """The same for the means over the points of each sensor, the columns of sensor_means_day.csv: time; sensor and points (their
        number) by sensor; and arrays of shape (steps, sensors)."""
        return self._columns("sensor_means_day.csv")

    @functools.cached_property
    def sensor_sums(self) -> dict[str, Any]:
        """The sums of these means over each date, the columns of sensor_day_sums.csv, of shape (dates, sensors): BAND_direct_mj_m2,
        ..., BAND_total_mj_m2, with photon units the same in _mol_m2, with their half-widths _error."""
        return self._columns("sensor_day_sums.csv")

    @functools.cached_property
    def planes(self) -> dict[str, Any]:
        """The light through horizontal planes at each step, the columns of planes_day.csv: time (texts); height_m by plane, in
        ascending order; and arrays of shape (steps, planes): sunfleck_ratio, BAND_down (W m-2), with photon units
        BAND_down_umol_m2_s, with their half-widths _error. Empty without planes."""
        return self._columns("planes_day.csv")

    @functools.cached_property
    def plane_sums(self) -> dict[str, Any]:
        """Its sums over each date, the columns of plane_day_sums.csv, of shape (dates, planes): BAND_down_mj_m2, with photon units
        BAND_down_mol_m2, with their half-widths _error."""
        return self._columns("plane_day_sums.csv")

    @functools.cached_property
    def plane_maps(self) -> list[dict[str, Any]]:
        """The maps of each plane summed over all steps, in ascending order of height: height_m, the columns of plane_H_day.csv: the
        centres of the cells (x_m and z_m, or x_m and y_m), and arrays of shape (rows, cells): sunlit_h and sunlit_share (time in
        direct sun), BAND_direct_mj_m2, BAND_total_mj_m2, with photon units BAND_total_mol_m2."""
        names = [name for name in self._core.tables() if name.startswith("plane_") and name.endswith("_day.csv")]
        heights = self.planes["height_m"].tolist() if names else []
        return [{"height_m": height, **self._core.columns(name)} for height, name in zip(heights, names, strict=True)]

    @functools.cached_property
    def plane_steps(self) -> list[dict[str, Any]]:
        """The maps of each plane at each step, in ascending order of height: height_m, and arrays of shape (steps, rows, cells) in
        single precision: sunfleck (NaN without a beam), BAND_direct and BAND_total (W m-2). Kept as `triangles` are."""
        self._expect_triangles("plane_steps")
        return self._core.plane_steps()

    @functools.cached_property
    def triangles(self) -> dict[str, np.ndarray]:
        """The fields of day.nc in single precision, shape (steps, triangles), W m-2: BAND_direct_upper, BAND_direct_lower,
        BAND_sky_upper, BAND_sky_lower (with a sky, parts of BAND_indirect), BAND_indirect_upper, BAND_indirect_lower,
        BAND_absorbed, BAND_absorbed_error. They are 0 in steps at night, unless lamps are lit. Several dates have them only with
        `day(..., triangles=True)`."""
        self._expect_triangles("triangles")
        return self._core.triangles()

    @property
    def has_triangles(self) -> bool:
        """Whether `triangles` and `plane_steps` were kept."""
        return self._core.has_triangles

    def describe(self, table: str) -> dict[str, tuple[str, str]]:
        """Returns the unit and the meaning of each column of a table such as day.csv; `tables` has the names."""
        return {name: (unit, meaning) for name, (unit, meaning, _) in self._core.describe(text(table, "table")).items()}

    @property
    def tables(self) -> list[str]:
        """The names of the tables, which are those of the program's files."""
        return list(self._core.tables())

    def table(self, name: str) -> str:
        """Returns the text of one of the `tables`, byte for byte as the program writes it."""
        return self._core.table(text(name, "table"))

    def _columns(self, table: str) -> dict[str, Any]:
        return with_text_arrays(self._core.columns(table)) if table in self._core.tables() else {}

    def _expect_triangles(self, name: str) -> None:
        if not self._core.has_triangles:
            refuse(name, "the light of every triangle was not kept", "pass triangles=True to sunfleck.day")

    def to_xarray(self) -> xarray.Dataset:
        """Returns `steps`, what organs absorb (organ_BAND_absorbed) and, if they were kept, `triangles` as an xarray Dataset with the
        dimensions time (UTC), organ and triangle. Needs xarray."""
        xarray = optional("xarray", "to_xarray")
        times = np.array([_utc(text) for text in self.steps["time"]], dtype="datetime64[ns]")
        of_day = {"title": self.summary["scene"], "seed": self.summary["seed"], "axes": self.summary["axes"]}
        data = xarray.Dataset(coords={"time": times}, attrs=of_day)
        units = self._units("day.csv")
        for name, values in self.steps.items():
            if name != "time":
                data[name] = ("time", values, {"units": units[name]})
        organs = dict(self.organ_steps)
        del organs["time"]
        for name in ("organ", "role", "plant", "rank", "area_m2"):
            data.coords["organ_name" if name == "organ" else f"organ_{name}"] = ("organ", organs.pop(name))
        for name, values in organs.items():
            data[f"organ_{name}"] = (("time", "organ"), values, {"units": "W m-2"})
        for name, values in self.triangles.items() if self.has_triangles else ():
            data[name] = (("time", "triangle"), values, {"units": "W m-2"})
        return data

    def to_dataframe(self, table: str = "steps") -> pandas.DataFrame:
        """Returns a table as a pandas DataFrame, one row for each combination: "steps" (by time, UTC), "sums" (by date), "season" (by
        date and kind_index), "organs" (by date and organ_index, the organ's number), "plants" (by date and plant_index),
        "organ_steps" (by time and organ_index), "sensors" (by time and point_index), "sensor_means" (by time and sensor_index),
        "sensor_sums" (by date and sensor_index), "planes" (by time and plane_index), "plane_sums" (by date and plane_index) or
        "triangles" (by time and triangle). attrs["units"] has the units. Needs pandas."""
        if table == "triangles":
            times = [_utc(text) for text in self.steps["time"]]
            flat = {name: values.ravel() for name, values in self.triangles.items()}
            index = crossed(["time", "triangle"], [times, range(self.summary["triangles"])])
            return data_frame(flat, index, dict.fromkeys(flat, "W m-2"))
        if table not in _FRAMES:
            refuse(f"to_dataframe({table!r})", "no such table of a day", f"use {', '.join(_FRAMES)} or triangles")
        second, file = _FRAMES[table]
        columns = dict(getattr(self, table))
        if not columns:
            refuse(f"to_dataframe({table!r})", "the scene has none", "add a [[sensor]] or a [[plane]] to the scene")
        first = "time" if "time" in columns else "date"
        when = columns.pop(first)
        if first == "time":
            when = [_utc(text) for text in when]
        units = self._units(file or "organs_day.csv")
        if not file:
            units = {name: units.get(name, "W m-2") for name in columns}
        if not second:
            return data_frame(columns, named(first, when), units)
        shape = next(values.shape for values in columns.values() if values.ndim == 2)
        flat = {name: np.broadcast_to(values, shape).ravel() for name, values in columns.items()}
        return data_frame(flat, crossed([first, second], [when, range(shape[1])]), units)

    def _units(self, table: str) -> dict[str, str]:
        return {name: unit for name, (unit, _) in self.describe(table).items()}

    def __reduce__(self) -> tuple[Any, ...]:
        return DayResult, (KeptDay(self._core),)

    def __deepcopy__(self, _: dict[int, Any]) -> DayResult:
        return DayResult(self._core)

    def __repr__(self) -> str:
        state = "complete" if self.complete else "not complete"
        return f"<sunfleck.DayResult of {self.summary['scene']!r}: {len(self.steps['time'])} steps; {self._absorbed()}; {state}>"

    def _absorbed(self) -> str:
        """Returns what vegetation absorbed of each band in all steps, per area of ground."""
        steps = self.steps
        parts = []
        for name in [column[: -len("_absorbed_vegetation")] for column in steps if column.endswith("_absorbed_vegetation")]:
            flux = np.nan_to_num(steps[f"{name}_absorbed_vegetation"])
            parts.append(f"{name} {1e-6 * float((flux * steps['step_s']).sum()):.4g}")
        return f"{', '.join(parts)} MJ m-2 absorbed by vegetation"


def _utc(text: str) -> np.datetime64:
    moment = datetime.datetime.fromisoformat(text).astimezone(datetime.timezone.utc)
    return np.datetime64(moment.replace(tzinfo=None))


def day(
    scene: Scene,
    *,
    start: Optional[str] = None,
    stop: Optional[str] = None,
    step: int = 60,
    date: Optional[str] = None,
    to_date: Optional[str] = None,
    folder: Union[str, "os.PathLike[str]", None] = None,
    device: str = "auto",
    threads: int = 0,
    allow_outside: bool = False,
    error: Optional[float] = None,
    direct_error: Optional[float] = None,
    indirect_error: Optional[float] = None,
    grid: Optional[float] = None,
    passes: Optional[int] = None,
    max_seconds: Optional[float] = None,
    max_rays: Optional[int] = None,
    memory: Optional[int] = None,
    together: Optional[int] = None,
    seed: int = 1,
    triangles: Optional[bool] = None,
    progress: Progress = None,
) -> DayResult:
    """Simulates one or more days in steps with a single tree. Gives the numbers of `sunfleck day`, bit for bit.

    scene, folder, device, threads, allow_outside: as for `Simulation`; the scene needs a place, and [weather] or direct_normal.
    start, stop: local time "HH:MM" (default: sunrise and sunset). step: minutes. date, to_date: "YYYY-MM-DD" (default: the
        scene's date). error ... seed, progress: as for `Simulation.run`; error bounds apply to each step, max_seconds to all steps
        together. together: how many consecutive steps of a date are simulated together, 1 to 96; they share their packets, which
        saves time (default: as many as fit, up to 6, or 1 with max_rays). memory: bytes for such steps and for replicates in
        progress, half for each, by default half of the free memory. triangles: whether the light of every triangle and the maps
        of planes at every step are kept (`triangles` and `plane_steps` of the result). By default they are for a single date, if
        they take at most a quarter of the free memory.
    Raises InputError (a ValueError) for bad input and KeyboardInterrupt after Ctrl-C.
    """
    work = work_options(
        {
            "error": error, "direct_error": direct_error, "indirect_error": indirect_error, "grid": grid, "passes": passes,
            "max_seconds": max_seconds, "max_rays": max_rays, "memory": memory, "seed": seed,
            "triangle_errors": False,
        }
    )  # fmt: skip
    given_times = {"start": start, "stop": stop, "date": date, "to_date": to_date}
    when = [text(str(value or ""), name) for name, value in given_times.items()]
    most = None if together is None else whole(together, "together", 1, 96)
    request = _core.DayRequest(*when, whole(step, "step", 1, 24 * 60), most)
    machine = (text(str(device), "device"), whole(threads, "threads", 0, 4096))
    access = flag(allow_outside, "allow_outside")
    source = SceneSource(scene, folder)
    kept = None if triangles is None else bool(triangles)
    given = (os.fspath(source.file), source.text, source.meshes, access, request, work, kept, *machine)
    with reporting(progress) as report, contextlib.ExitStack() as around:
        if source.text is not None:
            around.enter_context(without_line_numbers(source))
        core = _core.day(*given, report)
    for line in core.warnings:
        warnings.warn(line if source.text is None else of_dict(line, source), stacklevel=2)
    return DayResult(core)
