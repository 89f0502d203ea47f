#!/usr/bin/env python3
"""Makes Markdown tables from the measurements of report.sh: ratios to Embree, growth, whole runs, memory. All figures are medians."""

import argparse
import datetime
import json
import pathlib
import platform
import re
import resource
import statistics
import subprocess
import sys
import tempfile
from multiprocessing import get_context

PAPER = "scenes/maize_sparse.toml"
TITLES = {"cpu": "CPU path", "device": "Vulkan path", "embree1": "Embree, one ray at a time"}
COLOURS = {"cpu": "#0072b2", "device": "#d55e00", "embree1": "#666666"}
DASHES = {"beam": 1, "leaf": 2}
RAYS = {"beam": "sun's beam", "leaf": "packets from leaves"}
# Bounds of the table in the README: required values and goals.
GOALS = {
    "beam/device": (0.50, 0.65),
    "leaf/device": (0.45, 0.60),
    "beam/cpu": (1.2, 2.0),
    "leaf/cpu": (0.9, 1.1),
}


def medians(file):
    """Returns {name: {"ms": median wall time, counters...}} from a file of Google Benchmark."""
    runs = {}
    for run in json.loads(file.read_text())["benchmarks"]:
        if run["run_type"] == "iteration":
            name = re.sub(r"/(iterations:\d+|repeats:\d+|process_time|real_time)", "", run["run_name"])
            runs.setdefault(name, []).append(run)
    return {
        name: {key: statistics.median(run[key] for run in of) for key in of[0] if isinstance(of[0][key], float)}
        for name, of in runs.items()
    }


def table(head, rows):
    """Returns the lines of a table whose numbers are given as text."""
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rows]
    return "\n".join("| " + " | ".join(row) + " |" for row in lines) + "\n"


def verdict(ratio, must, aim):
    return "aim" if ratio >= aim else "must" if ratio >= must else "short"


def million_rays(entry):
    return f"{entry['items_per_second'] / 1e6:.2f}"


def tracing(ratios):
    rows = []
    for plot in ("endless", "single"):
        for rays in ("beam", "leaf", "random"):
            embree = ratios[f"trace/{rays}/{plot}/embree1"]["items_per_second"]
            row = [f"{rays}, {plot}", f"{embree / 1e6:.2f}"]
            for who in ("embree8", "cpu", "device"):
                entry = ratios.get(f"trace/{rays}/{plot}/{who}")
                if entry is None:
                    row.append("")
                    continue
                ratio = entry["items_per_second"] / embree
                goal = GOALS.get(f"{rays}/{who}") if plot == "endless" else None
                row.append(f"{ratio:.2f}" + (f" ({verdict(ratio, *goal)})" if goal else ""))
            rows.append(row)
    return table(["rays, plot", "Embree 1, M/s", "Embree 8 / 1", "CPU path / Embree 1", "device / Embree 1"], rows)


def copies(ratios):
    rows = []
    for name, entry in sorted(ratios.items()):
        if name.startswith("copies/") and name.endswith("/shared"):
            _, rays, who, _ = name.split("/")
            own = ratios[name.removesuffix("shared") + "own"]
            ratio = entry["items_per_second"] / own["items_per_second"]
            rows.append([f"{rays}, {who}", f"{own['items_per_second'] / 1e6:.2f}", f"{ratio:.2f} ({verdict(ratio, 0.7, 1.0)})"])
    return table(["64 copies of a plant", "own triangles, M/s", "shared / own (must 0.7, aim 1)"], rows)


def building(ratios):
    rows = []
    for plants in (16, 158):
        ours = ratios[f"build/sunfleck/plants:{plants}"]
        embree = ratios[f"build/embree/plants:{plants}"]
        rows.append([f"{ours['triangles']:,.0f}", f"{ours['real_time']:.0f}", f"{embree['real_time']:.0f}",
                     f"{ours['real_time'] / embree['real_time']:.1f}"])
    return table(["triangles", "tree, ms", "Embree commit, ms", "ratio (must 8, aim 4)"], rows)


def safeguards(ratios):
    rows = []
    for name, entry in sorted(ratios.items()):
        if name.startswith("safeguard/") and name.endswith("/with"):
            _, what, who, _ = name.split("/")
            without = ratios[name.removesuffix("with") + "without"]
            rows.append([f"{what.replace('_', ' ')}, {who}", f"{100 * (entry['real_time'] / without['real_time'] - 1):+.1f} %"])
    return table(["safeguard", "cost"], rows)


def features(runs):
    rows = []
    for name, entry in runs.items():
        if name.startswith("feature/"):
            _, what, who = name.split("/")
            plain = runs[f"feature/plain/{who}"]
            rows.append([f"{what.replace('_', ' ')}, {who}", f"{entry['real_time'] / 1e3:.2f}",
                         f"{entry['real_time'] / plain['real_time']:.2f}"])
    return table(["simulation of fixed work", "s", "relative to plain"], rows)


def growth(grown):
    rows = []
    whos = sorted({name.split("/")[2] for name in grown}, reverse=True)
    for rays in ("beam", "leaf"):
        first = {}
        for plants in sorted({int(name.split(":")[1]) for name in grown}):
            row = [f"{rays}, {grown[f'growth/{rays}/cpu/plants:{plants}']['triangles']:,.0f}"]
            for who in whos:
                entry = grown[f"growth/{rays}/{who}/plants:{plants}"]
                ns = 1e9 / entry["items_per_second"]
                row.append(f"{ns:.0f} ({ns / first.setdefault(who, ns):.2f})")
            rows.append(row)
    return table(["rays, triangles"] + [f"{who}, ns a ray" for who in whos], rows)


def plot_growth(grown, file):
    """Plots time per ray against triangles, log-log, with a line for each tracer and kind of rays."""
    lines = sorted({tuple(name.split("/")[1:3]) for name in grown})
    script = [f'set terminal pngcairo size 1000,640 font "DejaVu Sans,13"; set output "{file}"',
              'set logscale xy; set grid; set key left top reverse Left; set format x "10^{%T}"',
              'set xlabel "Triangles"; set ylabel "Time of a ray (ns)"; set xrange [2e4:2e7]; set yrange [30:5000]']
    blocks = []
    for rays, who in lines:
        points = sorted((entry["triangles"], 1e9 / entry["items_per_second"]) for name, entry in grown.items()
                        if name.split("/")[1:3] == [rays, who])
        blocks.append("\n".join(f"{x} {y}" for x, y in points) + "\ne\n")
    titles = ", ".join(f'"-" using 1:2 with linespoints lw 2 lc rgb "{COLOURS[who]}" dt {DASHES[rays]} pt 7 '
                       f'title "{TITLES[who]}, {RAYS[rays]}"' for rays, who in lines)
    subprocess.run(["gnuplot"], input="\n".join(script) + "\nplot " + titles + "\n" + "".join(blocks), text=True, check=True)


def run_once(command):
    """Returns the peak memory, bytes, of a command that must succeed."""
    subprocess.run(command, check=True, capture_output=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024


def peak_bytes(command):
    with get_context("spawn").Pool(1) as pool:  # a fresh parent, since the peak is that of all its children
        return pool.apply(run_once, (command,))


def memory(program, device, folder):
    """Returns the bytes per triangle of a direct-only run: the slope between two generated fields."""
    peaks = []
    for plants in (16, 158):
        rows = {16: 4, 158: 79}[plants]
        scene = folder / f"field{plants}.toml"
        per_row = plants // rows
        scene.write_text(
            f'[plot]\nsize = [{0.6 * per_row:.1f}, {0.6 * rows:.1f}]\nperiodic = true\n[sun]\nelevation = 53.0\nazimuth = 120.0\n'
            '[[band]]\nname = "PAR"\ndirect = 350.0\n[soil]\nreflectance = { PAR = 0.0 }\npatch = 0.02\n'
            "[optics.leaf]\nreflectance = { PAR = 0.0 }\ntransmittance = { PAR = 0.0 }\n"
            "[optics.stem]\nreflectance = { PAR = 0.0 }\ntransmittance = { PAR = 0.0 }\n"
            f'[[geometry]]\ngenerator = "maize"\nrows = {rows}\nper_row = {per_row}\nspacing = [0.6, 0.6]\nseed = 1\n')
        out = folder / f"field{plants}"
        peak = peak_bytes([program, "run", str(scene), "-o", str(out), "--device", device, "--images", "none", "--error", "0.01"])
        peaks.append((json.loads((out / "summary.json").read_text())["triangles"], peak))
    (few, small), (many, big) = peaks
    rows = [[f"{triangles:,}", f"{peak / 2**20:.0f} MiB"] for triangles, peak in peaks]
    rows.append(["slope (must 200, aim 120)", f"{(big - small) / (many - few):.0f} B a triangle"])
    return table(["triangles", "peak memory of a direct-only run"], rows)


def whole_run(program, device, folder, runs):
    who = "cpu" if device == "cpu" else "device"
    solve = runs[f"solve/paper/{who}"]
    host = 1 - solve["tracing"] * 1e3 / solve["real_time"]
    rows = []
    for images in ([], ["--images", "none"]):
        shares, totals = [], []
        for _ in range(3):
            out = folder / "paper"
            subprocess.run([program, "run", PAPER, "-o", str(out), "--device", device, *images], check=True, capture_output=True)
            seconds = json.loads((out / "summary.json").read_text())["seconds"]
            simulated = seconds["direct"] + seconds["indirect"]
            shares.append((seconds["total"] - simulated * (1 - host)) / seconds["total"])
            totals.append(seconds["total"])
        rows.append(["without pictures" if images else "with its pictures", f"{statistics.median(totals):.1f}",
                     f"{100 * statistics.median(shares):.0f} %", f"{100 * host:.0f} %"])
    return table(["`run` of the paper's scene", "s", "outside tracing (must 30 %, aim 15 %)", "host's share of the simulation"], rows)


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return platform.machine()


def main():
    arguments = argparse.ArgumentParser()
    for name in ("--build", "--device", "--work"):
        arguments.add_argument(name, required=True)
    arguments.add_argument("--plot", help="file of the growth's picture")
    options = arguments.parse_args()
    work = pathlib.Path(options.work)
    program = str(pathlib.Path(options.build) / "sunfleck")
    ratios, runs, grown = (medians(work / f"{name}.json") for name in ("ratios", "runs", "growth"))
    if options.plot:
        plot_growth(grown, options.plot)
    context = json.loads((work / "ratios.json").read_text())["context"]
    print(f"{processor()}, {context['num_cpus']} threads; {context.get('device', 'no Vulkan device')}, "
          f"{context.get('driver', '')}; {datetime.date.today()}\n")
    with tempfile.TemporaryDirectory() as folder:
        for part in (tracing(ratios), copies(ratios), building(ratios), safeguards(ratios), growth(grown), features(runs),
                     whole_run(program, options.device, pathlib.Path(folder), runs),
                     memory(program, options.device, pathlib.Path(folder))):
            print(part)
    return 0


if __name__ == "__main__":
    sys.exit(main())
