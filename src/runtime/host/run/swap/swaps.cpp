// SPDX-License-Identifier: LGPL-3.0-or-later
#include "swaps.hpp"

#include <algorithm>
#include <utility>

#include "driver_swap.hpp"
#include "swap.hpp"

namespace orca::host {

Swaps::~Swaps() = default;

void Swaps::begin(SwapOrder order, Done done) {
  const std::string name = order.component;
  if (is_under_way(name))
    return done(
        fail(Code::unavailable, "another swap of it is under way; try again when that is done", name));
  Result<std::unique_ptr<Exchange>> swap = make(std::move(order));
  if (!swap) return done(swap.error());
  if (const Status prepared = (*swap)->prepare(); !prepared.ok()) return done(prepared.error());
  open_.push_back({std::move(swap).value(), std::move(done)});
}

Result<std::unique_ptr<Exchange>> Swaps::make(SwapOrder order) {
  const std::string name = order.component;
  std::unique_ptr<Exchange> swap;
  HardwarePlace* const hardware = graph_.find_component(name) == nullptr ? system_.hardware(name) : nullptr;
  if (hardware != nullptr) {
    const graph::HardwareNode& node = *graph_.find_hardware(name);
    const DriverSwap::Site site{run_,         catalogue_,  *hardware, type_of(name, node.type),
                                node.process, stand_still_};
    swap = std::make_unique<DriverSwap>(site, std::move(order));
    return swap;
  }
  Result<ComponentInstance*> component = system_.instance(name);
  if (!component) return component.error();
  const Swap::Place place{
      graph_, run_, catalogue_, **component, type_of(name, graph_.find_component(name)->type), stand_still_};
  swap = std::make_unique<Swap>(place, std::move(order));
  return swap;
}

std::string Swaps::type_of(const std::string& name, const std::string& in_graph) const {
  const auto exchanged = types_.find(name);
  return exchanged != types_.end() ? exchanged->second : in_graph;
}

bool Swaps::concern_drivers() const {
  return std::ranges::any_of(
      open_, [&](const Open& open) { return graph_.find_component(open.swap->name()) == nullptr; });
}

bool Swaps::is_under_way(const std::string& name) const {
  return std::ranges::any_of(open_, [&](const Open& open) { return open.swap->name() == name; });
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
  if (outcome) types_[open.swap->name()] = outcome->new_type;
  const Done done = std::move(open.done);
  std::unique_ptr<Exchange> swap = std::move(open.swap);
  if (swap->is_stuck()) (void)swap.release();
  swap.reset();
  done(outcome);
}

}  // namespace orca::host
