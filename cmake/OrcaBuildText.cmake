# SPDX-License-Identifier: LGPL-3.0-or-later
# cmake -D FILE=... -D SOURCE=... -D BUILD=... -P OrcaBuildText.cmake: writes FILE, one line that says what is built: BUILD, and the commit of the
# folder SOURCE. No program contains it, so that a commit alone compiles nothing and gives no program another hash.
execute_process(COMMAND git -C "${SOURCE}" rev-parse --short=12 HEAD OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE
                RESULT_VARIABLE failed ERROR_QUIET)
execute_process(COMMAND git -C "${SOURCE}" diff --quiet HEAD RESULT_VARIABLE changed ERROR_QUIET)
if(failed)
  set(commit "of no known commit")
elseif(changed)
  set(commit "commit ${commit} with changes that are not committed")
else()
  set(commit "commit ${commit}")
endif()
file(CONFIGURE OUTPUT "${FILE}" CONTENT "${BUILD}; ${commit}\n" @ONLY)
