# SPDX-License-Identifier: LGPL-3.0-or-later
# Writes the types that ORCA_COMPONENT and ORCA_HARDWARE declare in SOURCES to OUT, one per line: "component
# NAME SENTENCE" or "hardware NAME SENTENCE", where SENTENCE is the first one of the class's comment, if it has one.
# Without any type the plugin would be of no use, and the build ends.

# first_sentence(OUT SOURCE CLASS): of the lines of /// before "class CLASS".
function(first_sentence out source class)
  set(${out} "" PARENT_SCOPE)
  file(READ ${source} text)
  if(NOT text MATCHES "\n((///[^\n]*\n)+)class ${class}[ \n]")
    return()
  endif()
  string(REGEX REPLACE "///[ ]*|\n$" "" comment "${CMAKE_MATCH_1}")
  string(REGEX REPLACE "[ \t\r\n]+" " " comment "${comment}")
  if(comment MATCHES "[.:] [A-Z@]")
    string(FIND "${comment}" "${CMAKE_MATCH_0}" end)
    string(SUBSTRING "${comment}" 0 ${end} comment)
  endif()
  string(REGEX REPLACE "[.: ]+$" "" comment "${comment}")
  set(${out} " ${comment}." PARENT_SCOPE)
endfunction()

set(types "")
foreach(source ${SOURCES})
  file(STRINGS ${source} lines REGEX "^ORCA_(COMPONENT|HARDWARE)\\(")
  foreach(line ${lines})
    if(NOT line MATCHES "\"[^\"]+\"")
      message(FATAL_ERROR "${source}: the type's name must be a text on the same line: ${line}")
    endif()
    string(REGEX REPLACE "^ORCA_([A-Z]+)\\([^\"]*\"([^\"]+)\".*$" "\\1" kind "${line}")
    string(TOLOWER ${kind} kind)
    string(REGEX REPLACE "^[^\"]*\"([^\"]+)\".*$" "\\1" type "${line}")
    string(REGEX REPLACE "^ORCA_[A-Z]+\\( *([A-Za-z0-9_]*).*$" "\\1" class "${line}")
    first_sentence(sentence ${source} "${class}")
    string(APPEND types "${kind} ${type}${sentence}\n")
  endforeach()
endforeach()
if(types STREQUAL "")
  list(JOIN SOURCES ", " sources)
  message(FATAL_ERROR "the plugin has no type: write ORCA_COMPONENT(Class, \"my.Type\") at the end of a source, at the "
                      "start of a line; looked in ${sources}")
endif()
file(WRITE ${OUT} "${types}")
