// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

namespace orca {

/// The places where the runtime calls into a plugin.
enum class Hook {
  load,         ///< Its library is loaded and the type looked up.
  constructor,  ///< The constructor of a component or a hardware container.
  prepare,      ///< HardwareContainer::prepare().
  configure,
  start,
  work,
  stop,
  suspend,
  resume,
  params_changed,
  save_state,
  load_state,
  handler,  ///< The handler of a Send or Query server; the port says which.
  strand,   ///< Everything that a hardware container does while the system runs.
  destructor,
  unload  ///< Its library is unloaded: static destructors and atexit handlers.
};

/// The hook as it stands in front of a verb: "work()", "its constructor".
[[nodiscard]] constexpr const char* to_string(Hook hook) {
  constexpr std::array kNames{"load()",         "its constructor",
                              "its prepare()",  "configure()",
                              "start()",        "work()",
                              "stop()",         "suspend()",
                              "resume()",       "params_changed()",
                              "save_state()",   "load_state()",
                              "a handler",      "its strand",
                              "its destructor", "its static destruction"};  // by the number of the enumerator
  static_assert(kNames.size() == static_cast<std::size_t>(Hook::unload) + 1);
  const auto number = static_cast<std::size_t>(hook);
  return number < kNames.size() ? kNames[number] : "?";
}

}  // namespace orca
