// SPDX-License-Identifier: LGPL-3.0-or-later
#include "byte_faults.hpp"

#include <algorithm>

namespace orca::hw::link {
namespace {

std::uint64_t& counter_of(std::array<std::uint64_t, kFaults>& counts, Fault fault) {
  return counts[static_cast<std::size_t>(fault)];
}

}  // namespace

ByteFaults::ByteFaults(Direction direction, const FaultRates& rates, const FaultPlan& plan)
    : rates_(rates), random_(plan.seed, "FaultyLink", direction == Direction::in ? "in" : "out") {
  std::ranges::copy_if(plan.script, std::back_inserter(script_),
                       [&](const ScriptedFault& fault) { return fault.direction == direction; });
  std::ranges::stable_sort(script_, {}, &ScriptedFault::at);
}

std::vector<std::uint8_t> ByteFaults::pass(std::span<const std::uint8_t> bytes, FaultModes& modes,
                                           std::array<std::uint64_t, kFaults>& counts) {
  std::vector<std::uint8_t> arrived;
  for (const std::uint8_t byte : bytes) {
    Fate fate = draw();
    apply_script(fate, modes);
    ++passed_;
    if (modes.ended) break;
    if (modes.silent) {
      ++counter_of(counts, Fault::silence);
      continue;
    }
    if (fate.insert) arrived.push_back(fate.inserted);
    const auto changed = static_cast<std::uint8_t>(fate.flip ? byte ^ fate.mask : byte);
    if (!fate.drop) arrived.insert(arrived.end(), fate.duplicate ? 2 : 1, changed);
    counter_of(counts, Fault::insert) += fate.insert;
    counter_of(counts, Fault::drop) += fate.drop;
    counter_of(counts, Fault::flip) += fate.flip && !fate.drop;
    counter_of(counts, Fault::duplicate) += fate.duplicate && !fate.drop;
  }
  return arrived;
}

// Draws the same number of random values for each byte, so that no rate changes what the others do.
ByteFaults::Fate ByteFaults::draw() {
  Fate fate{};
  fate.drop = random_.chance(rates_.drop);
  fate.flip = random_.chance(rates_.flip);
  fate.insert = random_.chance(rates_.insert);
  fate.duplicate = random_.chance(rates_.duplicate);
  const std::uint64_t bits = random_();
  fate.mask = static_cast<std::uint8_t>(1U << (bits & 7U));
  fate.inserted = static_cast<std::uint8_t>(bits >> 8U);
  return fate;
}

void ByteFaults::apply_script(Fate& fate, FaultModes& modes) {
  for (; next_ < script_.size() && script_[next_].at == passed_; ++next_) {
    const ScriptedFault& fault = script_[next_];
    switch (fault.fault) {
      case Fault::drop: fate.drop = true; break;
      case Fault::flip: fate.flip = true, fate.mask = fault.value; break;
      case Fault::insert: fate.insert = true, fate.inserted = fault.value; break;
      case Fault::duplicate: fate.duplicate = true; break;
      case Fault::silence: modes.silent = true; break;
      case Fault::refusal: modes.refuses = true; break;
      case Fault::end: modes.ended = true; break;
      case Fault::echo: modes.echo = true; break;
      case Fault::delay:
      case Fault::glue:
      case Fault::split: break;  // these need a time or no place: see FaultModes
    }
  }
}

}  // namespace orca::hw::link
