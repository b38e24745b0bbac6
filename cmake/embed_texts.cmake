# embed_texts(OUT HEADER ... NAMESPACE ... FOLDER ... LISTS name=a.toml,b.toml ...): generates a C++ source
# that contains the texts of the files in each list, and sets the variable OUT to the path of this source.
function(embed_texts out)
  cmake_parse_arguments(ARG "" "HEADER;NAMESPACE;FOLDER" "LISTS" ${ARGN})
  string(REPLACE "::" "_" source ${ARG_NAMESPACE})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${source}_embedded.cpp)
  string(REGEX REPLACE "[^=;]+=" "" files "${ARG_LISTS}")
  string(REPLACE "," ";" files "${files}")
  list(TRANSFORM files PREPEND ${ARG_FOLDER}/)
  set(script ${CMAKE_SOURCE_DIR}/cmake/embed.cmake)
  add_custom_command(
    OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -DHEADER=${ARG_HEADER} -DNAMESPACE=${ARG_NAMESPACE} -DFOLDER=${ARG_FOLDER}
            "-DTEXTS=${ARG_LISTS}" -DOUT=${source} -P ${script}
    DEPENDS ${files} ${script}
    VERBATIM)
  set(${out} ${source} PARENT_SCOPE)
endfunction()
