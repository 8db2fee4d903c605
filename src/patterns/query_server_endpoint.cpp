// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/query_endpoint.hpp"

#include <algorithm>
#include <utility>

namespace orca {

QueryServerEndpoint::QueryServerEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)) {}

Status QueryServerEndpoint::ask(const ObjectRef& request, QueryReplySink& reply_to, QueryId id) {
  {
    const std::lock_guard lock(mutex_);
    if (!handler_) {
      ++counters_.refused_closed;
      return fail(Code::unavailable, path() + " answers nothing, because " + closed_because_);
    }
    const auto waiting = std::ranges::count(waiting_, &reply_to, &Question::reply_to);
    if (waiting >= static_cast<std::ptrdiff_t>(contract().queue.depth)) {
      ++counters_.refused_full;
      return fail(Code::unavailable, path() + " is full: " + std::to_string(waiting) +
                                         " questions of this client wait to be answered; ask again later");
    }
    waiting_.push_back({request, &reply_to, id});
    ++counters_.accepted;
    counters_.high_water = std::max(counters_.high_water, static_cast<std::uint32_t>(waiting_.size()));
  }
  observe(request);
  home().strand.wake();
  return ok();
}

void QueryServerEndpoint::open(Handler handler) {
  const std::lock_guard lock(mutex_);
  handler_ = std::make_shared<const Handler>(std::move(handler));
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

std::optional<QueryServerEndpoint::Question> QueryServerEndpoint::next(
    std::shared_ptr<const Handler>& handler) {
  const std::lock_guard lock(mutex_);
  if (waiting_.empty() || !handler_) return std::nullopt;
  handler = handler_;
  Question question = std::move(waiting_.front());
  waiting_.pop_front();
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
  IntakeCounters now_counted = counters_;
  now_counted.refused = counters_.refused_full + counters_.refused_closed;
  now_counted.queued = static_cast<std::uint32_t>(waiting_.size());
  return now_counted;
}

}  // namespace orca
