// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "containment/guard.hpp"

namespace orca::host {

/// The only way into a component's code once it is constructed. It calls one hook or handler at a time, and
/// catches everything that they throw.
///
/// Thread contract: current() from anywhere, the rest on the component's strand.
class HookCaller {
 public:
  /// @param component  its name in the graph.
  explicit HookCaller(std::string component) : component_(std::move(component)) {}

  /// Sets the code that is called: any address in the plugin, or null while none is loaded.
  void set_code(const void* code) { code_ = code; }

  /// Calls `body` as this hook.
  /// @param port  port of a handler; "" for other hooks. It must outlive the call.
  /// @return the exception or interruption; nothing if the call returned.
  std::optional<PluginFault> call(Hook hook, const std::function<void()>& body, const char* port = "") {
    hook_.store(hook == Hook::handler ? port : to_string(hook), std::memory_order_release);
    std::optional<PluginFault> fault = guarded_call({component_.c_str(), hook, code_, port}, body);
    hook_.store("", std::memory_order_release);
    return fault;
  }

  /// Returns the hook that the strand is in now, for people: "work()"; for a handler its port; else "".
  [[nodiscard]] const char* current() const { return hook_.load(std::memory_order_acquire); }

 private:
  const std::string component_;
  const void* code_ = nullptr;
  std::atomic<const char*> hook_{""};
};

}  // namespace orca::host
