// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"
#include "serial_places.hpp"

namespace orca::hw::link {

/// Says why a serial device cannot be opened and what to do.
/// @param path    what was to be opened.
/// @param reason  errno of the attempt.
/// @param name    of the link, for messages.
[[nodiscard]] Error explain_refusal(const std::string& path, int reason, const SerialPlaces& places,
                                    const std::string& name);

/// Says that another program has the device, and which.
/// @pre  the caller has closed its own descriptor of it.
[[nodiscard]] Error explain_holder(const std::string& path, const std::string& name);

/// Says that this user may not open the device, and who may.
[[nodiscard]] Error explain_permission(const std::string& path, const std::string& name);

}  // namespace orca::hw::link
