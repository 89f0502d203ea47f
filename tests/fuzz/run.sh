#!/usr/bin/env bash
# Builds the fuzzers of users' files, unpacks the kept corpus (tests/fuzz/corpus/TARGET.tar.xz) and runs each fuzzer on it, two at
# a time:
#   tests/fuzz/run.sh [SECONDS] [TARGET...]     600 seconds and all targets by default
# Prints executions and findings; exits with status 1 if there is any finding. Needs Debian's clang, libclang-rt-14-dev and xz-utils.
# New inputs are kept in build/fuzz/corpus, inputs that ended a fuzzer in build/fuzz/findings. To add them to the corpus:
#   tests/fuzz/run.sh --merge [TARGET...]       packs the smallest files that reach as much as the kept and the new ones
# Equal files give equal archives.
set -euo pipefail
cd "$(dirname "$0")/../.."

build=build/fuzz
packed=tests/fuzz/corpus
kept=$build/tests/fuzz/corpus  # unpacked by the build
all=$(sed -n 's/^set(SUNFLECK_FUZZ_TARGETS \(.*\))$/\1/p' tests/fuzz/CMakeLists.txt)

merge=no
if [ "${1:-}" = --merge ]; then
  merge=yes
  shift
else
  seconds=${1:-600}
  shift || true
fi
targets=${*:-$all}

CC=clang CXX=clang++ cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSUNFLECK_FUZZ=ON -DSUNFLECK_UNITY=ON > /dev/null
# shellcheck disable=SC2046,SC2086
cmake --build "$build" --target fuzz_corpus $(printf 'fuzz_%s ' $targets)

# pack FOLDER ARCHIVE
pack() {
  tar --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX -cf - -C "$1" . | xz -9e -T1 > "$2"
}

merge_one() {
  local target=$1 smallest
  smallest=$(mktemp -d)
  mkdir -p "$build/corpus/$target"
  "$build/tests/fuzz/fuzz_$target" -merge=1 -use_counters=0 "$smallest" "$kept/$target" "$build/corpus/$target" 2> /dev/null
  pack "$smallest" "$packed/$target.tar.xz"
  printf '%-14s %5s files before, %5s after\n' "$target" "$(find "$kept/$target" -type f | wc -l)" \
    "$(find "$smallest" -type f | wc -l)"
  rm -r "$smallest"
}

run_one() {
  local target=$1 words=tests/fuzz/dictionaries/$1.dict dictionary=() found state=0
  mkdir -p "$build/corpus/$target" "$build/findings/$target"
  [ ! -f "$words" ] || dictionary=("-dict=$words")  # libFuzzer refuses an empty one
  "$build/tests/fuzz/fuzz_$target" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=1024 \
    -max_len=4096 "${dictionary[@]}" -print_final_stats=1 -artifact_prefix="$build/findings/$target/" \
    "$build/corpus/$target" "$kept/$target" > "$build/$target.log" 2>&1 || state=$?
  found=$(find "$build/findings/$target" -type f | wc -l)
  printf '%-14s %10s executions, %s findings\n' "$target" \
    "$(sed -n 's/^stat::number_of_executed_units: *//p' "$build/$target.log")" "$found"
  [ "$state" -eq 0 ]
}

export -f run_one merge_one
export build kept seconds="${seconds:-}"
if [ "$merge" = yes ]; then
  for target in $targets; do merge_one "$target"; done
else
  # shellcheck disable=SC2086
  printf '%s\n' $targets | xargs -P 2 -I{} bash -euo pipefail -c 'run_one {}' \
    || { echo "a fuzzer ended early; see $build/findings and the logs beside it" >&2; exit 1; }
fi
