// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "orca/base/exception_text.hpp"
#include "orca/base/strand.hpp"

namespace orca {

/// How a call into a plugin went wrong.
struct PluginFault {
  bool interrupted = false;  ///< Not a fault: the strand was told to leave.
  std::string text;          ///< What was thrown, copied, so that it outlives the plugin.
};

/// Calls into a plugin; nothing that it throws comes further than here.
template <class Call>
std::optional<PluginFault> guarded_call(Call&& call) {
  try {
    std::forward<Call>(call)();
    return std::nullopt;
  } catch (const Interrupted&) {
    return PluginFault{true, {}};
  } catch (...) {
    return PluginFault{false, describe_current_exception()};
  }
}

}  // namespace orca
