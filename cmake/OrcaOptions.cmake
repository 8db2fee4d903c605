# SPDX-License-Identifier: LGPL-3.0-or-later
# Compiler settings for everything in the tree.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

option(ORCA_WERROR "Warnings are errors (on in every preset)" OFF)
set(ORCA_SANITIZE "" CACHE STRING "Sanitizers for -fsanitize=, e.g. address,undefined or thread")

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)

# What all code that uses Orca is compiled with, plugins of other projects included.
add_library(orca_language INTERFACE)
add_library(orca::language ALIAS orca_language)
set_target_properties(orca_language PROPERTIES EXPORT_NAME language)
target_compile_features(orca_language INTERFACE cxx_std_20)
# Bit-identical runs: no fused multiply-add, no fast-math.
target_compile_options(orca_language INTERFACE -ffp-contract=off)

# What Orca's own code is compiled with.
add_library(orca_options INTERFACE)
set_target_properties(orca_options PROPERTIES EXPORT_NAME options)
target_link_libraries(orca_options INTERFACE orca_language)
target_compile_options(orca_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion $<$<BOOL:${ORCA_WERROR}>:-Werror>)

# g++ collects garbage once a unit takes 128 MB of memory, again and again. Later and less often saves a tenth of the time
# for a large unit, for a fifth more memory.
add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=524288>
                    $<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-expand=200>)

# Sources that are compiled together: g++ takes all but the first line of such a unit for headers, and warns of their
# unnamed namespaces. Preset "dev" compiles each alone, without this option.
if(CMAKE_UNITY_BUILD)
  add_compile_options(-Wno-subobject-linkage)
endif()

if(ORCA_SANITIZE)
  add_compile_options(-fsanitize=${ORCA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  # With sanitizers, g++ 12 warns wrongly of uninitialised members inside std::regex.
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  add_link_options(-fsanitize=${ORCA_SANITIZE})
endif()

find_program(ORCA_CCACHE ccache)
if(ORCA_CCACHE)
  # ccache can keep objects that use a precompiled header only if it may ignore the macros and times in that
  # header.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros ${ORCA_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${ORCA_CCACHE})
endif()
find_program(ORCA_MOLD mold)
if(ORCA_MOLD)
  add_link_options(-fuse-ld=mold)
endif()

# Python itself. What is called so may be a launcher such as pyenv's, a shell script that takes six times as long at each of hundreds of starts.
if(NOT Python3_EXECUTABLE)
  execute_process(COMMAND python3 -c "import sys; print(sys.executable)" OUTPUT_VARIABLE python OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(python)
    set(Python3_EXECUTABLE ${python} CACHE FILEPATH "Python's interpreter")
  endif()
endif()
