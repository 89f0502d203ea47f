"""The results of a simulation as arrays."""

from __future__ import annotations

import functools
import json
import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from ._errors import refuse

if TYPE_CHECKING:
    import xarray

_EXPORTS = ("csv", "nc", "vtp", "glb", "ply", "caribu")


class Result:
    """The results of one simulation. BAND stands for the name of a band, such as PAR.

    Fluxes are in W m-2, or in the band's own unit of irradiance; NAME_error is the half-width of the confidence interval of NAME, in
    its unit; it includes the unshot flux and is NaN if there are too few hits. Coordinates are in metres in the scene's own axes: X south, Y up, Z west, or
    x east, y north, z up with axes = "east-north-up". Arrays are computed on first access; those of the triangles are read-only
    views of memory that the result owns.
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

        plant, rank; organ and optics as indices into the lists organ_name and optics_name; area_m2 (one-sided); x, y, z
        (centroid after wrapping, m); BAND_direct_upper, BAND_direct_lower, BAND_indirect_upper, BAND_indirect_lower, with a sky
        BAND_sky_upper, BAND_sky_lower (incident on a face, W m-2), BAND_total (incident on both), BAND_absorbed,
        BAND_absorbed_error.
        """
        return self._outcome.triangles()

    def __getitem__(self, column: str) -> np.ndarray:
        """Returns a column of `triangles`: result["PAR_absorbed"]."""
        try:
            return self.triangles[column]
        except KeyError:
            refuse(f"result[{column!r}]", "no such column of triangles", f"use one of {', '.join(self.triangles)}")
            raise

    @functools.cached_property
    def organs(self) -> dict[str, Any]:
        """The columns of organs.csv as arrays of shape (organs,): plant, organ (a list of names), rank, area_m2, sunlit_fraction,
        BAND_direct, BAND_indirect, BAND_absorbed (W m-2, mean over the one-sided area), with photon units
        BAND_absorbed_umol_m2_s, each of these with its _error; role (a list of names). Soil elements of a mesh are included, the ground of [soil] is not."""
        return self._outcome.organs()

    @functools.cached_property
    def plants(self) -> dict[str, np.ndarray]:
        """The columns of plants.csv as arrays of shape (plants,): plant, x, y, z (m, where it stands), height_m, leaf_area_m2,
        sunlit_leaf_fraction, BAND_incident, BAND_absorbed (W of the whole plant), with photon units BAND_absorbed_umol_s, each of
        these with its _error."""
        return self._outcome.plants()

    @functools.cached_property
    def profile(self) -> dict[str, np.ndarray]:
        """The columns of profile.csv as arrays of shape (layers + 1,), from the ground up, with the top plane in the last row:
        height_m, leaf_area_index, sunfleck_ratio, sunlit_leaf_fraction, BAND_down, BAND_up, BAND_absorbed (by vegetation) and
        BAND_absorbed_structure, each with its _error."""
        return self._outcome.profile()

    @functools.cached_property
    def planes(self) -> list[dict[str, Any]]:
        """One dict per [[plane]]: height_m, x_m, z_m (centres of the cells), sunfleck_ratio and its _error, and maps of shape
        (cells along Z, cells along X): sunfleck, BAND_direct, BAND_total (W m-2 downwards). With the axes x east, y north, z up
        there is y_m instead of z_m, and the maps have the shape (cells along y, cells along x)."""
        return self._outcome.planes()

    @functools.cached_property
    def sensors(self) -> list[dict[str, Any]]:
        """One dict per [[sensor]]: name, and arrays of shape (points,): x, y, z, BAND_direct, BAND_sky, BAND_scattered,
        BAND_total and, with photon units, BAND_total_umol_m2_s, each with its _error."""
        return self._outcome.sensors()

    @functools.cached_property
    def sensor_means(self) -> dict[str, Any]:
        """The columns of sensor_means.csv as arrays of shape (sensors,), each the mean over the sensor's points: sensor (a list of
        names), points (their number), BAND_direct, BAND_sky, BAND_scattered, BAND_total and, with photon units,
        BAND_total_umol_m2_s, each with its _error; empty without sensors."""
        return self._outcome.sensor_means()

    @functools.cached_property
    def corners(self) -> np.ndarray:
        """The corners of the triangles, m, shape (triangles, 3 corners, 3 axes of the scene), as traced: wrapped into the plot."""
        return self._outcome.corners()

    def describe(self, table: str) -> dict[str, tuple[str, str]]:
        """Returns the unit and the meaning of each column of profile.csv, organs.csv, plants.csv, triangles.csv, sensors.csv
        or sensor_means.csv: result.describe("organs.csv")["area_m2"] is ("m2", "one-sided area")."""
        return {name: (unit, meaning) for name, (unit, meaning, _) in self._outcome.describe(table).items()}

    def table(self, name: str) -> str:
        """Returns the text of profile.csv, organs.csv, plants.csv, triangles.csv, sensors.csv or sensor_means.csv, byte for byte as the
        program writes it."""
        return self._outcome.table(name)

    def save(
        self, folder: Union[str, os.PathLike], *, export: Iterable[str] = ("csv",), images: Union[str, Iterable[str]] = "none"
    ) -> None:
        """Writes a result folder, as `sunfleck run -o FOLDER --export ... --images ...` does. Replaces an earlier result there.

        `export`: any of csv, nc, vtp, glb, ply, caribu. `images`: "none", "all", or file stems such as "rank_total".
        """
        exports = [export] if isinstance(export, str) else list(export)
        for name in exports:
            if name not in _EXPORTS:
                refuse(f"export: {name!r}", "no such format", f"use {', '.join(_EXPORTS)}")
        self._outcome.write(os.fspath(folder), exports, [images] if isinstance(images, str) else list(images))

    def to_xarray(self) -> xarray.Dataset:
        """Returns the variables of results.nc as an xarray Dataset: fields by `triangle`, the profile by `plane_height`, the
        balance by `band`, means of sensors by `sensor`, their points by `sensor_point`. Maps are in the list `planes` instead.
        Needs xarray."""
        import xarray

        def variables(table: str, dimension: str, columns: dict[str, Any]) -> dict[str, Any]:
            described = self._outcome.describe(table).items()
            return {name: (dimension, columns[name], {"units": unit}) for name, (unit, _, stored) in described if stored}

        data = xarray.Dataset(attrs={"title": self.summary["scene"], "seed": self.summary["seed"], "axes": self.summary["axes"]})
        data = data.assign(variables("triangles.csv", "triangle", self.triangles))
        for kind in ("organ", "optics"):
            words = self.triangles[f"{kind}_name"]
            data[kind].attrs.update(flag_values=np.arange(len(words)), flag_meanings=" ".join(words))
        data = data.set_coords(["plant", "rank", "organ", "optics", "x", "y", "z"])
        profile = variables("profile.csv", "plane_height", self.profile)
        height = profile.pop("height_m")
        data = data.assign(profile).assign_coords(plane_height=height, band=list(self.bands))
        balance = variables("balance", "band", self._outcome.balance())
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
            values = np.concatenate([sensor[name] for sensor in self.sensors])
            variables[f"sensor_point_{name}"] = ("sensor_point", values, {"units": unit})
        for name, (unit, _) in self.describe("sensor_means.csv").items():
            key = "sensor_name" if name == "sensor" else f"sensor_{name}"
            variables[key] = ("sensor", self.sensor_means[name], {"units": unit} if unit else {})
        return variables

    def __repr__(self) -> str:
        summary = self.summary
        state = "complete" if self.complete else summary["stopped"]
        return f"<sunfleck.Result of {summary['scene']!r}: {summary['triangles']} triangles, {', '.join(self.bands)}, {state}>"

