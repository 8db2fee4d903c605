// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace orca::host {

/// A table that a run writes: what passes through some ports, as CSV.
struct RecordingOptions {
  std::string file;
  std::vector<std::string> ports;  ///< "component.port", by their names in the graph.
};

}  // namespace orca::host
