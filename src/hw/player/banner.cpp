// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/player/banner.hpp"

#include <algorithm>

#include "orca/base/text.hpp"

namespace orca::hw::player {

namespace {

constexpr std::string_view kBannerStart = "Player v.";

}  // namespace

std::array<std::uint8_t, kBannerSize> make_banner(std::string_view version) {
  std::array<std::uint8_t, kBannerSize> banner{};
  const auto end = std::ranges::copy(kBannerStart, banner.begin()).out;
  std::ranges::copy(version.substr(0, kBannerSize - kBannerStart.size() - 1), end);
  return banner;
}

Result<std::string> parse_banner(std::span<const std::uint8_t> banner) {
  if (banner.size() < kBannerSize)
    return fail(Code::data_loss, "the banner of a Player server has 32 bytes, but only " +
                                     std::to_string(banner.size()) + " have arrived");
  const auto characters = banner.first(kBannerSize);
  const std::string text(characters.begin(), std::ranges::find(characters, std::uint8_t{0}));
  if (!text.starts_with(kBannerStart))
    return fail(Code::invalid_argument, "the server begins with " + in_quotes(printable(text)) +
                                            " and not with \"Player v.\"; check host and port");
  return text.substr(kBannerStart.size());
}

}  // namespace orca::hw::player
