# SPDX-License-Identifier: LGPL-3.0-or-later

# What most sources include of the standard library, parsed once for all libraries and once for all plugins, whose flags
# differ: more than a third of a source's time in the compiler went there. No header of Orca's, so that a change compiles
# nothing anew that does not include it. The preset "dev" compiles without: there a forgotten #include shows. Nor has it
# <filesystem>: that brings std::quoted to wherever a std::string is an argument.
set(ORCA_STANDARD_HEADERS
  <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <cstdlib> <deque> <functional> <limits> <map>
  <memory> <mutex> <numbers> <optional> <set> <span> <sstream> <stdexcept> <string> <string_view> <thread> <tuple>
  <type_traits> <utility> <variant> <vector>)
set(ORCA_LIBRARY_OPTIONS
  # Nobody replaces functions of our libraries at load time; knowing that makes calls within them cheaper.
  $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition -fno-plt>)

# ccache sees through a precompiled header with -fpch-preprocess only. Then g++ 12 no longer sees that these headers are the
# system's, and when it optimises it warns of overruns inside std::string that are none.
set(ORCA_PRECOMPILED_OPTIONS $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess -Wno-array-bounds -Wno-restrict
    -Wno-stringop-overflow -Wno-stringop-overread>)

# orca_add_precompiled_headers(NAME [options...]): for targets with those options.
function(orca_add_precompiled_headers name)
  add_library(${name} OBJECT ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/standard_headers.cpp)
  target_compile_options(${name} PRIVATE ${ARGN} ${ORCA_PRECOMPILED_OPTIONS})
  target_link_libraries(${name} PRIVATE orca_options)
  target_precompile_headers(${name} PRIVATE ${ORCA_STANDARD_HEADERS})
endfunction()
orca_add_precompiled_headers(orca_library_headers ${ORCA_LIBRARY_OPTIONS})

# orca_use_precompiled_headers(TARGET HEADERS)
function(orca_use_precompiled_headers target headers)
  target_compile_options(${target} PRIVATE ${ORCA_PRECOMPILED_OPTIONS})
  target_precompile_headers(${target} REUSE_FROM ${headers})
endfunction()

# orca_add_library(NAME [SHARED|STATIC] SOURCES ... [PUBLIC deps] [PRIVATE deps] [HEADERS dir])
#
# One library per layer. Public headers live in <folder>/include; each is compiled alone when ORCA_VERIFY_HEADERS is on.
function(orca_add_library name kind)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(orca_${name} ${kind} ${arg_SOURCES})
  add_library(orca::${name} ALIAS orca_${name})
  if(IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/include)
    file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/include/*.hpp)
    target_sources(orca_${name} PUBLIC FILE_SET HEADERS BASE_DIRS include FILES ${headers})
  endif()
  target_link_libraries(orca_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE} orca_options)
  target_compile_options(orca_${name} PRIVATE ${ORCA_LIBRARY_OPTIONS})
  orca_use_precompiled_headers(orca_${name} orca_library_headers)
  set_target_properties(orca_${name} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
endfunction()
