// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/send_server_endpoint.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace orca {

// One client's part of the intake.
class SendServerEndpoint::Edge final : public SendTarget {
 public:
  Edge(SendServerEndpoint& server, std::string client, const QueuePolicy& policy)
      : server_(server), client_(std::move(client)), policy_(policy) {}

  std::optional<Status> offer(const ObjectRef& object, SendReplySink& reply_to, SendId id,
                              bool may_wait) override;
  void withdraw(SendId id) override;
  [[nodiscard]] Duration patience() const override {
    return policy_.overflow == QueuePolicy::Overflow::block ? policy_.block_limit : Duration{0};
  }
  [[nodiscard]] std::string path() const override { return server_.path(); }

  // Below: called with the server's lock held.
  void refuse_held(const Error& reason);
  void handled();
  IntakeCounters counters;

 private:
  struct Offer {
    ObjectRef object;
    SendReplySink* reply_to;
    SendId id;
  };

  [[nodiscard]] bool full() const { return counters.queued >= policy_.depth; }
  void take_in(const ObjectRef& object);

  SendServerEndpoint& server_;
  const std::string client_;
  const QueuePolicy policy_;
  std::deque<Offer> held_;  // wait for room
};

std::optional<Status> SendServerEndpoint::Edge::offer(const ObjectRef& object, SendReplySink& reply_to,
                                                      SendId id, bool may_wait) {
  {
    const std::lock_guard lock(server_.mutex_);
    if (!server_.handler_) {
      ++counters.refused_closed;
      return fail(Code::unavailable, path() + " takes nothing, because " + server_.closed_because_);
    }
    if (full()) {
      const bool waits = may_wait || policy_.overflow == QueuePolicy::Overflow::block;
      if (waits && held_.size() < policy_.depth) {
        ++counters.waits;
        held_.push_back({object, &reply_to, id});
        return std::nullopt;
      }
      ++counters.refused_full;
      return fail(Code::unavailable, path() + " is full: " + std::to_string(counters.queued) +
                                         " objects from " + client_ +
                                         " wait to be handled; send again later");
    }
    take_in(object);
  }
  server_.home().strand.wake();
  return ok();
}

void SendServerEndpoint::Edge::take_in(const ObjectRef& object) {
  server_.waiting_.push_back({object, this});
  ++counters.accepted;
  counters.high_water = std::max(counters.high_water, ++counters.queued);
  server_.observe(object);
}

void SendServerEndpoint::Edge::withdraw(SendId id) {
  const std::lock_guard lock(server_.mutex_);
  counters.withdrawn += std::erase_if(held_, [&](const Offer& offer) { return offer.id == id; });
}

void SendServerEndpoint::Edge::refuse_held(const Error& reason) {
  counters.refused_closed += held_.size();
  for (const Offer& offer : held_) offer.reply_to->reply(offer.id, reason);
  held_.clear();
}

void SendServerEndpoint::Edge::handled() {
  --counters.queued;
  if (held_.empty()) return;
  const Offer offer = std::move(held_.front());
  held_.pop_front();
  take_in(offer.object);
  offer.reply_to->reply(offer.id, ok());
}

SendServerEndpoint::SendServerEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)) {}

SendServerEndpoint::~SendServerEndpoint() { cut_links(); }

SendTarget& SendServerEndpoint::connect(std::string client, const QueuePolicy& policy) {
  edges_.push_back(std::make_unique<Edge>(*this, std::move(client), policy));
  return *edges_.back();
}

void SendServerEndpoint::open(Handler handler) {
  const std::lock_guard lock(mutex_);
  handler_ = std::make_shared<const Handler>(std::move(handler));
}

void SendServerEndpoint::close(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  handler_ = nullptr;
  closed_because_ = reason;
  for (const auto& edge : edges_)
    edge->refuse_held(fail(Code::unavailable, path() + " takes nothing, because " + reason));
}

bool SendServerEndpoint::next(Accepted& accepted, std::shared_ptr<const Handler>& handler) {
  const std::lock_guard lock(mutex_);
  if (waiting_.empty() || !handler_) return false;
  handler = handler_;
  accepted = std::move(waiting_.front());
  waiting_.pop_front();
  accepted.edge->handled();
  return true;
}

bool SendServerEndpoint::handle_one(Status& outcome) {
  Accepted accepted;
  std::shared_ptr<const Handler> handler;
  if (!next(accepted, handler)) return false;
  home().provenance.begin_task(accepted.object.header());
  try {
    outcome = (*handler)(accepted.object);
  } catch (...) {
    count_failure(*accepted.edge);
    throw;
  }
  if (!outcome.ok()) {
    home().provenance.refuse_task();
    count_failure(*accepted.edge);
  }
  return true;
}

void SendServerEndpoint::count_failure(Edge& edge) {
  const std::lock_guard lock(mutex_);
  ++edge.counters.failed;
}

bool SendServerEndpoint::has_waiting() const {
  const std::lock_guard lock(mutex_);
  return !waiting_.empty();
}

IntakeCounters SendServerEndpoint::counters() const {
  IntakeCounters all;
  for (std::size_t edge = 0; edge < edges_.size(); ++edge) all += counters(edge);
  return all;
}

IntakeCounters SendServerEndpoint::counters(std::size_t edge) const {
  const std::lock_guard lock(mutex_);
  IntakeCounters of_edge = edges_.at(edge)->counters;
  of_edge.refused = of_edge.refused_full + of_edge.refused_closed + of_edge.withdrawn;
  return of_edge;
}

}  // namespace orca
