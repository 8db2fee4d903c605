// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string_view>

#include "orca/idl/object.hpp"

namespace orca {

/// An observer of everything that happens on the links of a run, for traces and taps.
///
/// Thread contract: called from the strand that sends; implementations synchronise themselves.
class LinkObserver {
 public:
  virtual ~LinkObserver() = default;

  /// Reports that an object was put into the queue of `component`.`port`.
  virtual void delivered(std::string_view component, std::string_view port, const ObjectRef& object) = 0;

  /// Reports that a client's port was connected to, or disconnected from, a server's port.
  virtual void link_changed(std::string_view client, std::string_view server, bool connected) = 0;
};

}  // namespace orca
