// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "orca/base/mutex.hpp"
#include "orca/base/result.hpp"
#include "orca/patterns/counters.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"
#include "orca/patterns/endpoints/request_link.hpp"

namespace orca {

/// The server side of Send. Accepted objects wait here until the component's strand handles them between two
/// laps. Each edge has its own room, so a sender that floods the server costs the others nothing. On an edge that
/// confirms what is handled, the sender has its answer after that.
///
/// Thread contract: handle_one() from the server's strand; the rest from any thread.
class SendServerEndpoint final : public Endpoint {
 public:
  using Handler = std::function<Status(const ObjectRef&)>;

  SendServerEndpoint(PortHome& home, PortContract contract);
  ~SendServerEndpoint() override;

  /// Adds an edge.
  /// @param client  path of the SendProxy, for messages.
  SendTarget& connect(std::string client, const QueuePolicy& policy);
  /// Gives the edge to a client another policy. Waiting objects stay.
  /// @return false if there is none.
  bool change(const std::string& client, const QueuePolicy& policy);
  /// Removes the edge to a client. Accepted objects are still handled. Those that wait for room, or for their handler's
  /// outcome on an edge that confirms it, are dropped and counted as withdrawn; an object in the handler is not confirmed. The
  /// client may be destroyed then. Nobody may use the edge any more.
  /// @thread  any; the client does not use it at the same time.
  void disconnect(const std::string& client);

  /// Opens or closes the intake. While it is closed, everything is refused with `reason`; accepted objects
  /// stay.
  void open(Handler handler);
  void close(const std::string& reason);

  /// Handles one waiting object.
  /// @return false if none was waiting. The handler's own error is counted and returned through `outcome`;
  /// an exception of the handler is counted and passed on.
  bool handle_one(Status& outcome);

  /// Returns whether something waits to be handled.
  [[nodiscard]] bool has_waiting() const;
  /// Returns the counters of all edges together, with those that were removed.
  [[nodiscard]] IntakeCounters counters() const;
  /// Returns the counters of one edge; edges count in the order of connect(), without those that were removed.
  [[nodiscard]] IntakeCounters counters(std::size_t edge) const;

 private:
  class Edge;
  struct Accepted {
    ObjectRef object;
    std::shared_ptr<Edge> edge;
    SendReplySink* reply_to;  // waits until the object is handled; null: it has its answer
    SendId id;
  };

  bool next(Accepted& accepted, std::shared_ptr<const Handler>& handler);
  void leave(const std::shared_ptr<Edge>& edge) ORCA_REQUIRES(mutex_);
  void settle(const Accepted& accepted, const Status& outcome);

  mutable Mutex mutex_;
  std::vector<std::shared_ptr<Edge>> edges_ ORCA_GUARDED_BY(mutex_);
  IntakeCounters of_gone_ ORCA_GUARDED_BY(mutex_);  // edges that were removed
  std::deque<Accepted> waiting_ ORCA_GUARDED_BY(mutex_);
  std::shared_ptr<const Handler> handler_ ORCA_GUARDED_BY(mutex_);
  std::string closed_because_ ORCA_GUARDED_BY(mutex_) = "it has not been started yet";
};

}  // namespace orca
