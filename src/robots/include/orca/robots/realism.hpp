// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

namespace orca::robots {

/// The level of the simulated devices' errors. Every comparison of results names the level it used.
enum class Realism {
  ideal,    ///< Exact sensors, wheels and odometry, a drive without lag and dead time.
  nominal,  ///< Errors as measured on such devices.
  harsh,    ///< Errors about twice as large.
};

[[nodiscard]] std::string_view to_string(Realism realism);
/// Returns the level "ideal", "nominal" or "harsh"; nothing for any other word.
[[nodiscard]] std::optional<Realism> realism_from(std::string_view word);

}  // namespace orca::robots
