// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/strand.hpp"

#include <utility>

namespace orca {

// The strand that takes in on this thread in order to wait, or null. It is awake, so nothing need wake it.
[[gnu::tls_model("initial-exec")]] static thread_local const Strand* t_awake = nullptr;

Strand::Strand(Executive& executive, TaskOptions options)
    : executive_(executive), options_(std::move(options)), event_(executive.make_event()) {}

bool Strand::is_taking_in_here() const { return t_awake == this; }

bool Strand::await_input() {
  std::unique_ptr<InputEvent> event = executive_.make_input_event();
  input_ = event.get();
  if (event != nullptr) event_ = std::move(event);
  return input_ != nullptr;
}

void Strand::set_doorbell(DoorbellWord& own) {
  event_ = executive_.make_doorbell_event(own);
  doorbell_ = executive_.doorbell() != nullptr ? executive_.doorbell() : &own;
}

bool Strand::take_in_all() {
  bool arrived = false;
  for (Intake* intake : intakes_) arrived = intake->take_in() || arrived;
  return arrived;
}

// Takes in, as a part of a wait. If something has arrived, the wait ends and what is waited for is looked at again.
bool Strand::take_in_awake() {
  t_awake = this;
  const bool arrived = take_in_all();
  t_awake = nullptr;
  return arrived;
}

void Strand::start(std::function<void()> body) { task_ = executive_.spawn(options_, std::move(body)); }

void Strand::throw_foreign() const {
  throw ForeignThread("a thread that runs no component waits in the name of " + name() +
                      "; only the component's own hooks, laps and handlers may");
}

// Waits with a look at the intakes and at what the watch guards. Returns true if woken or if something has
// arrived, false at the deadline.
bool Strand::wait_looking(TimePoint deadline) {
  if (!intakes_.empty() && take_in_awake()) return true;
  if (!watch_) return event_->wait_until(deadline);
  for (;;) {
    const TimePoint next_look = watch_();
    if (next_look >= deadline) return event_->wait_until(deadline);
    if (event_->wait_until(next_look)) return true;
  }
}

}  // namespace orca
