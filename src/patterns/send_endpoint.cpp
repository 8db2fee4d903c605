// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/send_endpoint.hpp"

namespace orca {

SendServerEndpoint::SendServerEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)) {}

Status SendServerEndpoint::offer(const ObjectRef& object) {
  {
    const std::lock_guard lock(mutex_);
    if (!handler_) {
      ++counters_.refused;
      return fail(Code::unavailable, path() + " takes nothing, because " + closed_because_);
    }
    if (waiting_.size() >= contract().queue.depth) {
      ++counters_.refused;
      return fail(Code::unavailable, path() + " is full: " + std::to_string(waiting_.size()) +
                                         " objects wait to be handled; send again later");
    }
    waiting_.push_back(object);
    ++counters_.accepted;
  }
  observe(object);
  home().strand.wake();
  return ok();
}

void SendServerEndpoint::open(Handler handler) {
  const std::lock_guard lock(mutex_);
  handler_ = std::move(handler);
}

void SendServerEndpoint::close(std::string reason) {
  const std::lock_guard lock(mutex_);
  handler_ = nullptr;
  closed_because_ = std::move(reason);
}

bool SendServerEndpoint::handle_one(Status& outcome) {
  ObjectRef object;
  Handler handler;
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty() || !handler_) return false;
    object = std::move(waiting_.front());
    waiting_.pop_front();
    handler = handler_;
  }
  home().provenance.note(object.header());
  try {
    outcome = handler(object);
  } catch (...) {
    count_failure();
    throw;
  }
  if (!outcome.ok()) count_failure();
  return true;
}

void SendServerEndpoint::count_failure() {
  const std::lock_guard lock(mutex_);
  ++counters_.failed;
}

bool SendServerEndpoint::has_waiting() const {
  const std::lock_guard lock(mutex_);
  return !waiting_.empty();
}

IntakeCounters SendServerEndpoint::counters() const {
  const std::lock_guard lock(mutex_);
  return counters_;
}

SendClientEndpoint::SendClientEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)) {}

Status SendClientEndpoint::send(ObjectLoan loan, const Provenance* provenance) {
  if (target_ == nullptr)
    return fail(Code::failed_precondition, "port " + path() + " is not connected; add <connect from=\"" +
                                               path() + "\" to=\"...\"/> to the graph");
  stamp(loan, provenance);
  return target_->offer(std::move(loan).seal());
}

}  // namespace orca
