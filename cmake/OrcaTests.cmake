# SPDX-License-Identifier: LGPL-3.0-or-later

# Tests are compiled once and run for a second, so they are not optimised, even in the release build. The second option
# lets ccache see through the precompiled header. With it g++ 12 does not know that these are system headers: when it
# optimises, as for the sanitizers, it warns wrongly of overruns inside std::string.
set(ORCA_TEST_OPTIONS $<$<CONFIG:Release>:-O0> $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_BUILD_TYPE STREQUAL "RelWithDebInfo")
  list(APPEND ORCA_TEST_OPTIONS -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
endif()

# What the sanitizers need not report, because it is in Fast DDS.
set(ORCA_TEST_ENVIRONMENT)
if(ORCA_SANITIZE STREQUAL "thread")
  # Without the second, each process sleeps for a second at its end.
  set(ORCA_TEST_ENVIRONMENT
      "TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/support/tsan.supp:atexit_sleep_ms=0")
elseif(ORCA_SANITIZE MATCHES "address")
  # Its readers are deleted as another type than they were made as.
  # Up to GCC 13 the leak detector may take a block of thread-local storage for one of an old glibc and crash while it reads
  # it (google/sanitizers, issue 1322). What it no longer follows are pointers that only such blocks hold.
  set(ORCA_TEST_ENVIRONMENT
      "ASAN_OPTIONS=new_delete_type_mismatch=0:intercept_tls_get_addr=0"
      "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/support/lsan.supp:print_suppressions=0")
endif()

# The environment of tests that compile: the compiler cache, also for what lies in a new folder each time.
set(ORCA_CACHED_COMPILER)
if(ORCA_CCACHE)
  set(ORCA_CACHED_COMPILER "CMAKE_CXX_COMPILER_LAUNCHER=${ORCA_CCACHE}" CCACHE_BASEDIR=/ CCACHE_NOHASHDIR=1)
endif()

# Most entries wait: for a robot in real time, for a process that ends. `./dev test` runs several entries per processor. Those that
# compute share the processors that this file tells ctest of (--resource-spec-file); without it they are held up by nothing.
cmake_host_system_information(RESULT ORCA_PROCESSORS QUERY NUMBER_OF_LOGICAL_CORES)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/processors.json CONTENT
  "{\"version\": {\"major\": 1, \"minor\": 0}, \"local\": [{\"processor\": [{\"id\": \"any\", \"slots\": @ORCA_PROCESSORS@}]}]}\n" @ONLY)

# orca_computes(TEST) says that a ctest entry keeps a processor busy for most of its time: no more of them run at once than there
# are processors. They start before all entries that wait, so that no processor is idle at the end. Not by PROCESSORS: an entry that
# needs several slots starts when all others have ended, because each slot that becomes free is taken at once.
function(orca_computes test)
  get_test_property(${test} COST cost)
  if(NOT cost)
    set(cost 0)
  endif()
  math(EXPR cost "1000 + ${cost}")
  set_tests_properties(${test} PROPERTIES RESOURCE_GROUPS processor:1 COST ${cost})
endfunction()

# All slots of any machine: ctest lets an entry that needs more than there are run alone.
set(ORCA_ALONE 1024)

# orca_add_test(NAME SOURCES ... LINK ... [LABELS ...] [TIMEOUT seconds] [COST seconds] [COMPUTES] [OPTIMISED] [TOGETHER] [SLOW_RUN])
#
# Adds a Catch2 program with one ctest entry. TIMEOUT [s] is a bound on hangs in the release build; the default is 300 s.
# COST [s] is what it takes on an idle machine; ctest starts the dearest first. It is given from about 10 s on. COMPUTES is for an
# entry that keeps a processor busy for most of its time. OPTIMISED is for tests that compute much themselves. TOGETHER are
# sources whose unnamed namespaces have no name in common: they are compiled in units if the preset does so. SLOW_RUN adds the
# entry NAME_whole to the slow tests, for all that slow_run.hpp leaves out of the normal suite.
function(orca_add_test name)
  cmake_parse_arguments(arg "OPTIMISED;TOGETHER;COMPUTES;SLOW_RUN" "TIMEOUT;COST" "SOURCES;LINK;LABELS;DEPENDS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  if(ORCA_SANITIZE OR CMAKE_BUILD_TYPE STREQUAL "Debug")
    math(EXPR arg_TIMEOUT "5 * ${arg_TIMEOUT}")  # code of these builds is many times slower
  endif()
  if(NOT arg_LABELS)
    set(arg_LABELS unit)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LINK} orca_test_headers Catch2::Catch2WithMain orca_options)
  if(NOT arg_OPTIMISED)
    target_compile_options(${name} PRIVATE ${ORCA_TEST_OPTIONS})
    target_precompile_headers(${name} REUSE_FROM orca_test_headers)
  endif()
  if(arg_TOGETHER AND ORCA_UNITY_TESTS)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON)
  endif()
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(arg_DEPENDS)
    add_dependencies(${name} ${arg_DEPENDS})
  endif()
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support)
  target_compile_definitions(${name} PRIVATE
    ORCA_SOURCE_DIR="${PROJECT_SOURCE_DIR}" ORCA_BINARY_DIR="${CMAKE_BINARY_DIR}")
  set(yielding)
  if(arg_COMPUTES)
    set(yielding nice -n 10)  # Tests beside it that run in real time come first.
  endif()
  add_test(NAME ${name} COMMAND ${yielding} $<TARGET_FILE:${name}> --use-colour no "~[.]~[data]~[tool]~[quiet]")
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT}
                       ENVIRONMENT "${ORCA_TEST_ENVIRONMENT}")
  if(arg_COST)
    set_tests_properties(${name} PROPERTIES COST ${arg_COST})
  endif()
  if(arg_COMPUTES)
    orca_computes(${name})
  endif()
  if(arg_SLOW_RUN)
    add_test(NAME ${name}_whole COMMAND ${name} --use-colour no "~[.]~[data]~[tool]~[quiet]")
    set_tests_properties(${name}_whole PROPERTIES LABELS slow TIMEOUT 3600
                         ENVIRONMENT "ORCA_SLOW=1;${ORCA_TEST_ENVIRONMENT}")
  endif()
endfunction()

# Adds a ctest entry, NAME_TAG_test for NAME_test, that runs the cases of a test whose tags match `cases`. Further arguments:
# [LABELS ...] [TIMEOUT seconds] [COST seconds] [COMPUTES]. It is shown as skipped if a case prints "SKIPPED: ".
function(orca_add_tagged_cases test tag cases)
  cmake_parse_arguments(arg "COMPUTES" "TIMEOUT;COST" "LABELS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  if(NOT arg_LABELS)
    set(arg_LABELS unit)
  endif()
  string(REGEX REPLACE "_test$" "_${tag}_test" name ${test})
  add_test(NAME ${name} COMMAND ${test} --use-colour no "${cases}")
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT} SKIP_REGULAR_EXPRESSION "SKIPPED: "
                       ENVIRONMENT "${ORCA_TEST_ENVIRONMENT}")
  if(arg_COST)
    set_tests_properties(${name} PROPERTIES COST ${arg_COST})
  endif()
  if(arg_COMPUTES)
    orca_computes(${name})
  endif()
endfunction()

# orca_add_optional_cases(TEST TAG [LABELS ...] [TIMEOUT seconds] [COST seconds] [COMPUTES]) adds an entry for the cases of TEST with the tag [data] (public
# data, which is not in the repository) or [tool] (a program that may not be installed).
function(orca_add_optional_cases test tag)
  orca_add_tagged_cases(${test} ${tag} "[${tag}]~[.]~[quiet]" ${ARGN})
endfunction()

# orca_add_quiet_cases(TEST [LABELS ...] [TIMEOUT seconds]) adds an entry for the cases of TEST with the tag [quiet], which runs while
# no other entry does: they measure a time that the work of others would change.
function(orca_add_quiet_cases test)
  orca_add_tagged_cases(${test} quiet "[quiet]~[.]" ${ARGN})
  string(REGEX REPLACE "_test$" "_quiet_test" name ${test})
  set_tests_properties(${name} PROPERTIES RESOURCE_LOCK quiet PROCESSORS ${ORCA_ALONE})
endfunction()
