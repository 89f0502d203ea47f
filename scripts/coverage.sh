#!/usr/bin/env bash
# Measures which lines of src the tests execute: scripts/coverage.sh [ctest options]
# Builds with counters in build/coverage, runs the tests (or those that ctest's options choose), prints the share of lines by
# file, and fails below 85 %. Leaves out the long tests, and the physics tests, whose statistics take most of an hour while
# threads share the counters, and hardly add to the share.
# SUNFLECK_COVERAGE_TARGETS names other targets to build instead of these tests.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
least=85
folders=(unit agreement regression extremes faults)

[ -f build/coverage/build.ninja ] || cmake --preset coverage
read -r -a targets <<< "${SUNFLECK_COVERAGE_TARGETS:-${folders[*]/%/_tests}}"
cmake --build --preset coverage --parallel "$(nproc)" --target "${targets[@]}"
find build/coverage -name '*.gcda' -delete
if [ $# -eq 0 ]; then set -- -L "^($(IFS='|'; echo "${folders[*]}"))\$" -LE long; fi
ctest --test-dir build/coverage --output-on-failure --no-tests=error --parallel "$(nproc)" "$@"
gcovr --root . --filter src/ --object-directory build/coverage --sort-percentage --fail-under-line "$least" build/coverage
