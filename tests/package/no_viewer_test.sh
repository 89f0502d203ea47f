#!/usr/bin/env bash
# Configures the program without its window and its Python module, as on a machine without GLFW, Dear ImGui and pybind11, and
# builds the replacement for the window: no_viewer_test.sh SOURCE_FOLDER BUILD_FOLDER
set -euo pipefail
source_folder="$1" build="$2"
rm -rf "$build"
cmake -S "$source_folder" -B "$build" -G Ninja -DSUNFLECK_TESTS=OFF -DSUNFLECK_VIEWER=OFF -DSUNFLECK_PYTHON_MODULE=OFF \
  > /dev/null
cmake --build "$build" --target src/viewer/CMakeFiles/sunfleck_viewer.dir/no_view.cpp.o > /dev/null
if grep -iE 'glfw|imgui|pybind11' "$build/build.ninja"; then
  echo "build.ninja names a library of the window or of Python" >&2
  exit 1
fi
