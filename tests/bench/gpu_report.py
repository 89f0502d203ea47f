#!/usr/bin/env python3
"""Makes the tables of gpu_check.sh from medians: agreement, rays per second by choice, the host's part, times of whole runs."""

import argparse
import datetime
import filecmp
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

from report import medians, million_rays, table

SCENE = "scenes/maize_sparse.toml"
COMPARED = ["maize_sparse", "maize_dense", "maize_overcast", "two_squares", "single_leaf", "chamber", "panels", "furnace_box",
            "checkerboard"]

# Scenes in which packets start on copies that share triangles and pass a receiver, or are aimed at a small stand.
POTTED_PLANT = """
[sun]
elevation = 50.0
azimuth   = 120.0
[sky]
model = "cie-overcast"
[[band]]
name    = "PAR"
direct  = 300.0
diffuse = 100.0
[soil]
reflectance = 0.15
[optics.leaf]
reflectance   = 0.12
transmittance = 0.06
[optics.stem]
reflectance = 0.12
[optics.clay]
reflectance = 0.3
role        = "structure"
[optics.peat]
reflectance = 0.1
role        = "soil"
[[geometry]]
file = "potted_plant.obj"
"""
MADE = {
    "copies": "[plot]\nsize = [2.0, 2.0]\n[[plane]]\nheight = 0.2\ncells = [20, 20]\n" + POTTED_PLANT + "instances = true\nat = ["
    + ", ".join(f"[{x / 4}, 0.0, {z / 4}]" for x in range(8) for z in range(8)) + "]\n",
    "lone_plant": "[plot]\nsize = [9.0, 9.0]\nperiodic = false\n" + POTTED_PLANT + "at = [[4.5, 0.0, 4.5]]\n",
}


def agreement(measured):
    rows = [[rays, f"{measured[f'device/agree/{rays}']['traced']:,.0f}", f"{measured[f'device/agree/{rays}']['differ']:,.0f}"]
            for rays in ("beam", "leaf")]
    return table(["rays", "traced on CPU path and device", "landings that differ (aim 0)"], rows)


def rates(measured):
    names = [name for name in measured if name.startswith(("trace/", "device/fetch/", "device/group/"))]
    return table(["rays, plot or choice", "million rays/s"], [[name.replace("/", ", "), million_rays(measured[name])] for name in names])


def rounds(measured):
    rows = []
    for name in (name for name in measured if name.startswith("rounds/")):
        run = measured[name]
        rate = 8 * run["packets"] / (run["real_time"] / 1e3)
        rows.append([name.removeprefix("rounds/").replace("/", ", rounds on the "), f"{rate / 1e6:.2f}", f"{run['cpu_time'] / 8:.1f}",
                     f"{run['submissions']:.0f}", f"{run['up'] / 1e6:.2f}", f"{run['down'] / 1e6:.2f}"])
    return table(["a replicate of 131,072 first packets", "million packets/s", "processor time, ms", "submissions", "MB up", "MB down"], rows)


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


def whole_tables(program, device, folder):
    """Compares the tables of whole runs on the CPU path and the device, byte by byte."""
    shutil.copy("scenes/potted_plant.obj", folder)
    for scene, text in MADE.items():
        (folder / f"{scene}.toml").write_text(text)
    scenes = [pathlib.Path(f"scenes/{scene}.toml") for scene in COMPARED] + [folder / f"{scene}.toml" for scene in MADE]
    rows = []
    for path in scenes:
        folders, scene = {}, path.stem
        for name in ("cpu", device):
            folders[name] = folder / f"{scene}_{len(folders)}"
            subprocess.run([program, "run", str(path), "-o", str(folders[name]), "--device", name, "--images", "none",
                            "--export", "csv", "--quiet"], check=True, capture_output=True)
        names = [path.name for path in folders["cpu"].glob("*.csv")]
        _, differ, missing = filecmp.cmpfiles(folders["cpu"], folders[device], names, shallow=False)
        rows.append([scene, str(len(names)), str(len(differ) + len(missing))])
    return table(["scene", "tables", "that differ from the CPU path's (aim 0)"], rows)


def cores(program, folder):
    """Times runs of the CPU path by number of threads."""
    rows = []
    for scene in COMPARED[:2]:
        for threads in [1, 2, 4, 8, 16, 32, 64]:
            if threads > (os.cpu_count() or 1):
                break
            run = [program, "run", f"scenes/{scene}.toml", "-o", str(folder / "cores"), "--device", "cpu", "--threads", str(threads),
                   "--images", "none", "--quiet"]
            rows.append([scene, str(threads), f"{statistics.median(seconds_of(run) for _ in range(3)):.2f}"])
    return table(["`run` on the CPU path", "threads", "s"], rows)


def main():
    arguments = argparse.ArgumentParser()
    for name in ("--program", "--device", "--measured"):
        arguments.add_argument(name, required=True)
    options = arguments.parse_args()
    measured = medians(pathlib.Path(options.measured))
    print(f"{options.device}, {datetime.date.today()}\n")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        for part in (agreement(measured), whole_tables(options.program, options.device, path), rates(measured), rounds(measured),
                     whole(options.program, options.device, measured["solve/paper/device"], path), cores(options.program, path)):
            print(part)
    return 0


if __name__ == "__main__":
    sys.exit(main())
