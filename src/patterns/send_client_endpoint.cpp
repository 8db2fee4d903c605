// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/send_endpoint.hpp"

namespace orca {

SendClientEndpoint::SendClientEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)) {}

Status SendClientEndpoint::send(ObjectLoan loan, const Provenance* provenance) {
  const Result<SendId> id = offer(std::move(loan), provenance, false);
  if (!id) return id.error();
  if (std::optional<Status> outcome = pending_.take(*id)) return count(std::move(*outcome));
  return receive_until(*id, saturating_add(home().strand.executive().now(), target_->patience()));
}

Status SendClientEndpoint::send_until(ObjectLoan loan, const Provenance* provenance, TimePoint deadline) {
  const Result<SendId> id = offer(std::move(loan), provenance, true);
  return id ? receive_until(*id, deadline) : Status(id.error());
}

Result<SendId> SendClientEndpoint::request(ObjectLoan loan, const Provenance* provenance) {
  return offer(std::move(loan), provenance, false);
}

Result<SendId> SendClientEndpoint::offer(ObjectLoan loan, const Provenance* provenance, bool may_wait) {
  if (target_ == nullptr)
    return fail(Code::failed_precondition, "port " + path() + " is not connected; add <connect from=\"" +
                                               path() + "\" to=\"...\"/> to the graph");
  stamp(loan, provenance);
  const SendId id = pending_.add();
  sent_.fetch_add(1, std::memory_order_relaxed);
  target_->offer(std::move(loan).seal(), *this, id, may_wait);
  return id;
}

std::optional<Status> SendClientEndpoint::receive(SendId id) {
  if (std::optional<Status> outcome = pending_.take(id)) return count(std::move(*outcome));
  if (pending_.state(id) != Pending::State::unknown) return std::nullopt;
  return Status(fail(Code::not_found, path() + " has sent no object " + std::to_string(id)));
}

Status SendClientEndpoint::receive_until(SendId id, TimePoint deadline) {
  try {
    home().strand.wait_for(deadline, [&] { return pending_.state(id) != Pending::State::waiting; });
  } catch (const Interrupted&) {
    withdraw(id);
    throw;
  }
  if (std::optional<Status> outcome = receive(id)) return std::move(*outcome);
  target_->withdraw(*this, id);
  if (std::optional<Status> outcome = receive(id)) return std::move(*outcome);  // accepted at the last moment
  withdraw(id);
  timed_out_.fetch_add(1, std::memory_order_relaxed);
  return fail(Code::deadline_exceeded, target_->path() + " had no room for what " + path() + " sent in time");
}

void SendClientEndpoint::withdraw(SendId id) {
  target_->withdraw(*this, id);
  pending_.forget(id);
}

Status SendClientEndpoint::count(Status outcome) {
  (outcome.ok() ? accepted_ : failed_).fetch_add(1, std::memory_order_relaxed);
  return outcome;
}

void SendClientEndpoint::reply(SendId id, Status outcome) {
  pending_.answer(id, std::move(outcome));
  home().strand.wake();
}

RequestCounters SendClientEndpoint::counters() const {
  return {sent_.load(std::memory_order_relaxed), accepted_.load(std::memory_order_relaxed),
          failed_.load(std::memory_order_relaxed), timed_out_.load(std::memory_order_relaxed)};
}

}  // namespace orca
