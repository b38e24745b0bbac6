# Precompiles large headers: those of the standard library, fmt and tl::expected; outside dbc also those of Eigen; for the tests also those of
# GoogleTest. They are then compiled once for all targets that share compiler options, not in each of some five hundred sources.
#
# Only for one-off builds (CANHIL_TOGETHER, the sanitizers). While sources are edited, a precompiled header hides missing includes and
# lowers the hit rate of ccache.
set(canhil_headers <algorithm> <array> <charconv> <chrono> <cmath> <cstdint> <cstring> <deque> <filesystem> <fstream> <functional>
    <limits> <map> <memory> <optional> <random> <set> <span> <sstream> <string> <string_view> <tuple> <utility> <variant> <vector>
    <fmt/format.h> <fmt/ranges.h> <tl/expected.hpp>)

# The C++ targets of a folder and its subfolders.
function(canhil_targets_of folder result)
  get_property(found DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  get_property(inner DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  set(targets "")
  foreach(target IN LISTS found)
    get_target_property(type ${target} TYPE)
    get_target_property(c_standard ${target} C_STANDARD)
    if(type MATCHES "^(STATIC_LIBRARY|EXECUTABLE)$" AND NOT c_standard)
      list(APPEND targets ${target})
    endif()
  endforeach()
  foreach(one IN LISTS inner)
    canhil_targets_of(${one} more)
    list(APPEND targets ${more})
  endforeach()
  set(${result} ${targets} PARENT_SCOPE)
endfunction()

# canhil_share_headers(FOLDER LIBRARIES lib... HEADERS <header>...): in a one-off build, makes one precompiled header for each set of compiler
# options in the folder. It must be called when all targets have their options, and where the same compiler is set as in the folder. All targets get
# the macros that the libraries define, because the compiler accepts a precompiled header only if the macros agree.
function(canhil_share_headers folder)
  if(NOT (CANHIL_SANITIZE OR CANHIL_TOGETHER))
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "LIBRARIES;HEADERS" ${ARGN})
  set(definitions "")
  foreach(library IN LISTS ARG_LIBRARIES)
    foreach(property INTERFACE_COMPILE_DEFINITIONS INTERFACE_COMPILE_OPTIONS)
      get_target_property(own ${library} ${property})
      if(own)
        list(APPEND definitions ${own}) # a definition may begin with -D
      endif()
    endforeach()
  endforeach()
  canhil_targets_of(${CMAKE_SOURCE_DIR}/${folder} targets)
  set(ways "")
  foreach(target IN LISTS targets)
    get_target_property(options ${target} COMPILE_OPTIONS)
    string(MD5 way "${options}")
    list(APPEND ways ${way})
    list(APPEND ${way}_targets ${target})
    set(${way}_options ${options})
  endforeach()
  list(REMOVE_DUPLICATES ways)
  foreach(way IN LISTS ways)
    list(LENGTH ${way}_targets count)
    if(count LESS 4) # for so few targets, compiling the header takes as long as it saves
      continue()
    endif()
    string(SUBSTRING ${way} 0 6 short)
    set(owner canhil_headers_${folder}_${short})
    file(WRITE ${CMAKE_BINARY_DIR}/${owner}.cpp "")
    add_library(${owner} OBJECT ${CMAKE_BINARY_DIR}/${owner}.cpp)
    set_target_properties(${owner} PROPERTIES COMPILE_OPTIONS "${${way}_options}" EXPORT_COMPILE_COMMANDS OFF)
    target_link_libraries(${owner} PRIVATE ${ARG_LIBRARIES})
    target_compile_definitions(${owner} PRIVATE ${definitions})
    target_precompile_headers(${owner} PRIVATE ${ARG_HEADERS})
    foreach(target IN LISTS ${way}_targets)
      target_compile_definitions(${target} PRIVATE ${definitions})
      target_precompile_headers(${target} REUSE_FROM ${owner})
    endforeach()
  endforeach()
endfunction()
