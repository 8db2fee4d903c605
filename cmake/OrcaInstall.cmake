# SPDX-License-Identifier: LGPL-3.0-or-later
# What `cmake --install` puts where, and find_package(Orca), for an installed Orca and for the build folder alike.
#
#   bin/                     programs, which find everything else from where they are
#   lib/orca/                libraries; plugins/ has the plugins
#   lib/cmake/Orca, share/pkgconfig, include/orca    what components are compiled with
#   share/orca/              graphs, worlds, robots, experiments and the page, in folders as in the source tree
#
# Libraries are private to Orca, because 0.x does not promise that a program works with another version of them: what a plugin was
# compiled with is compared when it is loaded.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(ORCA_LIB lib/orca)
set(ORCA_CMAKE lib/cmake/Orca)
set(ORCA_SHARE share/orca)
set(ORCA_PAGES share/doc/orca-doc/pages)

# What programs and components of other projects may link.
set(ORCA_EXPORTED language base idl xml text geometry geometry_objects carmen recording_reading recording ros
    object_reading object_recording robot_file patterns patterns_local patterns_frames patterns_shm patterns_dds component_api
    hw_framing hw_link hw_api hw_driver graph plugin host testing options)
list(TRANSFORM ORCA_EXPORTED PREPEND orca_)

# orca_set_rpath(PATHS TARGETS...): the folders in which they look for libraries, in the build folder and once they are installed. Else CMake
# would fill up the paths of the build folder with ":", and each would have the loader search the folder that a program is started in.
function(orca_set_rpath paths)
  set_target_properties(${ARGN} PROPERTIES INSTALL_RPATH "${paths}" BUILD_WITH_INSTALL_RPATH ON)
endfunction()

# orca_install_program(PROGRAM COMPONENT): with its page and completions.
function(orca_install_program program component)
  orca_set_rpath("$ORIGIN/../${ORCA_LIB};$ORIGIN/../lib" ${program})
  install(TARGETS ${program} RUNTIME DESTINATION bin COMPONENT ${component})
  set(share ${CMAKE_BINARY_DIR}/share)
  install(FILES ${share}/man/man1/${program}.1 DESTINATION share/man/man1 COMPONENT ${component})
  install(FILES ${share}/bash-completion/completions/${program} DESTINATION share/bash-completion/completions COMPONENT ${component})
  install(FILES ${share}/zsh/site-functions/_${program} DESTINATION share/zsh/site-functions COMPONENT ${component})
endfunction()

# Libraries that a program loads, and what other projects compile and link with.
function(orca_install_libraries)
  get_property(shared GLOBAL PROPERTY ORCA_SHARED_LIBRARIES)
  orca_set_rpath($ORIGIN ${shared})
  list(REMOVE_ITEM shared ${ORCA_EXPORTED})
  install(TARGETS ${shared} LIBRARY DESTINATION ${ORCA_LIB} COMPONENT runtime)
  install(TARGETS ${ORCA_EXPORTED} EXPORT Orca
    LIBRARY DESTINATION ${ORCA_LIB} COMPONENT runtime
    ARCHIVE DESTINATION ${ORCA_LIB} COMPONENT dev
    FILE_SET HEADERS DESTINATION include COMPONENT dev)
  foreach(folder ${CMAKE_BINARY_DIR}/idl/include ${ORCA_PLUGIN_LAYOUTS})
    install(DIRECTORY ${folder}/ DESTINATION include COMPONENT dev FILES_MATCHING PATTERN *.h PATTERN *.hpp)
  endforeach()
endfunction()

# Plugins go into the package of the folder that they are made in.
function(orca_install_plugins)
  get_property(plugins GLOBAL PROPERTY ORCA_PLUGINS)
  foreach(plugin ${plugins})
    get_target_property(folder ${plugin} SOURCE_DIR)
    if(folder MATCHES "^${PROJECT_SOURCE_DIR}/src/hw/")
      set(component drivers)
    elseif(folder MATCHES "^${PROJECT_SOURCE_DIR}/sim/")
      set(component simulator)
    else()
      set(component runtime)
    endif()
    orca_set_rpath("$ORIGIN/..;$ORIGIN/../lib" ${plugin})
    install(TARGETS ${plugin} LIBRARY DESTINATION ${ORCA_LIB}/plugins COMPONENT ${component})
    install(FILES ${ORCA_PLUGIN_DIR}/${plugin}.types DESTINATION ${ORCA_LIB}/plugins COMPONENT ${component})
  endforeach()
endfunction()

# find_package(Orca): the same files for the build folder, whose targets lie there, and for what is installed.
function(orca_install_package)
  set(config ${PROJECT_SOURCE_DIR}/cmake/OrcaConfig.cmake.in)
  set(places DEPLOYER LAYOUTS RECIPE IDL_FILES IDL_TOOLS)

  set(DEPLOYER ${CMAKE_BINARY_DIR}/bin/deployer)
  set(LAYOUTS ${ORCA_PLUGIN_LAYOUTS})
  set(RECIPE ${PROJECT_SOURCE_DIR}/cmake/OrcaPlugin.cmake)
  set(IDL_FILES ${PROJECT_SOURCE_DIR}/idl/orca)
  set(IDL_TOOLS ${PROJECT_SOURCE_DIR}/idl/tools)
  configure_package_config_file(${config} ${CMAKE_BINARY_DIR}/OrcaConfig.cmake INSTALL_PREFIX ${CMAKE_BINARY_DIR}
    INSTALL_DESTINATION ${CMAKE_BINARY_DIR} PATH_VARS ${places})
  export(EXPORT Orca NAMESPACE Orca:: FILE ${CMAKE_BINARY_DIR}/OrcaTargets.cmake)

  set(DEPLOYER bin/deployer)
  set(LAYOUTS include)
  set(RECIPE ${ORCA_CMAKE}/OrcaPlugin.cmake)
  set(IDL_FILES ${ORCA_SHARE}/idl)
  set(IDL_TOOLS ${ORCA_CMAKE}/idl)
  set(made ${CMAKE_BINARY_DIR}/installed)
  configure_package_config_file(${config} ${made}/OrcaConfig.cmake INSTALL_DESTINATION ${ORCA_CMAKE} PATH_VARS ${places})
  write_basic_package_version_file(${made}/OrcaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  file(COPY_FILE ${made}/OrcaConfigVersion.cmake ${CMAKE_BINARY_DIR}/OrcaConfigVersion.cmake ONLY_IF_DIFFERENT)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/install/orca.pc.in ${made}/orca.pc @ONLY)
  install(EXPORT Orca NAMESPACE Orca:: DESTINATION ${ORCA_CMAKE} FILE OrcaTargets.cmake COMPONENT dev)
  install(FILES ${made}/OrcaConfig.cmake ${made}/OrcaConfigVersion.cmake ${PROJECT_SOURCE_DIR}/cmake/OrcaPlugin.cmake
    ${PROJECT_SOURCE_DIR}/cmake/OrcaIdl.cmake DESTINATION ${ORCA_CMAKE} COMPONENT dev)
  set(recipe ${PROJECT_SOURCE_DIR}/cmake/plugin)
  install(FILES ${recipe}/plugin.map ${recipe}/plugin_entry.cpp ${recipe}/object_library_entry.cpp ${recipe}/write_types.cmake ${recipe}/driver_trial.py
    DESTINATION ${ORCA_CMAKE}/plugin COMPONENT dev)
  install(DIRECTORY idl/tools/ DESTINATION ${ORCA_CMAKE}/idl COMPONENT dev FILES_MATCHING PATTERN *.py)
  install(DIRECTORY idl/orca/ DESTINATION ${ORCA_SHARE}/idl COMPONENT dev FILES_MATCHING PATTERN *.idl)
  install(FILES ${made}/orca.pc DESTINATION share/pkgconfig COMPONENT dev)
endfunction()

# Graphs, what they name, and the page. An experiment that needs public data, which is not installed, is left out.
function(orca_install_files)
  foreach(folder graphs sim/robots sim/fixtures sim/ways)
    install(DIRECTORY ${folder}/ DESTINATION ${ORCA_SHARE}/${folder} COMPONENT runtime)
  endforeach()
  foreach(folder sim/worlds sim/layers sim/experiments)
    install(DIRECTORY ${folder}/ DESTINATION ${ORCA_SHARE}/${folder} COMPONENT simulator
      REGEX "/barn(\\.xml|_tuned)$" EXCLUDE)
  endforeach()
  install(FILES schemas.xml DESTINATION ${ORCA_SHARE} COMPONENT runtime)
  install(DIRECTORY templates/ DESTINATION ${ORCA_SHARE}/templates COMPONENT tools)
  install(FILES ${CMAKE_BINARY_DIR}/share/orca/build.txt DESTINATION ${ORCA_SHARE} COMPONENT simulator)
  install(DIRECTORY web/ DESTINATION ${ORCA_SHARE}/web COMPONENT web
    FILES_MATCHING PATTERN *.js PATTERN *.html PATTERN *.css PATTERN *.svg)
  install(DIRECTORY python/orca_robots DESTINATION lib/python3/dist-packages COMPONENT simulator FILES_MATCHING PATTERN *.py)
  install(FILES docs/hardware/60-orca-serial.rules DESTINATION lib/udev/rules.d COMPONENT drivers)
  install(FILES cmake/install/orca@.service DESTINATION lib/systemd/system COMPONENT runtime)
  install(FILES cmake/install/orca.sysusers DESTINATION lib/sysusers.d RENAME orca.conf COMPONENT runtime)
endfunction()

# Pages lie as in the source tree, so that their links lead where they should.
function(orca_install_pages)
  install(FILES README.md CHANGELOG.md CONTRIBUTING.md LICENSE.md DESTINATION ${ORCA_PAGES} COMPONENT doc)
  install(DIRECTORY docs DESTINATION ${ORCA_PAGES} COMPONENT doc PATTERN docs/book EXCLUDE)
  file(GLOB pages RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS src/components/*/README.md)
  foreach(page ${pages})
    cmake_path(GET page PARENT_PATH folder)
    install(FILES ${page} DESTINATION ${ORCA_PAGES}/${folder} COMPONENT doc)
  endforeach()
endfunction()

# To be called when all targets are known, except tests.
function(orca_install)
  orca_install_program(deployer runtime)
  orca_install_program(orcactl tools)
  orca_install_program(hwprobe tools)
  orca_install_program(orcaview web)
  orca_install_program(simbatch simulator)
  orca_install_libraries()
  orca_install_plugins()
  orca_install_package()
  orca_install_files()
  orca_install_pages()
endfunction()
