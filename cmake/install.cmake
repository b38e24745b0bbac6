# cmake --install installs programs, the libraries for find_package(canhil), data and documents. cpack -G DEB packs the same files into a Debian
# package.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The libraries that other projects can link: messages and their codecs, buses, logs, estimators.
set(canhil_exported wire files dbc messages messages_fd logs ports strapdown filtering transfer_alignment inflight_alignment los_rate wind)
foreach(library IN LISTS canhil_exported)
  get_target_property(type canhil_${library} TYPE)
  target_include_directories(canhil_${library} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/canhil>)
  set_target_properties(canhil_${library} PROPERTIES EXPORT_NAME ${library})
endforeach()
list(TRANSFORM canhil_exported PREPEND canhil_ OUTPUT_VARIABLE targets)
install(TARGETS ${targets} dbcgen EXPORT canhil ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/canhil)
install(EXPORT canhil NAMESPACE canhil:: FILE canhil-targets.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/canhil)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/canhil-config.cmake.in ${CMAKE_BINARY_DIR}/canhil-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/canhil)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/canhil-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/canhil-config.cmake ${CMAKE_BINARY_DIR}/canhil-config-version.cmake
              ${CMAKE_CURRENT_LIST_DIR}/canhil_generate.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/canhil)
foreach(folder dbc/wire dbc/files dbc/parser dbc/logs dbc/ports target/estimators)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/canhil/${folder}/.. FILES_MATCHING PATTERN "*.hpp")
endforeach()
foreach(generated generated generated_fd)
  install(DIRECTORY ${CMAKE_BINARY_DIR}/dbc/codegen/${generated}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/canhil FILES_MATCHING PATTERN "*.hpp")
endforeach()

install(TARGETS hil-target hil-bench hil-bench-campaign hil-bench-fmu hil-bench-paper)
set(data ${CMAKE_INSTALL_DATADIR}/canhil)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/bench/flights ${CMAKE_SOURCE_DIR}/bench/monte_carlo ${CMAKE_SOURCE_DIR}/bench/acceptance
                  ${CMAKE_SOURCE_DIR}/docs/examples DESTINATION ${data})
install(FILES ${CMAKE_SOURCE_DIR}/dbc/canhil.dbc ${CMAKE_SOURCE_DIR}/dbc/canhil-fd.dbc DESTINATION ${data}/dbc)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN examples EXCLUDE)
install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
foreach(program hil-bench hil-target)
  install(FILES ${CMAKE_SOURCE_DIR}/packaging/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ${program})
endforeach()

# The Python package, where Debian's Python looks for packages if the prefix is /usr. pip and this file describe it by the same pyproject.toml:
# its entry point makes pytest load the plugin.
file(STRINGS ${CMAKE_SOURCE_DIR}/python/pyproject.toml description REGEX "^description = ")
string(REGEX REPLACE "^description = \"(.*)\"$" "\\1" description "${description}")
file(STRINGS ${CMAKE_SOURCE_DIR}/python/pyproject.toml entry_point REGEX "^canhil = \"canhil[.]")
string(REPLACE "\"" "" entry_point "${entry_point}")
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/python/METADATA @ONLY CONTENT "Metadata-Version: 2.1
Name: canhil
Version: @PROJECT_VERSION@
Summary: @description@
")
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/python/entry_points.txt @ONLY CONTENT "[pytest11]
@entry_point@
")
set(python_packages lib/python3/dist-packages)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/python/canhil DESTINATION ${python_packages} FILES_MATCHING PATTERN "*.py" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
install(FILES ${CMAKE_BINARY_DIR}/python/METADATA ${CMAKE_BINARY_DIR}/python/entry_points.txt
        DESTINATION ${python_packages}/canhil-${PROJECT_VERSION}.dist-info)

# The unit file contains the path of the installed program, which is known only at installation.
install(CODE "
  set(bindir \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR}\")
  configure_file(\"${CMAKE_SOURCE_DIR}/packaging/hil-target@.service\" \"${CMAKE_BINARY_DIR}/hil-target@.service\" @ONLY)")
install(FILES ${CMAKE_BINARY_DIR}/hil-target@.service DESTINATION lib/systemd/system)

# Manual pages from the output of --help: one for each program and each subcommand of hil-bench.
find_program(HELP2MAN help2man)
if(HELP2MAN)
  add_custom_target(canhil_manual ALL
    COMMAND ${CMAKE_SOURCE_DIR}/packaging/manual.sh ${CMAKE_BINARY_DIR} ${CMAKE_BINARY_DIR}/man ${PROJECT_VERSION}
    DEPENDS hil-target hil-bench hil-bench-campaign dbcgen ${CMAKE_SOURCE_DIR}/packaging/manual.sh
    COMMENT "Manual pages" VERBATIM)
  install(DIRECTORY ${CMAKE_BINARY_DIR}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
endif()

# Builds everything that is installed, but no tests: cmake --build build/default --target canhil_installed.
add_custom_target(canhil_installed)
add_dependencies(canhil_installed ${targets} dbcgen hil-target hil-bench hil-bench-campaign hil-bench-fmu hil-bench-paper)
if(HELP2MAN)
  add_dependencies(canhil_installed canhil_manual)
endif()

set(CPACK_PACKAGE_NAME canhil)
set(CPACK_PACKAGE_VENDOR canhil)
set(CPACK_PACKAGE_CONTACT "canhil developers <canhil@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "hardware-in-the-loop bench over CAN for navigation and guidance estimators")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "can-utils, iproute2, python3")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-pytest, python3-pandas, python3-matplotlib, cmake, g++, libeigen3-dev, libfmt-dev, libexpected-dev, libpcap-dev, zlib1g-dev")
include(CPack)
