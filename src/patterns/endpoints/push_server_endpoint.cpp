// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/push_server_endpoint.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace orca {

// One client's subscription, or the place for it.
class PushServerEndpoint::Edge final : public PushSource {
 public:
  Edge(PushServerEndpoint& server, std::string client) : server_(server), client_(std::move(client)) {}

  [[nodiscard]] const std::string& client() const { return client_; }
  void attach(PushSink& sink, const UpdateRate& rate) override;
  void detach() override;
  void change(const UpdateRate& rate) override;
  void room() override { server_.home().strand.wake(); }
  [[nodiscard]] Duration base_period() const override { return server_.base_period(); }
  [[nodiscard]] std::string path() const override { return server_.path(); }

  // Below: called with the server's lock held, while subscribed.
  [[nodiscard]] bool is_due(const ObjectRef& object);
  [[nodiscard]] PushSink& sink() const { return *sink_; }
  void regrant();

  std::optional<TimePoint> owed_until{};  // the publisher waits for room there

 private:
  PushServerEndpoint& server_;
  const std::string client_;
  PushSink* sink_ = nullptr;  // null: not subscribed
  UpdateRate asked_;
  UpdateGrant grant_;
  std::uint32_t to_skip_ = 0;  // objects until the next one is due
  TimePoint next_due_{};       // for irregular servers
};

inline bool PushServerEndpoint::Edge::is_due(const ObjectRef& object) {
  if (to_skip_ > 0) {
    --to_skip_;
    return false;
  }
  if (grant_.base_period == Duration{0} && grant_.interval > Duration{0}) {
    const TimePoint made(Duration(object.header().creation_time().ns()));
    if (made < next_due_) return false;
    next_due_ = saturating_add(made, grant_.interval);
  }
  to_skip_ = grant_.multiple - 1;
  return true;
}

PushServerEndpoint::PushServerEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)),
      base_period_(Endpoint::contract().period.count()),
      mutex_(home.strand.executive()) {}

PushServerEndpoint::~PushServerEndpoint() { cut_links(); }

PushSource& PushServerEndpoint::connect(std::string client) {
  const MutexLock lock(mutex_);
  edges_.push_back(std::make_unique<Edge>(*this, std::move(client)));
  return *edges_.back();
}

void PushServerEndpoint::disconnect(const std::string& client) {
  const MutexLock lock(mutex_);
  std::erase_if(edges_, [&](const auto& edge) { return edge->client() == client; });
}

void PushServerEndpoint::announce(Duration base_period) {
  const MutexLock lock(mutex_);
  base_period_ = base_period.count();
  for (Edge* edge : subscribed_) edge->regrant();
}

ObjectRef PushServerEndpoint::seal(ObjectLoan&& loan, const Provenance* provenance) {
  stamp(loan, provenance);
  return std::move(loan).seal();
}

void PushServerEndpoint::publish(ObjectRef&& object) {
  ++pushed_;
  if (LinkObserver* observer = home().observer) observer->pushed(component(), contract().name, object);
  if (subscriber_count() > 0 && !hand_out(object)) wait_for_room(object);
}

bool PushServerEndpoint::is_looked_at() const {
  LinkObserver* const observer = home().observer;
  return observer != nullptr && observer->is_looked_at(component(), contract().name);
}

std::size_t PushServerEndpoint::audience() const { return subscriber_count() + (is_looked_at() ? 1 : 0); }

// Returns false if the publisher must wait for room somewhere. Otherwise the last subscriber may have got the
// publisher's own view.
bool PushServerEndpoint::hand_out(ObjectRef& object) {
  bool done = true;
  const MutexLock lock(mutex_);
  for (Edge* edge : subscribed_) {
    if (!edge->is_due(object)) continue;
    const bool mine = done && edge == subscribed_.back();
    const std::optional<Duration> wait =
        mine ? edge->sink().deliver(std::move(object)) : edge->sink().deliver(ObjectRef(object));
    if (!wait) continue;
    edge->owed_until = saturating_add(home().strand.executive().now(), *wait);
    done = false;
  }
  for (PushOutlet* outlet : outlets_) outlet->flush();
  return done;
}

void PushServerEndpoint::wait_for_room(const ObjectRef& object) {
  try {
    while (!home().strand.wait_for(next_limit(), [&] { return settle(object); })) {
    }
  } catch (const Interrupted&) {  // its next blocking call makes the component leave
    give_up(object);
  }
}

// Retries where the object is still owed. Returns true when no edge waits for it any more.
bool PushServerEndpoint::settle(const ObjectRef& object) {
  bool settled = true;
  const MutexLock lock(mutex_);
  for (Edge* edge : subscribed_) {
    if (!edge->owed_until) continue;
    if (edge->sink().deliver(ObjectRef(object))) {
      if (home().strand.executive().now() < *edge->owed_until) {
        settled = false;
        continue;
      }
      edge->sink().give_up(object);
    }
    edge->owed_until.reset();
  }
  return settled;
}

void PushServerEndpoint::give_up(const ObjectRef& object) {
  const MutexLock lock(mutex_);
  for (Edge* edge : subscribed_) {
    if (edge->owed_until) edge->sink().give_up(object);
    edge->owed_until.reset();
  }
}

TimePoint PushServerEndpoint::next_limit() const {
  const MutexLock lock(mutex_);
  TimePoint next = kForever;
  for (const Edge* edge : subscribed_)
    if (edge->owed_until) next = std::min(next, *edge->owed_until);
  return next;
}

void PushServerEndpoint::Edge::regrant() {
  const UpdateGrant before = grant_;
  grant_ = grant_rate(asked_, server_.base_period());
  to_skip_ = std::min(to_skip_, grant_.multiple - 1);
  if (next_due_ > TimePoint{}) next_due_ += grant_.interval - before.interval;
  sink_->granted(grant_);
}

void PushServerEndpoint::Edge::attach(PushSink& sink, const UpdateRate& rate) {
  {
    const MutexLock lock(server_.mutex_);
    if (sink_ != nullptr) std::erase(server_.subscribed_, this);
    sink_ = &sink;
    asked_ = rate;
    grant_ = {};
    to_skip_ = 0;
    next_due_ = {};
    owed_until.reset();
    server_.subscribed_.push_back(this);
    ++server_.subscriptions_;
    regrant();
    server_.subscribers_.store(server_.subscribed_.size(), std::memory_order_release);
  }
  server_.home().strand.wake();  // a client connecting may change the server's state
}

void PushServerEndpoint::Edge::detach() {
  {
    const MutexLock lock(server_.mutex_);
    sink_ = nullptr;
    std::erase(server_.subscribed_, this);
    server_.subscribers_.store(server_.subscribed_.size(), std::memory_order_release);
  }
  server_.home().strand.wake();
}

void PushServerEndpoint::Edge::change(const UpdateRate& rate) {
  const MutexLock lock(server_.mutex_);
  if (sink_ == nullptr) return;
  asked_ = rate;
  regrant();
}

}  // namespace orca
