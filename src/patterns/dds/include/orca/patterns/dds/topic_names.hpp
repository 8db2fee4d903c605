// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

namespace orca {

/// Returns the topic of DDS on which a Push port publishes.
/// @param path  "component.port".
[[nodiscard]] inline std::string object_topic(const std::string& graph, std::string path) {
  path[path.rfind('.')] = '/';
  return "orca/" + graph + "/" + path;
}

/// Returns the topic of DDS on which a process hears what others send to it alone.
/// @param run  name of the run; "*" in permissions.
[[nodiscard]] inline std::string inbox_topic(const std::string& graph, const std::string& run,
                                             const std::string& process) {
  return "orca-lines/" + graph + "/" + run + "/" + process;
}

}  // namespace orca
