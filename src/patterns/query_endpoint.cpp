// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/query_endpoint.hpp"

#include <utility>

namespace orca {

QueryServerEndpoint::QueryServerEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)) {}

Status QueryServerEndpoint::ask(const ObjectRef& request, QueryReplySink& reply_to, QueryId id) {
  {
    const std::lock_guard lock(mutex_);
    if (!handler_) {
      ++counters_.refused;
      return fail(Code::unavailable, path() + " answers nothing, because " + closed_because_);
    }
    if (waiting_.size() >= contract().queue.depth) {
      ++counters_.refused;
      return fail(Code::unavailable, path() + " is full: " + std::to_string(waiting_.size()) +
                                         " questions wait to be answered; ask again later");
    }
    waiting_.push_back({request, &reply_to, id});
    ++counters_.accepted;
  }
  observe(request);
  home().strand.wake();
  return ok();
}

void QueryServerEndpoint::open(Handler handler) {
  const std::lock_guard lock(mutex_);
  handler_ = std::move(handler);
}

void QueryServerEndpoint::close(const std::string& reason) {
  std::deque<Question> left;
  {
    const std::lock_guard lock(mutex_);
    handler_ = nullptr;
    closed_because_ = reason;
    left.swap(waiting_);
  }
  for (const Question& question : left)
    question.reply_to->reply(question.id,
                             fail(Code::unavailable, path() + " answers nothing, because " + reason));
}

std::optional<QueryServerEndpoint::Question> QueryServerEndpoint::next(Handler& handler) {
  const std::lock_guard lock(mutex_);
  if (waiting_.empty() || !handler_) return std::nullopt;
  handler = handler_;
  Question question = std::move(waiting_.front());
  waiting_.pop_front();
  return question;
}

bool QueryServerEndpoint::handle_one() {
  Handler handler;
  const std::optional<Question> question = next(handler);
  if (!question) return false;
  home().provenance.note(question->request.header());
  try {
    answer(*question, handler(question->request));
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
    of_question.note(question.request.header());
    stamp(loan, &of_question);
    question.reply_to->reply(question.id, std::move(loan).seal());
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    ++counters_.failed;
  }
  question.reply_to->reply(question.id, answer.error());
}

bool QueryServerEndpoint::has_waiting() const {
  const std::lock_guard lock(mutex_);
  return !waiting_.empty();
}

IntakeCounters QueryServerEndpoint::counters() const {
  const std::lock_guard lock(mutex_);
  return counters_;
}

QueryClientEndpoint::QueryClientEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)) {}

Result<QueryId> QueryClientEndpoint::request(ObjectLoan loan, const Provenance* provenance) {
  if (target_ == nullptr)
    return fail(Code::failed_precondition, "port " + path() + " is not connected; add <connect from=\"" +
                                               path() + "\" to=\"...\"/> to the graph");
  stamp(loan, provenance);
  QueryId id = 0;
  {
    const std::lock_guard lock(mutex_);
    id = next_id_++;
    pending_.emplace(id, std::nullopt);
  }
  const Status accepted = target_->ask(std::move(loan).seal(), *this, id);
  if (accepted.ok()) return id;
  forget(id);
  return accepted.error();
}

std::optional<Result<ObjectRef>> QueryClientEndpoint::receive(QueryId id) {
  const std::lock_guard lock(mutex_);
  const auto found = pending_.find(id);
  if (found == pending_.end())
    return Result<ObjectRef>(fail(Code::not_found, path() + " has no question " + std::to_string(id)));
  if (!found->second) return std::nullopt;
  std::optional<Result<ObjectRef>> answer = std::move(found->second);
  pending_.erase(found);
  if (*answer) home().provenance.note((*answer)->header());
  return answer;
}

Result<ObjectRef> QueryClientEndpoint::receive_until(QueryId id, TimePoint deadline) {
  home().strand.wait_for(deadline, [&] { return answered(id); });
  if (std::optional<Result<ObjectRef>> answer = receive(id)) return std::move(*answer);
  forget(id);
  return fail(Code::deadline_exceeded, target_->path() + " did not answer " + path() + " in time");
}

void QueryClientEndpoint::forget(QueryId id) {
  const std::lock_guard lock(mutex_);
  pending_.erase(id);
}

bool QueryClientEndpoint::answered(QueryId id) const {
  const std::lock_guard lock(mutex_);
  const auto found = pending_.find(id);
  return found == pending_.end() || found->second.has_value();
}

void QueryClientEndpoint::reply(QueryId id, Result<ObjectRef> answer) {
  const bool good = answer.has_value();
  const ObjectRef object = good ? *answer : ObjectRef{};
  {
    const std::lock_guard lock(mutex_);
    const auto found = pending_.find(id);
    if (found == pending_.end()) return;  // gave up waiting
    found->second = std::move(answer);
  }
  if (good) observe(object);
  home().strand.wake();
}

}  // namespace orca
