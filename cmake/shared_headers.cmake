# Heavy headers of the standard library, Eigen and fmt, of the tests also GoogleTest, are read once for all targets that are compiled
# alike, not once for each of some five hundred sources.
#
# For a build that is made once (CANHIL_TOGETHER, the sanitizers). Where sources are edited, each names what it includes and ccache
# tells what has changed; a precompiled header hides the first and disturbs the second.
set(canhil_headers <algorithm> <array> <charconv> <chrono> <cmath> <cstdint> <cstring> <deque> <filesystem> <fstream> <functional>
    <limits> <map> <memory> <optional> <random> <set> <span> <sstream> <string> <string_view> <tuple> <utility> <variant> <vector>
    <fmt/format.h> <fmt/ranges.h>)

# Targets of a folder and of those in it, that are compiled as C++.
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

# canhil_share_headers(FOLDER HEADERS...): for each way in which the targets of the folder are compiled.
function(canhil_share_headers folder)
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
    if(count LESS 4) # the header costs as much as it saves
      continue()
    endif()
    string(SUBSTRING ${way} 0 6 short)
    set(owner canhil_headers_${folder}_${short})
    file(WRITE ${CMAKE_BINARY_DIR}/${owner}.cpp "")
    add_library(${owner} OBJECT ${CMAKE_BINARY_DIR}/${owner}.cpp)
    set_target_properties(${owner} PROPERTIES COMPILE_OPTIONS "${${way}_options}" EXPORT_COMPILE_COMMANDS OFF)
    target_link_libraries(${owner} PRIVATE fmt::fmt Eigen3::Eigen GTest::gmock)
    target_precompile_headers(${owner} PRIVATE ${ARGN})
    foreach(target IN LISTS ${way}_targets)
      target_precompile_headers(${target} REUSE_FROM ${owner})
    endforeach()
  endforeach()
endfunction()
