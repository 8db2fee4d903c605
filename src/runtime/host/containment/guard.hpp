// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "environment.hpp"
#include "orca/base/activity.hpp"
#include "orca/base/exception_text.hpp"
#include "orca/base/strand.hpp"
#include "orca/host/last_words.hpp"

namespace orca::host {

/// The way in which a call into a plugin went wrong.
struct PluginFault {
  bool interrupted = false;  ///< Not a fault: the strand was asked to end.
  std::string text;          ///< What was thrown, copied so that it outlives the plugin.
};

/// The code that is called, for alarms and for the last words of a process that dies of it.
struct PluginCall {
  const char* who;  ///< Name of the component or hardware container.
  Hook hook;
  const void* code;       ///< Any address in the plugin.
  const char* port = "";  ///< Port of a handler; "" for other hooks.
};

/// A guard for the time in which a plugin's code runs: its own lifetime.
class PluginTurn {
 public:
  explicit PluginTurn(const PluginCall& call) : activity_(call.who, call.hook, call.code, call.port) {
    LastWords::prepare_thread();
    Environment::of_process().entering(activity_);
  }
  ~PluginTurn() { Environment::of_process().left(activity_); }
  PluginTurn(const PluginTurn&) = delete;
  PluginTurn& operator=(const PluginTurn&) = delete;

 private:
  const Activity activity_;
};

/// Checks what a plugin's code has changed so far. To be called when the code begins to wait, before anyone
/// else's turn.
inline void pause_plugin_turn() {
  if (const Activity* const turn = Activity::current()) Environment::of_process().leaving(*turn);
}

/// Calls into a plugin and catches everything that it throws.
template <class Call>
std::optional<PluginFault> guarded_call(const PluginCall& called, Call&& call) {
  const PluginTurn turn(called);
  try {
    std::forward<Call>(call)();
    return std::nullopt;
  } catch (const Interrupted&) {
    return PluginFault{true, {}};
  } catch (...) {
    return PluginFault{false, describe_current_exception()};
  }
}

}  // namespace orca::host
