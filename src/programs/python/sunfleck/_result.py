"""The results of a simulation as arrays."""

from __future__ import annotations

import functools
import json
import math
import os
from collections.abc import Iterable, Iterator
from html import escape
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import _plots
from ._columns import data_frame, named, numbered, optional, triangle_columns, with_text_arrays
from ._errors import refuse
from ._kept import KeptOutcome
from ._options import above_zero, path, text, texts, whole

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas
    import xarray

# The tables of to_dataframe, and those with their units.
_FRAMES = {"organs": "organs.csv", "triangles": "triangles.csv", "plants": "plants.csv", "layers": "profile.csv",
           "sensors": "sensors.csv", "sensor_means": "sensor_means.csv", "bands": "balance"}  # fmt: skip
_EXPORTS = ("csv", "nc", "vtp", "glb", "ply", "caribu")


def _with_error(value: float, half_width: Optional[float]) -> str:
    """Returns "83.6 ± 0.2": the half-width with one digit, the value as exact as it."""
    if half_width is None or not math.isfinite(half_width) or half_width <= 0.0:
        return f"{value:.4g}"
    decimals = max(0, -math.floor(math.log10(half_width)))
    return f"{value:.{decimals}f} ± {half_width:.{decimals}f}"


class Result:
    """The results of one simulation. BAND stands for the name of a band, such as PAR.

    Fluxes are in W m-2, or in the band's own unit of irradiance; NAME_error is the half-width of the confidence interval of NAME,
    in its unit; it includes the unshot flux and is NaN if there are too few hits. Coordinates are in metres in the scene's own
    axes: X south, Y up, Z west, or x east, y north, z up with axes = "east-north-up". Arrays are computed on first access and are
    read-only, since every access returns the same one: copy an array to change it. Texts are arrays of fixed width (dtype <U), so
    that `result["organ"] == "leaf"` is a mask. `organ` is everywhere the organ's name, `organ_index` its row in `organs`.

    A result can be copied and pickled: it then keeps its arrays, its summary and its short tables, but not the scene, so
    that it cannot be saved or rendered any more.
    """

    def __init__(self, outcome: Any) -> None:
        self._outcome = outcome

    @property
    def complete(self) -> bool:
        """Whether the requested work was done, or the requested bounds were reached."""
        return self._outcome.complete

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """The contents of summary.json: energy balance, errors reached, device, seconds, settings."""
        return json.loads(self._outcome.summary())

    @property
    def bands(self) -> dict[str, dict[str, Any]]:
        """The energy balance of each band by name, W m-2 of ground: incident, absorbed_vegetation, absorbed_structure,
        absorbed_soil, reflected, transmitted, unshot; their half-widths are in `error`; `residual`, the quanta missing from the
        sum, is 0."""
        return {band["name"]: band for band in self.summary["bands"]}

    @functools.cached_property
    def triangles(self) -> dict[str, Any]:
        """The columns of triangles.csv as arrays of shape (triangles,), in the order of the scene's geometry.

        plant, rank; organ and optics (names); organ_index (row in `organs`); area_m2 (one-sided); x, y, z
        (centroid after wrapping, m); BAND_direct_upper, BAND_direct_lower, BAND_indirect_upper, BAND_indirect_lower, with a sky
        BAND_sky_upper, BAND_sky_lower (incident on a face, W m-2; BAND_sky is part of BAND_indirect, which is all light but the
        direct), BAND_total (incident on both), BAND_absorbed, BAND_absorbed_error.
        """
        return triangle_columns(self._outcome)

    def __getitem__(self, column: str) -> np.ndarray:
        """Returns a column of `triangles`: result["PAR_absorbed"]."""
        try:
            return self.triangles[column]
        except KeyError:
            refuse(f"result[{column!r}]", "no such column of triangles", f"use one of {', '.join(self.triangles)}")
            raise

    def __iter__(self) -> Iterator[str]:
        """Gives the names of the columns of `triangles`."""
        return iter(self.triangles)

    @functools.cached_property
    def organs(self) -> dict[str, Any]:
        """The columns of organs.csv as arrays of shape (organs,): plant, organ (names), rank, area_m2, sunlit_fraction,
        BAND_direct, BAND_indirect, BAND_absorbed (W m-2, mean over the one-sided area), with photon units
        BAND_absorbed_umol_m2_s, and the sunlit and shaded classes, each with its _error; role (names). Soil elements of a mesh are
        included, the ground of [soil] is not."""
        return with_text_arrays(self._outcome.columns("organs.csv"))

    @functools.cached_property
    def plants(self) -> dict[str, np.ndarray]:
        """The columns of plants.csv as arrays of shape (plants,): plant, x, y, z (m, where it stands), height_m, leaf_area_m2,
        sunlit_leaf_fraction, BAND_incident, BAND_absorbed (W of the whole plant), with photon units BAND_absorbed_umol_s, each of
        these with its _error."""
        return self._outcome.columns("plants.csv")

    @functools.cached_property
    def profile(self) -> dict[str, np.ndarray]:
        """The columns of profile.csv as arrays of shape (layers + 1,), from the ground up, with the top plane in the last row:
        height_m, leaf_area_index, sunfleck_ratio, sunlit_leaf_fraction, BAND_down, BAND_up, BAND_absorbed (by vegetation) and
        BAND_absorbed_structure, each with its _error."""
        return self._outcome.columns("profile.csv")

    @functools.cached_property
    def planes(self) -> list[dict[str, Any]]:
        """One dict per [[plane]], in ascending order of height: height_m, x_m, z_m (centres of the cells), sunfleck_ratio and its
        _error, and maps of shape (cells along Z, cells along X): sunfleck, BAND_direct, BAND_total (W m-2 downwards). With the axes
        x east, y north, z up there is y_m instead of z_m, and the maps have the shape (cells along y, cells along x)."""
        return self._outcome.planes()

    @functools.cached_property
    def sensors(self) -> list[dict[str, Any]]:
        """One dict per [[sensor]]: name, and arrays of shape (points,): x, y, z, BAND_direct, BAND_sky, BAND_scattered,
        BAND_total and, with photon units, BAND_total_umol_m2_s, each with its _error."""
        return self._outcome.sensors()

    @functools.cached_property
    def sensor_means(self) -> dict[str, Any]:
        """The columns of sensor_means.csv as arrays of shape (sensors,), each the mean over the sensor's points: sensor (names),
        points (their number), BAND_direct, BAND_sky, BAND_scattered, BAND_total and, with photon units,
        BAND_total_umol_m2_s, each with its _error; empty without sensors."""
        return with_text_arrays(self._outcome.columns("sensor_means.csv")) if self.sensors else {}

    @functools.cached_property
    def corners(self) -> np.ndarray:
        """The corners of the triangles, m, shape (triangles, 3 corners, 3 axes of the scene), as traced: wrapped into the plot."""
        return self._outcome.corners()

    def describe(self, table: str) -> dict[str, tuple[str, str]]:
        """Returns the unit and the meaning of each column of profile.csv, organs.csv, plants.csv, triangles.csv, sensors.csv
        or sensor_means.csv: result.describe("organs.csv")["area_m2"] is ("m2", "one-sided area")."""
        described: dict[str, tuple[str, str]] = {}
        for name, (unit, meaning, _) in self._outcome.describe(text(table, "table")).items():
            described[name] = (unit, meaning)
            if table == "triangles.csv" and name == "organ":
                described["organ_index"] = ("1", "row of the organ in organs.csv, from 0")
        return described

    def table(self, name: str) -> str:
        """Returns the text of profile.csv, organs.csv, plants.csv, triangles.csv, sensors.csv or sensor_means.csv, byte for byte as the
        program writes it."""
        return self._outcome.table(text(name, "table"))

    def save(
        self, folder: Union[str, "os.PathLike[str]"], *, export: Iterable[str] = ("csv",), images: Union[str, Iterable[str]] = "none"
    ) -> None:
        """Writes a result folder, as `sunfleck run -o FOLDER --export ... --images ...` does. Replaces an earlier result there.

        `export`: any of csv, nc, vtp, glb, ply, caribu. `images`: "none", "all", or file stems such as "rank_total".
        """
        exports = texts(export, "export")
        for name in exports:
            if name not in _EXPORTS:
                refuse(f"export: {name!r}", "no such format", f"use {', '.join(_EXPORTS)}")
        self._outcome.write(os.fsencode(path(folder, "folder")), exports, texts(images, "images"))

    def to_xarray(self) -> xarray.Dataset:
        """Returns the variables of results.nc as an xarray Dataset: fields by `triangle`, corners also by `vertex`, the profile by
        `plane_height`, the balance by `band`, means of sensors by `sensor`, their points by `sensor_point`. Maps are in the list
        `planes` instead. `organ` and `optics` are names; in results.nc they are numbers, whose names organ_name and optics_name
        hold. Needs xarray."""
        xarray = optional("xarray", "to_xarray")

        def variables(table: str, dimension: str, columns: dict[str, Any]) -> dict[str, Any]:
            described = self._outcome.describe(table).items()
            return {name: (dimension, columns[name], {"units": unit}) for name, (unit, _, stored) in described if stored}

        data = xarray.Dataset(attrs={"title": self.summary["scene"], "seed": self.summary["seed"], "axes": self.summary["axes"]})
        data = data.assign(variables("triangles.csv", "triangle", self.triangles))
        data["organ_index"] = ("triangle", self.triangles["organ_index"], {"units": "1"})
        for number, axis in enumerate("xyz"):
            data[f"corner_{axis}"] = (("triangle", "vertex"), self.corners[:, :, number], {"units": "m"})
        data = data.set_coords(["plant", "rank", "organ", "organ_index", "optics", "x", "y", "z"])
        profile = variables("profile.csv", "plane_height", self.profile)
        height = profile.pop("height_m")
        data = data.assign(profile).assign_coords(plane_height=height, band=list(self.bands))
        balance = variables("balance", "band", self._outcome.columns("balance"))
        for name in sorted(balance, key=lambda name: name.endswith("_error")):
            data[name] = balance[name]
        data = data.assign(self._sensor_variables())
        return data.assign(
            plot_area_m2=((), self.summary["plot_area_m2"], {"units": "m2"}),
            leaf_area_index=((), self.summary["leaf_area_index"], {"units": "1"}),
        )

    def _sensor_variables(self) -> dict[str, Any]:
        """Returns the variables of results.nc that begin with sensor_."""
        if not self.sensors:
            return {}
        names = [sensor["name"] for sensor in self.sensors for _ in sensor["x"]]
        variables: dict[str, Any] = {"sensor_point_name": ("sensor_point", names)}
        for name, (unit, _) in self.describe("sensors.csv").items():
            if name not in ("sensor", "point"):
                values = np.concatenate([sensor[name] for sensor in self.sensors])
                variables[f"sensor_point_{name}"] = ("sensor_point", values, {"units": unit})
        for name, (unit, _) in self.describe("sensor_means.csv").items():
            key = "sensor_name" if name == "sensor" else f"sensor_{name}"
            variables[key] = ("sensor", self.sensor_means[name], {"units": unit} if unit else {})
        return variables

    def to_dataframe(self, table: str) -> pandas.DataFrame:
        """Returns a table as a pandas DataFrame: "organs" (index organ_index), "triangles" (triangle), "plants", "layers" (the
        columns of `profile`), "sensors" (sensor and point), "sensor_means" or "bands" (the balance, by band). Names are categories; attrs["units"]
        has the unit of each column. Needs pandas."""
        if table not in _FRAMES:
            refuse(f"to_dataframe({table!r})", "no such table", f"use one of {', '.join(_FRAMES)}")
        units = {name: unit for name, (unit, _) in self.describe(_FRAMES[table]).items()}
        if table == "sensors":
            return self._sensors_frame(units)
        if table == "bands":
            return data_frame(self._outcome.columns("balance"), named("band", self.bands), units)
        columns = self.profile if table == "layers" else getattr(self, table)
        if not columns:
            refuse(f"to_dataframe({table!r})", "the scene has no sensors", "add a [[sensor]]")
        index = {"organs": "organ_index", "triangles": "triangle", "plants": "plant_index", "layers": "layer", "sensor_means": "sensor_index"}[table]
        return data_frame(columns, numbered(index, len(next(iter(columns.values())))), units)

    def _sensors_frame(self, units: dict[str, str]) -> pandas.DataFrame:
        pandas = optional("pandas", "to_dataframe")
        frames = {}
        for sensor in self.sensors:
            columns = {name: values for name, values in sensor.items() if isinstance(values, np.ndarray)}
            frames[sensor["name"]] = data_frame(columns, numbered("point", len(sensor["x"])), units)
        return pandas.concat(frames, names=["sensor"]) if frames else pandas.DataFrame()

    def plot(
        self,
        kind: str = "profile",
        *,
        quantity: Optional[str] = None,
        band: Optional[str] = None,
        plane: int = 0,
        ax: Optional[matplotlib.axes.Axes] = None,
    ) -> matplotlib.axes.Axes:
        """Draws with matplotlib, and returns the axes.

        kind: "profile", a column of `profile` against height with its errors, or "map", a map of `planes`. quantity: the column;
            by default BAND_down of a profile, BAND_total of a map. band: by default the first. plane: the number of the plane,
            from 0 for the lowest.
        ax: axes to draw into; by default those of a new figure.
        """
        return _plots.draw(self, kind, quantity, band, plane, ax)

    def render(
        self,
        *,
        chart: str = "rank",
        field: str = "total",
        band: Optional[str] = None,
        view: str = "camera",
        size: tuple[int, int] = (1600, 1200),
        samples: int = 4,
        repeat: Optional[int] = None,
        range: Optional[float] = None,
    ) -> np.ndarray:
        """Returns a picture, uint8 of shape (height, width, 3), sRGB, pixel for pixel as `sunfleck render SCENE` draws it.

        chart: rank, rank-interval, rank-log, hue or map. field: direct, sky, indirect, total, absorbed or scattered. band: by default the
            first. view: camera, top, side or fisheye. size: (width, height), each 64..8192. samples: per pixel, 1..256.
        repeat: N x N copies of a periodic plot, N odd up to 9; by default 1, or enough for a horizon in a view upwards. range: upper end of the scale of rank-interval, rank-log and map, and of the soil in rank charts, W m-2.
        """
        try:
            width, height = size
        except (TypeError, ValueError):
            refuse(f"size = {size!r}", "must be (width, height)", "give two whole numbers")
        pixels = (whole(width, "size", 64, 8192), whole(height, "size", 64, 8192))
        copies = None if repeat is None else whole(repeat, "repeat", 1, 9)
        if copies is not None and copies % 2 == 0:
            refuse(f"repeat = {copies}", "must be odd: the plot is in the middle of its copies", f"give {copies + 1}")
        top = None if range is None else above_zero(range, "range")
        names = {"chart": chart, "field": field, "band": "" if band is None else band, "view": view}
        words = [text(value, name) for name, value in names.items()]
        return self._outcome.render(*words, pixels, whole(samples, "samples", 1, 256), copies, top)

    def __reduce__(self) -> tuple[Any, ...]:
        return Result, (KeptOutcome(self._outcome),)

    def __deepcopy__(self, _: dict[int, Any]) -> Result:
        return Result(self._outcome)

    def _absorbed(self) -> dict[str, tuple[float, float]]:
        """Returns what vegetation absorbs of each band, and its half-width."""
        return {name: (band["absorbed_vegetation"], band["error"]["absorbed_vegetation"]) for name, band in self.bands.items()}

    def _reached(self) -> list[str]:
        """Returns what was traced, why it ended, and the errors that were reached."""
        summary = self.summary
        passes = {name: summary[name] for name in ("direct", "indirect") if summary.get(name)}
        rays = sum(work.get(kind, 0) for work in passes.values() for kind in ("rays", "sky_rays", "packets"))
        told = [f"{rays:,} rays and packets", summary["stopped"]]
        for name, work in passes.items():
            reached, wanted = work.get("relative_error"), work.get("bound")
            if reached is not None:
                told.append(f"{name} error {reached:.2g}" + (f" (bound {wanted:g})" if wanted else ""))
        for name, error in (summary.get("triangle_relative_error") or {}).items():
            if error is not None:
                told.append(f"{name} absorbed by a triangle known to {100.0 * error:.2g} %")
        return told

    def __repr__(self) -> str:
        summary = self.summary
        absorbed = ", ".join(f"{name} {_with_error(value, error)}" for name, (value, error) in self._absorbed().items())
        light = f"{absorbed} W m-2 absorbed by vegetation"
        return f"<sunfleck.Result of {summary['scene']!r}: {summary['triangles']} triangles; {light}; {', '.join(self._reached())}>"

    def _repr_html_(self) -> str:
        """Returns the balance as a table, for notebooks."""
        terms = ("incident", "absorbed_vegetation", "absorbed_soil", "reflected")
        heads = "".join(f"<th>{term.replace('_', ' ')}</th>" for term in ("band", *terms))
        rows = []
        for name, band in self.bands.items():
            cells = [f"<td>{escape(name)}</td>"]
            for term in terms:
                error = band["error"].get(term)
                cells.append(f"<td>{_with_error(band[term], error)}</td>")
            rows.append(f"<tr>{''.join(cells)}</tr>")
        summary = self.summary
        title = f"{escape(summary['scene'])}: {summary['triangles']} triangles, W m-2 of ground"
        return f"<table><caption>{title}</caption><tr>{heads}</tr>{''.join(rows)}</table><p>{escape(', '.join(self._reached()))}</p>"
