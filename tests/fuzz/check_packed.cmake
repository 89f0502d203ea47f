# Fails unless the corpus folder holds one archive for each target and nothing else, because any other file would never be
# replayed: cmake -D CORPUS=... -D TARGETS="scene;obj" -P check_packed.cmake
cmake_minimum_required(VERSION 3.25)

set(expected ${TARGETS})
list(TRANSFORM expected APPEND .tar.xz)
file(GLOB_RECURSE found RELATIVE ${CORPUS} ${CORPUS}/*)
foreach(name ${found})
  if(NOT name IN_LIST expected)
    message(SEND_ERROR "${name} is no target's archive; pack new files with tests/fuzz/run.sh --merge")
  endif()
endforeach()
foreach(name ${expected})
  if(NOT name IN_LIST found)
    message(SEND_ERROR "${name} is missing")
  endif()
endforeach()
