// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

/// A test case whose body is a function with these parameters. `run` calls it with what it has made for it: a task, a peer, two
/// ends of a link.
#define CASE_IN(run, parameters, title, tags) \
  CASE_IN_AS(INTERNAL_CATCH_UNIQUE_NAME(case_in_), run, parameters, title, tags)
#define CASE_IN_AS(function, run, parameters, title, tags) \
  static void function parameters;                         \
  TEST_CASE(title, tags) { run(function); }                \
  static void function parameters
