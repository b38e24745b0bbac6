# canhil_generate(TARGET name DBC file [NAMESPACE ns] [HEADER dir/name.hpp]): creates a library with the
# codecs for the messages of a DBC file. Targets that link this library can #include "dir/name.hpp" (default:
# messages/NAME.hpp, namespace NAME). The build fails if the DBC file is malformed or breaks a rule of
# docs/dbc.md.
function(canhil_generate)
  cmake_parse_arguments(ARG "" "TARGET;DBC;NAMESPACE;HEADER" "" ${ARGN})
  if(NOT ARG_TARGET OR NOT ARG_DBC)
    message(FATAL_ERROR "canhil_generate: expected TARGET name DBC file")
  endif()
  if(NOT ARG_NAMESPACE)
    set(ARG_NAMESPACE ${ARG_TARGET})
  endif()
  if(NOT ARG_HEADER)
    set(ARG_HEADER messages/${ARG_TARGET}.hpp)
  endif()
  cmake_path(ABSOLUTE_PATH ARG_DBC)
  set(root ${CMAKE_CURRENT_BINARY_DIR}/generated)
  set(header ${root}/${ARG_HEADER})
  cmake_path(REPLACE_EXTENSION header LAST_ONLY cpp OUTPUT_VARIABLE source)
  cmake_path(GET header PARENT_PATH folder)
  file(MAKE_DIRECTORY ${folder})
  add_custom_command(
    OUTPUT ${header} ${source}
    COMMAND canhil::dbcgen ${ARG_DBC} --namespace ${ARG_NAMESPACE} --output ${header} --source ${source} --include ${ARG_HEADER}
    DEPENDS canhil::dbcgen ${ARG_DBC}
    COMMENT "dbcgen ${ARG_HEADER}"
    VERBATIM)
  add_custom_target(${ARG_TARGET}_header DEPENDS ${header})
  add_library(${ARG_TARGET} STATIC ${source})
  target_include_directories(${ARG_TARGET} PUBLIC $<BUILD_INTERFACE:${root}>)
  target_link_libraries(${ARG_TARGET} PUBLIC canhil::wire)
  add_dependencies(${ARG_TARGET} ${ARG_TARGET}_header)
endfunction()
