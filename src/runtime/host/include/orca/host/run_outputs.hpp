// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/host/picture.hpp"

namespace orca::host {

/// What a run records: what passes through some ports, as a table in a CSV file; as an MCAP file, which has the log and the
/// alarms as well; or, of odometry and scans, as a log of CARMEN.
struct RecordingOptions {
  std::string file;
  /// "component.port", by their names in the graph; empty, not of a table: all through which objects leave their component.
  std::vector<std::string> ports;
};

/// Returns whether a recording of everything has the port: with these, each object is in it once. Those are PushServers,
/// SendProxies, and both ends of Query: questions at the one, replies at the other.
[[nodiscard]] inline bool is_source(const PortContract& port) {
  return port.pattern == Pattern::query || (port.pattern == Pattern::push) == (port.role == Role::server);
}

/// Returns whether a recording is an MCAP file or a log of CARMEN, by its name.
[[nodiscard]] inline bool is_bag_file(std::string_view file) {
  return file.ends_with(".mcap") || file.ends_with(".carmen");
}

/// What a run leaves behind and shows besides its log. A plain value.
struct RunOutputs {
  std::string trace_file;     ///< Empty: no trace is written.
  bool trace_values = false;  ///< The trace shows each object that is delivered.
  std::vector<RecordingOptions> recordings;
  PictureOptions picture;
  bool looks_on = false;  ///< The listener is offered a RunView, and the result has the ways of the robots.
};

}  // namespace orca::host
