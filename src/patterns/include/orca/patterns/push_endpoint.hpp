// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "orca/patterns/endpoint.hpp"

namespace orca {

/// Where pushed objects go: one per edge, at the client's side of a link.
class PushSink {
 public:
  virtual ~PushSink() = default;
  /// Takes the object without blocking.
  /// @thread  the server's strand.
  virtual void deliver(const ObjectRef& object) = 0;
};

/// Where a client subscribes: the server's side of a link.
class PushSource {
 public:
  virtual ~PushSource() = default;
  virtual void attach(PushSink& sink) = 0;
  virtual void detach(PushSink& sink) = 0;
  /// "component.port" of the server.
  [[nodiscard]] virtual std::string path() const = 0;
};

/// Server side of Push: hands every object to all subscribers, each with a queue of its own.
///
/// Thread contract: push() from one strand at a time; subscriptions from any.
class PushServerEndpoint final : public Endpoint {
 public:
  PushServerEndpoint(PortHome& home, PortContract contract);

  /// Stamps the object and hands it on. Costs nothing more when nobody listens.
  /// @param provenance  what the object answers; null: nothing.
  /// @return the object as all subscribers see it.
  ObjectRef push(ObjectLoan loan, const Provenance* provenance);

  [[nodiscard]] std::size_t subscriber_count() const { return subscribers_.load(std::memory_order_acquire); }

  /// The source that a local client attaches to.
  [[nodiscard]] PushSource& source() { return source_; }

 private:
  class Source final : public PushSource {
   public:
    explicit Source(PushServerEndpoint& server) : server_(server) {}
    void attach(PushSink& sink) override;
    void detach(PushSink& sink) override;
    [[nodiscard]] std::string path() const override { return server_.path(); }

   private:
    PushServerEndpoint& server_;
  };

  Source source_{*this};
  mutable std::mutex mutex_;
  std::vector<PushSink*> sinks_;
  std::atomic<std::size_t> subscribers_{0};
};

/// What has happened on one edge so far.
struct EdgeCounters {
  std::uint64_t delivered = 0;  ///< Objects put into the queue.
  std::uint64_t dropped = 0;    ///< Objects lost because the queue was full.
};

/// Client side of one Push edge: the subscription and its queue.
///
/// Thread contract: deliver() from the server's strand, the rest from the client's.
class PushEdge final : public PushSink {
 public:
  PushEdge(Endpoint& client, PushSource& source, QueuePolicy policy,
           std::function<void(const ObjectRef&)> observe);

  void subscribe();
  void unsubscribe();
  [[nodiscard]] bool subscribed() const { return subscribed_; }

  void deliver(const ObjectRef& object) override;

  /// The oldest object not yet taken, or null.
  [[nodiscard]] ObjectRef take();
  /// The newest object, taken or not, or null before the first.
  [[nodiscard]] ObjectRef latest() const;
  [[nodiscard]] bool has_new() const;
  [[nodiscard]] EdgeCounters counters() const;
  [[nodiscard]] std::string source_path() const { return source_.path(); }

 private:
  bool interval_has_passed(const ObjectRef& object);

  Endpoint& client_;
  PushSource& source_;
  const QueuePolicy policy_;
  const std::function<void(const ObjectRef&)> observe_;
  bool subscribed_ = false;

  mutable std::mutex mutex_;
  std::vector<ObjectRef> ring_;  // never grows: no allocation per object
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  ObjectRef newest_;
  std::optional<Duration> last_made_;  // of the object delivered last
  EdgeCounters counters_;
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
