// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "orca/base/mutex.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"
#include "orca/patterns/endpoints/published.hpp"
#include "orca/patterns/endpoints/push_link.hpp"
#include "orca/patterns/endpoints/task_mutex.hpp"

namespace orca {

/// A link that carries one copy of an object for several subscribers. It collects the edges for which an object is due,
/// each of which hands it the object, and sends the object in flush().
///
/// Thread contract: flush() as PushServerEndpoint::publish(), with the server's lock held: it must not block.
class PushOutlet {
 public:
  virtual ~PushOutlet() = default;
  /// Reports that the object was handed to all edges for which it is due.
  virtual void flush() = 0;
};

/// The server side of Push. It hands every object to all subscribers, each of which has its own queue.
///
/// Thread contract: connect() before the component runs, or from any task; seal() and publish() from one task at a time;
/// disconnect(), announce() and the sources from any task; the rest from any thread.
class PushServerEndpoint final : public Endpoint {
 public:
  PushServerEndpoint(PortHome& home, PortContract contract);
  ~PushServerEndpoint() override;

  /// Adds an edge, not yet subscribed.
  /// @param client  "component.port", for disconnect().
  PushSource& connect(std::string client = {});
  /// Removes the edges to a client. Nobody may use them any more. @pre  they are not subscribed.
  void disconnect(const std::string& client);
  /// Adds an outlet, which is flushed after each object. It outlives the edges that use it.
  /// @thread  before the component runs.
  void add_outlet(PushOutlet& outlet) { outlets_.push_back(&outlet); }

  /// Announces the time between two objects from now on [s]; 0: irregular. All subscribers get new grants of
  /// their rates.
  void announce(Duration base_period);
  [[nodiscard]] Duration base_period() const { return Duration(base_period_); }

  /// Stamps an object that is to be published. From now on nobody can change it.
  /// @param provenance  what the object answers; null: nothing.
  /// @thread  the component's strand; any other only if the contract says from_device.
  [[nodiscard]] ObjectRef seal(ObjectLoan&& loan, const Provenance* provenance);

  /// Hands a sealed object to all subscribers. Only edges whose policy is `block` can make it wait, after all
  /// others have the object. The wait ends early when the component must leave its lap; the object is then
  /// dropped on those edges.
  /// @thread  as seal(), which it follows.
  void publish(ObjectRef&& object);

  [[nodiscard]] std::size_t subscriber_count() const { return subscribers_.load(std::memory_order_acquire); }
  /// Returns how often a client has subscribed so far.
  [[nodiscard]] std::uint64_t subscription_count() const { return subscriptions_; }
  /// Returns whether somebody looks on, such as a recording.
  [[nodiscard]] bool is_looked_at() const;
  /// Returns subscriber_count(), and one more if somebody looks on.
  [[nodiscard]] std::size_t audience() const;
  /// Returns the number of objects pushed so far, with or without subscribers.
  [[nodiscard]] std::uint64_t pushed_count() const { return pushed_; }

 private:
  class Edge;

  bool hand_out(ObjectRef& object);
  void wait_for_room(const ObjectRef& object);
  bool settle(const ObjectRef& object);
  void give_up(const ObjectRef& object);
  [[nodiscard]] TimePoint next_limit() const;

  std::vector<PushOutlet*> outlets_;
  std::atomic<std::size_t> subscribers_{0};
  Published<std::uint64_t> subscriptions_;
  Published<std::uint64_t> pushed_;
  Published<Duration::rep> base_period_;

  mutable TaskMutex mutex_;
  std::vector<std::unique_ptr<Edge>> edges_ ORCA_GUARDED_BY(mutex_);  // all that are connected
  std::vector<Edge*> subscribed_ ORCA_GUARDED_BY(mutex_);             // in order of subscription
};

}  // namespace orca
