# SPDX-License-Identifier: LGPL-3.0-or-later
# The build recipe for plugins. Anything less pins a library in memory or runs stale code after a swap:
# see docs/adr/0004-plugin-recipe.md.
set(ORCA_BUILD_ID ${PROJECT_VERSION})
set(ORCA_PLUGIN_SUPPORT_DIR ${CMAKE_CURRENT_LIST_DIR}/plugin)
set(ORCA_PLUGIN_OPTIONS -fvisibility=hidden -fvisibility-inlines-hidden $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)
orca_add_precompiled_headers(orca_plugin_headers ${ORCA_PLUGIN_OPTIONS})

# orca_add_component(NAME SOURCES... [LINK targets...])
#
# Builds plugins/NAME.so from SOURCES, and plugins/NAME.types, which tells the loader which types it holds. A plugin may
# hold any number of ORCA_COMPONENT and ORCA_HARDWARE types.
function(orca_add_component name)
  cmake_parse_arguments(arg "" "" "LINK" ${ARGN})
  add_library(${name} MODULE ${arg_UNPARSED_ARGUMENTS} ${ORCA_PLUGIN_SUPPORT_DIR}/plugin_entry.cpp)
  set_target_properties(${name} PROPERTIES
    PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${ORCA_PLUGIN_DIR}
    LINK_DEPENDS ${ORCA_PLUGIN_SUPPORT_DIR}/plugin.map)
  target_compile_options(${name} PRIVATE ${ORCA_PLUGIN_OPTIONS})
  orca_use_precompiled_headers(${name} orca_plugin_headers)
  target_link_options(${name} PRIVATE -Wl,--version-script=${ORCA_PLUGIN_SUPPORT_DIR}/plugin.map)
  if(NOT (CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND ORCA_SANITIZE))
    target_link_options(${name} PRIVATE -Wl,-z,defs)
  endif()
  target_compile_definitions(${name} PRIVATE ORCA_BUILD_ID="${ORCA_BUILD_ID}")
  target_link_libraries(${name} PRIVATE orca::component_api orca::hw_api ${arg_LINK} orca_options)
  list(TRANSFORM arg_UNPARSED_ARGUMENTS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE sources)
  add_custom_command(TARGET ${name} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -DOUT=${ORCA_PLUGIN_DIR}/${name}.types "-DSOURCES=${sources}"
            -P ${ORCA_PLUGIN_SUPPORT_DIR}/write_types.cmake VERBATIM)
  set_property(GLOBAL APPEND PROPERTY ORCA_PLUGINS ${name})
endfunction()
