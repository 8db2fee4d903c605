// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/host/picture.hpp"

namespace orca::host {

/// A table that a run writes: what passes through some ports, as CSV.
struct RecordingOptions {
  std::string file;
  std::vector<std::string> ports;  ///< "component.port", by their names in the graph.
};

/// What a run leaves behind and shows besides its log. A plain value.
struct RunOutputs {
  std::string trace_file;     ///< Empty: no trace is written.
  bool trace_values = false;  ///< The trace shows each object that is delivered.
  std::vector<RecordingOptions> recordings;
  PictureOptions picture;
  bool looks_on = false;  ///< The listener is offered a RunView, and the result has the ways of the robots.
};

}  // namespace orca::host
