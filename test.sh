#!/usr/bin/env bash
# Installs what is missing, builds the program and its tests, and runs them: ./test.sh
# The unit tests run under the sanitizers alone. ./test.sh --full runs them optimised too, and adds clang-tidy, the tests labelled
# "long", the physics tests under the sanitizers, the thread sanitizer, the validation layer's thorough checks of the agreement
# tests, and the share of src's lines that tests execute.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

full=no
for argument in "$@"; do
  case "$argument" in
    --full) full=yes ;;
    *) echo "test.sh: '$argument' (no such option); use ./test.sh or ./test.sh --full" >&2; exit 2 ;;
  esac
done

if [ "$full" = yes ]; then scripts/install_packages.sh full; else scripts/install_packages.sh test; fi

echo "== format =="
find src shaders tests \( -name '*.h' -o -name '*.cpp' \) -not -path 'tests/data/*' -print0 |
  xargs -0 clang-format --dry-run --Werror

echo "== build =="
# Ninja would compile two sources more than there are processors, which then compete for their caches: that takes a sixth longer.
CMAKE_BUILD_PARALLEL_LEVEL="$(nproc)"
export CMAKE_BUILD_PARALLEL_LEVEL
if [ "$full" = yes ]; then
  cmake --preset ci -DSUNFLECK_UNIT_TESTS=ON -DSUNFLECK_LONG_TESTS=ON -DSUNFLECK_UNITY=OFF # clang-tidy reads each source by itself
elif [ ! -f build/ci/build.ninja ]; then
  cmake --preset ci -DSUNFLECK_UNIT_TESTS=OFF -DSUNFLECK_LONG_TESTS=OFF
fi
cmake --build --preset ci

if [ "$full" = yes ]; then
  echo "== clang-tidy =="
  run-clang-tidy -quiet -p build/ci "^$PWD/(src|tests)/" 2> /dev/null
fi

echo "== tests =="
export SUNFLECK_REQUIRE_DEVICE=1
# Some tests wait for windows and signals, so that one more than there are processors keeps these busy.
run_tests=(ctest --output-on-failure --no-tests=error --parallel "$(($(nproc) + 1))")
leave_out=(-LE long)
[ "$full" = no ] || leave_out=()
"${run_tests[@]}" --test-dir build/ci "${leave_out[@]}"

checked='^unit$'
built=unit_tests
if [ "$full" = yes ]; then
  checked='^(unit|physics)$'
  built='unit_tests physics_tests'
fi
echo "== ${built//_/ } under the address and undefined-behaviour sanitizers =="
[ -f build/asan/build.ninja ] || cmake --preset asan
# In large pages from jemalloc, clang takes a sixth less time.
# shellcheck disable=SC2086 # a list of targets
LD_PRELOAD=libjemalloc.so.2 MALLOC_CONF=thp:always,narenas:1 cmake --build --preset asan --target $built
"${run_tests[@]}" --test-dir build/asan -L "$checked" -LE long
[ "$full" = yes ] || exit 0

echo "== unit and physics tests under the thread sanitizer =="
[ -f build/tsan/build.ninja ] || cmake --preset tsan
cmake --build --preset tsan
# Runs without Vulkan, because the sanitizer does not see what a driver's threads do. The file lists the reports that it ignores.
VK_ICD_FILENAMES=/none SUNFLECK_REQUIRE_DEVICE=0 TSAN_OPTIONS="suppressions=$PWD/tests/threads/suppressions.txt" \
  "${run_tests[@]}" --test-dir build/tsan -L '^(unit|physics)$' -LE long

echo "== agreement tests with the validation layer's thorough checks =="
SUNFLECK_THOROUGH_VALIDATION=1 "${run_tests[@]}" --test-dir build/ci -L '^agreement$'

echo "== coverage =="
scripts/coverage.sh
