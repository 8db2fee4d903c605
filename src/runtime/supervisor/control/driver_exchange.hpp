// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "control/system_names.hpp"
#include "orca/graph/graph.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

struct SwapWish;

/// Orders a process to exchange the driver of one of its hardware elements. The new driver is not tried out in a shadow: the
/// process tries the plugin as it does each time it loads one.
/// @param take  takes the process's answer, with a record about the exchange.
/// @errors  unavailable if the process takes no orders at present; those of plugin::PluginImage::copy().
/// @thread  the supervisor's.
[[nodiscard]] Status order_driver_exchange(const SwapWish& wish, const graph::HardwareNode& hardware,
                                           const SystemNames& names,
                                           std::function<void(const Answer& answer)> take);

}  // namespace orca::supervisor
