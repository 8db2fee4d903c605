// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/host/run_system.hpp"

namespace orca::test {

/// The result of a run in the test's own process, and the events that its listener received.
struct RecordedRun {
  host::RunResult result;
  std::vector<std::string>
      heard;  ///< "started", "built", "arrived home", "failed home: lost", "contact Dewey", "alarm UMASK", "ended"
  host::RunGlance first_glance;       ///< When everything was built; empty unless RunOptions::looks_on.
  std::vector<idl::Alarm> alarms;     ///< As the listener heard them.
  std::vector<std::string> infos;     ///< "host: all is well"
  std::vector<std::string> warnings;  ///< "host: something is odd"
};

/// Runs a graph whose plugins are those of the tests and the shipped ones.
/// @param attributes  of the graph: ends="...".
[[nodiscard]] RecordedRun record_run(const std::string& attributes, const std::string& elements,
                                     const host::RunOptions& options);

/// Virtual time, on fibers unless the build cannot have them.
[[nodiscard]] host::RunOptions virtual_run();

}  // namespace orca::test
