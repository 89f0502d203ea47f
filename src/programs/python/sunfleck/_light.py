"""Sun and sky without a canopy."""

from __future__ import annotations

import datetime
import os
from collections.abc import Mapping
from typing import Any, Optional, Union

import numpy as np

from . import _core
from ._errors import refuse
from ._options import flag, real, refuse_masked, whole


def sun_position(time: Any, latitude: float, longitude: float, altitude: float = 0.0) -> tuple[Any, Any]:
    """Returns the sun's true elevation (without refraction) and its azimuth clockwise from north, both in degrees.

    time: a datetime with a time zone, a string such as "2002-08-08T10:10:00+08:00", a numpy.datetime64 (UTC), or a sequence or
        array of these; years 1900 to 2100. latitude, longitude: degrees north and east. altitude: m above sea level,
        -500 to 9000.
    Returns floats for one time, arrays of the shape of `time` for several. Within 0.0003 degrees of the NREL algorithm.
    """
    latitude, longitude, altitude = real(latitude, "latitude"), real(longitude, "longitude"), real(altitude, "altitude")
    if not -90.0 <= latitude <= 90.0:
        refuse(f"latitude = {latitude}", "must lie in -90..90", "give degrees north")
    if not -180.0 <= longitude <= 360.0:
        refuse(f"longitude = {longitude}", "must lie in -180..360", "give degrees east")
    if not -500.0 <= altitude <= 9000.0:
        refuse(f"altitude = {altitude}", "must lie in -500..9000", "give metres above sea level")
    if isinstance(time, (datetime.datetime, np.datetime64, str)):
        return _core.sun_position(_unix_seconds(time), latitude, longitude, altitude)
    refuse_masked(time, "time")
    times = np.asarray(time)
    if times.dtype.kind not in "MOU":
        refuse(f"time: {times.dtype}", "must be times", "give datetime with a time zone, numpy.datetime64 or ISO strings")
    positions = np.array(
        [_core.sun_position(_unix_seconds(one), latitude, longitude, altitude) for one in times.ravel()], dtype=float
    ).reshape(-1, 2)
    return positions[:, 0].reshape(times.shape), positions[:, 1].reshape(times.shape)


def _unix_seconds(time: Any) -> float:
    if isinstance(time, str):
        try:
            time = datetime.datetime.fromisoformat(time)
        except ValueError:
            refuse(f"time = {time!r}", "must be a date and time", "write 2002-08-08T10:10:00+08:00")
    if isinstance(time, np.datetime64):
        if np.isnat(time):
            refuse("time = NaT", "must be a time", "remove it")
        year = 1970 + int(time.astype("datetime64[Y]").astype(np.int64))
        if not 1900 <= year <= 2100:  # microseconds overflow for others
            refuse(f"time: the year {year}", "must lie in 1900..2100", "give a time in this range")
        return float(time.astype("datetime64[us]").astype(np.int64)) * 1e-6
    if not isinstance(time, datetime.datetime):
        refuse(f"time: {type(time).__name__}", "must be a datetime", "give datetime with a time zone, numpy.datetime64 or a string")
    if time.tzinfo is None:
        refuse(f"time = {time.isoformat()}", "has no time zone", "add one, e.g. tzinfo=datetime.timezone.utc")
    return time.timestamp()


class Sky:
    """A sky of horizontal irradiance 1: gives its radiance, and directions drawn from it. See `sky`."""

    def __init__(self, core: Any) -> None:
        self._core = core

    def radiance(self, elevation: Any, azimuth: Any) -> Any:
        """Returns the radiance, sr-1, towards elevation and azimuth (degrees, clockwise from north; arrays that broadcast): the
        radiance in W m-2 sr-1 of a sky that gives a horizontal plane 1 W m-2. It is 0 below the horizon. A list of lights has no
        radiance."""
        if self._core.is_list:
            refuse("radiance", "a sky of single lights has no radiance", "use `lights`")
        for name, angles in (("elevation", elevation), ("azimuth", azimuth)):
            refuse_masked(angles, name)
        up, around = np.broadcast_arrays(np.asarray(elevation, dtype=float), np.asarray(azimuth, dtype=float))
        if not (np.isfinite(up).all() and np.isfinite(around).all()):
            refuse("elevation, azimuth", "must be finite", "remove NaN and infinity")
        values = self._core.radiance(np.ascontiguousarray(up).ravel(), np.ascontiguousarray(around).ravel()).reshape(up.shape)
        return values if values.shape else float(values)

    def draw(self, count: int, seed: int = 1) -> np.ndarray:
        """Returns `count` unit vectors towards the sky (X south, Y up, Z west), shape (count, 3). Each represents the same share
        of the irradiance of a horizontal plane."""
        return self._core.draw(whole(count, "count", 0, 2**31), whole(seed, "seed", 0, 2**64 - 1))

    @property
    def lights(self) -> list[tuple[float, tuple[float, float, float]]]:
        """The share of the horizontal irradiance and the unit vector of each light of a list; empty for other skies."""
        return self._core.lights()

    @property
    def spherical_irradiance(self) -> float:
        """The flux on a sphere per area of its cross-section: 2 under a uniform sky."""
        return self._core.spherical_irradiance


def sky(
    model: Union[str, Mapping[str, Any]],
    *,
    sun: Optional[Mapping[str, Any]] = None,
    type: Optional[int] = None,
    dni: Optional[float] = None,
    dhi: Optional[float] = None,
    file: Union[str, "os.PathLike[str]", None] = None,
    folder: Union[str, "os.PathLike[str]"] = ".",
    allow_outside: bool = False,
) -> Sky:
    """Returns the sky described by a scene's [sky] table: sky("cie", type=12, sun={"elevation": 40, "azimuth": 120}).

    model: uniform, cie-overcast, cie-clear, cie (with type, 1..15), perez (with dni and dhi, W m-2), lights (with file); or the
        whole table as a dict. sun: as a scene's [sun]; models that follow the sun need it.
    """
    given = {"type": type, "dni": dni, "dhi": dhi, "file": file}
    table = {**(model if isinstance(model, Mapping) else {"model": model}), **{key: value for key, value in given.items() if value is not None}}
    tables: dict[str, Any] = {"plot": {"size": [1.0, 1.0]}, "sky": table, "band": [{"name": "all", "diffuse": 1.0}]}
    if sun is not None:
        tables["sun"] = sun
    from ._scene import SceneSource
    from ._simulation import without_line_numbers

    source = SceneSource(tables, folder)
    with without_line_numbers(source):
        return Sky(_core.Sky(os.fsencode(source.file), source.text, flag(allow_outside, "allow_outside")))
