// SPDX-License-Identifier: LGPL-3.0-or-later
#include "machines/motors_accord.hpp"

#include <utility>

namespace orca::supervisor {
namespace {

// Operators give orders one by one: a number far beyond is rubbish, and would leave no room for the next.
constexpr std::uint64_t kFarBeyond = std::uint64_t{1} << 32;

}  // namespace

MotorsAccord::MotorsAccord(std::string here, const std::vector<std::string>& others)
    : here_(std::move(here)) {
  for (const std::string& other : others) said_[other];
}

std::uint64_t MotorsAccord::order(bool holds) {
  take_over({latest_.number + 1, holds});
  return latest_.number;
}

void MotorsAccord::take_over(const Order& order) {
  latest_ = order;
  outcome_ = idl::MOTORS_PENDING;
  is_new_ = true;
}

std::optional<MotorsAccord::Order> MotorsAccord::take_order() {
  if (!std::exchange(is_new_, false)) return std::nullopt;
  return latest_;
}

void MotorsAccord::note(std::uint64_t number, idl::MotorsOutcome outcome) {
  if (number == latest_.number) outcome_ = outcome;
}

void MotorsAccord::hear(const idl::MachineState& state, bool is_gathering) {
  const auto known = said_.find(state.origin());
  if (known == said_.end() || state.motors_order() > latest_.number + kFarBeyond) return;
  known->second = state;
  const Order theirs{state.motors_order(), state.motors_held()};
  const bool is_later =
      theirs.number > latest_.number || (theirs.number == latest_.number && theirs.holds && !latest_.holds);
  if (!is_later) return;
  is_gathering && !theirs.holds ? catch_up(theirs) : take_over(theirs);
}

// Takes note of a release that was ordered before this machine was there.
void MotorsAccord::catch_up(const Order& order) {
  if (latest_.holds) return take_over({order.number + 1, true});
  latest_ = order;
  outcome_ = idl::MOTORS_IDLE;
}

void MotorsAccord::fill(idl::MachineState& state) const {
  state.motors_order(latest_.number);
  state.motors_held(latest_.holds);
  state.motors_outcome(outcome_);
}

std::vector<MotorsAccord::Word> MotorsAccord::words() const {
  std::vector<Word> words{{here_, outcome_}};
  for (const auto& [machine, said] : said_) {
    const bool knows_it = said.motors_order() == latest_.number && said.motors_held() == latest_.holds;
    words.push_back({machine, knows_it ? said.motors_outcome() : idl::MOTORS_PENDING});
  }
  return words;
}

}  // namespace orca::supervisor
