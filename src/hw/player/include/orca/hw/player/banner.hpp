// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "orca/base/result.hpp"

namespace orca::hw::player {

inline constexpr std::size_t kBannerSize = 32;  ///< [bytes]

/// Returns what a server sends first: "Player v." and the version, filled up with zero bytes.
/// @param version  e.g. "3.1.1-dev"; cut after 22 characters, so that a zero byte always ends it.
[[nodiscard]] std::array<std::uint8_t, kBannerSize> make_banner(std::string_view version);

/// Returns the version in a banner.
/// @param banner  The first kBannerSize bytes of the connection.
/// @errors  data_loss if there are fewer; invalid_argument if they do not begin like the banner of a Player server.
[[nodiscard]] Result<std::string> parse_banner(std::span<const std::uint8_t> banner);

}  // namespace orca::hw::player
