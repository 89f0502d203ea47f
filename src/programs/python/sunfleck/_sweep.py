"""Simulations of a scene with several optical properties at once."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from ._errors import InputError, refuse
from ._result import Result
from ._scene import Scene, SceneSource, refuse_unknown_optics
from ._simulation import Simulation

if TYPE_CHECKING:
    import pandas

_COEFFICIENTS = ("reflectance", "transmittance")  # of a face
_BY_BAND = (*_COEFFICIENTS, "emission")
_FACES = ("upper", "lower")
_PAR_UMOL_PER_JOULE = 4.57  # of sunlight, as the program assumes it (McCree 1972)


class Variant:
    """The results of one variant of a sweep, under the names that they have in a `Result`.

    `number` is that of the variant, from 0. All variants share their packets, so that their errors are correlated: a difference
    between two of them is known better than their errors say. Arrays are read-only, as variants share many of them: copy an array
    to change it.
    """

    def __init__(self, result: Result, bands: Sequence[str], number: int) -> None:
        self.result = result  #: the simulation of all variants, whose bands are those of each variant: PAR-1, PAR-2, ...
        self.number = number
        self._bands = {_name(band, number): band for band in bands}
        self._others = tuple(f"{name}_" for name in result.bands if name not in self._bands)

    @property
    def complete(self) -> bool:
        """Whether the requested work was done, or the requested bounds were reached, for all variants."""
        return self.result.complete

    @property
    def bands(self) -> dict[str, dict[str, Any]]:
        """The energy balance of each band, as in `Result.bands`."""
        return {own: {**self.result.bands[name], "name": own} for name, own in self._bands.items()}

    @property
    def triangles(self) -> dict[str, Any]:
        """The columns of triangles.csv, as in `Result.triangles`."""
        return self._own(self.result.triangles)

    def __getitem__(self, column: str) -> np.ndarray:
        """Returns a column of `triangles`: variant["PAR_absorbed"]."""
        columns = self.triangles
        if column not in columns:
            refuse(f"variant[{column!r}]", "no such column of triangles", f"use one of {', '.join(columns)}")
        return columns[column]

    def __iter__(self) -> Iterator[str]:
        """Gives the names of the columns of `triangles`."""
        return iter(self.triangles)

    @property
    def organs(self) -> dict[str, Any]:
        """The columns of organs.csv, as in `Result.organs`."""
        return self._own(self.result.organs)

    @property
    def plants(self) -> dict[str, np.ndarray]:
        """The columns of plants.csv, as in `Result.plants`."""
        return self._own(self.result.plants)

    @property
    def profile(self) -> dict[str, np.ndarray]:
        """The columns of profile.csv, as in `Result.profile`."""
        return self._own(self.result.profile)

    @property
    def planes(self) -> list[dict[str, Any]]:
        """The maps of each [[plane]], as in `Result.planes`."""
        return [self._own(plane) for plane in self.result.planes]

    @property
    def sensors(self) -> list[dict[str, Any]]:
        """The readings of each [[sensor]], as in `Result.sensors`."""
        return [self._own(sensor) for sensor in self.result.sensors]

    @property
    def sensor_means(self) -> dict[str, Any]:
        """The columns of sensor_means.csv, as in `Result.sensor_means`."""
        return self._own(self.result.sensor_means)

    def to_dataframe(self, table: str) -> pandas.DataFrame:
        """Returns a table as a pandas DataFrame, as `Result.to_dataframe` does. Needs pandas."""
        frame = self.result.to_dataframe(table)
        if table == "bands":
            return frame.loc[list(self._bands)].rename(index=self._bands)
        units = self._own(frame.attrs.get("units", {}))
        frame = frame[[name for name in frame.columns if not name.startswith(self._others)]].rename(columns=self._own_name)
        frame.attrs["units"] = units
        return frame

    def __repr__(self) -> str:
        absorbed = ", ".join(f"{name} {band['absorbed_vegetation']:.4g}" for name, band in self.bands.items())
        return f"<sunfleck.Variant {self.number}: {absorbed} W m-2 absorbed by vegetation>"

    def _own(self, columns: Mapping[str, Any]) -> dict[str, Any]:
        return {self._own_name(name): values for name, values in columns.items() if not name.startswith(self._others)}

    def _own_name(self, column: str) -> str:
        for name, own in self._bands.items():
            if column.startswith(f"{name}_"):
                return own + column[len(name) :]
        return column


def sweep(
    scene: Scene,
    *,
    optics: Optional[Mapping[str, Mapping[str, Any]]] = None,
    soil: Optional[Mapping[str, Any]] = None,
    folder: Union[str, "os.PathLike[str]", None] = None,
    device: str = "auto",
    threads: int = 0,
    allow_outside: bool = False,
    **work: Any,
) -> list[Variant]:
    """Simulates a scene with several optical properties at once, and returns the results of each variant.

    optics, soil: changes of the scene's tables, with a list in place of every number that varies, one value for each variant:
        optics={"leaf": {"reflectance": [0.08, 0.12, 0.16], "transmittance": {"PAR": [0.04, 0.06, 0.08], "NIR": 0.4}}}. All lists have
        the same length. A number holds for all variants. Unlike in `run` and `relight`, whose optics replace the tables of the
        names that they contain, what is left out stays as the scene has it: {"leaf": {"reflectance": [0.1, 0.2]}} keeps the
        transmittance of leaves. Only a `spectrum` of a table that changes is replaced by the values.
    All other arguments: as for `run`.

    The variants are bands of one simulation: packets find their way through the canopy once and carry the light of all variants. The
    bounds hold for every variant, for which reason the most difficult one decides how many packets there are.

    Raises InputError (a ValueError) like `run`, and for lists of different lengths.
    """
    if "band" in work:
        refuse("band", "a sweep takes its bands from the scene", "change them there")
    given = {key: table for key, table in (("optics", optics), ("soil", soil)) if table}
    variants = _count(given)
    tables = _tables(scene, folder, device, threads, allow_outside)
    names = _band_names(tables)
    changed_optics = given.get("optics", {})
    refuse_unknown_optics(changed_optics, [*tables.get("optics", {}), "structure"])  # the last need not be defined

    def expanded(table: Mapping[str, Any], changes: Mapping[str, Any], place: str) -> dict[str, Any]:
        return _expanded(_overlaid(table, changes, names, place), names, variants)

    changed = {
        **(scene if isinstance(scene, Mapping) else tables),
        "band": [_renamed(band, variant) for variant in range(variants) for band in tables["band"]],
        "optics": {
            name: expanded(tables.get("optics", {}).get(name, {}), changed_optics.get(name, {}), f"optics.{name}")
            for name in {**tables.get("optics", {}), **changed_optics}
        },
    }
    if "soil" in tables or "soil" in given:
        changed["soil"] = expanded(tables.get("soil", {}), given.get("soil", {}), "soil")
    place = folder if isinstance(scene, Mapping) else Path(scene).parent
    simulation = Simulation(changed, folder=place, device=device, threads=threads, allow_outside=allow_outside)
    result = simulation.run(**work)
    return [Variant(result, names, variant) for variant in range(variants)]


def _tables(scene: Scene, folder: Any, device: str, threads: int, allow_outside: bool) -> Mapping[str, Any]:
    """Returns the keys of the scene."""
    try:
        return SceneSource(scene, folder).tables
    except (OSError, InputError):
        Simulation(scene, folder=folder, device=device, threads=threads, allow_outside=allow_outside)  # raises the program's error
        raise


def _renamed(band: Mapping[str, Any], variant: int) -> dict[str, Any]:
    """Returns the band of a variant. Only the name tells how many photons a joule of PAR has, if nothing else does."""
    renamed = {**band, "name": _name(band["name"], variant)}
    if band["name"] in ("PAR", "par") and "unit" in band and "range_nm" not in band:
        renamed.setdefault("umol_per_joule", _PAR_UMOL_PER_JOULE)
    return renamed


def _name(band: str, variant: int) -> str:
    return f"{band}-{variant + 1}"


def _band_names(tables: Mapping[str, Any]) -> list[str]:
    bands = tables.get("band")
    if not isinstance(bands, Sequence) or not all(isinstance(band, Mapping) and "name" in band for band in bands):
        refuse("sweep", "the scene has no list of named bands", 'give "band": [{"name": "PAR", ...}]')
    return [str(band["name"]) for band in bands]


def _is_list(value: Any) -> bool:
    return isinstance(value, (list, tuple)) or (isinstance(value, np.ndarray) and value.ndim > 0)


def _checked(table: Any, place: str) -> Mapping[str, Any]:
    if not isinstance(table, Mapping):
        refuse(f"{place}: {type(table).__name__}", "must be a dict", 'give {"reflectance": [0.1, 0.2]}, for example')
    return table


def _lists(table: Any, place: str) -> Iterator[tuple[str, int]]:
    """Returns the lists of values that vary, with their lengths."""
    for key, value in _checked(table, place).items():
        name = f"{place}.{key}"
        if key in _FACES:
            yield from _lists(value, name)
        elif key in _BY_BAND:
            for band, item in value.items() if isinstance(value, Mapping) else ((None, value),):
                if _is_list(item):
                    yield (name if band is None else f"{name}.{band}"), len(item)
        elif _is_list(value) and key != "rgb":
            refuse(name, "no such values can vary", f"use {', '.join(_BY_BAND)}")


def _count(given: Mapping[str, Any]) -> int:
    """Returns the number of variants."""
    lists = list(_lists(given["soil"], "soil")) if "soil" in given else []
    for name, table in _checked(given.get("optics", {}), "optics").items():
        lists += _lists(table, f"optics.{name}")
    if not lists:
        refuse("sweep", "nothing varies", 'give a list of values, such as optics={"leaf": {"reflectance": [0.1, 0.2]}}')
    for name, length in lists:
        if length == 0:
            refuse(name, "the list is empty", "give one value for each variant")
        if length != lists[0][1]:
            refuse(f"{name}: {length} values", f"{lists[0][0]} has {lists[0][1]}", "give one value for each variant everywhere")
    return lists[0][1]


def _coefficients(table: Mapping[str, Any], names: Sequence[str]) -> dict[str, dict[str, Any]]:
    """Returns the coefficients of a table by band."""
    return {
        key: dict(table[key]) if isinstance(table[key], Mapping) else dict.fromkeys(names, table[key])
        for key in _BY_BAND
        if key in table
    }


def _without(table: Mapping[str, Any], keys: Sequence[str]) -> dict[str, Any]:
    return {key: value for key, value in table.items() if key not in keys}


def _together(*parts: Mapping[str, Mapping[str, Any]]) -> dict[str, dict[str, Any]]:
    """Returns the coefficients of all parts; later ones replace earlier ones of the same band."""
    joint: dict[str, dict[str, Any]] = {}
    for part in parts:
        for key, of_bands in part.items():
            joint[key] = {**joint.get(key, {}), **of_bands}
    return joint


def _overlaid(table: Mapping[str, Any], changes: Mapping[str, Any], names: Sequence[str], place: str) -> dict[str, Any]:
    """Returns the table with the changes, its coefficients by band."""
    faces = [face for face in _FACES if face in table or face in changes]
    for part in (changes, *(changes.get(face, {}) for face in faces)):
        if "spectrum" in part:
            refuse(f"{place}.spectrum", "a sweep needs the values of each band", "give reflectance and transmittance instead")
    if changes:  # replace a spectrum of the scene
        own_faces = {face: _without(table[face], ("spectrum",)) for face in _FACES if face in table}
        table = {**_without(table, ("spectrum",)), **own_faces}
    own, changed = _coefficients(table, names), _coefficients(changes, names)
    overlaid = _without({**table, **changes}, _COEFFICIENTS)
    if not faces:
        return {**overlaid, **_together(own, changed)}
    overlaid.update(_together(*({"emission": part["emission"]} for part in (own, changed) if "emission" in part)))
    both = [_without(part, ("emission",)) for part in (own, changed)]
    for face in _FACES:
        of_face = [_coefficients(part.get(face, {}), names) for part in (table, changes)]
        kept = _without({**table.get(face, {}), **changes.get(face, {})}, _COEFFICIENTS)
        overlaid[face] = {**kept, **_together(both[0], of_face[0], both[1], of_face[1])}
    return overlaid


def _expanded(table: Mapping[str, Any], names: Sequence[str], variants: int) -> dict[str, Any]:
    """Returns the table with a value for every band of every variant."""
    expanded = {**table, **{face: _expanded(table[face], names, variants) for face in _FACES if face in table}}
    for key, of_bands in _coefficients(table, names).items():
        expanded[key] = {
            _name(str(band), variant): item[variant] if _is_list(item) else item
            for band, item in of_bands.items()
            for variant in range(variants)
        }
    return expanded
