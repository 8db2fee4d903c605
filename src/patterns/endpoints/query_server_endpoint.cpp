// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/query_server_endpoint.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/mutex.hpp"

namespace orca {

// One client's part of the intake.
class QueryServerEndpoint::Edge final : public QueryTarget {
 public:
  Edge(QueryServerEndpoint& server, std::string client) : server_(server), client_(std::move(client)) {}

  [[nodiscard]] const std::string& client() const { return client_; }

  std::optional<Result<ObjectRef>> offer(const ObjectRef& request, QueryReplySink& reply_to, QueryId id,
                                         bool may_wait) override;
  void withdraw(QueryId /*id*/) override {}  // no question is held: it was accepted or refused at once
  [[nodiscard]] Duration patience() const override { return Duration{0}; }
  [[nodiscard]] std::string path() const override { return server_.path(); }

  std::uint32_t waiting = 0;  // guarded by the server's lock

 private:
  QueryServerEndpoint& server_;
  const std::string client_;
};

std::optional<Result<ObjectRef>> QueryServerEndpoint::Edge::offer(const ObjectRef& request,
                                                                  QueryReplySink& reply_to, QueryId id,
                                                                  bool /*may_wait*/) {
  {
    const MutexLock lock(server_.mutex_);
    IntakeCounters& counters = server_.counters_;
    if (!server_.handler_) {
      ++counters.refused_closed;
      return fail(Code::unavailable, path() + " answers nothing, because " + server_.closed_because_);
    }
    if (waiting >= server_.contract().queue.depth) {
      ++counters.refused_full;
      return fail(Code::unavailable, path() + " is full: " + std::to_string(waiting) +
                                         " questions of this client wait to be answered; ask again later");
    }
    server_.waiting_.push_back({this, request, &reply_to, id});
    ++waiting;
    ++counters.accepted;
    counters.high_water = std::max(counters.high_water, static_cast<std::uint32_t>(server_.waiting_.size()));
  }
  server_.observe(request);
  server_.home().strand.wake();
  return std::nullopt;
}

QueryServerEndpoint::QueryServerEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)) {}

QueryServerEndpoint::~QueryServerEndpoint() { cut_links(); }

QueryTarget& QueryServerEndpoint::connect(std::string client) {
  const MutexLock lock(mutex_);
  edges_.push_back(std::make_unique<Edge>(*this, std::move(client)));
  return *edges_.back();
}

void QueryServerEndpoint::disconnect(const std::string& client) {
  const MutexLock lock(mutex_);
  counters_.withdrawn +=
      std::erase_if(waiting_, [&](const Question& one) { return one.edge->client() == client; });
  if (handled_ != nullptr && handled_->client() == client) handled_ = nullptr;
  std::erase_if(edges_, [&](const auto& edge) { return edge->client() == client; });
}

void QueryServerEndpoint::open(Handler handler) {
  const MutexLock lock(mutex_);
  handler_ = std::make_shared<const Handler>(std::move(handler));
}

void QueryServerEndpoint::close(const std::string& reason) {
  const MutexLock lock(mutex_);
  handler_ = nullptr;
  closed_because_ = reason;
  for (const Question& question : waiting_)
    question.reply_to->reply(question.id,
                             fail(Code::unavailable, path() + " answers nothing, because " + reason));
  waiting_.clear();
  for (const auto& edge : edges_) edge->waiting = 0;
}

std::optional<QueryServerEndpoint::Question> QueryServerEndpoint::next(
    std::shared_ptr<const Handler>& handler) {
  const MutexLock lock(mutex_);
  if (waiting_.empty() || !handler_) return std::nullopt;
  handler = handler_;
  Question question = std::move(waiting_.front());
  waiting_.pop_front();
  --question.edge->waiting;
  handled_ = question.edge;
  return question;
}

bool QueryServerEndpoint::handle_one() {
  std::shared_ptr<const Handler> handler;
  const std::optional<Question> question = next(handler);
  if (!question) return false;
  home().provenance.begin_handling(question->request.header());
  try {
    answer(*question, (*handler)(question->request));
  } catch (...) {
    answer(*question, fail(Code::internal, path() + " threw while it answered"));
    throw;
  }
  return true;
}

void QueryServerEndpoint::answer(const Question& question, Result<ObjectLoan> answer) {
  if (answer) {
    ObjectLoan loan = std::move(answer).value();
    Provenance of_question;  // not home().provenance: the handler may have taken other objects meanwhile
    of_question.begin_handling(question.request.header());
    stamp(loan, &of_question);
    return reply(question, std::move(loan).seal());
  }
  reply(question, answer.error());
}

// Replies with the lock held, so that the client cannot go meanwhile.
void QueryServerEndpoint::reply(const Question& question, Result<ObjectRef> answer) {
  const MutexLock lock(mutex_);
  if (!answer) ++counters_.failed;
  if (std::exchange(handled_, nullptr) != nullptr) question.reply_to->reply(question.id, std::move(answer));
}

bool QueryServerEndpoint::has_waiting() const {
  const MutexLock lock(mutex_);
  return !waiting_.empty();
}

IntakeCounters QueryServerEndpoint::counters() const {
  const MutexLock lock(mutex_);
  IntakeCounters now_counted = counters_;
  now_counted.refused = counters_.refused_full + counters_.refused_closed + counters_.withdrawn;
  now_counted.queued = static_cast<std::uint32_t>(waiting_.size());
  return now_counted;
}

}  // namespace orca
