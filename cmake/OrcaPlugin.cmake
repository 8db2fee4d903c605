# SPDX-License-Identifier: LGPL-3.0-or-later
# The build recipe for plugins. Without any part of it a library can be pinned in memory, or stale code can
# run after a swap: see docs/adr/0004-plugin-recipe.md.
set(ORCA_BUILD_ID ${PROJECT_VERSION})
set(ORCA_PLUGIN_SUPPORT_DIR ${CMAKE_CURRENT_LIST_DIR}/plugin)
set(ORCA_PLUGIN_OPTIONS -fvisibility=hidden -fvisibility-inlines-hidden $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)
orca_add_precompiled_headers(orca_plugin_headers ${ORCA_PLUGIN_OPTIONS})

# Everything that a plugin compiles in has a hash of its layout in a generated header, which plugins and loader share.
# That of binutils, also with clang: llvm-readelf, which CMake would choose there, does not show debug information.
find_program(ORCA_READELF readelf REQUIRED)
function(orca_add_plugin_layouts)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  add_library(orca_layout_probe OBJECT ${ORCA_PLUGIN_SUPPORT_DIR}/layout_probe.cpp)
  target_link_libraries(orca_layout_probe PRIVATE orca::component_api orca::hw_api orca_options)
  target_compile_options(orca_layout_probe PRIVATE
    -O0 -g2 -gdwarf-4 -fno-eliminate-unused-debug-types
    $<$<CXX_COMPILER_ID:GNU>:-femit-class-debug-always> $<$<CXX_COMPILER_ID:Clang>:-fstandalone-debug>)
  set(header ${CMAKE_BINARY_DIR}/layouts/include/orca/component/generated/plugin_layouts.hpp)
  cmake_path(GET header PARENT_PATH folder)
  file(MAKE_DIRECTORY ${folder})
  add_custom_command(OUTPUT ${header}
    COMMAND ${Python3_EXECUTABLE} -B ${ORCA_PLUGIN_SUPPORT_DIR}/list_layouts.py --readelf ${ORCA_READELF}
            --object $<TARGET_OBJECTS:orca_layout_probe> --out ${header} --text ${CMAKE_BINARY_DIR}/layouts/layouts.txt
    DEPENDS ${ORCA_PLUGIN_SUPPORT_DIR}/list_layouts.py orca_layout_probe $<TARGET_OBJECTS:orca_layout_probe>
    COMMENT "Layouts of what crosses the plugin boundary" VERBATIM)
  add_custom_target(orca_plugin_layouts DEPENDS ${header})
endfunction()

# orca_use_plugin_layouts(TARGET): lets it include orca/component/generated/plugin_layouts.hpp.
function(orca_use_plugin_layouts target)
  target_include_directories(${target} PRIVATE ${CMAKE_BINARY_DIR}/layouts/include)
  add_dependencies(${target} orca_plugin_layouts)
endfunction()

# orca_add_component(NAME SOURCES... [LINK targets...])
#
# Builds plugins/NAME.so from SOURCES, and plugins/NAME.types, which lists its types for the loader. A plugin
# may hold any number of ORCA_COMPONENT and ORCA_HARDWARE types.
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
  orca_use_plugin_layouts(${name})
  list(TRANSFORM arg_UNPARSED_ARGUMENTS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE sources)
  add_custom_command(TARGET ${name} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -DOUT=${ORCA_PLUGIN_DIR}/${name}.types "-DSOURCES=${sources}"
            -P ${ORCA_PLUGIN_SUPPORT_DIR}/write_types.cmake VERBATIM)
  set_property(GLOBAL APPEND PROPERTY ORCA_PLUGINS ${name})
endfunction()
