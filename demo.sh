#!/usr/bin/env bash
# Installs what is missing, builds the program and runs the main job: the light on a sparse maize stand.
# The last line of output names the folder with the results. Steps that are already done are not repeated.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

scene=scenes/maize_sparse.toml
results=results/maize_sparse
program=build/release/sunfleck
seal=results/maize_sparse.sha256 # checksums of the program, the scene and every result of the last demo

scripts/install_packages.sh run
[ -f build/release/build.ninja ] || cmake --preset release
cmake --build --preset release --parallel "$(nproc)" # more at a time would compete for the processors' caches

if [ -d "$results" ] && sha256sum --check --status "$seal" 2> /dev/null; then
  echo "The results are there and belong to this program and scene; delete $results to compute them again."
else
  rm -f "$seal"
  "$program" run "$scene" -o "$results"
  find "$program" "$scene" "$results" -type f -print0 | sort -z | xargs -0 sha256sum > "$seal"
fi
echo "$PWD/$results"
