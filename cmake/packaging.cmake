# `cmake --install build/release --prefix P`, and `cpack` in build/release for a Debian package.
include(GNUInstallDirs)

set(UNDERSTUDY_MAINTAINER "Understudy maintainers <maintainers@understudy.invalid>" CACHE STRING
    "Whom the Debian package names as its maintainer")
set(UNDERSTUDY_DEBIAN_REVISION 1)

# The package contains this component. The texts of licences are another component: Debian already has ours, and those
# of the vendored libraries are in the package's `copyright`.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME understudy)

set(packaging ${CMAKE_CURRENT_LIST_DIR}/../packaging)
set(scenarios_folder ${CMAKE_INSTALL_DATADIR}/understudy/scenarios)

install(TARGETS understudy RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# The program looks for them in lib/understudy, whatever the name of the libraries' folder is.
install(TARGETS understudy_tty_shim understudy_host_time LIBRARY DESTINATION lib/understudy)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenarios/ DESTINATION ${scenarios_folder} USE_SOURCE_PERMISSIONS
  PATTERN "*.port" EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples ${PROJECT_SOURCE_DIR}/recipes
  DESTINATION ${CMAKE_INSTALL_DATADIR}/understudy USE_SOURCE_PERMISSIONS
  PATTERN "__pycache__" EXCLUDE PATTERN ".pytest_cache" EXCLUDE PATTERN "*.port" EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md
        ${PROJECT_SOURCE_DIR}/SECURITY.md ${packaging}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
# Files that pages link to are installed at the same relative paths as in the source, so the links work.
foreach(linked benchmarks/README.md emulator/play/README.md third_party/README.md cmake/rooms.cmake)
  cmake_path(GET linked PARENT_PATH folder)
  install(FILES ${PROJECT_SOURCE_DIR}/${linked} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder})
endforeach()

# link_installed(PLACE FOLDER): makes a link, below the prefix, at PLACE to the FOLDER that is installed elsewhere.
function(link_installed place folder)
  cmake_path(GET place PARENT_PATH parent)
  cmake_path(GET place FILENAME name)
  file(RELATIVE_PATH target /${parent} /${folder})
  set(links ${PROJECT_BINARY_DIR}/packaging/links/${parent})
  file(MAKE_DIRECTORY ${links})
  file(CREATE_LINK ${target} ${links}/${name} SYMBOLIC)
  install(FILES ${links}/${name} DESTINATION ${parent})
endfunction()
set(shared ${CMAKE_INSTALL_DATADIR}/understudy)
link_installed(${CMAKE_INSTALL_DOCDIR}/scenarios ${scenarios_folder})
link_installed(${CMAKE_INSTALL_DOCDIR}/examples ${shared}/examples)
link_installed(${CMAKE_INSTALL_DOCDIR}/recipes ${shared}/recipes)
link_installed(${shared}/docs ${CMAKE_INSTALL_DOCDIR}/docs)  # scenarios/README.md links to ../docs
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)
file(GLOB licences CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/third_party/*/LICENSE)
foreach(licence IN LISTS licences)
  cmake_path(GET licence PARENT_PATH folder)
  install(FILES ${PROJECT_SOURCE_DIR}/${licence} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder} COMPONENT licence)
endforeach()

# Pages, pictures and proofs only; install(DIRECTORY) would create empty folders.
file(GLOB_RECURSE pages CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
     ${PROJECT_SOURCE_DIR}/docs/*.md ${PROJECT_SOURCE_DIR}/docs/*.svg ${PROJECT_SOURCE_DIR}/docs/*.png
     ${PROJECT_SOURCE_DIR}/docs/fidelity/proofs/*.yaml ${PROJECT_SOURCE_DIR}/docs/fidelity/proofs/*.json)
foreach(page IN LISTS pages)
  cmake_path(GET page PARENT_PATH folder)
  install(FILES ${PROJECT_SOURCE_DIR}/${page} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder})
endforeach()

# Files that contain the prefix, which is known only at the installation.
install(CODE "
  set(PACKAGING [[${packaging}]])
  set(STAGING [[${PROJECT_BINARY_DIR}/packaging]])
  set(PROGRAM [[$<TARGET_FILE:understudy>]])
  set(VERSION ${PROJECT_VERSION})
  set(DEBIAN_VERSION ${PROJECT_VERSION}-${UNDERSTUDY_DEBIAN_REVISION})
  set(MAINTAINER [[${UNDERSTUDY_MAINTAINER}]])
  set(PROGRAMS \${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR})
  set(MANUALS \${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_MANDIR}/man1)
  set(DOCUMENTATION \${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR})
  set(COMPLETIONS \${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR})
  set(SCHEMAS \${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/understudy/schemas)
  set(EXTENSION \${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/understudy/vscode)
  set(SCENARIOS \${CMAKE_INSTALL_PREFIX}/${scenarios_folder})
  # systemd looks here below /usr and /usr/local, whatever the name of the libraries' folder is.
  set(UNITS \${CMAKE_INSTALL_PREFIX}/lib/systemd/system)")
install(SCRIPT ${packaging}/install_generated.cmake)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME understudy)
set(CPACK_PACKAGE_CONTACT ${UNDERSTUDY_MAINTAINER})
set(CPACK_COMPONENTS_ALL understudy)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PROJECT_CONFIG_FILE ${packaging}/debian_depends.cmake)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${UNDERSTUDY_DEBIAN_REVISION})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION electronics)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS OFF)  # see debian_depends.cmake
set(CPACK_UNDERSTUDY_PROGRAMS ${PROJECT_BINARY_DIR}/understudy ${PROJECT_BINARY_DIR}/lib/understudy/tty_shim.so
    ${PROJECT_BINARY_DIR}/lib/understudy/host_time.so)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "gnuplot-nox, gtkwave, mbpoll, python3:any, wireshark")  # two examples are in Python
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${packaging}/postinst ${packaging}/prerm ${packaging}/postrm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "firmware-faithful emulator of industrial motion controllers")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Host software that drives a motion controller over a serial line (an
operator panel, a PLC, a test bench) opens a pseudo-terminal instead and
finds the same registers, the same frames, the same exceptions, and the
same motion to the millisecond and the pulse.
.
The systemd service understudy@NAME serves the bench /etc/understudy/NAME.yaml.")
include(CPack)
