// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

#include "orca/base/executive.hpp"
#include "orca/component/host.hpp"
#include "trace.hpp"

namespace orca::host {

/// What all instances of one run share.
struct RunContext {
  Executive& executive;
  Trace& trace;
  std::uint64_t seed = 1;
  /// Takes announcements of any instance. Any strand.
  std::function<void(const Announcement&)> announce;
  /// Called whenever an instance has changed its state. Any strand.
  std::function<void()> changed;
  /// A picture is to be drawn in the end.
  bool wants_scene = false;
};

}  // namespace orca::host
