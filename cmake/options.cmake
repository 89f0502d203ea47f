# Compiler settings of all our targets.
add_library(sunfleck_options INTERFACE)
# Contraction of a*b+c would make CPU and GPU differ in the last bit; see shaders/shared/bridge.h.
target_compile_options(sunfleck_options INTERFACE -ffp-contract=off -Wall -Wextra -Wshadow -Wno-missing-field-initializers)
if(SUNFLECK_WERROR)
  target_compile_options(sunfleck_options INTERFACE -Werror)
endif()
if(SUNFLECK_SANITIZE)
  # What is left out takes about a third of the time to compile. The address sanitizer finds accesses through null and beyond objects
  # too, and the fuzz targets have all checks.
  target_compile_options(sunfleck_options INTERFACE
    -fsanitize=address,undefined -fno-sanitize=alignment,null,object-size,pointer-overflow,vptr -fno-sanitize-recover=all
    -fno-omit-frame-pointer)
  target_link_options(sunfleck_options INTERFACE -fsanitize=address,undefined)
endif()
if(SUNFLECK_THREAD_SANITIZE)
  target_compile_options(sunfleck_options INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(sunfleck_options INTERFACE -fsanitize=thread)
  target_include_directories(sunfleck_options BEFORE INTERFACE ${PROJECT_SOURCE_DIR}/tests/threads)
endif()
if(SUNFLECK_COVERAGE)
  target_compile_options(sunfleck_options INTERFACE --coverage -fprofile-update=atomic)
  target_link_options(sunfleck_options INTERFACE --coverage)
endif()
if(SUNFLECK_FUZZ)
  # The fuzzer observes every target; a number too large for its integer type counts as a finding too.
  target_compile_options(sunfleck_options INTERFACE
    -g -fsanitize=fuzzer-no-link,address,undefined,float-cast-overflow -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(sunfleck_options INTERFACE -fsanitize=address,undefined)
endif()
target_include_directories(sunfleck_options INTERFACE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/shaders)

# Returns in `targets` what is used: a folder of src, such as physics/bvh, stands for its target sunfleck_physics_bvh.
function(sunfleck_targets targets)
  list(TRANSFORM ARGN REPLACE "^(base|simulate|(physics|devices|files|pictures|simulate|programs)/.*)$" "sunfleck_\\0" OUTPUT_VARIABLE names)
  list(TRANSFORM names REPLACE "/" "_" REGEX "^sunfleck_")
  set(${targets} ${names} PARENT_SCOPE)
endfunction()

# Has the sources of a target compiled together, `batch` at a time, if SUNFLECK_UNITY is on: sunfleck_unity(<target> <batch>)
function(sunfleck_unity target batch)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${SUNFLECK_UNITY} UNITY_BUILD_BATCH_SIZE ${batch})
  if(SUNFLECK_UNITY)
    # GCC takes sources that are compiled together for headers, which must not name types of an anonymous namespace.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# Adds the static library of this folder of src, which links what it uses and no more:
# sunfleck_folder(SOURCES <files> USES <folders and libraries>)
function(sunfleck_folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES" ${ARGN})
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/src OUTPUT_VARIABLE folder)
  sunfleck_targets(target ${folder})
  sunfleck_targets(used ${ARG_USES})
  add_library(${target} STATIC ${ARG_SOURCES})
  target_link_libraries(${target} PUBLIC ${used} PRIVATE sunfleck_options)
  # Hardly any time is spent in these folders, and their libraries take long to compile: with sanitizers, longer than the tests that
  # use them take to run.
  if(folder MATCHES "^(programs/|simulate|files/)")
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
    if(SUNFLECK_SANITIZE OR SUNFLECK_THREAD_SANITIZE)
      target_compile_options(${target} PRIVATE -O0)
    endif()
  endif()
  sunfleck_unity(${target} 40)
endfunction()
