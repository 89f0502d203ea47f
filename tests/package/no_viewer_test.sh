#!/usr/bin/env bash
# Configures the program without its window and its Python module, as on a machine without GLFW, Dear ImGui and pybind11, and
# checks that the main program compiles so: no_viewer_test.sh SOURCE_FOLDER BUILD_FOLDER
set -euo pipefail
source_folder="$1" build="$2"
rm -rf "$build"
cmake -S "$source_folder" -B "$build" -G Ninja -DSUNFLECK_TESTS=OFF -DSUNFLECK_VIEWER=OFF -DSUNFLECK_PYTHON_MODULE=OFF \
  > /dev/null
if grep -iE 'glfw|imgui|pybind11' "$build/build.ninja"; then
  echo "build.ninja names a library of the window or of Python" >&2
  exit 1
fi
# Runs the command of one file alone: building even one object by ninja would build all libraries that its target links.
compile=$(sed -n 's/^  "command": "\(.* [^ ]*programs\/main\.cpp\)",$/\1/p' "$build/compile_commands.json" | sed 's/\\"/"/g')
[ -n "$compile" ] || { echo "compile_commands.json has no command for programs/main.cpp" >&2; exit 1; }
cd "$build"
eval "$compile -fsyntax-only"
