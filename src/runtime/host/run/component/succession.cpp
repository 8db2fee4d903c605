// SPDX-License-Identifier: LGPL-3.0-or-later
#include "succession.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace orca::host {
namespace {

constexpr std::size_t kMostLateLaps = 3;

bool works(ComponentState state) {
  return state == ComponentState::work || state == ComponentState::suspended_work;
}

bool can_tell_its_state(ComponentState state) {
  return works(state) || state == ComponentState::idle || state == ComponentState::suspended_idle;
}

}  // namespace

template <class Body>
Status Succession::call(Hook hook, const Body& body) {
  Status outcome;
  const auto fault = parts_.hooks.call(hook, [&] { outcome = body(); });
  const std::string name = hook_text(hook, "");
  if (fault && fault->interrupted) return fail(Code::unavailable, name + " was interrupted");
  if (fault) return fail(Code::internal, name + " " + fault->text);
  if (!outcome.ok()) return fail(outcome.error().code, name + " said: " + outcome.error().text());
  return ok();
}

Status Succession::take_over(Residency& successor, ComponentState state, TakeOver& report) {
  const TimePoint began = parts_.now();
  std::vector<std::byte> bytes;
  std::optional<StateTag> tag;
  if (can_tell_its_state(state)) {
    if (Status saved = save(bytes); !saved.ok()) return saved;
    tag = {residency_.type_name(), residency_.component()->state_version()};
  }
  residency_.trade_places(successor);
  if (Status entered = enter(state, bytes, tag, report); !entered.ok()) {
    residency_.trade_places(successor);
    seat(state);
    return entered;
  }
  predecessor_ = &successor;
  allowed_late_laps_ = 2 * late_laps_.count() + kMostLateLaps;
  late_laps_ = {};
  const std::lock_guard lock(mutex_);
  taken_back_.reset();
  report.pause = parts_.now() - began;
  return ok();
}

// The new object is in its place; it only has to begin.
Status Succession::enter(ComponentState state, const std::vector<std::byte>& bytes,
                         const std::optional<StateTag>& tag, TakeOver& report) {
  seat(state);
  if (works(state))
    if (Status started = start(); !started.ok()) return started;
  if (tag)
    if (Status loaded = load(*tag, bytes, report); !loaded.ok()) return loaded;
  return is_suspended(state) ? pause() : ok();
}

Status Succession::save(std::vector<std::byte>& bytes) {
  StateWriter writer;
  Status saved = call(Hook::save_state, [&] {
    residency_.component()->save_state(writer);
    return ok();
  });
  bytes = writer.bytes();
  return saved;
}

Status Succession::load(const StateTag& tag, const std::vector<std::byte>& bytes, TakeOver& report) {
  if (!accepts(tag)) {
    if (tag.type != residency_.type_name()) return ok();
    return fail(Code::failed_precondition, "it cannot read the state " + tag.text() +
                                               ": its own version is " +
                                               std::to_string(residency_.component()->state_version()) +
                                               ", and accepted_states() does not name that one");
  }
  report.state = tag;
  return call(Hook::load_state, [&] {
    StateReader reader(tag, bytes);
    const Status loaded = residency_.component()->load_state(reader);
    return loaded.ok() ? reader.finish() : loaded;
  });
}

bool Succession::accepts(const StateTag& tag) const {
  const Component& component = *residency_.component();
  if (tag == StateTag{residency_.type_name(), component.state_version()}) return true;
  const std::vector<StateTag> others = component.accepted_states();
  return std::ranges::find(others, tag) != others.end();
}

Status Succession::start() {
  residency_.note_started(true);
  return call(Hook::start, [this] { return residency_.component()->start(); });
}

// Connects laps and intake with the object that is there now. Laps that start by the same trigger as before keep their
// rhythm.
void Succession::seat(ComponentState state) {
  (void)parts_.laps.choose(parts_.settings.trigger.value_or(residency_.declared().trigger), parts_.ports);
  if (takes_intake(state) || is_suspended(state))
    parts_.ports.open();  // what comes while it is suspended waits
}

bool Succession::take_back(ComponentState state, const std::string& why) {
  if (predecessor_ == nullptr) return false;
  residency_.trade_places(*std::exchange(predecessor_, nullptr));
  late_laps_ = {};
  seat(state);
  catch_up(state);
  parts_.run.reporter.note(make_alarm(AlarmKind::swap_undone, parts_.settings.name, "",
                                      "the new one failed, and the old one is back: " + why));
  {
    const std::lock_guard lock(mutex_);
    taken_back_ = why;
  }
  parts_.run.changed();  // whoever has ordered the exchange need not wait for the end of the probation
  return true;
}

// Brings the old object to where the component is now: it may have been started or stopped meanwhile.
void Succession::catch_up(ComponentState state) {
  if (works(state) && !residency_.is_started()) (void)start();
  if (!works(state) && residency_.is_started()) {
    residency_.note_started(false);
    (void)call(Hook::stop, [this] {
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
  (void)call(Hook::resume, [this] {
    residency_.component()->resume();
    return ok();
  });
}

Status Succession::pause() {
  residency_.note_paused(true);
  return call(Hook::suspend, [this] {
    residency_.component()->suspend();
    return ok();
  });
}

bool Succession::is_too_slow(TimePoint began) {
  const Duration period = parts_.laps.period();
  late_laps_.note(period > Duration{0} && parts_.now() - began > period);
  return predecessor_ != nullptr && late_laps_.count() >= allowed_late_laps_;
}

std::string Succession::too_slow_text() const {
  char text[96];
  std::snprintf(text, sizeof text, "%zu of its laps took longer than their period of %g s",
                late_laps_.count(), to_seconds(parts_.laps.period()));
  return text;
}

std::optional<std::string> Succession::take_back_reason() const {
  const std::lock_guard lock(mutex_);
  return taken_back_;
}

}  // namespace orca::host
