# Compiler settings every target of ours is built with.
add_library(sunfleck_options INTERFACE)
# Contraction of a*b+c would make CPU and GPU differ in the last bit; see shaders/shared/bridge.h.
target_compile_options(sunfleck_options INTERFACE -ffp-contract=off -Wall -Wextra -Wshadow -Wno-missing-field-initializers)
if(SUNFLECK_WERROR)
  target_compile_options(sunfleck_options INTERFACE -Werror)
endif()
if(SUNFLECK_SANITIZE)
  target_compile_options(sunfleck_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(sunfleck_options INTERFACE -fsanitize=address,undefined)
endif()
target_include_directories(sunfleck_options INTERFACE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/shaders)

# One static library a folder: sunfleck_folder(<name> SOURCES ... USES <targets>)
function(sunfleck_folder name)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES" ${ARGN})
  add_library(sunfleck_${name} STATIC ${ARG_SOURCES})
  target_link_libraries(sunfleck_${name} PUBLIC ${ARG_USES} PRIVATE sunfleck_options)
endfunction()
