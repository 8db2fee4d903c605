// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/task_mutex.hpp"
#include "orca/patterns/counters.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"
#include "orca/patterns/endpoints/published.hpp"
#include "orca/patterns/endpoints/push_link.hpp"

namespace orca {

/// The client side of one Push edge: the subscription and its queue.
///
/// Thread contract: deliver(), give_up(), granted() and lost() from the server's side; counters(), grant()
/// and source_path() from any thread; the rest from the client's strand.
class PushEdge final : public PushSink {
 public:
  PushEdge(Endpoint& client, PushSource& source, const QueuePolicy& policy);
  /// Makes an edge that has no server yet.
  /// @param path  "component.port" of the server for which it is kept.
  PushEdge(Endpoint& client, std::string path, const QueuePolicy& policy);

  void subscribe();
  void unsubscribe();
  [[nodiscard]] bool subscribed() const {
    return subscribed_.load(std::memory_order_acquire) && has_server();
  }

  /// Moves the edge to another server, and with it the subscription if there is one. What waits stays, and so does the newest
  /// object until one comes from the new server.
  /// @param source  null: to none. The edge then has no subscription until it is moved to one.
  void move_to(PushSource* source);
  /// Moves the edge to no server, and forgets what waits and the newest object.
  void leave();
  [[nodiscard]] bool has_server() const { return source_.load(std::memory_order_acquire) != nullptr; }
  /// Gives the edge another policy. What waits and finds no room any more is dropped, the oldest first.
  void set_policy(const QueuePolicy& policy);

  /// Requests another update rate, from now on or from the next subscription on. The rate that the graph
  /// gives the edge is the limit.
  void ask(const UpdateRate& rate);
  /// Returns the rate that the server granted in this subscription, or in the last one.
  [[nodiscard]] UpdateGrant grant() const;

  std::optional<Duration> deliver(ObjectRef&& object) override;
  void give_up(const ObjectRef& object) override;
  void granted(const UpdateGrant& grant) override;
  void lost(std::uint64_t objects) override;

  /// Takes the oldest object that has not been taken yet; null if there is none.
  [[nodiscard]] ObjectRef take();
  /// Returns the newest object, taken or not; null before the first.
  [[nodiscard]] ObjectRef latest() const;
  /// Returns the stamp of the object that take() would return; nothing if there is none.
  [[nodiscard]] std::optional<TimePoint> oldest_stamp() const;
  /// Drops the waiting objects whose stamp is before `time`, up to the first that is not.
  /// @return whether there were any.
  bool drop_before(TimePoint time);
  /// Returns whether an object waits to be taken.
  [[nodiscard]] bool has_new() const {
    look();
    return holds_new();
  }
  /// Does the same, without a look at what has arrived from other processes.
  [[nodiscard]] bool holds_new() const { return count_.load(std::memory_order_acquire) > 0; }

  /// Returns whether the edge's deadline has passed since the last object, or since the subscription. It
  /// stays true until the next object comes. It is always false without a deadline.
  [[nodiscard]] bool deadline_missed() const;

  /// Reports to the observer that a deadline was missed, once until the next object comes.
  /// @return when to call it again if the strand is not woken before; kForever while no deadline runs.
  TimePoint watch_deadline();

  [[nodiscard]] EdgeCounters counters() const;
  [[nodiscard]] const QueuePolicy& policy() const { return policy_; }
  /// Returns "component.port" of the present server, or of the last one.
  [[nodiscard]] std::string source_path() const;
  [[nodiscard]] Duration base_period() const { return has_server() ? source()->base_period() : Duration{0}; }

 private:
  static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

  // The numbers of EdgeCounters, each readable at any time.
  struct Counts {
    Published<std::uint64_t> delivered;
    Published<std::uint64_t> dropped_oldest;
    Published<std::uint64_t> dropped_newest;
    Published<std::uint64_t> dropped_blocked;
    Published<std::uint64_t> dropped_by_link;
    Published<std::uint64_t> unmatched;
    Published<std::uint64_t> left_behind;
    Published<std::uint64_t> waits;
    Published<std::uint64_t> missed_deadlines;
    Published<std::uint32_t> high_water;
  };

  void look() const { strand_.take_in(); }
  [[nodiscard]] PushSource* source() const { return source_.load(std::memory_order_acquire); }
  [[nodiscard]] QueuePolicy policy_now() const;
  void tell_of_link(bool connected) const;
  void fit(const QueuePolicy& policy);
  void forget_objects();
  [[nodiscard]] ObjectRef pop();
  bool make_room();
  void drop(Published<std::uint64_t>& reason, std::uint64_t objects);
  [[nodiscard]] std::uint64_t drops_to_report();
  void report_drops(std::uint64_t drops) const;
  void report(LinkTrouble kind, const std::string& text) const;
  void put(ObjectRef&& object, std::uint32_t count);
  void expect_first();
  bool count_missed(TimePoint time);
  void note_missed();
  [[nodiscard]] UpdateRate rate() const;
  [[nodiscard]] TimePoint now() const { return strand_.executive().now(); }
  [[nodiscard]] std::uint64_t missed_until(TimePoint time) const;

  Endpoint& client_;
  Strand& strand_;  // of the client: each push and each look needs it
  std::atomic<PushSource*> source_{nullptr};
  UpdateRate asked_;
  std::atomic<bool> subscribed_{false};  // or will be, as soon as there is a server
  Counts counts_;
  Published<Duration::rep> last_arrival_;   // of an object, or of the subscription; only kept with a deadline
  Published<Duration::rep> deadline_;       // of the policy, for all threads
  Published<std::int64_t> accepted_drops_;  // of the policy, for all threads; -1: any number

  mutable std::mutex told_mutex_;
  // Guarded by told_mutex_.
  UpdateGrant grant_;
  std::string path_;  // of the server

  mutable TaskMutex mutex_;
  QueuePolicy policy_;  // written by the client's strand with the lock held, which reads it without
  // Below: guarded by mutex_. The count may be read at any time.
  std::atomic<std::uint32_t> count_{0};
  std::uint32_t first_ = 0;
  std::vector<ObjectRef> ring_;      // never grows: no allocation per object
  ObjectRef newest_;                 // as long as it is not in the ring
  bool publisher_waits_ = false;     // for room
  bool subscriber_stuck_ = false;    // it took nothing during a whole wait: nobody waits for it until it does
  std::uint64_t late_arrivals_ = 0;  // objects that came after their deadline
  std::uint64_t reported_delays_ = 0;       // those of them that were reported, and the present one if it was
  Published<std::uint64_t> drops_;          // while subscribed; may be read at any time
  std::uint64_t report_drops_at_ = kNever;  // the number of drops at which they are reported next
};

}  // namespace orca
