#!/usr/bin/env bash
# Checks the program on a real GPU and measures which choices are best there, in one go:
#   tests/bench/gpu_check.sh [--device NAME] [FILE.md]
# Builds, runs the agreement tests and `validate` on that device, compares ten million hits and the tables of eleven scenes with the
# CPU path, measures rays per second with each choice (tree fetch, workgroup size), rounds of packets on the device and on the host in
# four stands, the host's part, the time to a picture and runs on 1, 2, 4 ... cores; writes Markdown tables. Without --device it takes
# the first device that is not software; `--device lavapipe` tries the script itself. Exits with status 3 if there is no such device.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

device=gpu
if [ "${1:-}" = --device ]; then
  device="$2"
  shift 2
fi
out="${1:-/dev/stdout}"

build=build/ci
[ -f "$build/build.ninja" ] || cmake --preset ci
cmake --build "$build" --target sunfleck sunfleck_bench agreement_tests

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
# Fails with the program's own message and status if there is no such device.
"$build/sunfleck" run scenes/maize_sparse.toml --grid 0.05 -o "$work/first" --device "$device" --images none --quiet
name="$(python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["device"]["name"])' "$work/first/summary.json")"
echo "device: $name" >&2

"$build/sunfleck" validate --device "$device" >&2
SUNFLECK_TEST_DEVICE="$name" SUNFLECK_REQUIRE_DEVICE=1 ctest --test-dir "$build" -L '^agreement$' --output-on-failure >&2

"$build/tests/bench/sunfleck_bench" --device="$name" --benchmark_filter='^(device|rounds|trace/.*/(cpu|device)|solve/paper/device)' \
  --benchmark_repetitions=5 --benchmark_min_time=0.2 --benchmark_enable_random_interleaving=true \
  --benchmark_out="$work/device.json" --benchmark_out_format=json >&2

PYTHONDONTWRITEBYTECODE=1 python3 tests/bench/gpu_report.py --program "$build/sunfleck" --device "$name" --measured "$work/device.json" > "$work/report.md"
cat "$work/report.md" > "$out"
