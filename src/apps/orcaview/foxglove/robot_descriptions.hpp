// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "foxglove/channels.hpp"

namespace orca::view {

/// A robot's file that a graph names. A plain value.
struct RobotFile {
  std::string hardware;  ///< Name of the element that names it.
  std::string path;
  std::string packages;  ///< Folder of the packages that it names; empty: those above it.
  std::string text;
};

/// Size of the largest robot's file that is shown [bytes].
inline constexpr std::size_t kLongestDescription = std::size_t{4} << 20;

/// Reads the robots' files that a graph names. Leaves out those that cannot be read, and larger ones.
/// @param graph  the answer to the command graph, as JSON.
/// @throws json::exception if it is no graph.
[[nodiscard]] std::vector<RobotFile> robots_of(const nlohmann::json& graph);

/// Returns channels with the text of a robot's file each: `/robot_description`, or, with several robots,
/// `/HARDWARE/robot_description`.
/// @param first  number of the first channel.
[[nodiscard]] std::vector<Channel> robot_descriptions_of(const std::vector<RobotFile>& robots,
                                                         std::uint32_t first);

}  // namespace orca::view
