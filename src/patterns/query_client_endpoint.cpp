// SPDX-License-Identifier: LGPL-3.0-or-later
#include <utility>

#include "orca/patterns/query_endpoint.hpp"

namespace orca {

QueryClientEndpoint::QueryClientEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)) {}

Result<QueryId> QueryClientEndpoint::request(ObjectLoan loan, const Provenance* provenance) {
  if (target_ == nullptr)
    return fail(Code::failed_precondition, "port " + path() + " is not connected; add <connect from=\"" +
                                               path() + "\" to=\"...\"/> to the graph");
  stamp(loan, provenance);
  const QueryId id = pending_.add();
  sent_.fetch_add(1, std::memory_order_relaxed);
  const Status accepted = target_->ask(std::move(loan).seal(), *this, id);
  if (accepted.ok()) return id;
  pending_.forget(id);
  failed_.fetch_add(1, std::memory_order_relaxed);
  return accepted.error();
}

std::optional<Result<ObjectRef>> QueryClientEndpoint::receive(QueryId id) {
  std::optional<Result<ObjectRef>> answer = pending_.take(id);
  if (!answer) {
    if (pending_.state(id) != Pending::State::unknown) return std::nullopt;
    return Result<ObjectRef>(fail(Code::not_found, path() + " has no question " + std::to_string(id)));
  }
  if (*answer) home().provenance.note((*answer)->header());
  (*answer ? answered_ : failed_).fetch_add(1, std::memory_order_relaxed);
  return answer;
}

Result<ObjectRef> QueryClientEndpoint::receive_until(QueryId id, TimePoint deadline) {
  home().strand.wait_for(deadline, [&] { return pending_.state(id) != Pending::State::waiting; });
  if (std::optional<Result<ObjectRef>> answer = receive(id)) return std::move(*answer);
  forget(id);
  timed_out_.fetch_add(1, std::memory_order_relaxed);
  return fail(Code::deadline_exceeded, target_->path() + " did not answer " + path() + " in time");
}

void QueryClientEndpoint::reply(QueryId id, Result<ObjectRef> answer) {
  const ObjectRef object = answer.has_value() ? *answer : ObjectRef{};
  if (!pending_.answer(id, std::move(answer))) return;  // gave up waiting
  if (object) observe(object);
  home().strand.wake();
}

RequestCounters QueryClientEndpoint::counters() const {
  return {sent_.load(std::memory_order_relaxed), answered_.load(std::memory_order_relaxed),
          failed_.load(std::memory_order_relaxed), timed_out_.load(std::memory_order_relaxed)};
}

}  // namespace orca
