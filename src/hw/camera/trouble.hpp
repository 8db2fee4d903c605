// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"

namespace orca::hw::camera {

/// Says why a camera cannot be opened, and what to do.
/// @param reason  errno of the attempt; ENOTTY: it is no video device.
/// @pre  the caller has closed its own descriptor of it.
[[nodiscard]] Error explain_refusal(const std::string& path, int reason);

/// Says that a device is one of video, but gives no pictures as they are read here.
/// @param card  what it calls itself.
/// @param why   what it does instead.
[[nodiscard]] Error explain_no_camera(const std::string& path, const std::string& card,
                                      const std::string& why);

}  // namespace orca::hw::camera
