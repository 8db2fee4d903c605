// SPDX-License-Identifier: LGPL-3.0-or-later
#include "component_loop.hpp"

#include <algorithm>

#include "orca/base/system/task_time.hpp"

namespace orca::host {

ComponentLoop::ComponentLoop(ComponentParts& parts, Residency& residency, Lifecycle& life,
                             StateKeeper& keeper)
    : parts_(parts), residency_(residency), life_(life), keeper_(keeper) {
  parts_.strand.set_leave_condition([this] { return must_leave_lap(); });
}

void ComponentLoop::open_gate() {
  parts_.injector.begin();
  gate_open_.store(true, std::memory_order_release);
  parts_.strand.wake();
}

void ComponentLoop::announce_exit() { parts_.strand.end(); }

void ComponentLoop::request_exit(bool keeps_state) {
  keeps_last_state_.store(keeps_state, std::memory_order_relaxed);
  exit_requested_.store(true, std::memory_order_release);
  parts_.strand.wake();
}

void ComponentLoop::run() {
  watch_deadlines();
  if (life_.state() == ComponentState::unloaded) {
    parts_.ports.hold();
    parts_.run.changed();
  } else {
    life_.handle(ComponentEvent::loaded);
  }
  while (!is_to_exit()) turn();
  if (keeps_last_state_.load(std::memory_order_relaxed) && can_tell_its_state(life_.state()))
    keeper_.keep_last();
  while (life_.state() != ComponentState::exit) life_.handle(ComponentEvent::exit);
}

void ComponentLoop::watch_deadlines() {
  if (parts_.ports.has_deadline()) parts_.strand.set_watch([this] { return parts_.ports.watch_deadlines(); });
}

void ComponentLoop::turn() {
  if (parts_.strand.is_ending()) return parts_.strand.pause_until(kForever);
  if (parts_.orders.carry_out_next()) {
    keeper_.note_change();
    return parts_.run.changed();
  }
  const bool silent = parts_.injector.is_silent();
  if (!silent && keeper_.awaits_restore() && takes_intake(life_.state()) && parts_.ports.has_intake())
    return restore_early();
  if (!silent && handle_one_intake()) return keeper_.note_change();
  if (const auto event = look()) return life_.handle(*event);
  if (silent) return parts_.strand.pause_until(kForever);
  if (keeping_time() <= parts_.now()) return keeper_.keep();
  if (life_.state() == ComponentState::work && parts_.laps.is_due(parts_.now())) return lap();
  parts_.strand.pause_until(next_wake_up());
}

// What has been sent or asked finds the object as its predecessor was.
void ComponentLoop::restore_early() {
  if (const Status restored = keeper_.restore_early(); !restored.ok())
    life_.fail_with(ComponentEvent::failed, Hook::load_state,
                    "cannot go on from the state that was kept: " + restored.error().text());
}

// Returns a circumstance that leads out of the present state; nothing if there is none.
std::optional<ComponentEvent> ComponentLoop::look() const {
  const auto leads_on = [this](ComponentEvent event) { return transition(life_.state(), event) != nullptr; };
  const ComponentEvent clients = wanted() ? ComponentEvent::wanted : ComponentEvent::unwanted;
  if (leads_on(clients)) return clients;
  if (leads_on(ComponentEvent::asked_for) && asked_for()) return ComponentEvent::asked_for;
  if (leads_on(ComponentEvent::unused) && parts_.now() >= unload_time()) return ComponentEvent::unused;
  return std::nullopt;
}

// --- Laps -------------------------------------------------------------------------------------------------

void ComponentLoop::lap() {
  const TimePoint began = parts_.now();
  parts_.laps.lap_begins(began);
  Outcome outcome;
  activity_before_lap_ = parts_.strand.activity();
  parts_.home.provenance.begin_lap();
  const Duration time = parts_.lap_time();
  parts_.home.computing.begin(time);
  in_lap_ = true;
  if (parts_.meter) parts_.meter->begin();
  const Duration used = parts_.recent_laps ? task_time() : Duration{0};
  const auto fault = parts_.hooks.call(Hook::work, [&] {
    parts_.injector.act();
    outcome = residency_.component()->work();
  });
  in_lap_ = false;
  const bool given_up = fault && fault->interrupted;
  if (parts_.meter && !given_up) parts_.meter->end();
  if (parts_.recent_laps && !given_up) parts_.recent_laps->add(task_time() - used, began);
  if (given_up) {
    parts_.home.computing.give_up();
  } else if (computes_to_end(time)) {
    if (fault) {
      life_.fail_with(ComponentEvent::threw, Hook::work, fault->text);
    } else if (!life_.gave_up_lap(began)) {
      conclude(outcome);
    }
  }
  keeper_.note_change();
}

// Lets the time pass that the lap computes for. Returns false if the component has to end before.
bool ComponentLoop::computes_to_end(Duration time) {
  Computing& computing = parts_.home.computing;
  if (!computing.finish()) return false;
  if (time > Duration{0} && parts_.laps.is_overdue(parts_.now())) computing.note_overrun();
  return true;
}

void ComponentLoop::conclude(const Outcome& outcome) {
  if (outcome.kind == Outcome::Kind::done) {
    life_.handle(ComponentEvent::done);
  } else if (outcome.kind == Outcome::Kind::failed) {
    life_.fail_with(ComponentEvent::failed, Hook::work, "failed: " + outcome.reason);
  }
}

// --- What is sent and asked -------------------------------------------------------------------------------

bool ComponentLoop::handle_one_intake() {
  if (!takes_intake(life_.state())) return false;
  bool handled = false;
  for (const auto& intake : parts_.ports.send_servers())
    if (!handled) handled = handle_sent(*intake.endpoint);
  for (const auto& intake : parts_.ports.query_servers())
    if (!handled) handled = handle_asked(*intake.endpoint);
  if (handled) last_intake_ = parts_.now();
  return handled;
}

bool ComponentLoop::handle_sent(SendServerEndpoint& endpoint) {
  if (!endpoint.has_waiting()) return false;
  const std::string& port = endpoint.contract().name;
  bool handled = false;
  Status outcome;
  const auto fault = parts_.hooks.call(
      Hook::handler,
      [&] {
        parts_.injector.act();
        handled = endpoint.handle_one(outcome);
      },
      port.c_str());
  contain(endpoint, fault);
  if (!outcome.ok())
    parts_.report_refusal(port +
                          ": could not handle an object that it had accepted: " + outcome.error().text());
  return handled || fault;
}

bool ComponentLoop::handle_asked(QueryServerEndpoint& endpoint) {
  if (!endpoint.has_waiting()) return false;
  bool handled = false;
  const auto fault = parts_.hooks.call(
      Hook::handler,
      [&] {
        parts_.injector.act();
        handled = endpoint.handle_one();
      },
      endpoint.contract().name.c_str());
  contain(endpoint, fault);
  return handled || fault;
}

void ComponentLoop::contain(const Endpoint& endpoint, const std::optional<PluginFault>& fault) {
  if (fault && !fault->interrupted)
    life_.fail_with(ComponentEvent::threw, Hook::handler, fault->text, endpoint.contract().name.c_str());
}

// --- The world --------------------------------------------------------------------------------------------

bool ComponentLoop::asked_for() const { return wanted() || (is_open() && parts_.ports.has_intake()); }

bool ComponentLoop::wanted() const {
  if (!is_open()) return false;
  if (residency_.stays_active()) return true;
  return parts_.settings.watchable ? parts_.ports.has_audience() : parts_.ports.has_subscribers();
}

bool ComponentLoop::must_leave_lap() const {
  pause_plugin_turn();
  if (is_to_exit()) return true;
  if (!in_lap_) return false;
  // A lap that has only waited so far can be given up without loss.
  const bool clean = parts_.strand.activity() == activity_before_lap_;
  return !wanted() || (clean && (parts_.orders.waits() || parts_.ports.has_intake()));
}

// Returns when an idle component is to be unloaded; kForever if it is to stay.
TimePoint ComponentLoop::unload_time() const {
  if (!parts_.settings.on_demand || parts_.settings.stay_warm) return kForever;
  return saturating_add(std::max(life_.entered(), last_intake_), parts_.settings.idle_time);
}

TimePoint ComponentLoop::keeping_time() const {
  return can_tell_its_state(life_.state()) ? keeper_.due() : kForever;
}

TimePoint ComponentLoop::next_wake_up() const {
  if (life_.state() == ComponentState::work) return std::min(parts_.laps.next(), keeping_time());
  return life_.state() == ComponentState::idle ? std::min(unload_time(), keeping_time()) : keeping_time();
}

}  // namespace orca::host
