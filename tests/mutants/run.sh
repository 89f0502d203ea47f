#!/usr/bin/env bash
# Builds the program with one deliberate mistake at a time, in a separate folder, and expects it to be found:
# tests/mutants/run.sh [MUTANT ...]. Without names it takes every *.patch of this folder. The first line of a patch may say what
# finds it, such as "found by: validate differential": `sunfleck validate` on the CPU path and on software Vulkan, which is what a
# patch without that line asks for; the differential test of tests/long, which compares the CPU path with an independent tracer; or
# `rounds`, which compares each stage of a device's rounds with the host's.
# SUNFLECK_REQUIRE_DEVICE=1 makes the lack of software Vulkan an error.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
root="$(cd "$here/../.." && pwd)"

mutants=("$@")
if [ ${#mutants[@]} -eq 0 ]; then
  for patch in "$here"/*.patch; do mutants+=("$(basename "$patch" .patch)"); done
fi

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
mkdir "$work/source"
cp -a "$root/CMakeLists.txt" "$root/cmake" "$root/src" "$root/shaders" "$root/tests" "$work/source"
export CCACHE_BASEDIR="$work"
launcher=()
if command -v ccache > /dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
cmake -S "$work/source" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSUNFLECK_PYTHON_MODULE=OFF \
  "${launcher[@]}" > /dev/null

# Prints the cases that failed. Returns 0 if the mistake was found, 1 if not.
found_on() {
  local device="$1" status=0
  "$work/build/sunfleck" validate --quiet --device "$device" -o "$work/result" > "$work/failed.txt" 2> "$work/errors.txt" ||
    status=$?
  if [ "$status" -eq 3 ] && [ "${SUNFLECK_REQUIRE_DEVICE:-0}" != 1 ]; then
    echo "  $device: no such device, skipped"
    return 0
  fi
  if [ "$status" -ne 1 ] || ! grep -q FAIL "$work/failed.txt"; then
    echo "  $device: NOT FOUND (exit status $status)"
    cat "$work/errors.txt"
    return 1
  fi
  echo "  $device: found, $(grep -c FAIL "$work/failed.txt") cases fail:"
  sed 's/^/    /' "$work/failed.txt"
}

# Does the same for tests of an executable: found_by_tests NAME EXECUTABLE FILTER LINES, where LINES is a pattern of what they print.
found_by_tests() {
  local name="$1" executable="$2" filter="$3" lines="$4"
  if "$work/build/tests/$executable" --gtest_filter="$filter" > "$work/failed.txt" 2>&1; then
    echo "  $name: NOT FOUND"
    return 1
  fi
  if ! grep -q "$lines" "$work/failed.txt"; then
    echo "  $name: the test did not run"
    cat "$work/failed.txt"
    return 1
  fi
  echo "  $name: found, $(grep -c '^\[  FAILED  \].*ms)$' "$work/failed.txt") tests fail:"
  grep "$lines" "$work/failed.txt" | sed 's/^/    /'
}

build() {
  cmake --build "$work/build" --target "$1" > "$work/build.txt" 2>&1 || { cat "$work/build.txt"; exit 1; }
}

missed=0
for mutant in "${mutants[@]}"; do
  echo "== $mutant =="
  patch --quiet --fuzz=0 -p1 -d "$work/source" < "$here/$mutant.patch"
  finders="$(sed -n '1s/^found by: //p' "$here/$mutant.patch")"
  for finder in ${finders:-validate}; do
    case "$finder" in
      validate)
        build sunfleck
        for device in cpu lavapipe; do found_on "$device" || missed=$((missed + 1)); done
        ;;
      differential)
        build long_tests
        found_by_tests differential long/long_tests '*Differential*' 'rms z' || missed=$((missed + 1))
        ;;
      rounds)
        build agreement_tests
        found_by_tests rounds agreement/agreement_tests 'RoundsAgreement.*' '^\[  FAILED  \].*ms)$' || missed=$((missed + 1))
        ;;
      *)
        echo "  nothing is called $finder"
        missed=$((missed + 1))
        ;;
    esac
  done
  patch --quiet --reverse --fuzz=0 -p1 -d "$work/source" < "$here/$mutant.patch"
done
[ "$missed" -eq 0 ] || { echo "$missed mistakes not found"; exit 1; }
echo "every mistake was found"
