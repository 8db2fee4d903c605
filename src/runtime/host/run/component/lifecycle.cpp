// SPDX-License-Identifier: LGPL-3.0-or-later
#include "lifecycle.hpp"

#include <utility>

namespace orca::host {

Lifecycle::Lifecycle(ComponentParts& parts, Residency& residency, Succession& succession, StateKeeper& keeper)
    : parts_(parts),
      residency_(residency),
      succession_(succession),
      keeper_(keeper),
      state_(parts.settings.on_demand ? ComponentState::unloaded : ComponentState::init) {}

std::string Lifecycle::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

std::optional<Error> Lifecycle::refusal() const {
  const std::lock_guard lock(mutex_);
  return refusal_;
}

void Lifecycle::handle(ComponentEvent event) {
  for (FollowUp next = event; next;) {
    const ComponentTransition* const found = transition(state(), *next);
    next = found != nullptr ? carry_out(*found) : std::nullopt;
  }
}

void Lifecycle::fail_with(ComponentEvent event, Hook hook, const std::string& what, const char* port) {
  if (succession_.take_back(state(), hook_text(hook, port) + " " + what)) return;
  handle(report(event, hook, what, port));
}

// Reports a failure of the component; nothing else does.
ComponentEvent Lifecycle::report(ComponentEvent event, Hook hook, const std::string& what, const char* port) {
  const std::string text = hook_text(hook, port) + " " + what;
  {
    const std::lock_guard lock(mutex_);
    failure_ = text;
  }
  parts_.report_failure(hook, text, port);
  return event;
}

// --- Actions ----------------------------------------------------------------------------------------------

Lifecycle::FollowUp Lifecycle::carry_out(const ComponentTransition& transition) {
  for (const ComponentAction action : transition.actions)
    if (const FollowUp next = carry_out(action, transition.to)) return next;
  return std::nullopt;
}

Lifecycle::FollowUp Lifecycle::carry_out(ComponentAction action, ComponentState to) {
  switch (action) {
    case ComponentAction::enter: enter(to); return std::nullopt;
    case ComponentAction::load: return load();
    case ComponentAction::configure: return configure();
    case ComponentAction::start: return start();
    case ComponentAction::stop: return call(Hook::stop, &Component::stop, ComponentEvent::stop_threw);
    case ComponentAction::try_stop: try_stop(); return std::nullopt;
    case ComponentAction::suspend: return call(Hook::suspend, &Component::suspend);
    case ComponentAction::resume: return call(Hook::resume, &Component::resume);
    case ComponentAction::unload: residency_.unload(); return std::nullopt;
    default: arrange(action); return std::nullopt;
  }
}

// Carries out the actions that call none of the component's code.
void Lifecycle::arrange(ComponentAction action) {
  switch (action) {
    case ComponentAction::open_intake: return parts_.ports.open();
    case ComponentAction::hold_intake: return parts_.ports.hold();
    case ComponentAction::close_intake: return parts_.ports.close("it has failed: " + failure());
    case ComponentAction::subscribe: return parts_.ports.subscribe();
    case ComponentAction::begin_laps: return parts_.laps.begin(parts_.now());
    case ComponentAction::unsubscribe: parts_.ports.unsubscribe(); return parts_.home.provenance.end_task();
    case ComponentAction::end:
      parts_.orders.refuse_all();
      return parts_.ports.close("the system is being stopped");
    default: return;
  }
}

void Lifecycle::enter(ComponentState state) {
  if (is_failed(state)) has_failed_.store(true, std::memory_order_release);
  if (state == ComponentState::work) has_worked_.store(true, std::memory_order_release);
  if (is_failed(state) || state == ComponentState::work)
    ended_badly_.store(is_failed(state), std::memory_order_release);
  entered_ = parts_.now();
  const ComponentState before = state_.exchange(state, std::memory_order_acq_rel);
  parts_.run.trace.state_changed(parts_.settings.name, to_string(before), to_string(state));
  parts_.run.changed();
}

// --- Hooks ------------------------------------------------------------------------------------------------

Lifecycle::FollowUp Lifecycle::load() {
  Status loaded;
  if (const auto fault = parts_.hooks.call(Hook::load, [&] { loaded = residency_.load(); }))
    loaded = fail(Code::internal, fault->text);
  if (loaded.ok()) return ComponentEvent::loaded;
  return report(ComponentEvent::failed, Hook::load, "said: " + loaded.error().text());
}

Lifecycle::FollowUp Lifecycle::configure() {
  Status configured;
  const auto fault =
      parts_.hooks.call(Hook::configure, [&] { configured = residency_.component()->configure(); });
  if (fault && fault->interrupted) return ComponentEvent::interrupted;
  if (fault)
    return refuse(ComponentEvent::threw, fail(Code::invalid_argument, "configure() " + fault->text),
                  fault->text);
  if (configured.ok())
    configured =
        parts_.laps.choose(parts_.settings.trigger.value_or(residency_.declared().trigger), parts_.ports);
  if (configured.ok()) return ComponentEvent::configured;
  const Error& error = configured.error();
  return refuse(ComponentEvent::failed, error, "said: " + error.text());
}

// Keeps why the component cannot be configured, and reports it.
Lifecycle::FollowUp Lifecycle::refuse(ComponentEvent event, Error reason, const std::string& what) {
  {
    const std::lock_guard lock(mutex_);
    refusal_ = std::move(reason);
  }
  return report(event, Hook::configure, what);
}

Lifecycle::FollowUp Lifecycle::start() {
  Status started = keeper_.prepare_start();
  if (!started.ok())
    return report(ComponentEvent::failed, Hook::start, "could not begin: " + started.error().text());
  residency_.note_started(true);
  const auto fault = parts_.hooks.call(Hook::start, [&] { started = residency_.component()->start(); });
  if (fault && fault->interrupted) return ComponentEvent::interrupted;
  if (!fault && started.ok()) return restore();
  const std::string what = fault ? fault->text : "said: " + started.error().text();
  if (succession_.take_back(state(), "start() " + what)) return start();
  return report(fault ? ComponentEvent::threw : ComponentEvent::failed, Hook::start, what);
}

// Goes on from what was kept before the process ended, if anything was.
Lifecycle::FollowUp Lifecycle::restore() {
  const Status restored = keeper_.restore();
  if (restored.ok()) return ComponentEvent::started;
  return report(ComponentEvent::failed, Hook::start,
                "cannot go on from the state that was kept: " + restored.error().text());
}

void Lifecycle::try_stop() {
  residency_.note_started(false);
  const auto fault = parts_.hooks.call(Hook::stop, [this] { residency_.component()->stop(); });
  if (fault && !fault->interrupted) parts_.report_failure(Hook::stop, "stop() " + fault->text);
}

Lifecycle::FollowUp Lifecycle::call(Hook hook, void (Component::*function)(), ComponentEvent if_it_throws) {
  if (hook == Hook::stop) residency_.note_started(false);
  if (hook == Hook::suspend || hook == Hook::resume) residency_.note_paused(hook == Hook::suspend);
  const auto fault = parts_.hooks.call(hook, [&] { (residency_.component()->*function)(); });
  if (!fault || fault->interrupted) return std::nullopt;
  if (succession_.take_back(state(), std::string(to_string(hook)) + " " + fault->text)) return std::nullopt;
  return report(if_it_throws, hook, fault->text);
}

// --- Orders -----------------------------------------------------------------------------------------------

Status Lifecycle::suspend() {
  return order(ComponentEvent::suspend, "; only IDLE and WORK can be suspended");
}

Status Lifecycle::resume() { return order(ComponentEvent::resume, ", not SUSPENDED"); }

Status Lifecycle::order(ComponentEvent event, const std::string& only) {
  if (transition(state(), event) == nullptr)
    return fail(Code::failed_precondition, std::string("it is ") + to_string(state()) + only,
                parts_.settings.name);
  handle(event);
  if (is_failed(state())) return fail(Code::internal, failure(), parts_.settings.name);
  return ok();
}

Status Lifecycle::take_over(Residency& successor, bool fresh, TakeOver& report) {
  const ComponentState now = state();
  if (now == ComponentState::init)
    return fail(Code::failed_precondition, "it is being loaded; try again", parts_.settings.name);
  if (now == ComponentState::unloaded) return residency_.trade_loaders(successor), ok();
  const std::string was = residency_.type_name();
  if (Status taken = succession_.take_over(successor, now, fresh, report); !taken.ok()) return taken;
  parts_.run.trace.code_exchanged(parts_.settings.name, was, residency_.type_name(), report.pause);
  handle(ComponentEvent::replaced);
  return ok();
}

Status Lifecycle::change_params(const ParamValues& values) {
  const ParamValues old = parts_.params.values();
  ParamValues changed = old;
  for (const auto& [name, value] : values) changed[name] = value;
  if (residency_.component() != nullptr)
    if (Status accepted = offer_params(changed, old); !accepted.ok()) return accepted;
  parts_.params.keep(std::move(changed));
  return ok();
}

// Gives the component the changed values, and the old ones back if it does not accept them.
Status Lifecycle::offer_params(const ParamValues& changed, const ParamValues& old) {
  set_params(residency_.declared().params, changed);
  Status accepted;
  const auto fault =
      parts_.hooks.call(Hook::params_changed, [&] { accepted = residency_.component()->params_changed(); });
  if (!fault && accepted.ok()) return ok();
  set_params(residency_.declared().params, old);
  if (!fault) return accepted;
  if (!fault->interrupted) fail_with(ComponentEvent::threw, Hook::params_changed, fault->text);
  return fail(Code::internal, "params_changed() " + fault->text, parts_.settings.name);
}

}  // namespace orca::host
