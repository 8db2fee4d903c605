// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "orca/hw/camera/stream.hpp"

namespace orca::hw::camera {

/// Returns what Video4Linux2 calls a format, from its number: "YUYV".
/// @thread  pure function; any.
[[nodiscard]] std::string name_of_format(std::uint32_t number);

/// Sets the format, size and rate of a camera: those of all that it has and that can be read here whose size is nearest to the
/// wish; of these one that reaches the rate; of these the one that is converted with the least work and loss.
/// @return what the camera will give, which it says itself.
/// @errors  unavailable, `is_busy` set, if another program has it. invalid_argument, with the formats that it has, if none can be
///          read here. not_found if it has gone.
[[nodiscard]] Result<Mode> choose_mode(VideoCalls& calls, int descriptor, const Wish& wish, bool& is_busy);

}  // namespace orca::hw::camera
