// SPDX-License-Identifier: LGPL-3.0-or-later

/// @file
/// The questions about several Push ports that a Synchronizer asks within a lap, and the runtime between two laps.
///
/// Thread contract: the strand of the component that owns the ports.
#pragma once

#include <span>

#include "orca/base/time.hpp"

namespace orca {

class PushClientEndpoint;

/// Returns whether an object waits at one of the ports.
[[nodiscard]] bool any_new(std::span<PushClientEndpoint* const> ports);

/// Returns whether an object waits from every server that the ports are subscribed to, and each port has one.
[[nodiscard]] bool all_new(std::span<PushClientEndpoint* const> ports);

/// Returns whether the oldest waiting objects of all servers that the ports are subscribed to belong to one moment:
/// their stamps differ by at most `within` [s], and each port has such a server. Drops the objects before that
/// which are too old to match any other that waits or comes.
[[nodiscard]] bool match(std::span<PushClientEndpoint* const> ports, Duration within);

}  // namespace orca
