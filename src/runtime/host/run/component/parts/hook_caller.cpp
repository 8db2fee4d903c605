// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hook_caller.hpp"

namespace orca::host {

std::optional<PluginFault> HookCaller::call(Hook hook, const std::function<void()>& body, const char* port) {
  hook_.store(hook == Hook::handler ? port : to_string(hook), std::memory_order_release);
  std::optional<PluginFault> fault = guarded_call({component_.c_str(), hook, code_, port}, body);
  hook_.store("", std::memory_order_release);
  return fault;
}

}  // namespace orca::host
