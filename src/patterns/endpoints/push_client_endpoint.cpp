// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/push_client_endpoint.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace orca {

PushClientEndpoint::PushClientEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)) {}

PushEdge& PushClientEndpoint::connect(PushSource& source, const QueuePolicy& policy) {
  if (alternatives_) alternatives_->add(source);
  if (alternatives_ && !edges_.empty()) return *edges_.back();
  if (PushEdge* const edge = vacancy_for(source)) {
    edge->set_policy(policy);
    edge->move_to(&source);
    return *edge;
  }
  const MutexLock lock(mutex_);
  edges_.push_back(std::make_unique<PushEdge>(*this, source, policy));
  if (subscribes_) edges_.back()->subscribe();
  return *edges_.back();
}

// Edges of an array keep their places, by which components know them.
PushEdge* PushClientEndpoint::vacancy_for(const PushSource& source) const {
  if (!contract().many) return edges_.empty() ? nullptr : edges_.front().get();
  const auto is_his = [path = source.path()](const auto& edge) {
    return !edge->has_server() && edge->source_path() == path;
  };
  const auto found = std::ranges::find_if(edges_, is_his);
  return found == edges_.end() ? nullptr : found->get();
}

void PushClientEndpoint::take_places_of(const PushClientEndpoint& other) {
  assert(contract().many && edges_.empty());
  const MutexLock lock(other.mutex_);
  for (const auto& edge : other.edges_)
    edges_.push_back(std::make_unique<PushEdge>(*this, edge->source_path(), contract().queue));
}

void PushClientEndpoint::disconnect(const std::string& server) {
  if (PushEdge* const edge = edge_from(server)) edge->leave();
}

PushEdge* PushClientEndpoint::edge_from(const std::string& server) const {
  const auto found = std::ranges::find_if(
      edges_, [&](const auto& edge) { return edge->has_server() && edge->source_path() == server; });
  return found == edges_.end() ? nullptr : found->get();
}

bool PushClientEndpoint::connected() const {
  return std::ranges::any_of(edges_, [](const auto& edge) { return edge->has_server(); });
}

std::optional<EdgeCounters> PushClientEndpoint::counters_from(const std::string& server) const {
  const MutexLock lock(mutex_);
  for (const auto& edge : edges_)
    if (edge->source_path() == server) return edge->counters();
  return std::nullopt;
}

std::optional<TimeFigures> PushClientEndpoint::ages_from(const std::string& server) const {
  const MutexLock lock(mutex_);
  for (const auto& edge : edges_)
    if (edge->source_path() == server) return edge->ages();
  return std::nullopt;
}

bool PushClientEndpoint::has_new() const {
  home().strand.take_in();
  return std::any_of(edges_.begin(), edges_.end(), [](const auto& edge) { return edge->holds_new(); });
}

bool PushClientEndpoint::has_new_from_all() const {
  return has_new() && std::all_of(edges_.begin(), edges_.end(),
                                  [](const auto& edge) { return edge->holds_new() || !edge->subscribed(); });
}

bool PushClientEndpoint::has_deadline() const {
  return std::any_of(edges_.begin(), edges_.end(),
                     [](const auto& edge) { return edge->policy().deadline > Duration{0}; });
}

TimePoint PushClientEndpoint::watch_deadlines() {
  TimePoint next = kForever;
  for (const auto& edge : edges_) next = std::min(next, edge->watch_deadline());
  return next;
}

void PushClientEndpoint::allow_moves() {
  assert(!contract().many && edges_.empty());
  alternatives_.emplace(home().strand, [this](PushSource& source) { edges_.front()->move_to(&source); });
}

bool PushClientEndpoint::move_to(const std::string& server) {
  return alternatives_ && alternatives_->want(server);
}

void PushClientEndpoint::subscribe_all() {
  if (alternatives_) (void)alternatives_->take_in();
  subscribes_ = !contract().many;
  for (const auto& edge : edges_) edge->subscribe();
}

void PushClientEndpoint::unsubscribe_all() {
  subscribes_ = false;
  for (const auto& edge : edges_) edge->unsubscribe();
}

}  // namespace orca
