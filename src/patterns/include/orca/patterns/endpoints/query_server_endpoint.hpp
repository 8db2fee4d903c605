// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/mutex.hpp"
#include "orca/base/result.hpp"
#include "orca/patterns/counters.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"
#include "orca/patterns/endpoints/request_link.hpp"

namespace orca {

/// The server side of Query. Questions wait here until the component's strand answers them between two laps.
/// Each edge has room for as many questions as the port's depth.
///
/// Thread contract: connect() and counters() from any thread; the targets from any task; the rest from the server's
/// strand.
class QueryServerEndpoint final : public Endpoint {
 public:
  using Handler = std::function<Result<ObjectLoan>(const ObjectRef&)>;

  QueryServerEndpoint(PortHome& home, PortContract contract);
  ~QueryServerEndpoint() override;

  /// Adds an edge.
  /// @param client  "component.port", for disconnect().
  QueryTarget& connect(std::string client = {});
  /// Removes the edges to a client. Its questions that still wait are dropped, and counted as withdrawn; one that is in the
  /// handler is not answered. The client may be destroyed then. Nobody may use the edges any more.
  /// @thread  any; the client does not use them at the same time.
  void disconnect(const std::string& client);

  void open(Handler handler);
  /// Closes the intake and answers the questions that still wait with `reason` as the error.
  void close(const std::string& reason);

  /// Answers one waiting question.
  /// @return false if none was waiting. An exception of the handler is passed on after the client has got an
  /// error as its answer.
  bool handle_one();

  /// Returns whether something waits to be handled.
  [[nodiscard]] bool has_waiting() const;
  /// Returns the counters of all edges together.
  [[nodiscard]] IntakeCounters counters() const;

 private:
  class Edge;
  struct Question {
    Edge* edge = nullptr;
    ObjectRef request;
    QueryReplySink* reply_to = nullptr;
    QueryId id = 0;
  };

  std::optional<Question> next(std::shared_ptr<const Handler>& handler);
  void answer(const Question& question, Result<ObjectLoan> answer);
  void reply(const Question& question, Result<ObjectRef> answer);

  mutable Mutex mutex_;
  std::vector<std::unique_ptr<Edge>> edges_ ORCA_GUARDED_BY(mutex_);
  std::deque<Question> waiting_ ORCA_GUARDED_BY(mutex_);
  // The edge from which the question in the handler came; null: there is none, or its client is gone.
  const Edge* handled_ ORCA_GUARDED_BY(mutex_) = nullptr;
  std::shared_ptr<const Handler> handler_ ORCA_GUARDED_BY(mutex_);
  std::string closed_because_ ORCA_GUARDED_BY(mutex_) = "it has not been started yet";
  IntakeCounters counters_ ORCA_GUARDED_BY(mutex_);
};

}  // namespace orca
