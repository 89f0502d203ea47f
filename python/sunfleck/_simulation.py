"""Simulations: one, or many of one canopy."""

from __future__ import annotations

import contextlib
import os
import re
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Optional, Union

from . import _core
from ._errors import InputError
from ._options import whole, work_options
from ._result import Result
from ._scene import Scene, SceneSource

Progress = Callable[[Mapping[str, Any]], object]


class _Unchanged:
    def __repr__(self) -> str:
        return "UNCHANGED"


UNCHANGED: Any = _Unchanged()


@contextlib.contextmanager
def without_line_numbers(source: SceneSource) -> Iterator[None]:
    """Messages about a text that the user never saw name no line of it."""
    try:
        yield
    except InputError as error:
        begin = re.escape(str(source.file))
        raise InputError(re.sub(rf"^{begin}:\d+: ", f"{source.file.name}: ", str(error))) from None


class Simulation:
    """A scene whose tree and device are kept, so that another sun, sky or optics costs only its tracing.

    scene: the path of a scene file (TOML), or a dict with its keys. In a dict an entry of `geometry` may hold arrays instead of
        a file: `vertices`, float (n, 3), m, with `triangles`, int (m, 3), or vertices (m, 3, 3) alone; `optics`, a name of
        [optics] or m of them; and optionally `organ` (names; default: as optics), `plant` and `rank` (whole numbers; default 1
        and 0), one for all or m of them; besides `up` ("y" or "z"), `scale`, `heading` and `at` as for files.
    folder: where a dict's files are looked for (default: the current folder).
    device: auto, gpu, lavapipe, cpu, a number or a name, as the program's --device.
    threads: of the CPU path, 0 for all cores. (Of lavapipe those of the first simulation of a process.)
    allow_outside: whether files may lie outside the scene's folder.

    Raises InputError (a ValueError) for a bad scene or array, DeviceError without such a device. Warnings about the scene are
    Python's warnings. A Simulation serves one thread at a time; others run while it traces.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        folder: Union[str, os.PathLike, None] = None,
        device: str = "auto",
        threads: int = 0,
        allow_outside: bool = False,
    ) -> None:
        self._source = SceneSource(scene, folder)
        self._light: dict[str, Any] = {}
        checked_threads = whole(threads, "threads", 0, 1024)
        with self._tidied():
            self._core = _core.Simulation(
                os.fspath(self._source.file), self._source.text, self._source.meshes, allow_outside, str(device), checked_threads
            )
        self._source.meshes = {}
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
        """Other light or optics from here on, each a table of a scene file: sun={"elevation": 40, "azimuth": 120}.

        sun, sky and weather replace the table that was (None: there is none), band all bands; soil and optics replace the keys
        and names that they give. Raises InputError, and changes nothing, where the new scene is not sound.
        """
        given = {"sun": sun, "sky": sky, "band": band, "weather": weather, "soil": soil, "optics": optics}
        changes = {key: value for key, value in given.items() if value is not UNCHANGED}
        if not changes:
            return
        light = dict(self._light)
        for key, value in changes.items():
            light[key] = {**light.get(key, {}), **value} if key in ("soil", "optics") and value is not None else value
        text = self._source.text_with(light)
        with self._tidied(always=True):
            self._core.relight(os.fspath(self._source.file), text)
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
        progress: Optional[Progress] = None,
    ) -> Result:
        """Simulates, and gives the numbers of `sunfleck run` with the same options, bit for bit.

        sun ... optics: as in `relight`; they stay until they are changed again.
        error, direct_error, indirect_error: relative error bounds, in place of the scene's [accuracy].
        grid (m), passes: fixed work instead. max_seconds, max_rays: stop there; `complete` of the result is then False.
        memory: bytes for replicates in the making, by default a quarter of what is free.
        triangle_errors: whether the errors of single triangles are kept, 32 bytes a triangle and band.
        progress: called about ten times a second with {"stage", "rays", "fraction", "seconds_left", "pass",
            "relative_error", "bound"}; an exception from it ends
            the simulation and is raised here, as KeyboardInterrupt is after Ctrl-C.
        """
        options = work_options(
            {
                "error": error, "direct_error": direct_error, "indirect_error": indirect_error, "grid": grid, "passes": passes,
                "max_seconds": max_seconds, "max_rays": max_rays, "memory": memory, "seed": seed,
                "triangle_errors": triangle_errors,
            }
        )  # fmt: skip
        self.relight(sun=sun, sky=sky, band=band, weather=weather, soil=soil, optics=optics)
        return Result(self._core.run(options, progress))

    @property
    def device(self) -> dict[str, str]:
        """What traces: kind ("vulkan" or "cpu"), name, driver."""
        return self._core.device

    @property
    def sun(self) -> Optional[tuple[float, float]]:
        """Elevation and azimuth (clockwise from north) of the sun as it stands, degrees; None without a sun."""
        return self._core.sun

    @property
    def triangles(self) -> int:
        """How many triangles the canopy has."""
        return self._core.triangles

    @contextlib.contextmanager
    def _tidied(self, always: bool = False) -> Iterator[None]:
        if always or self._source.text is not None:
            with without_line_numbers(self._source):
                yield
        else:
            yield

    def _warn(self) -> None:
        for line in self._core.warnings:
            warnings.warn(line, stacklevel=3)


def run(scene: Scene, **options: Any) -> Result:
    """Simulates a scene once: Simulation(scene, folder=, device=, threads=, allow_outside=).run(...).

    The first four options go to `Simulation`, all others to its `run`. A scene that is simulated more than once, under other
    light, is better kept as a Simulation.
    """
    kept = {name: options.pop(name) for name in ("folder", "device", "threads", "allow_outside") if name in options}
    return Simulation(scene, **kept).run(**options)
