// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string_view>

#include "orca/idl/object.hpp"

namespace orca {

/// The kinds of trouble that a connection reports.
enum class LinkTrouble {
  late,     ///< A Push edge: no object has come within its deadline.
  dropped,  ///< A Push edge: it has dropped more objects than it may.
  refused,  ///< A Send or Query: the server refused, answered with an error, or did not answer in time.
};

/// An observer of everything that happens on the links of a run, for traces and taps.
///
/// Thread contract: called from the strands of both ends, foreign_call() from any thread; implementations
/// synchronise themselves.
class LinkObserver {
 public:
  virtual ~LinkObserver() = default;

  /// Reports that an object was put into the queue of `component`.`port`.
  virtual void delivered(std::string_view component, std::string_view port, const ObjectRef& object) = 0;

  /// Reports that a component has pushed an object, before anybody receives it, and even if nobody does.
  virtual void pushed(std::string_view /*component*/, std::string_view /*port*/,
                      const ObjectRef& /*object*/) {}

  /// Returns whether somebody looks at what a component pushes there: an operator, or a recording.
  [[nodiscard]] virtual bool is_looked_at(std::string_view /*component*/, std::string_view /*port*/) {
    return false;
  }

  /// Reports that a component sends an object, or asks a question, whatever the server says to it.
  virtual void requested(std::string_view /*component*/, std::string_view /*port*/,
                         const ObjectRef& /*object*/) {}

  /// Reports that a client's port was connected to, or disconnected from, a server's port.
  virtual void link_changed(std::string_view client, std::string_view server, bool connected) = 0;

  /// Reports trouble on a connection. An observer that keeps no log may ignore it.
  /// @param from, to  "component.port" of the ends, as in `<connect from= to=>`.
  /// @param text      what has happened, without the ends.
  virtual void trouble(LinkTrouble /*kind*/, std::string_view /*from*/, std::string_view /*to*/,
                       std::string_view /*text*/) {}

  /// Reports that a port has refused a call, because the calling thread runs no component.
  /// @param code  any address in the component's plugin; null: not known.
  /// @thread  the one that called.
  virtual void foreign_call(std::string_view /*component*/, std::string_view /*port*/, const void* /*code*/) {
  }
};

}  // namespace orca
