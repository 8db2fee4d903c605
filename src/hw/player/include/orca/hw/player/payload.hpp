// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::hw::player {

/// Returns the bytes of a payload in XDR: big-endian, each member a multiple of 4 bytes, lists with their count twice.
///
/// Defined for the structures in the headers of the interfaces.
template <class Payload>
[[nodiscard]] std::vector<std::uint8_t> encode(const Payload& payload);

/// Reads a payload. Numbers are taken as they are: they may be infinite, not a number, or out of all proportion.
/// @errors  data_loss, with the name of the payload, if it is shorter or longer than its content says, if the two
///          counts of a list differ, if a list has more elements than bytes follow, or if an enumeration has an unknown
///          value. No memory is taken for elements that are not there.
template <class Payload>
[[nodiscard]] Result<Payload> decode(std::span<const std::uint8_t> bytes);

}  // namespace orca::hw::player
