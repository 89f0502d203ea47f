"""Simulations of a scene, once or repeatedly with one canopy."""

from __future__ import annotations

import contextlib
import os
import re
import warnings
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Optional, Union

from . import _core
from ._errors import InputError, in_python, refuse
from ._options import flag, text, whole, work_options
from ._progress import Progress, check_progress, reporting
from ._result import Result
from ._scene import Scene, SceneSource, refuse_unknown_optics

Path = Union[str, "os.PathLike[str]"]


class _Unchanged:
    def __repr__(self) -> str:
        return "UNCHANGED"


UNCHANGED: Any = _Unchanged()  # the default of what a call leaves as it is


@contextlib.contextmanager
def without_line_numbers(source: SceneSource) -> Iterator[None]:
    """Rewrites the messages of errors as of_dict does."""
    try:
        yield
    except InputError as error:
        raise type(error)(of_dict(str(error), source)) from None


def of_dict(message: str, source: SceneSource) -> str:
    """Returns a message about a text that the user never saw without line numbers, and in Python's words."""
    begin = re.escape(str(source.present_file))
    message = re.sub(rf"^{begin}:(\d+): geometry\b", lambda found: f"{source.file.name}: {source.entry_at(int(found[1]))}", message)
    return in_python(re.sub(rf"^{begin}(:\d+)?: ", f"{source.file.name}: ", message))


def _checked_table(table: Any, place: str) -> Mapping[str, Any]:
    """Returns the table of soil or optics if it has a value for each of its keys."""
    if not isinstance(table, Mapping):
        example = '{"leaf": {...}}' if place == "optics" else '{"reflectance": 0.2}'
        refuse(f"{place}: {type(table).__name__}", "must be a dict", f"give {example}")
    for key, value in table.items():
        if value is None:
            refuse(f"{place}.{key} = None", "is no value", "leave it out to keep what the scene has")
    return table


class Simulation:
    """A scene whose tree and device are kept, so that another sun, sky or optics costs only the tracing.

    scene: the path of a scene file (TOML), or a dict with its keys. In a dict an entry of `geometry` may hold arrays instead of
        a file: `vertices`, float (n, 3), m, with `triangles`, int (m, 3), or vertices (m, 3, 3) alone; `optics`, one name of an
        [optics] table, m names, or a dict of patterns of the names in `organ`, {"leaf*": "leaf", "*": "stem"}; and optionally
        `organ` (names; default: as optics), `plant` and `rank` (whole numbers), one for all triangles or m of them; `up` ("x",
        "y" or "z"), `scale`, `heading` and `at`, or `positions`, `role`, `split` and `instances` work as for files. Entries that
        give the same `plant` are parts of one plant; further copies of an entry, by `at`, and entries without `plant` are numbered
        after the plants before them, and a later entry cannot have such a number.
    folder: folder in which the files of a dict are looked up (default: the current folder).
    device: auto (a GPU if there is one, else cpu), gpu, lavapipe, cpu, a device number or part of a device name, as with the
        program's --device.
    threads: number of threads of the CPU path, 0 for all cores. (For lavapipe the first simulation of a process decides.)
    allow_outside: whether files may lie outside the scene's folder.

    Raises InputError (a ValueError) for a bad scene or array, DeviceError if there is no such device. Warnings about the scene
    are issued as Python warnings. Only one thread at a time may use a Simulation; other threads run while it traces.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        folder: Optional[Path] = None,
        device: str = "auto",
        threads: int = 0,
        allow_outside: bool = False,
    ) -> None:
        self._source = SceneSource(scene, folder)
        self._light: dict[str, Any] = {}
        machine = (text(str(device), "device"), whole(threads, "threads", 0, 4096))
        access = flag(allow_outside, "allow_outside")
        with self._tidied():
            self._core = _core.Simulation(os.fspath(self._source.file), self._source.text, self._source.meshes, access, *machine)
        self._source.meshes = {}
        if self._source.text is None:
            self._source.keep(self._core.scene_text)
        self._warn()

    def relight(
        self,
        *,
        sun: Optional[Mapping[str, Any]] = UNCHANGED,
        sky: Optional[Mapping[str, Any]] = UNCHANGED,
        band: Sequence[Mapping[str, Any]] = UNCHANGED,
        weather: Optional[Mapping[str, Any]] = UNCHANGED,
        soil: Mapping[str, Any] = UNCHANGED,
        optics: Mapping[str, Mapping[str, Any]] = UNCHANGED,
    ) -> None:
        """Changes light or optics from now on; each argument is a table of a scene file: sun={"elevation": 40, "azimuth": 120}.

        sun, sky and weather replace the whole table (None removes it), and band replaces all bands. soil replaces the keys that it
        contains: {"reflectance": 0.2} keeps the patch. optics replaces the tables of the names that it contains, each as a whole:
        {"leaf": {"reflectance": 0.2}} makes leaves opaque, so give transmittance, too. (In `sweep` what is left out stays.)
        Raises InputError and changes nothing if the new scene is invalid, or if no surface can have optics of such a name.
        """
        given: dict[str, Any] = {"sun": sun, "sky": sky, "band": band, "weather": weather, "soil": soil, "optics": optics}
        changes = {key: value for key, value in given.items() if value is not UNCHANGED}
        if not changes:
            return
        light = dict(self._light)
        for key, value in changes.items():
            overlaid = key in ("soil", "optics") and value is not None
            light[key] = {**(light.get(key) or {}), **_checked_table(value, key)} if overlaid else value
        if "optics" in changes:
            refuse_unknown_optics(changes["optics"], [*self._source.tables.get("optics", {}), *self._core.optics_names])
        changed = self._source.text_with(light)
        with self._tidied(always=True):
            self._core.relight(os.fspath(self._source.present_file), changed)
        self._light = light
        self._warn()

    def run(
        self,
        *,
        sun: Optional[Mapping[str, Any]] = UNCHANGED,
        sky: Optional[Mapping[str, Any]] = UNCHANGED,
        band: Sequence[Mapping[str, Any]] = UNCHANGED,
        weather: Optional[Mapping[str, Any]] = UNCHANGED,
        soil: Mapping[str, Any] = UNCHANGED,
        optics: Mapping[str, Mapping[str, Any]] = UNCHANGED,
        error: Optional[float] = None,
        direct_error: Optional[float] = None,
        indirect_error: Optional[float] = None,
        grid: Optional[float] = None,
        passes: Optional[int] = None,
        max_seconds: Optional[float] = None,
        max_rays: Optional[int] = None,
        memory: Optional[int] = None,
        seed: int = 1,
        triangle_errors: bool = True,
        progress: Progress = None,
    ) -> Result:
        """Simulates the scene. Gives the numbers of `sunfleck run` with the same options, bit for bit.

        sun ... optics: as in `relight`; they stay until they are changed again.
        error, direct_error, indirect_error: relative error bounds that replace the scene's [accuracy].
        grid (m), passes: fixed work instead of a bound. max_seconds, max_rays: limits; a result that they cut short has
            `complete` False. Eight small replicates at least are made before max_rays stops them.
        memory: bytes for replicates in progress, by default a quarter of the free memory.
        triangle_errors: whether the light of single triangles is estimated with the help of their neighbours, with its errors.
            False saves time and memory where only organs, layers and totals matter: values of triangles are then what landed on
            each, which is several times noisier. Sums over organs are the same.
        progress: True shows a bar, that of tqdm if it is installed, else a line on stderr. A function is called about ten
            times a second with {"stage", "rays", "fraction", "seconds_left", "pass", "relative_error", "bound"}. An exception
            from it ends the simulation and is raised here, as is KeyboardInterrupt after Ctrl-C.
        """
        options = work_options(
            {
                "error": error, "direct_error": direct_error, "indirect_error": indirect_error, "grid": grid, "passes": passes,
                "max_seconds": max_seconds, "max_rays": max_rays, "memory": memory, "seed": seed,
                "triangle_errors": triangle_errors,
            }
        )  # fmt: skip
        check_progress(progress)
        self.relight(sun=sun, sky=sky, band=band, weather=weather, soil=soil, optics=optics)
        with reporting(progress) as report:
            result = Result(self._core.run(options, report))
        if not result.complete and not any(band["incident"] for band in result.bands.values()):
            warnings.warn("the run ended before the first rays were counted: the result contains no light yet", stacklevel=2)
        return result

    @property
    def device(self) -> dict[str, str]:
        """The device that traces: kind ("vulkan" or "cpu"), name, driver."""
        return self._core.device

    @property
    def sun(self) -> Optional[tuple[float, float]]:
        """The sun's current elevation and azimuth (clockwise from north), degrees; None without a sun."""
        return self._core.sun

    @property
    def triangles(self) -> int:
        """The number of triangles of the canopy."""
        return self._core.triangles

    def __repr__(self) -> str:
        return f"<sunfleck.Simulation of {self._source.file.name}: {self.triangles} triangles, {self.device['name']}>"

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("Simulation: cannot be pickled or copied (it holds a tree and a device); make one from its scene instead")

    @contextlib.contextmanager
    def _tidied(self, always: bool = False) -> Iterator[None]:
        if always or self._source.text is not None:
            with without_line_numbers(self._source):
                yield
        else:
            yield

    def _warn(self) -> None:
        for line in self._core.warnings:
            is_text = self._source.text is not None or bool(self._light)
            warnings.warn(of_dict(line, self._source) if is_text else line, stacklevel=3)


def run(
    scene: Scene,
    *,
    folder: Optional[Path] = None,
    device: str = "auto",
    threads: int = 0,
    allow_outside: bool = False,
    sun: Optional[Mapping[str, Any]] = UNCHANGED,
    sky: Optional[Mapping[str, Any]] = UNCHANGED,
    band: Sequence[Mapping[str, Any]] = UNCHANGED,
    weather: Optional[Mapping[str, Any]] = UNCHANGED,
    soil: Mapping[str, Any] = UNCHANGED,
    optics: Mapping[str, Mapping[str, Any]] = UNCHANGED,
    error: Optional[float] = None,
    direct_error: Optional[float] = None,
    indirect_error: Optional[float] = None,
    grid: Optional[float] = None,
    passes: Optional[int] = None,
    max_seconds: Optional[float] = None,
    max_rays: Optional[int] = None,
    memory: Optional[int] = None,
    seed: int = 1,
    triangle_errors: bool = True,
    progress: Progress = None,
) -> Result:
    """Simulates a scene once. scene, folder, device, threads, allow_outside: as for `Simulation`; all others: as for its `run`.

    For several simulations of one scene under different light, a Simulation is faster.
    """
    return Simulation(scene, folder=folder, device=device, threads=threads, allow_outside=allow_outside).run(
        sun=sun, sky=sky, band=band, weather=weather, soil=soil, optics=optics, error=error, direct_error=direct_error,
        indirect_error=indirect_error, grid=grid, passes=passes, max_seconds=max_seconds, max_rays=max_rays, memory=memory,
        seed=seed, triangle_errors=triangle_errors, progress=progress,
    )  # fmt: skip
