// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/mutex.hpp"
#include "orca/base/system/recent_times.hpp"
#include "orca/patterns/counters.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"
#include "orca/patterns/endpoints/published.hpp"
#include "orca/patterns/endpoints/push_link.hpp"
#include "orca/patterns/endpoints/task_mutex.hpp"

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

  /// Moves the edge to another server, and with it the subscription if there is one. Waiting objects stay, and so does the
  /// newest one until the new server sends another.
  /// @param source  null: to none. The edge then has no subscription until it is moved to one.
  void move_to(PushSource* source);
  /// Moves the edge to no server, and forgets what waits and the newest object.
  void leave();
  [[nodiscard]] bool has_server() const { return source_.load(std::memory_order_acquire) != nullptr; }
  /// Gives the edge another policy. Waiting objects without room are dropped, the oldest first.
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
  /// Returns how old objects were lately when they arrived, counted from their creation_time, by the clock that the processes of a
  /// machine share; nothing in virtual time, in which it is not measured.
  [[nodiscard]] std::optional<TimeFigures> ages() const;
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
  void tell_of_link(bool connected) const;
  void fit(const QueuePolicy& policy) ORCA_REQUIRES(mutex_);
  void forget_objects();
  [[nodiscard]] ObjectRef pop();
  bool make_room() ORCA_REQUIRES(mutex_);
  void drop(Published<std::uint64_t>& reason, std::uint64_t objects) ORCA_REQUIRES(mutex_);
  [[nodiscard]] std::uint64_t drops_to_report() ORCA_REQUIRES(mutex_);
  void report_drops(std::uint64_t drops) const;
  void report(LinkTrouble kind, const std::string& text) const;
  void put(ObjectRef&& object, std::uint32_t count) ORCA_REQUIRES(mutex_);
  void expect_first();
  bool count_missed(TimePoint time) ORCA_REQUIRES(mutex_);
  void note_missed() ORCA_REQUIRES(mutex_);
  [[nodiscard]] UpdateRate rate() const;
  [[nodiscard]] TimePoint now() const { return strand_.executive().now(); }
  [[nodiscard]] std::uint64_t missed_until(TimePoint time) const;

  Endpoint& client_;
  Strand& strand_;  // of the client: each push and each look needs it
  std::atomic<PushSource*> source_{nullptr};
  UpdateRate asked_;
  std::atomic<bool> subscribed_{false};  // or will be, as soon as there is a server
  Counts counts_;
  const std::unique_ptr<RecentTimes> ages_;  // of objects when they arrived; null in virtual time
  Published<Duration::rep> last_arrival_;   // of an object, or of the subscription; only kept with a deadline
  Published<Duration::rep> deadline_;       // of the policy, for all threads
  Published<std::int64_t> accepted_drops_;  // of the policy, for all threads; -1: any number

  mutable Mutex told_mutex_;
  UpdateGrant grant_ ORCA_GUARDED_BY(told_mutex_);
  std::string path_ ORCA_GUARDED_BY(told_mutex_);  // of the server

  mutable TaskMutex mutex_;
  QueuePolicy policy_;  // written by the client's strand with the lock held, which reads it without
  std::atomic<std::uint32_t> count_{0};
  std::uint32_t first_ ORCA_GUARDED_BY(mutex_) = 0;
  std::vector<ObjectRef> ring_ ORCA_GUARDED_BY(mutex_);   // never grows: no allocation per object
  ObjectRef newest_ ORCA_GUARDED_BY(mutex_);              // as long as it is not in the ring
  bool publisher_waits_ ORCA_GUARDED_BY(mutex_) = false;  // for room
  // It took nothing during a whole wait: nobody waits for it until it does.
  bool subscriber_stuck_ ORCA_GUARDED_BY(mutex_) = false;
  std::uint64_t late_arrivals_ ORCA_GUARDED_BY(mutex_) = 0;  // objects that came after their deadline
  // Those of them that were reported, and the present one if it was.
  std::uint64_t reported_delays_ ORCA_GUARDED_BY(mutex_) = 0;
  Published<std::uint64_t> drops_;  // while subscribed; may be read at any time
  // The number of drops at which they are reported next.
  std::uint64_t report_drops_at_ ORCA_GUARDED_BY(mutex_) = kNever;
};

}  // namespace orca
