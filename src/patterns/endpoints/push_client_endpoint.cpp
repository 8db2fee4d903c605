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
  assert(contract().many || edges_.empty());
  edges_.push_back(std::make_unique<PushEdge>(*this, source, policy));
  return *edges_.back();
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
  alternatives_.emplace(home().strand, [this](PushSource& source) { edges_.front()->move_to(source); });
}

bool PushClientEndpoint::move_to(const std::string& server) {
  return alternatives_ && alternatives_->want(server);
}

void PushClientEndpoint::subscribe_all() {
  if (alternatives_) (void)alternatives_->take_in();
  for (const auto& edge : edges_) edge->subscribe();
}

void PushClientEndpoint::unsubscribe_all() {
  for (const auto& edge : edges_) edge->unsubscribe();
}

}  // namespace orca
