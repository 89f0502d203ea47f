#!/usr/bin/env bash
# Which lines of src the tests execute: scripts/coverage.sh [ctest options]
# Builds with counters in build/coverage, runs all tests but the long ones (or those that ctest's options choose), prints the
# share of lines by file, and fails below 85 %. SUNFLECK_COVERAGE_TARGETS: what to build instead of everything.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
least=85

[ -f build/coverage/build.ninja ] || cmake --preset coverage
read -r -a targets <<< "${SUNFLECK_COVERAGE_TARGETS:-all}"
cmake --build --preset coverage --target "${targets[@]}"
find build/coverage -name '*.gcda' -delete
if [ $# -eq 0 ]; then set -- -LE long; fi
ctest --test-dir build/coverage --output-on-failure --no-tests=error --parallel "$(nproc)" "$@"
gcovr --root . --filter src/ --object-directory build/coverage --sort-percentage --fail-under-line "$least" build/coverage
