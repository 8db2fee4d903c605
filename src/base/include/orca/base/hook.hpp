// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca {

/// The places where the runtime calls into a plugin.
enum class Hook {
  load,         ///< Its library is loaded and the type looked up.
  constructor,  ///< Of a component or a hardware container.
  prepare,      ///< HardwareContainer::prepare().
  configure,
  start,
  work,
  stop,
  suspend,
  resume,
  params_changed,
  handler,  ///< Of a Send or Query server; the port says which.
  strand,   ///< Everything that a hardware container does while the system runs.
  destructor,
  unload  ///< Its library is unloaded: static destructors and atexit handlers.
};

/// The hook as it stands in front of a verb: "work()", "its constructor".
[[nodiscard]] constexpr const char* to_string(Hook hook) {
  switch (hook) {
    case Hook::load: return "load()";
    case Hook::constructor: return "its constructor";
    case Hook::prepare: return "its prepare()";
    case Hook::configure: return "configure()";
    case Hook::start: return "start()";
    case Hook::work: return "work()";
    case Hook::stop: return "stop()";
    case Hook::suspend: return "suspend()";
    case Hook::resume: return "resume()";
    case Hook::params_changed: return "params_changed()";
    case Hook::handler: return "a handler";
    case Hook::strand: return "its strand";
    case Hook::destructor: return "its destructor";
    case Hook::unload: return "its static destruction";
  }
  return "?";
}

}  // namespace orca
