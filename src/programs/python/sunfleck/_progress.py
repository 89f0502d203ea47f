"""How far a simulation is: given to a function, or shown as a bar."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Optional, Protocol, Union

from ._errors import refuse

State = Mapping[str, Any]
Report = Callable[[State], object]
Progress = Union[Report, bool, None]


class _Bar(Protocol):
    def show(self, state: State) -> None: ...

    def close(self) -> None: ...


def check_progress(progress: Progress) -> None:
    """Raises InputError for a value that `reporting` does not take."""
    if not (progress is None or isinstance(progress, bool) or callable(progress)):
        refuse(f"progress: {type(progress).__name__}", "must be True, False, None or a function", "give progress=True for a bar")


@contextlib.contextmanager
def reporting(progress: Progress) -> Iterator[Optional[Report]]:
    """Yields what the compiled part is to call: the function itself, that of a bar for True, None for None and False."""
    check_progress(progress)
    if progress is None or progress is False:
        yield None
    elif progress is True:
        bar = _bar()
        try:
            yield bar.show
        finally:
            bar.close()
    else:
        yield progress


def words(state: State) -> str:
    """Returns the state in a few words: "indirect pass, 12.3 million rays, 8 s left"."""
    parts = [f"{state['pass']} pass", f"{state['rays'] / 1e6:.1f} million rays"]
    if state["seconds_left"] is not None:
        parts.append(f"{state['seconds_left']:.0f} s left")
    return ", ".join(parts)


class _Line:
    """A line on stderr that is written over as the percentage grows."""

    def __init__(self) -> None:
        self._percent = -1
        self._length = 0

    def show(self, state: State) -> None:
        percent = int(100.0 * state["fraction"])
        if percent == self._percent:
            return
        text = f"sunfleck: {percent:3d} %, {words(state)}"
        sys.stderr.write("\r" + text.ljust(self._length))
        sys.stderr.flush()
        self._percent, self._length = percent, len(text)

    def close(self) -> None:
        if self._length:
            sys.stderr.write("\n")


class _TqdmBar:
    """A bar of tqdm, in a terminal or a notebook."""

    def __init__(self, tqdm: Any) -> None:
        form = "{desc}: {percentage:3.0f} %|{bar}| {postfix}"
        self._bar = tqdm(total=1.0, desc="sunfleck", bar_format=form)

    def show(self, state: State) -> None:
        self._bar.set_postfix_str(words(state), refresh=False)
        self._bar.update(max(0.0, state["fraction"] - self._bar.n))

    def close(self) -> None:
        self._bar.close()


def _bar() -> _Bar:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _Line()
    return _TqdmBar(tqdm)
