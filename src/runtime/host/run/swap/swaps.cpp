// SPDX-License-Identifier: LGPL-3.0-or-later
#include "swaps.hpp"

#include <algorithm>
#include <utility>

namespace orca::host {

Swaps::~Swaps() = default;

void Swaps::begin(SwapOrder order, Done done) {
  const std::string name = order.component;
  Result<ComponentInstance*> component = system_.instance(name);
  if (!component) return done(component.error());
  if (is_under_way(name))
    return done(
        fail(Code::unavailable, "another swap of it is under way; try again when that is done", name));
  const graph::ComponentNode* const node = graph_.find_component(name);
  const auto exchanged = types_.find(name);
  const Swap::Place place{graph_, run_, catalogue_, **component,
                          exchanged != types_.end() ? exchanged->second : node->type};
  auto swap = std::make_unique<Swap>(place, std::move(order));
  if (const Status prepared = swap->prepare(); !prepared.ok()) return done(prepared.error());
  open_.push_back({std::move(swap), std::move(done)});
}

bool Swaps::is_under_way(const std::string& component) const {
  return std::ranges::any_of(open_, [&](const Open& open) { return open.swap->component() == component; });
}

TimePoint Swaps::go_on() {
  TimePoint next = kForever;
  for (Open& open : open_) {
    if (const auto outcome = open.swap->step()) {
      conclude(open, *outcome);
    } else {
      next = std::min(next, open.swap->wake_up());
    }
  }
  std::erase_if(open_, [](const Open& open) { return open.swap == nullptr; });
  return next;
}

void Swaps::give_up() {
  for (Open& open : open_) conclude(open, open.swap->give_up());
  open_.clear();
}

void Swaps::conclude(Open& open, const Result<SwapReport>& outcome) {
  if (outcome) types_[open.swap->component()] = outcome->new_type;
  const Done done = std::move(open.done);
  std::unique_ptr<Swap> swap = std::move(open.swap);
  if (swap->is_stuck()) (void)swap.release();
  swap.reset();
  done(outcome);
}

}  // namespace orca::host
