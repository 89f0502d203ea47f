# Unpacks one target's corpus into a separate folder: cmake -D ARCHIVE=NAME.tar.xz -D FOLDER=... -D STAMP=... -P unpack.cmake
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
file(ARCHIVE_EXTRACT INPUT ${ARCHIVE} DESTINATION ${FOLDER})
file(GLOB files ${FOLDER}/*)
if(NOT files)
  message(FATAL_ERROR "${ARCHIVE}: it holds no file; restore it from the repository")
endif()
file(TOUCH ${STAMP})
