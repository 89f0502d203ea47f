# Embeds a file: sunfleck_embed(<target> <name> <file>) gives the target's sources the header "<name>.h" with the array
# `constexpr unsigned char <name>[]`. The array is written at build time by this same file, run as a script.

if(CMAKE_SCRIPT_MODE_FILE)
  file(READ ${SOURCE} bytes HEX)
  string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  file(WRITE ${HEADER} "#pragma once\nnamespace sunfleck {\nconstexpr unsigned char ${NAME}[] = {\n${bytes}\n};\n}\n")
  return()
endif()

set(SUNFLECK_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

function(sunfleck_embed target name file)
  set(header ${CMAKE_CURRENT_BINARY_DIR}/embedded/${name}.h)
  file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  add_custom_command(
    OUTPUT ${header}
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${file} -DHEADER=${header} -DNAME=${name} -P ${SUNFLECK_EMBED_SCRIPT}
    DEPENDS ${file} ${SUNFLECK_EMBED_SCRIPT}
    VERBATIM
    COMMENT "Embedding ${file}")
  target_sources(${target} PRIVATE ${header})
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/embedded)
endfunction()
