#!/usr/bin/env bash
# Measures all figures of the engine's speed and writes one Markdown table of ratios:
#   tests/bench/report.sh [--device NAME] [--build DIR] [--plot GROWTH.png] [FILE.md]
# NAME is a device as for `sunfleck run`, lavapipe by default; DIR holds the program and its tests, build/ci by default. Takes
# a quarter of an hour on two cores, which should have nothing else to do.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

device=lavapipe
build=build/ci
plot=()
while [ $# -gt 0 ]; do
  case "$1" in
    --device) device="$2"; shift 2 ;;
    --build) build="$2"; shift 2 ;;
    --plot) plot=(--plot "$2"); shift 2 ;;
    -*) echo "report.sh: '$1' (no such option); use --device NAME, --build DIR or --plot FILE" >&2; exit 2 ;;
    *) break ;;
  esac
done
out="${1:-/dev/stdout}"

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

# measure GROUPS REPETITIONS NAME [option ...]
measure() {
  "$build/tests/bench/sunfleck_bench" --device="$device" --benchmark_filter="^($1)/" --benchmark_repetitions="$2" \
    --benchmark_min_time=0.2 "${@:4}" --benchmark_out="$work/$3.json" --benchmark_out_format=json > "$work/$3.log" ||
    { cat "$work/$3.log" >&2; exit 1; }
}
# The repetitions of a group's measurements take turns, so that a noisy machine affects all of them; but large canopies are made
# only once.
measure 'trace|copies|build|safeguard' 5 ratios --benchmark_enable_random_interleaving=true
measure 'feature|solve' 3 runs --benchmark_enable_random_interleaving=true
measure growth 3 growth

PYTHONDONTWRITEBYTECODE=1 python3 tests/bench/report.py --build "$build" --device "$device" --work "$work" "${plot[@]}" > "$work/report.md"
cat "$work/report.md" > "$out"
