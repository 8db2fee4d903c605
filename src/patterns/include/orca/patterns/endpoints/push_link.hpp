// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "orca/base/time.hpp"
#include "orca/idl/object.hpp"
#include "orca/patterns/update_rate.hpp"

namespace orca {

/// The client's side of one Push edge, as its link sees it: the destination of pushed objects.
///
/// Thread contract: tasks of the client's executive; a link that receives on a thread of its own hands over
/// to a task. It is called with the server's lock held, so nothing here may block or call the source back.
class PushSink {
 public:
  virtual ~PushSink() = default;

  /// Takes the object, or drops and counts it; never blocks.
  /// @return nothing if the object was taken or dropped. Otherwise the queue is full and its policy asks the
  /// publisher to wait for room, at most this long [s], and to try again; `object` is then unchanged.
  /// @thread  the server's strand.
  virtual std::optional<Duration> deliver(ObjectRef&& object) = 0;

  /// Drops and counts an object for which the publisher has waited long enough.
  virtual void give_up(const ObjectRef& object) = 0;

  /// Stores the update rate that the server grants. Called at attach() and whenever the rate changes.
  /// @thread  any.
  virtual void granted(const UpdateGrant& grant) = 0;

  /// Counts objects that the link lost on their way here, because it had no room for them.
  virtual void lost(std::uint64_t objects) = 0;
};

/// The server's side of one Push edge, as its link sees it: the place where the client subscribes.
///
/// Thread contract: any task of the server's executive; base_period() and path() from any thread.
class PushSource {
 public:
  virtual ~PushSource() = default;
  /// Subscribes. An edge has at most one subscription.
  virtual void attach(PushSink& sink, const UpdateRate& rate) = 0;
  /// Ends the subscription. Nothing is delivered afterwards.
  virtual void detach() = 0;
  /// Requests another rate while subscribed.
  virtual void change(const UpdateRate& rate) = 0;
  /// Reports that the sink has room again, for which the publisher waits.
  virtual void room() = 0;
  /// Returns the time between two objects [s] if the server is regular and has announced it; otherwise 0.
  [[nodiscard]] virtual Duration base_period() const = 0;
  /// Returns "component.port" of the server.
  [[nodiscard]] virtual std::string path() const = 0;
};

}  // namespace orca
