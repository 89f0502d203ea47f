# Compiles a GLSL compute shader to SPIR-V and embeds it as a C++ header with an array named <name>_spirv.
# sunfleck_shader(<target> <name> <source> [DEFINES ...])
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)

function(sunfleck_shader target name source)
  cmake_parse_arguments(ARG "" "" "DEFINES" ${ARGN})
  list(TRANSFORM ARG_DEFINES PREPEND "-D")
  set(header ${CMAKE_BINARY_DIR}/embedded/${name}.spirv.h)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/embedded)
  add_custom_command(
    OUTPUT ${header}
    COMMAND ${GLSLANG_VALIDATOR} -V --quiet --target-env vulkan1.2 -I${PROJECT_SOURCE_DIR}/shaders ${ARG_DEFINES}
            --depfile ${header}.d --vn ${name}_spirv -o ${header} ${source}
    DEPENDS ${source}
    DEPFILE ${header}.d
    COMMENT "SPIR-V ${name}")
  target_sources(${target} PRIVATE ${header})
endfunction()
