// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/send_server_endpoint.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace orca {
namespace {

constexpr Duration kHandlingLimit = 1s;  // of a sender's wait, where the graph gives none

}  // namespace

// One client's part of the intake.
class SendServerEndpoint::Edge final : public SendTarget, public std::enable_shared_from_this<Edge> {
 public:
  Edge(SendServerEndpoint& server, std::string client, const QueuePolicy& first)
      : policy(first), server_(server), client_(std::move(client)) {}

  std::optional<Status> offer(const ObjectRef& object, SendReplySink& reply_to, SendId id,
                              bool may_wait) override;
  void withdraw(SendId id) override;
  [[nodiscard]] Duration patience() const override {
    if (policy.overflow == QueuePolicy::Overflow::block) return policy.block_limit;
    return confirms_handled() ? kHandlingLimit : Duration{0};
  }
  [[nodiscard]] std::string path() const override { return server_.path(); }

  [[nodiscard]] const std::string& client() const { return client_; }

  // Below: called with the server's lock held, which clang cannot follow through the pointer to an edge.
  void refuse_held(const Error& reason);
  void leave();
  void take_next();
  [[nodiscard]] IntakeCounters summed() const;
  IntakeCounters counters;
  QueuePolicy policy;
  bool is_gone = false;

 private:
  struct Offer {
    ObjectRef object;
    SendReplySink* reply_to;
    SendId id;
  };

  [[nodiscard]] bool full() const { return counters.queued >= policy.depth; }
  [[nodiscard]] bool confirms_handled() const { return policy.confirm == QueuePolicy::Confirm::handled; }
  void take_in(const Offer& offer) ORCA_THREAD_WORD(no_thread_safety_analysis);
  template <class Which>
  std::size_t take_back(const Which& which) ORCA_THREAD_WORD(no_thread_safety_analysis);

  SendServerEndpoint& server_;
  const std::string client_;
  std::deque<Offer> held_;  // wait for room
};

std::optional<Status> SendServerEndpoint::Edge::offer(const ObjectRef& object, SendReplySink& reply_to,
                                                      SendId id, bool may_wait) {
  {
    const MutexLock lock(server_.mutex_);
    if (!server_.handler_) {
      ++counters.refused_closed;
      return fail(Code::unavailable, path() + " takes nothing, because " + server_.closed_because_);
    }
    if (full()) {
      const bool waits = may_wait || policy.overflow == QueuePolicy::Overflow::block;
      if (waits && held_.size() < policy.depth) {
        ++counters.waits;
        held_.push_back({object, &reply_to, id});
        return std::nullopt;
      }
      ++counters.refused_full;
      return fail(Code::unavailable, path() + " is full: " + std::to_string(counters.queued) +
                                         " objects from " + client_ +
                                         " wait to be handled; send again later");
    }
    take_in({object, &reply_to, id});
  }
  server_.home().strand.wake();
  if (confirms_handled()) return std::nullopt;
  return ok();
}

void SendServerEndpoint::Edge::take_in(const Offer& offer) {
  server_.waiting_.push_back(
      {offer.object, shared_from_this(), confirms_handled() ? offer.reply_to : nullptr, offer.id});
  ++counters.accepted;
  counters.high_water = std::max(counters.high_water, ++counters.queued);
  server_.observe(offer.object);
}

void SendServerEndpoint::Edge::withdraw(SendId id) {
  const MutexLock lock(server_.mutex_);
  counters.withdrawn += std::erase_if(held_, [&](const Offer& offer) { return offer.id == id; });
  const std::size_t taken_back = take_back([&](const Accepted& one) { return one.id == id; });
  for (std::size_t i = 0; i < taken_back; ++i) take_next();
}

// Takes those objects back whose sender still waits for its answer.
template <class Which>
std::size_t SendServerEndpoint::Edge::take_back(const Which& which) {
  const std::size_t taken_back = std::erase_if(server_.waiting_, [&](const Accepted& one) {
    return one.edge.get() == this && one.reply_to != nullptr && which(one);
  });
  counters.accepted -= taken_back;
  counters.withdrawn += taken_back;
  return taken_back;
}

void SendServerEndpoint::Edge::refuse_held(const Error& reason) {
  counters.refused_closed += held_.size();
  for (const Offer& offer : held_) offer.reply_to->reply(offer.id, reason);
  held_.clear();
}

void SendServerEndpoint::Edge::leave() {
  is_gone = true;
  counters.withdrawn += held_.size();
  held_.clear();
  take_back([](const Accepted& /*any*/) { return true; });
}

IntakeCounters SendServerEndpoint::Edge::summed() const {
  IntakeCounters sum = counters;
  sum.refused = sum.refused_full + sum.refused_closed + sum.withdrawn;
  return sum;
}

// An object has left the queue: the first one that waits for room takes its place.
void SendServerEndpoint::Edge::take_next() {
  --counters.queued;
  if (held_.empty()) return;
  const Offer offer = std::move(held_.front());
  held_.pop_front();
  take_in(offer);
  if (!confirms_handled()) offer.reply_to->reply(offer.id, ok());
}

SendServerEndpoint::SendServerEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)) {}

SendServerEndpoint::~SendServerEndpoint() { cut_links(); }

SendTarget& SendServerEndpoint::connect(std::string client, const QueuePolicy& policy) {
  const MutexLock lock(mutex_);
  edges_.push_back(std::make_shared<Edge>(*this, std::move(client), policy));
  return *edges_.back();
}

bool SendServerEndpoint::change(const std::string& client, const QueuePolicy& policy) {
  const MutexLock lock(mutex_);
  const auto found = std::ranges::find(edges_, client, [](const auto& edge) { return edge->client(); });
  if (found != edges_.end()) (*found)->policy = policy;
  return found != edges_.end();
}

void SendServerEndpoint::disconnect(const std::string& client) {
  const MutexLock lock(mutex_);
  for (const auto& edge : edges_)
    if (edge->client() == client) leave(edge);
  std::erase_if(edges_, [](const auto& edge) { return edge->is_gone; });
}

void SendServerEndpoint::leave(const std::shared_ptr<Edge>& edge) {
  edge->leave();
  of_gone_ += edge->summed();
  of_gone_.queued = 0;  // what is left is counted no more
}

void SendServerEndpoint::open(Handler handler) {
  const MutexLock lock(mutex_);
  handler_ = std::make_shared<const Handler>(std::move(handler));
}

void SendServerEndpoint::close(const std::string& reason) {
  const MutexLock lock(mutex_);
  handler_ = nullptr;
  closed_because_ = reason;
  for (const auto& edge : edges_)
    edge->refuse_held(fail(Code::unavailable, path() + " takes nothing, because " + reason));
}

bool SendServerEndpoint::next(Accepted& accepted, std::shared_ptr<const Handler>& handler) {
  const MutexLock lock(mutex_);
  if (waiting_.empty() || !handler_) return false;
  handler = handler_;
  accepted = std::move(waiting_.front());
  waiting_.pop_front();
  accepted.edge->take_next();
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
    settle(accepted, fail(Code::internal, path() + " did not come to the end of handling the object"));
    throw;
  }
  if (!outcome.ok()) home().provenance.refuse_task();
  settle(accepted, outcome);
  return true;
}

// Counts the outcome of an object, and reports it to a sender that still waits for it. Holds the lock, so that the sender
// cannot go meanwhile.
void SendServerEndpoint::settle(const Accepted& accepted, const Status& outcome) {
  const MutexLock lock(mutex_);
  if (!outcome.ok()) ++(accepted.edge->is_gone ? of_gone_ : accepted.edge->counters).failed;
  if (accepted.reply_to != nullptr && !accepted.edge->is_gone) accepted.reply_to->reply(accepted.id, outcome);
}

bool SendServerEndpoint::has_waiting() const {
  const MutexLock lock(mutex_);
  return !waiting_.empty();
}

IntakeCounters SendServerEndpoint::counters() const {
  const MutexLock lock(mutex_);
  IntakeCounters all = of_gone_;
  for (const auto& edge : edges_) all += edge->summed();
  return all;
}

IntakeCounters SendServerEndpoint::counters(std::size_t edge) const {
  const MutexLock lock(mutex_);
  return edges_.at(edge)->summed();
}

}  // namespace orca
