# SPDX-License-Identifier: LGPL-3.0-or-later

# The headers of the standard library that most sources include. They are parsed once for all libraries and once for
# all plugins, whose flags differ; they took more than a third of the time to compile a source. Headers of Orca are
# not among them, so that a changed header recompiles only its users. Nor is <filesystem>, which makes std::quoted
# visible wherever a std::string is an argument. Preset "dev" has no precompiled headers, so that a forgotten #include
# shows there; nor has "fuzz", where some libraries are compiled with flags of their own.
set(ORCA_STANDARD_HEADERS
  <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <cstdlib> <deque> <functional> <limits> <map>
  <memory> <mutex> <numbers> <optional> <set> <span> <sstream> <stdexcept> <string> <string_view> <thread> <tuple>
  <type_traits> <utility> <variant> <vector>)
set(ORCA_LIBRARY_OPTIONS
  # Functions of these libraries are not replaced at load time, which makes calls within them cheaper.
  $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition -fno-plt>)

# ccache needs -fpch-preprocess to see through a precompiled header. With this option g++ 12 does not know that these
# are system headers, and when it optimises it warns wrongly of overruns inside std::string.
set(ORCA_PRECOMPILED_OPTIONS $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess -Wno-array-bounds -Wno-restrict
    -Wno-stringop-overflow -Wno-stringop-overread>)

# orca_add_precompiled_headers(NAME [options...]): precompiles the headers for targets with those options.
function(orca_add_precompiled_headers name)
  add_library(${name} OBJECT ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/standard_headers.cpp)
  target_compile_options(${name} PRIVATE ${ARGN} ${ORCA_PRECOMPILED_OPTIONS})
  target_link_libraries(${name} PRIVATE orca_options)
  target_precompile_headers(${name} PRIVATE ${ORCA_STANDARD_HEADERS})
endfunction()
orca_add_precompiled_headers(orca_library_headers ${ORCA_LIBRARY_OPTIONS})

# orca_use_precompiled_headers(TARGET HEADERS): lets TARGET use the headers that were precompiled as HEADERS.
function(orca_use_precompiled_headers target headers)
  target_compile_options(${target} PRIVATE ${ORCA_PRECOMPILED_OPTIONS})
  target_precompile_headers(${target} REUSE_FROM ${headers})
endfunction()

# orca_runs_seldom(TARGET): for code that runs when a system starts, ends or is asked, and not in each lap. g++ compiles
# it in two thirds of the time with -Og. That g++ 12 warns then of uninitialised members of an empty std::optional is wrong.
function(orca_runs_seldom target)
  if(CMAKE_BUILD_TYPE STREQUAL "Release" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Og -Wno-maybe-uninitialized)
  endif()
endfunction()

# orca_add_program_parts(NAME SOURCES...): everything of a program but main(), for its tests as well.
function(orca_add_program_parts name)
  add_library(${name} STATIC ${ARGN})
  target_link_libraries(${name} PRIVATE orca_options)
  target_compile_options(${name} PRIVATE ${ORCA_LIBRARY_OPTIONS})
  orca_use_precompiled_headers(${name} orca_library_headers)
  orca_runs_seldom(${name})
endfunction()

# orca_add_library(NAME SHARED|STATIC SOURCES ... [PUBLIC deps] [PRIVATE deps])
#
# Adds the library of one layer. Public headers live in <folder>/include; the target
# all_verify_interface_header_sets compiles each alone.
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
  if(kind STREQUAL "SHARED")
    set_property(GLOBAL APPEND PROPERTY ORCA_SHARED_LIBRARIES orca_${name})
    # What assert() says of its file must not name the folder that Orca was built in.
    target_compile_options(orca_${name} PRIVATE -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=)
  endif()
  orca_use_precompiled_headers(orca_${name} orca_library_headers)
  set_target_properties(orca_${name} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON EXPORT_NAME ${name})
endfunction()
