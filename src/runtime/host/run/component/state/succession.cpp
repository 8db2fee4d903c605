// SPDX-License-Identifier: LGPL-3.0-or-later
#include "succession.hpp"

#include <cstdio>
#include <utility>

namespace orca::host {
namespace {

constexpr std::size_t kMostLateLaps = 3;

Error with_way_out(const Error& error) {
  return fail(
      error.code,
      error.message + "; orcactl swap with --fresh lets the new one begin without the old one's state",
      error.where);
}

bool works(ComponentState state) {
  return state == ComponentState::work || state == ComponentState::suspended_work;
}

}  // namespace

Status Succession::check_state(ComponentState state) {
  if (!can_tell_its_state(state)) return ok();
  const Result<KeptState> saved = hooks_.save();
  if (!saved) return saved.error();
  const Result<bool> loaded = hooks_.load(*saved);
  return loaded ? ok() : Status(loaded.error());
}

Status Succession::take_over(Residency& successor, ComponentState state, bool fresh, TakeOver& report) {
  const TimePoint began = parts_.now();
  std::optional<KeptState> kept;
  if (!fresh && can_tell_its_state(state)) {
    Result<KeptState> saved = hooks_.save();
    if (!saved) return with_way_out(saved.error());
    kept = std::move(saved).value();
  }
  residency_.trade_places(successor);
  if (Status entered = enter(state, kept, report); !entered.ok()) {
    residency_.trade_places(successor);
    seat(state);
    return entered;
  }
  allowed_late_laps_ = 2 * late_laps_.count() + kMostLateLaps;
  late_laps_ = {};
  const MutexLock lock(mutex_);
  predecessor_ = &successor;
  taken_back_.reset();
  report.pause = parts_.now() - began;
  return ok();
}

// The new object is in its place; it only has to begin.
Status Succession::enter(ComponentState state, const std::optional<KeptState>& saved, TakeOver& report) {
  seat(state);
  if (works(state))
    if (Status started = start(); !started.ok()) return started;
  if (saved)
    if (Status loaded = load(*saved, report); !loaded.ok()) return loaded;
  return is_suspended(state) ? pause() : ok();
}

Status Succession::load(const KeptState& saved, TakeOver& report) {
  const Result<bool> loaded = hooks_.load(saved);
  if (!loaded) return with_way_out(loaded.error());
  if (*loaded) report.state = saved.tag;
  return ok();
}

Status Succession::start() {
  residency_.note_started(true);
  return hooks_.call(Hook::start, [this] { return residency_.component()->start(); });
}

// Connects laps and intake with the object that is there now. Laps that start by the same trigger as before keep their
// rhythm.
void Succession::seat(ComponentState state) {
  (void)parts_.laps.choose(parts_.settings.trigger.value_or(residency_.declared().trigger), parts_.ports);
  if (takes_intake(state) || is_suspended(state))
    parts_.ports.open();  // what comes while it is suspended waits
}

bool Succession::confirm() {
  const MutexLock lock(mutex_);
  predecessor_ = nullptr;
  return !is_going_back_;
}

// Returns what holds the old object, to which the component goes back now; null: there is no way back.
Residency* Succession::leave_predecessor() {
  const MutexLock lock(mutex_);
  is_going_back_ = predecessor_ != nullptr;
  return std::exchange(predecessor_, nullptr);
}

bool Succession::take_back(ComponentState state, const std::string& why) {
  Residency* const predecessor = leave_predecessor();
  if (predecessor == nullptr) return false;
  residency_.trade_places(*predecessor);
  late_laps_ = {};
  seat(state);
  catch_up(state);
  parts_.run.reporter.note(make_alarm(idl::SWAP_UNDONE, parts_.settings.name, "",
                                      "the new one failed, and the old one is back: " + why));
  {
    const MutexLock lock(mutex_);
    taken_back_ = why;
    is_going_back_ = false;
  }
  parts_.run.changed();  // whoever has ordered the exchange need not wait for the end of the probation
  return true;
}

// Brings the old object to where the component is now: it may have been started or stopped meanwhile.
void Succession::catch_up(ComponentState state) {
  if (works(state) && !residency_.is_started()) (void)start();
  if (!works(state) && residency_.is_started()) {
    residency_.note_started(false);
    (void)hooks_.call(Hook::stop, [this] {
      residency_.component()->stop();
      return ok();
    });
  }
  pause_as(state);
}

void Succession::pause_as(ComponentState state) {
  if (is_suspended(state) == residency_.is_paused()) return;
  if (is_suspended(state)) {
    (void)pause();
    return;
  }
  residency_.note_paused(false);
  (void)hooks_.call(Hook::resume, [this] {
    residency_.component()->resume();
    return ok();
  });
}

Status Succession::pause() {
  residency_.note_paused(true);
  return hooks_.call(Hook::suspend, [this] {
    residency_.component()->suspend();
    return ok();
  });
}

bool Succession::is_too_slow(TimePoint began) {
  const Duration period = parts_.laps.period();
  late_laps_.note(period > Duration{0} && parts_.now() - began > period);
  return late_laps_.count() >= allowed_late_laps_;
}

std::string Succession::too_slow_text() const {
  char text[96];
  std::snprintf(text, sizeof text, "%zu of its laps took longer than their period of %g s",
                late_laps_.count(), to_seconds(parts_.laps.period()));
  return text;
}

std::optional<std::string> Succession::take_back_reason() const {
  const MutexLock lock(mutex_);
  return taken_back_;
}

}  // namespace orca::host
