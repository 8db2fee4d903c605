// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "foxglove/channels.hpp"

namespace orca::view {

/// Size of the largest robot's file that is shown [bytes]. Larger ones are left out.
inline constexpr std::size_t kLongestDescription = std::size_t{4} << 20;

/// Returns channels with the robots' files that a graph names, each with the text of a file: `/robot_description`, or, with several
/// robots, `/HARDWARE/robot_description`. No other file is read.
/// @param graph  the answer to the command graph, as JSON.
/// @param first  number of the first channel.
/// @throws json::exception if it is no graph.
[[nodiscard]] std::vector<Channel> robot_descriptions_of(const nlohmann::json& graph, std::uint32_t first);

}  // namespace orca::view
