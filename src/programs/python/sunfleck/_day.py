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
from ._options import whole, work_options
from ._progress import Progress, reporting
from ._scene import Scene, SceneSource
from ._simulation import without_line_numbers

if TYPE_CHECKING:
    import pandas
    import xarray


class DayResult:
    """The results of one or more days, as `sunfleck day` gives them; BAND stands for the name of a band."""

    def __init__(self, core: Any) -> None:
        self._core = core

    @property
    def complete(self) -> bool:
        """Whether all steps were done and reached their bounds."""
        return self._core.complete

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """The contents of summary.json."""
        return json.loads(self._core.summary())

    @functools.cached_property
    def steps(self) -> dict[str, Any]:
        """The columns of day.csv as arrays of shape (steps,): time (texts: the start of each step with its UTC
        offset), step_s, elevation_deg and azimuth_deg (at the midpoint of the step), BAND_incident, BAND_absorbed_vegetation,
        BAND_absorbed_structure, BAND_absorbed_soil, BAND_reflected (W m-2 of ground) and sunlit_leaf_fraction, these with their
        half-widths _error."""
        return with_text_arrays(self._core.steps())

    @functools.cached_property
    def organs(self) -> dict[str, Any]:
        """The absorption of organs: date; organ and role (names), plant, rank and area_m2 by organ; and arrays
        of shape (dates, organs): BAND_absorbed_mj_m2 (per one-sided area), with photon units BAND_absorbed_mol_m2, with their
        half-widths _error."""
        return with_text_arrays(self._core.organs())

    @functools.cached_property
    def plants(self) -> dict[str, Any]:
        """The absorption of plants: date; plant, x, y, z, height_m and leaf_area_m2 by plant; and arrays of shape (dates,
        plants): BAND_absorbed_mj (of the whole plant), with photon units BAND_absorbed_mol, with their half-widths _error."""
        return with_text_arrays(self._core.plants())

    @functools.cached_property
    def triangles(self) -> dict[str, np.ndarray]:
        """The fields of day.nc in single precision, shape (steps, triangles), W m-2: BAND_direct_upper, BAND_direct_lower,
        BAND_sky_upper, BAND_sky_lower (with a sky), BAND_indirect_upper, BAND_indirect_lower, BAND_absorbed,
        BAND_absorbed_error. They are 0 at night."""
        return self._core.triangles()

    def describe(self, table: str) -> dict[str, tuple[str, str]]:
        """Returns the unit and the meaning of each column of day.csv, organs_day.csv or plants_day.csv."""
        return {name: (unit, meaning) for name, (unit, meaning, _) in self._core.describe(table).items()}

    def table(self, name: str) -> str:
        """Returns the text of day.csv, organs_day.csv or plants_day.csv, byte for byte as the program writes it."""
        return self._core.table(name)

    def to_xarray(self) -> xarray.Dataset:
        """Returns `steps` and `triangles` as an xarray Dataset with the dimensions time (UTC) and triangle. Needs xarray."""
        xarray = optional("xarray", "to_xarray")
        times = np.array([_utc(text) for text in self.steps["time"]], dtype="datetime64[ns]")
        data = xarray.Dataset(coords={"time": times}, attrs={"title": self.summary["scene"], "seed": self.summary["seed"]})
        for name, values in self.steps.items():
            if name != "time":
                data[name] = ("time", values)
        for name, values in self.triangles.items():
            data[name] = (("time", "triangle"), values, {"units": "W m-2"})
        return data

    def to_dataframe(self, table: str = "steps") -> pandas.DataFrame:
        """Returns "steps" (by time, UTC), "organs" (by date and organ_index, the organ's number), "plants" (by date and
        plant_index) or "triangles" (by time and triangle) as a pandas DataFrame, one row for each combination. attrs["units"]
        has the units. Needs pandas."""
        times = [_utc(text) for text in self.steps["time"]]
        if table == "steps":
            columns = {name: values for name, values in self.steps.items() if name != "time"}
            return data_frame(columns, named("time", times), self._units("day.csv"))
        if table == "triangles":
            count = self.summary["triangles"]
            flat = {name: values.ravel() for name, values in self.triangles.items()}
            return data_frame(flat, crossed(["time", "triangle"], [times, range(count)]), dict.fromkeys(flat, "W m-2"))
        if table not in ("organs", "plants"):
            refuse(f"to_dataframe({table!r})", "no such table of a day", "use steps, organs, plants or triangles")
        columns = dict(self.organs if table == "organs" else self.plants)
        dates = columns.pop("date")
        count = len(columns["plant"])
        flat = {name: np.broadcast_to(values, (len(dates), count)).ravel() for name, values in columns.items()}
        index = crossed(["date", f"{table[:-1]}_index"], [dates, range(count)])
        return data_frame(flat, index, self._units(f"{table}_day.csv"))

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
    seed: int = 1,
    progress: Progress = None,
) -> DayResult:
    """Simulates one or more days in steps with a single tree. Gives the numbers of `sunfleck day`, bit for bit.

    scene, folder, device, threads, allow_outside: as for `Simulation`; the scene needs a place, and [weather] or direct_normal.
    start, stop: local time "HH:MM" (default: sunrise and sunset). step: minutes. date, to_date: "YYYY-MM-DD" (default: the
        scene's date). error ... seed, progress: as for `Simulation.run`; error bounds apply to each step, max_seconds to all steps
        together.
    Raises InputError (a ValueError) for bad input and KeyboardInterrupt after Ctrl-C.
    """
    work = work_options(
        {
            "error": error, "direct_error": direct_error, "indirect_error": indirect_error, "grid": grid, "passes": passes,
            "max_seconds": max_seconds, "max_rays": max_rays, "memory": memory, "seed": seed,
            "triangle_errors": True,
        }
    )  # fmt: skip
    when = (str(start or ""), str(stop or ""), str(date or ""), str(to_date or ""))
    request = _core.DayRequest(*when, whole(step, "step", 1, 24 * 60))
    machine = (str(device), whole(threads, "threads", 0, 1024))
    source = SceneSource(scene, folder)
    given = (os.fspath(source.file), source.text, source.meshes, allow_outside, request, work, *machine)
    with reporting(progress) as report, contextlib.ExitStack() as around:
        if source.text is not None:
            around.enter_context(without_line_numbers(source))
        core = _core.day(*given, report)
    for line in core.warnings:
        warnings.warn(line, stacklevel=2)
    return DayResult(core)
