"""While it traces: progress, exceptions, Ctrl-C, and other threads."""

import json
import os
import signal
import subprocess
import sys
import threading
import time

import pytest
import sunfleck
from conftest import with_arrays

ENDLESS = {"error": 1e-7, "device": "cpu"}
PATIENCE_S = 600.0  # limit for work that never ends


def test_progress_is_told():
    told = []
    result = sunfleck.run(with_arrays(), device="cpu", error=0.02, progress=told.append)
    assert result.complete and told
    keys = {"stage", "rays", "fraction", "seconds_left", "pass", "relative_error", "bound"}
    assert all(set(state) == keys for state in told)
    for measure in ("rays", "fraction"):
        assert [state[measure] for state in told] == sorted(state[measure] for state in told)
    assert told[-1]["stage"] == "run" and told[-1]["fraction"] == 1.0
    assert told[-1]["bound"] == 0.02


def test_progress_of_fixed_work_has_no_bound():
    told = []
    sunfleck.run(with_arrays(), device="cpu", grid=0.05, passes=8, progress=told.append)
    assert told and all(state["bound"] is None for state in told)
    assert told[-1]["relative_error"] > 0.0


class Enough(Exception):
    """Ends a run from within its progress."""


def test_exceptions_of_progress_end_the_work():
    def stop(state):
        raise Enough

    simulation = sunfleck.Simulation(with_arrays(), device="cpu")
    with pytest.raises(Enough):
        simulation.run(error=1e-7, progress=stop)
    assert simulation.run(grid=0.1, passes=8).complete, "it goes on being of use"


def test_limits_are_kept():
    with pytest.warns(UserWarning, match="no light yet"):
        result = sunfleck.run(with_arrays(), **ENDLESS, max_seconds=1e-9)
    assert not result.complete and result.summary["stopped"] == "time spent"


def test_other_threads_run_meanwhile():
    """They run between two reports of progress, when no Python code of the run does."""
    ticks = 0
    at_last_report = 0
    seen = 0
    done = threading.Event()

    def count():
        nonlocal ticks
        while not done.is_set():
            ticks += 1
            time.sleep(0.001)

    def report(_):
        nonlocal at_last_report, seen
        seen += ticks > at_last_report
        if seen == 5:
            raise Enough
        at_last_report = ticks

    thread = threading.Thread(target=count)
    thread.start()
    try:
        with pytest.raises(Enough):
            sunfleck.run(with_arrays(), **ENDLESS, max_seconds=PATIENCE_S, progress=report)
    finally:
        done.set()
        thread.join()


def test_one_call_at_a_time():
    simulation = sunfleck.Simulation(with_arrays(), device="cpu")
    begun = threading.Event()
    enough = threading.Event()

    def report(_):
        begun.set()
        if enough.is_set():
            raise Enough

    def work():
        with pytest.raises(Enough):
            simulation.run(error=1e-7, progress=report)

    thread = threading.Thread(target=work)
    thread.start()
    assert begun.wait(PATIENCE_S)
    try:
        with pytest.raises(sunfleck.SunfleckError, match="already running in another thread"):
            simulation.run()
    finally:
        enough.set()
        thread.join()


def test_simulations_of_several_threads():
    expected = sunfleck.run(with_arrays(), grid=0.05, passes=8, device="cpu").table("triangles.csv")
    found = []
    work = lambda: found.append(sunfleck.run(with_arrays(), grid=0.05, passes=8, device="cpu").table("triangles.csv"))  # noqa: E731
    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [expected] * 4


def interrupt(work, is_ready=lambda: True):
    """Runs Python code that prints "begun", sends it Ctrl-C once it is ready, and returns the seconds that it takes to end."""
    code = (
        "import sys; sys.path.insert(0, sys.argv[1])\n"
        "import conftest, sunfleck\n"
        "try:\n"
        f"    {work}\n"
        "except KeyboardInterrupt:\n"
        "    print('interrupted', flush=True)\n"
    )
    child = subprocess.Popen([sys.executable, "-B", "-c", code, os.path.dirname(__file__)], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "begun\n"
    while not is_ready():
        time.sleep(0.01)
    child.send_signal(signal.SIGINT)
    begin = time.monotonic()
    rest, _ = child.communicate(timeout=PATIENCE_S)
    assert rest.splitlines()[-1] == "interrupted" and child.returncode == 0
    return time.monotonic() - begin


@pytest.mark.parametrize("device", ["cpu", "lavapipe"])
def test_interrupts_are_heard(device):
    interrupt(f"sunfleck.run(conftest.with_arrays(), error=1e-7, device={device!r}, progress=lambda _: print('begun', flush=True))")


def test_interrupts_end_pictures():
    result = "result = sunfleck.run(conftest.with_arrays(), **conftest.WORK)"
    begun = "print('begun', flush=True)"
    assert interrupt(f"{result}; {begun}; result.render(size=(8192, 8192), samples=256)") < 20.0, "it would take minutes"


def test_interrupts_while_a_result_is_saved(tmp_path):
    """What is written is whole, and the summary says that pictures are missing."""
    folder = tmp_path / "out"
    result = "result = sunfleck.run(conftest.with_arrays(), **conftest.WORK)"
    saving = f"print('begun', flush=True); result.save({str(folder)!r}, images='all')"
    interrupt(f"{result}; {saving}", is_ready=(folder / "summary.json").exists)
    summary = json.loads((folder / "summary.json").read_text())
    assert not summary["complete"] and summary["stopped"] == "interrupted"


ENDS_WITH_A_THREAD = """
import sys, threading, time
import sunfleck
from conftest import with_arrays

def loop():
    while True:
        sunfleck.run(with_arrays(), device="cpu", error=1e-7)

threading.Thread(target=loop, daemon=True).start()
time.sleep(0.5)
print("done")
sys.exit(0)
"""


def test_a_daemon_thread_ends_with_the_interpreter():
    here = os.path.dirname(__file__)
    ended = subprocess.run([sys.executable, "-c", ENDS_WITH_A_THREAD], cwd=here, capture_output=True, text=True, timeout=PATIENCE_S)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "done\n", "")


def test_threads_write_netcdf_one_after_the_other(tmp_path):
    results = [sunfleck.run(with_arrays(), device="cpu", error=0.1, seed=seed) for seed in (1, 2)]
    failures = []

    def save(number):
        try:
            for _ in range(8):
                results[number].save(tmp_path / str(number), export=["nc"])
        except Exception as error:
            failures.append(error)

    threads = [threading.Thread(target=save, args=(number,)) for number in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures
    for number in range(2):
        assert (tmp_path / str(number) / "results.nc").stat().st_size > 1000


def test_a_bad_progress_changes_no_light():
    simulation = sunfleck.Simulation(with_arrays(), device="cpu")
    before = simulation.sun
    with pytest.raises(sunfleck.InputError, match="progress: int"):
        simulation.run(sun={"elevation": 20.0, "azimuth": 90.0}, progress=1)
    assert simulation.sun == before
