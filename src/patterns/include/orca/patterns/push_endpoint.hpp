// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/task_mutex.hpp"
#include "orca/patterns/counters.hpp"
#include "orca/patterns/endpoint.hpp"
#include "orca/patterns/update_rate.hpp"

namespace orca {

/// Where pushed objects go: one per edge, at the client's side of a link.
///
/// Thread contract: tasks of the client's executive; a link that receives on a thread of its own hands over
/// to a task. Called with the server's lock held, so nothing here may block or call the source back.
class PushSink {
 public:
  virtual ~PushSink() = default;

  /// Takes the object, or drops and counts it; never blocks.
  /// @return nothing when that is done; otherwise the queue is full and its policy asks the publisher to wait
  /// for room and to try again, at most so long: then `object` is as it was.
  /// @thread  the server's strand.
  virtual std::optional<Duration> deliver(ObjectRef&& object) = 0;

  /// The publisher has waited long enough for this object: it is dropped and counted.
  virtual void give_up(const ObjectRef& object) = 0;

  /// The server grants this update rate, at attach() and whenever it changes.
  /// @thread  any.
  virtual void granted(const UpdateGrant& grant) = 0;
};

/// Where a client subscribes: the server's side of a link.
///
/// Thread contract: any task of the server's executive; base_period() and path() from any thread.
class PushSource {
 public:
  virtual ~PushSource() = default;
  virtual void attach(PushSink& sink, const UpdateRate& rate) = 0;
  /// After this nothing more is delivered.
  virtual void detach(PushSink& sink) = 0;
  /// Asks for another rate while subscribed.
  virtual void change(PushSink& sink, const UpdateRate& rate) = 0;
  /// There is room again at an edge for which the publisher waits.
  virtual void room(PushSink& sink) = 0;
  /// Time between two objects [s], if the server is regular and has said so; otherwise 0.
  [[nodiscard]] virtual Duration base_period() const = 0;
  /// "component.port" of the server.
  [[nodiscard]] virtual std::string path() const = 0;
};

/// Server side of Push: hands every object to all subscribers, each with a queue of its own.
///
/// Thread contract: seal() and publish() from one task at a time; announce() and the source from any task;
/// the rest from any thread.
class PushServerEndpoint final : public Endpoint {
 public:
  PushServerEndpoint(PortHome& home, PortContract contract);

  /// Says how often objects come, in future; 0: irregularly. All subscribers are granted their rates anew.
  void announce(Duration base_period);
  [[nodiscard]] Duration base_period() const { return Duration(base_period_); }

  /// Stamps an object that is to be published: from now on nobody can change it.
  /// @param provenance  what the object answers; null: nothing.
  /// @thread  the component's strand; any other only if the contract says from_device.
  [[nodiscard]] ObjectRef seal(ObjectLoan loan, const Provenance* provenance);

  /// Hands a sealed object to all subscribers. Only edges whose policy is `block` can make it wait, after all
  /// others have the object; that wait ends early when the component must leave its lap, and the object is
  /// dropped there.
  /// @thread  as seal(), which it follows.
  void publish(ObjectRef object);

  [[nodiscard]] std::size_t subscriber_count() const { return subscribers_.load(std::memory_order_acquire); }
  /// Objects pushed so far, with or without subscribers.
  [[nodiscard]] std::uint64_t pushed_count() const { return pushed_; }

  /// The source that a local client attaches to.
  [[nodiscard]] PushSource& source() { return source_; }

 private:
  class Source final : public PushSource {
   public:
    explicit Source(PushServerEndpoint& server) : server_(server) {}
    void attach(PushSink& sink, const UpdateRate& rate) override;
    void detach(PushSink& sink) override;
    void change(PushSink& sink, const UpdateRate& rate) override;
    void room(PushSink& sink) override;
    [[nodiscard]] Duration base_period() const override { return server_.base_period(); }
    [[nodiscard]] std::string path() const override { return server_.path(); }

   private:
    PushServerEndpoint& server_;
  };

  struct Subscription {
    PushSink* sink;
    UpdateRate asked;
    UpdateGrant grant{};
    std::uint32_t to_skip = 0;              // objects until the next one is due
    TimePoint next_due{};                   // for irregular servers
    std::optional<TimePoint> owed_until{};  // the publisher waits for room there

    [[nodiscard]] bool is_due(const ObjectRef& object);
    void regrant(Duration base_period);
  };

  Subscription* find(PushSink& sink);
  bool hand_out(ObjectRef& object);
  void wait_for_room(const ObjectRef& object);
  bool settle(const ObjectRef& object);
  void give_up(const ObjectRef& object);
  [[nodiscard]] TimePoint next_limit() const;

  Source source_{*this};
  std::atomic<std::size_t> subscribers_{0};
  Published<std::uint64_t> pushed_;
  Published<Duration::rep> base_period_;

  mutable TaskMutex mutex_;
  std::vector<Subscription> subscriptions_;  // guarded by mutex_
};

/// Client side of one Push edge: the subscription and its queue.
///
/// Thread contract: deliver(), give_up() and granted() from the server's side; counters(), grant() and the
/// paths from anywhere; the rest from the client's strand.
class PushEdge final : public PushSink {
 public:
  PushEdge(Endpoint& client, PushSource& source, const QueuePolicy& policy);

  void subscribe();
  void unsubscribe();
  [[nodiscard]] bool subscribed() const { return subscribed_.load(std::memory_order_acquire); }

  /// Asks to be updated at another rate, now or from the next subscription on. What the graph says of the
  /// edge is the limit.
  void ask(const UpdateRate& rate);
  /// What the server agreed to in this subscription; of an unsubscribed edge, what it agreed to last.
  [[nodiscard]] UpdateGrant grant() const;

  std::optional<Duration> deliver(ObjectRef&& object) override;
  void give_up(const ObjectRef& object) override;
  void granted(const UpdateGrant& grant) override;

  /// The oldest object not yet taken, or null.
  [[nodiscard]] ObjectRef take();
  /// The newest object, taken or not, or null before the first.
  [[nodiscard]] ObjectRef latest() const;
  [[nodiscard]] bool has_new() const { return count_.load(std::memory_order_acquire) > 0; }

  /// Whether the edge's deadline has passed since the last object, or since the subscription; true until the
  /// next object comes. Always false without a deadline.
  [[nodiscard]] bool deadline_missed() const;

  [[nodiscard]] EdgeCounters counters() const;
  [[nodiscard]] const QueuePolicy& policy() const { return policy_; }
  [[nodiscard]] std::string source_path() const { return source_.path(); }
  [[nodiscard]] Duration base_period() const { return source_.base_period(); }

 private:
  // EdgeCounters, each readable at any time.
  struct Counts {
    Published<std::uint64_t> delivered;
    Published<std::uint64_t> dropped_oldest;
    Published<std::uint64_t> dropped_newest;
    Published<std::uint64_t> dropped_blocked;
    Published<std::uint64_t> left_behind;
    Published<std::uint64_t> waits;
    Published<std::uint64_t> missed_deadlines;
    Published<std::uint32_t> high_water;
  };

  bool make_room();
  void put(ObjectRef&& object, std::uint32_t count);
  void arrive(TimePoint time);
  [[nodiscard]] UpdateRate rate() const;
  [[nodiscard]] TimePoint now() const { return client_.home().strand.executive().now(); }
  [[nodiscard]] std::uint64_t missed_until(TimePoint time) const;

  Endpoint& client_;
  PushSource& source_;
  const QueuePolicy policy_;
  UpdateRate asked_;
  std::atomic<bool> subscribed_{false};
  Counts counts_;
  Published<Duration::rep> last_arrival_;  // of an object, or of the subscription; only kept with a deadline

  mutable std::mutex grant_mutex_;
  UpdateGrant grant_;  // guarded by grant_mutex_

  mutable TaskMutex mutex_;
  // Below: guarded by mutex_. The count may be read at any time.
  std::atomic<std::uint32_t> count_{0};
  std::uint32_t first_ = 0;
  std::vector<ObjectRef> ring_;    // never grows: no allocation per object
  ObjectRef newest_;               // as long as it is not in the ring
  bool publisher_waits_ = false;   // for room
  bool subscriber_stuck_ = false;  // it took nothing during a whole wait: nobody waits for it until it does
};

/// Client side of Push: the edges that end at one PushProxy; at most one unless the port is an array.
class PushClientEndpoint final : public Endpoint {
 public:
  PushClientEndpoint(PortHome& home, PortContract contract);

  /// Adds an edge, not yet subscribed.
  PushEdge& connect(PushSource& source, const QueuePolicy& policy);

  [[nodiscard]] bool connected() const { return !edges_.empty(); }
  [[nodiscard]] const std::vector<std::unique_ptr<PushEdge>>& edges() const { return edges_; }
  [[nodiscard]] bool has_new() const;

  void subscribe_all();
  void unsubscribe_all();

 private:
  std::vector<std::unique_ptr<PushEdge>> edges_;
};

}  // namespace orca
