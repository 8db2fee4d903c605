# SPDX-License-Identifier: LGPL-3.0-or-later
# Debian packages of what OrcaInstall.cmake installs, one for each of its components: ./dev package.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME orca)
set(CPACK_PACKAGE_VENDOR "The Orca authors")
set(CPACK_PACKAGE_CONTACT "The Orca authors <orca@users.noreply.example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/install/finish_packages.cmake)
set(CPACK_ORCA_FILES ${PROJECT_SOURCE_DIR}/cmake/install)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 0orca1)  # 0: older than any that Debian itself may make of this version
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/lib)
set(CPACK_COMPONENTS_ALL)

# orca_package(COMPONENT SECTION SUMMARY [DETAILS...] [DEPENDS packages...] [RECOMMENDS packages...] [ALL]): what a package says of
# itself. All but the pages need the programs of the same version. ALL: it has nothing that depends on the processor.
macro(orca_package component section summary)
  cmake_parse_arguments(arg "ALL" "DETAILS" "DEPENDS;RECOMMENDS" ${ARGN})
  string(TOUPPER ${component} NAME)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  list(JOIN arg_DEPENDS ", " CPACK_DEBIAN_${NAME}_PACKAGE_DEPENDS)
  list(JOIN arg_RECOMMENDS ", " CPACK_DEBIAN_${NAME}_PACKAGE_RECOMMENDS)
  set(CPACK_DEBIAN_${NAME}_PACKAGE_NAME orca-${component})
  set(CPACK_DEBIAN_${NAME}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${NAME}_DESCRIPTION "${summary}\n${arg_DETAILS}")
  if(arg_ALL)
    set(CPACK_DEBIAN_${NAME}_PACKAGE_ARCHITECTURE all)
  endif()
endmacro()

set(same "orca-runtime (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
orca_package(runtime science "component framework for mobile robots: deployer and components"
  DETAILS "Runs robot systems that a graph in XML describes: components for behaviours,
localisation, planning and tasks, the program that brings them up, graphs,
and a systemd unit that runs one from the start of the computer."
  RECOMMENDS orca-simulator orca-tools)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${CPACK_ORCA_FILES}/postinst ${CPACK_ORCA_FILES}/prerm
    ${CPACK_ORCA_FILES}/postrm)
orca_package(tools science "component framework for mobile robots: tools of operators"
  DETAILS "orcactl shows and commands running robot systems, records them and exchanges
their code. hwprobe finds out which device is at which serial port."
  DEPENDS "${same}" RECOMMENDS orca-drivers)
orca_package(web science "component framework for mobile robots: page in the browser"
  DETAILS "orcaview shows a running robot system, a recording or a comparison in the
browser, and commands the system."
  DEPENDS "${same}" node-dagre-layout libjs-dygraphs)
orca_package(drivers science "component framework for mobile robots: drivers of devices"
  DETAILS "Drivers for Pioneers and PeopleBots, Nomad Scout and XR4000, Create 2, SICK
LMS, RPLIDAR, cameras of Linux and Player servers, and udev rules for their
serial adapters. Users of serial ports must be in the group dialout, users of
cameras in the group video."
  DEPENDS "${same}")
orca_package(simulator science "component framework for mobile robots: simulator and comparisons"
  DETAILS "Simulated robots and emulated devices, worlds, and simbatch, which compares
algorithms in worlds with seeds and reports what is established. The Python
package orca_robots uses both."
  DEPENDS "${same}" RECOMMENDS orca-tools python3)
orca_package(dev libdevel "component framework for mobile robots: files for development"
  DETAILS "Headers, libraries and the CMake package with which components and drivers
are compiled and tested."
  DEPENDS "${same}" g++ cmake pkg-config catch2 libcairo2-dev libeigen3-dev libfastrtps-dev liblz4-dev libsqlite3-dev libtinyxml2-dev libzstd-dev zlib1g-dev
  RECOMMENDS ninja-build orca-simulator python3)
orca_package(doc doc "component framework for mobile robots: documents"
  DETAILS "Pages about components, graphs, the simulator, hardware and comparisons, and
the decisions behind them." ALL)
include(CPack)
