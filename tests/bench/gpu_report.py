#!/usr/bin/env python3
"""Makes the table of gpu_check.sh from medians: agreement, rays per second by choice, the host's part, time to a picture."""

import argparse
import datetime
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

from report import medians, million_rays, table

SCENE = "scenes/maize_sparse.toml"


def agreement(measured):
    rows = [[rays, f"{measured[f'device/agree/{rays}']['traced']:,.0f}", f"{measured[f'device/agree/{rays}']['differ']:,.0f}"]
            for rays in ("beam", "leaf")]
    return table(["rays", "traced on CPU path and device", "landings that differ (aim 0)"], rows)


def rates(measured):
    names = [name for name in measured if name.startswith(("trace/", "device/fetch/", "device/group/"))]
    return table(["rays, plot or choice", "million rays/s"], [[name.replace("/", ", "), million_rays(measured[name])] for name in names])


def seconds_of(command):
    start = time.monotonic()
    subprocess.run(command, check=True, capture_output=True)
    return time.monotonic() - start


def whole(program, device, solve, folder):
    result = folder / "paper"
    run = [program, "run", SCENE, "-o", str(result), "--device", device, "--images", "none", "--export", "csv"]
    render = [program, "render", SCENE, "-o", str(folder / "picture.png"), "--device", device, "--size", "1600x1200",
              "--error", "0.02"]
    host_s = (solve["real_time"] - solve["tracing"] * 1e3) / 1e3
    rows = [["simulation of the paper's scene", f"{solve['real_time'] / 1e3:.2f}"],
            ["of it the host's part", f"{host_s:.2f}"],
            ["`run` of it, without pictures", f"{statistics.median(seconds_of(run) for _ in range(3)):.2f}"],
            ["scene to a picture of 1600 x 1200, error 2 %", f"{statistics.median(seconds_of(render) for _ in range(3)):.2f}"]]
    return table(["", "s"], rows)


def main():
    arguments = argparse.ArgumentParser()
    for name in ("--program", "--device", "--measured"):
        arguments.add_argument(name, required=True)
    options = arguments.parse_args()
    measured = medians(pathlib.Path(options.measured))
    print(f"{options.device}, {datetime.date.today()}\n")
    with tempfile.TemporaryDirectory() as folder:
        for part in (agreement(measured), rates(measured),
                     whole(options.program, options.device, measured["solve/paper/device"], pathlib.Path(folder))):
            print(part)
    return 0


if __name__ == "__main__":
    sys.exit(main())
