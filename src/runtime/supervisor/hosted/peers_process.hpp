// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "orca/base/result.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// Lives the life of the host process that speaks with the other machines: it carries states between the supervisor and a
/// Bulletin until it is told to end, or the supervisor is gone. It runs no component.
/// @param request  number of the order.
/// @errors  those of orca_open_bulletin(), which the supervisor has been told.
/// @thread  the main thread.
[[nodiscard]] Status carry_states(Channel& channel, const Meet& meet, std::uint64_t request);

}  // namespace orca::supervisor
