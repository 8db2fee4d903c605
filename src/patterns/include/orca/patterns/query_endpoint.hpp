// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "orca/base/result.hpp"
#include "orca/patterns/counters.hpp"
#include "orca/patterns/endpoint.hpp"
#include "orca/patterns/pending_answers.hpp"

namespace orca {

/// Names one question of one client until its answer has been taken.
using QueryId = std::uint64_t;

/// Where answers go: the client's side of a link.
class QueryReplySink {
 public:
  virtual ~QueryReplySink() = default;
  virtual void reply(QueryId id, Result<ObjectRef> answer) = 0;
};

/// Where questions go: the server's side of a link.
class QueryTarget {
 public:
  virtual ~QueryTarget() = default;
  /// Accepts the question, or refuses it with the reason. An accepted question is always answered, be it by
  /// an error.
  virtual Status ask(const ObjectRef& request, QueryReplySink& reply_to, QueryId id) = 0;
  [[nodiscard]] virtual std::string path() const = 0;
};

/// Server side of Query: questions wait here until the component's strand answers them between two laps. Each
/// client has room for as many as the port's depth says.
///
/// Thread contract: ask() from any strand; the rest from the server's.
class QueryServerEndpoint final : public Endpoint, public QueryTarget {
 public:
  using Handler = std::function<Result<ObjectLoan>(const ObjectRef&)>;

  QueryServerEndpoint(PortHome& home, PortContract contract);

  Status ask(const ObjectRef& request, QueryReplySink& reply_to, QueryId id) override;
  [[nodiscard]] std::string path() const override { return Endpoint::path(); }

  void open(Handler handler);
  /// Closes the intake and answers what still waits with `reason` as the error.
  void close(const std::string& reason);

  /// Answers one waiting question.
  /// @return false if none was waiting. An exception of the handler is passed on after the client has been
  /// told.
  bool handle_one();

  /// Whether something waits to be handled.
  [[nodiscard]] bool has_waiting() const;
  [[nodiscard]] IntakeCounters counters() const;

 private:
  struct Question {
    ObjectRef request;
    QueryReplySink* reply_to = nullptr;
    QueryId id = 0;
  };

  std::optional<Question> next(std::shared_ptr<const Handler>& handler);
  void answer(const Question& question, Result<ObjectLoan> answer);

  mutable std::mutex mutex_;
  std::deque<Question> waiting_;
  std::shared_ptr<const Handler> handler_;
  std::string closed_because_ = "it has not been started yet";
  IntakeCounters counters_;
};

/// Client side of Query.
///
/// Thread contract: reply() from the server's strand, counters() from anywhere, the rest from the client's
/// strand.
class QueryClientEndpoint final : public Endpoint, public QueryReplySink {
 public:
  QueryClientEndpoint(PortHome& home, PortContract contract);

  void connect(QueryTarget& target) { target_ = &target; }
  [[nodiscard]] bool connected() const { return target_ != nullptr; }

  /// @errors  failed_precondition if not connected; unavailable with the server's reason if refused.
  Result<QueryId> request(ObjectLoan loan, const Provenance* provenance);

  /// The answer, or nothing while there is none yet.
  /// @errors  not_found for an id that was never given or whose answer has been taken.
  std::optional<Result<ObjectRef>> receive(QueryId id);

  /// Blocks until the answer is there; forgets the question at the deadline.
  /// @errors  deadline_exceeded; throws Interrupted.
  Result<ObjectRef> receive_until(QueryId id, TimePoint deadline);

  /// Nobody waits for this answer any more: it is thrown away, now or when it comes.
  void forget(QueryId id) { pending_.forget(id); }

  void reply(QueryId id, Result<ObjectRef> answer) override;

  [[nodiscard]] RequestCounters counters() const;

 private:
  using Pending = PendingAnswers<Result<ObjectRef>>;

  QueryTarget* target_ = nullptr;
  Pending pending_;
  // Written by the client's strand only.
  std::atomic<std::uint64_t> sent_{0};
  std::atomic<std::uint64_t> answered_{0};
  std::atomic<std::uint64_t> failed_{0};
  std::atomic<std::uint64_t> timed_out_{0};
};

}  // namespace orca
