// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/supervisor/exit_reason.hpp"

#include <catch2/catch.hpp>

#include <csignal>

using namespace orca::supervisor;

TEST_CASE("The end of a process is told in words", "[supervisor][processes]") {
  const auto [reason, text] = GENERATE(table<ExitReason, std::string>({
      {ExitReason{}, "exited with status 0"},
      {ExitReason{.status = 3}, "exited with status 3"},
      {ExitReason{.signal = SIGSEGV}, "was ended by SIGSEGV"},
      {ExitReason{.signal = SIGABRT, .dumped_core = true}, "was ended by SIGABRT (core dumped)"},
      {ExitReason{.signal = SIGKILL, .out_of_memory = true},
       "was ended by SIGKILL (the system has probably run out of memory)"},
      {ExitReason{.signal = SIGKILL, .force = Force::hang}, "hung and was killed"},
      {ExitReason{.signal = SIGKILL, .force = Force::memory},
       "used more memory than the graph allows and was killed"},
      {ExitReason{.status = 0, .force = Force::refused}, "could not come up and was ended"},
      {ExitReason{.status = 0, .force = Force::overdue}, "did not end when asked to and was killed"},
      {ExitReason{.status = 1, .is_guess = true}, "ended, and its new supervisor cannot tell how"},
      {ExitReason{.status = 1, .force = Force::hang, .is_guess = true}, "hung and was killed"},
      {ExitReason{.status = 0, .is_guess = true}, "ended as it had said"},
  }));
  CHECK(reason.text() == text);
  CHECK(reason.is_normal() == (text == "exited with status 0" || text == "ended as it had said"));
}
