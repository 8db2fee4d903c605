# SPDX-License-Identifier: LGPL-3.0-or-later
# What Orca's own build does for plugins, those of other projects included.

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
  set(header ${ORCA_PLUGIN_LAYOUTS}/orca/component/generated/plugin_layouts.hpp)
  cmake_path(GET header PARENT_PATH folder)
  file(MAKE_DIRECTORY ${folder})
  add_custom_command(OUTPUT ${header}
    COMMAND ${Python3_EXECUTABLE} -B ${ORCA_PLUGIN_SUPPORT_DIR}/list_layouts.py --readelf ${ORCA_READELF}
            --object $<TARGET_OBJECTS:orca_layout_probe> --out ${header} --text ${CMAKE_BINARY_DIR}/layouts/layouts.txt
    DEPENDS ${ORCA_PLUGIN_SUPPORT_DIR}/list_layouts.py orca_layout_probe $<TARGET_OBJECTS:orca_layout_probe>
    COMMENT "Layouts of what crosses the plugin boundary" VERBATIM)
  add_custom_target(orca_plugin_layouts DEPENDS ${header})
endfunction()

# orca_add_plugin_entry(): what is the same in every plugin, compiled once for all of this build.
function(orca_add_plugin_entry)
  add_library(orca_plugin_entry OBJECT ${ORCA_PLUGIN_SUPPORT_DIR}/plugin_entry.cpp)
  target_compile_options(orca_plugin_entry PRIVATE ${ORCA_PLUGIN_OPTIONS})
  target_compile_definitions(orca_plugin_entry PRIVATE ORCA_BUILD_ID="${ORCA_BUILD_ID}")
  target_link_libraries(orca_plugin_entry PRIVATE ${ORCA_PLUGIN_LINK})
  orca_use_precompiled_headers(orca_plugin_entry orca_plugin_headers)
  orca_use_plugin_layouts(orca_plugin_entry)
endfunction()
