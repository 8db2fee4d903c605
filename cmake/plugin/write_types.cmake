# SPDX-License-Identifier: LGPL-3.0-or-later
# Writes the types that ORCA_COMPONENT and ORCA_HARDWARE declare in SOURCES to OUT, one per line: "component
# NAME" or "hardware NAME". Without any, the plugin would be of no use, and the build ends.
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
    string(APPEND types "${kind} ${type}\n")
  endforeach()
endforeach()
if(types STREQUAL "")
  list(JOIN SOURCES ", " sources)
  message(FATAL_ERROR "the plugin has no type: write ORCA_COMPONENT(Class, \"my.Type\") at the end of a source, at the "
                      "start of a line; looked in ${sources}")
endif()
file(WRITE ${OUT} "${types}")
