# SPDX-License-Identifier: LGPL-3.0-or-later

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
  # Nobody replaces functions of our libraries at load time; knowing that makes calls within them cheaper.
  target_compile_options(orca_${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition -fno-plt>)
  set_target_properties(orca_${name} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
endfunction()
