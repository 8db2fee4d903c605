// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/patterns/counters.hpp"
#include "orca/patterns/endpoint.hpp"
#include "orca/patterns/pending_answers.hpp"

namespace orca {

/// Names one sent object of one client until its outcome has been taken.
using SendId = std::uint64_t;

/// Where the outcomes of sent objects go: the client's side of a link.
class SendReplySink {
 public:
  virtual ~SendReplySink() = default;
  /// The object was accepted, from now on it is not lost; or it was refused, with the reason.
  /// @thread  called with the server's lock held: must not call the target back.
  virtual void reply(SendId id, Status outcome) = 0;
};

/// Where sent objects go: the server's side of one edge.
///
/// Thread contract: the client's strand.
class SendTarget {
 public:
  virtual ~SendTarget() = default;

  /// Accepts or refuses the object and says so through `reply_to`, as a rule before it returns. Never blocks.
  /// @param may_wait  a full server keeps the offer until it has room, as it does for every offer where the
  /// edge's policy is `block`.
  virtual void offer(const ObjectRef& object, SendReplySink& reply_to, SendId id, bool may_wait) = 0;
  /// The client waits no longer: an offer that was not accepted by now never will be.
  virtual void withdraw(SendReplySink& reply_to, SendId id) = 0;
  /// How long a client should wait for an outcome that does not come at once.
  [[nodiscard]] virtual Duration patience() const = 0;
  [[nodiscard]] virtual std::string path() const = 0;
};

/// Server side of Send: accepted objects wait here until the component's strand handles them between two
/// laps. Each edge has room of its own, so a sender that floods the server costs the others nothing.
///
/// Thread contract: connect() before the components run; handle_one() from the server's strand; the rest from
/// any.
class SendServerEndpoint final : public Endpoint {
 public:
  using Handler = std::function<Status(const ObjectRef&)>;

  SendServerEndpoint(PortHome& home, PortContract contract);
  ~SendServerEndpoint() override;

  /// Adds an edge.
  /// @param client  path of the SendProxy, for messages.
  SendTarget& connect(std::string client, const QueuePolicy& policy);

  /// Opens or closes the intake. Closed, everything is refused with `reason`; what was accepted stays.
  void open(Handler handler);
  void close(const std::string& reason);

  /// Handles one waiting object.
  /// @return false if none was waiting. The handler's own error is counted and returned through `outcome`;
  /// what it throws is counted and passes.
  bool handle_one(Status& outcome);

  /// Whether something waits to be handled.
  [[nodiscard]] bool has_waiting() const;
  /// Of all edges together.
  [[nodiscard]] IntakeCounters counters() const;
  /// Of one edge, in the order of connect().
  [[nodiscard]] IntakeCounters counters(std::size_t edge) const;
  [[nodiscard]] std::size_t edge_count() const { return edges_.size(); }

 private:
  class Edge;
  struct Accepted {
    ObjectRef object;
    Edge* edge;
  };

  bool next(Accepted& accepted, std::shared_ptr<const Handler>& handler);
  void count_failure(Edge& edge);

  std::vector<std::unique_ptr<Edge>> edges_;

  mutable std::mutex mutex_;
  // Below, and the edges' content: guarded by mutex_.
  std::deque<Accepted> waiting_;
  std::shared_ptr<const Handler> handler_;
  std::string closed_because_ = "it has not been started yet";
};

/// Client side of Send.
///
/// Thread contract: reply() from the server's side, counters() from anywhere, the rest from the client's
/// strand.
class SendClientEndpoint final : public Endpoint, public SendReplySink {
 public:
  SendClientEndpoint(PortHome& home, PortContract contract);

  void connect(SendTarget& target) { target_ = &target; }
  [[nodiscard]] bool connected() const { return target_ != nullptr; }

  /// Sends and waits for the outcome, which on most edges is there at once.
  /// @errors  failed_precondition if not connected; unavailable with the server's reason if refused;
  /// deadline_exceeded. Throws Interrupted.
  Status send(ObjectLoan loan, const Provenance* provenance);
  /// The same, but where the server is full, waits for room until the deadline.
  Status send_until(ObjectLoan loan, const Provenance* provenance, TimePoint deadline);

  /// Sends without waiting for the outcome.
  /// @errors  failed_precondition if not connected.
  Result<SendId> request(ObjectLoan loan, const Provenance* provenance);
  /// The outcome, or nothing while there is none yet.
  /// @errors  not_found for an id that was never given or whose outcome has been taken.
  std::optional<Status> receive(SendId id);
  /// Blocks until the outcome is there; at the deadline the object is withdrawn.
  /// @errors  deadline_exceeded; throws Interrupted.
  Status receive_until(SendId id, TimePoint deadline);

  void reply(SendId id, Status outcome) override;

  [[nodiscard]] RequestCounters counters() const;

 private:
  using Pending = PendingAnswers<Status>;

  Result<SendId> offer(ObjectLoan loan, const Provenance* provenance, bool may_wait);
  void withdraw(SendId id);
  Status count(Status outcome);

  SendTarget* target_ = nullptr;
  Pending pending_;
  // Written by the client's strand only.
  std::atomic<std::uint64_t> sent_{0};
  std::atomic<std::uint64_t> accepted_{0};
  std::atomic<std::uint64_t> failed_{0};
  std::atomic<std::uint64_t> timed_out_{0};
};

}  // namespace orca
