# SPDX-License-Identifier: LGPL-3.0-or-later
# The build recipe for plugins, in Orca's own build and in others (OrcaConfig.cmake.in), which set before:
#   ORCA_BUILD_ID         what a plugin says of the Orca that it was built with
#   ORCA_PLUGIN_DIR       where plugins are built
#   ORCA_PLUGIN_LAYOUTS   folder of the generated header with the layouts that plugins compile in
#   ORCA_PLUGIN_LINK      targets that each plugin links
#   ORCA_DEPLOYER         the program that runs graphs, for tests of drivers
#
#   ORCA_IDL_FILES, ORCA_IDL_TOOLS  see OrcaIdl.cmake
#
# Without any part of it a library can be pinned in memory, or stale code can
# run after a swap: see docs/adr/0004-plugin-recipe.md.
set(ORCA_PLUGIN_SUPPORT_DIR ${CMAKE_CURRENT_LIST_DIR}/plugin)
set(ORCA_PLUGIN_OPTIONS -fvisibility=hidden -fvisibility-inlines-hidden $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)

include(${CMAKE_CURRENT_LIST_DIR}/OrcaIdl.cmake)

# orca_use_plugin_layouts(TARGET): lets it include orca/component/generated/plugin_layouts.hpp.
function(orca_use_plugin_layouts target)
  target_include_directories(${target} PRIVATE ${ORCA_PLUGIN_LAYOUTS})
  if(TARGET orca_plugin_layouts)
    add_dependencies(${target} orca_plugin_layouts)
  endif()
endfunction()

# orca_keep_plugin(FOLDER NAME): when everything is configured, plugins that were built into FOLDER by targets which are gone
# are removed, so that no graph finds them.
function(orca_keep_plugin folder name)
  get_property(folders GLOBAL PROPERTY ORCA_PLUGIN_FOLDERS)
  if(NOT folders)
    cmake_language(DEFER DIRECTORY ${CMAKE_SOURCE_DIR} CALL orca_remove_stale_plugins)
  endif()
  set_property(GLOBAL APPEND PROPERTY ORCA_PLUGIN_FOLDERS ${folder})
  set_property(GLOBAL APPEND PROPERTY ORCA_PLUGIN_LISTS ${folder}/${name}.types)
endfunction()

function(orca_remove_stale_plugins)
  get_property(folders GLOBAL PROPERTY ORCA_PLUGIN_FOLDERS)
  get_property(known GLOBAL PROPERTY ORCA_PLUGIN_LISTS)
  list(REMOVE_DUPLICATES folders)
  foreach(folder ${folders})
    file(GLOB lists ${folder}/*.types)
    list(REMOVE_ITEM lists ${known})
    foreach(list ${lists})
      cmake_path(REPLACE_EXTENSION list LAST_ONLY so OUTPUT_VARIABLE plugin)
      message(STATUS "Removing ${plugin}, whose target is gone")
      file(REMOVE ${list} ${plugin})
    endforeach()
  endforeach()
endfunction()

# orca_add_component(NAME SOURCES... [LINK targets...])
#
# Builds plugins/NAME.so from SOURCES, and plugins/NAME.types, which lists its types for the loader. A plugin
# may hold any number of ORCA_COMPONENT and ORCA_HARDWARE types.
function(orca_add_component name)
  cmake_parse_arguments(arg "" "" "LINK" ${ARGN})
  if(TARGET orca_plugin_entry)
    set(entry $<TARGET_OBJECTS:orca_plugin_entry>)
  else()
    set(entry ${ORCA_PLUGIN_SUPPORT_DIR}/plugin_entry.cpp)
  endif()
  add_library(${name} MODULE ${arg_UNPARSED_ARGUMENTS} ${entry})
  set_target_properties(${name} PROPERTIES
    PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${ORCA_PLUGIN_DIR}
    LINK_DEPENDS "${ORCA_PLUGIN_SUPPORT_DIR}/plugin.map;${ORCA_PLUGIN_SUPPORT_DIR}/write_types.cmake")
  target_compile_options(${name} PRIVATE ${ORCA_PLUGIN_OPTIONS})
  if(TARGET orca_plugin_headers)
    orca_use_precompiled_headers(${name} orca_plugin_headers)
  endif()
  target_link_options(${name} PRIVATE -Wl,--build-id -Wl,--version-script=${ORCA_PLUGIN_SUPPORT_DIR}/plugin.map)
  if(NOT (CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND ORCA_SANITIZE))
    target_link_options(${name} PRIVATE -Wl,-z,defs)
  endif()
  target_compile_definitions(${name} PRIVATE ORCA_BUILD_ID="${ORCA_BUILD_ID}")
  target_link_libraries(${name} PRIVATE ${ORCA_PLUGIN_LINK} ${arg_LINK})
  orca_use_plugin_layouts(${name})
  set(sources ${arg_UNPARSED_ARGUMENTS})
  list(TRANSFORM sources PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ REGEX "^[^/]")
  add_custom_command(TARGET ${name} PRE_LINK
    COMMAND ${CMAKE_COMMAND} -DOUT=${ORCA_PLUGIN_DIR}/${name}.types "-DSOURCES=${sources}"
            -P ${ORCA_PLUGIN_SUPPORT_DIR}/write_types.cmake VERBATIM)
  set_property(GLOBAL APPEND PROPERTY ORCA_PLUGINS ${name})
  orca_keep_plugin(${ORCA_PLUGIN_DIR} ${name})
endfunction()

# orca_add_component_test(NAME SOURCES...)
#
# Builds tests/NAME from SOURCES with Catch2, which tries components of plugins/ (orca/testing/component_trial.hpp), and
# gives it to ctest.
function(orca_add_component_test name)
  find_package(Catch2 2 REQUIRED)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE Orca::testing Orca::language Catch2::Catch2WithMain)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  get_property(plugins GLOBAL PROPERTY ORCA_PLUGINS)
  add_dependencies(${name} ${plugins})
  add_test(NAME ${name} COMMAND ${name})
endfunction()

# orca_add_driver_test(NAME TYPE EMULATOR command... SERVER type PORT port [PARAMS NAME=VALUE...])
#
# Gives ctest a test that tries the driver TYPE of plugins/ with an emulation of its device, over good and bad lines: see
# plugin/driver_trial.py. The server, such as orca.LaserServer, pushes its readings at the port.
function(orca_add_driver_test name type)
  cmake_parse_arguments(arg "" "SERVER;PORT" "EMULATOR;PARAMS" ${ARGN})
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  list(TRANSFORM arg_PARAMS PREPEND --param= OUTPUT_VARIABLE params)
  add_test(NAME ${name} COMMAND ${Python3_EXECUTABLE} -B ${ORCA_PLUGIN_SUPPORT_DIR}/driver_trial.py
    --deployer ${ORCA_DEPLOYER} --plugins ${ORCA_PLUGIN_DIR} --type ${type} --server ${arg_SERVER} --port ${arg_PORT} ${params}
    ${arg_EMULATOR})
  set_tests_properties(${name} PROPERTIES TIMEOUT 120)
endfunction()
