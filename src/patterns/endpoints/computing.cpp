// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/computing.hpp"

#include <utility>

namespace orca {

void Computing::begin(Duration time) {
  owed_ = time;
  if (time == Duration{0}) return;
  ++laps_;
  time_ += time.count();
}

// A computer that computes hears nothing: what wakes the strand is looked at by its next wait.
bool Computing::spend() {
  const Executive& executive = strand_.executive();
  const TimePoint now = executive.now();
  const Duration time = std::exchange(owed_, Duration{0});
  const TimePoint alone = saturating_add(now, time);
  const TimePoint end = cores_ == nullptr ? alone : cores_->reserve(now, time);
  waited_ += (end - alone).count();
  strand_.note_activity();  // so that the lap is not taken for one that has only waited so far
  while (executive.now() < end && !strand_.is_ending()) strand_.pause_until(end);
  return executive.now() >= end;
}

}  // namespace orca
