// SPDX-License-Identifier: LGPL-3.0-or-later
#include "component_instance.hpp"

#include <utility>

namespace orca::host {

const char* to_string(ComponentState state) {
  switch (state) {
    case ComponentState::unloaded: return "UNLOADED";
    case ComponentState::init: return "INIT";
    case ComponentState::idle: return "IDLE";
    case ComponentState::connect: return "CONNECT";
    case ComponentState::work: return "WORK";
    case ComponentState::work_done: return "WORK_DONE";
    case ComponentState::work_failed: return "WORK_FAILED";
    case ComponentState::suspended: return "SUSPENDED";
    case ComponentState::exit: return "EXIT";
  }
  return "?";
}

ComponentInstance::ComponentInstance(RunContext& run, ComponentSettings settings, Loader loader,
                                     Unloader unloader, Device* hardware)
    : run_(run),
      settings_(std::move(settings)),
      loader_(std::move(loader)),
      unloader_(std::move(unloader)),
      hardware_(hardware),
      strand_(run.executive, {settings_.name, settings_.priority}),
      home_{strand_, settings_.name, &run.trace, {}},
      ports_(home_),
      stays_active_(settings_.autonomous.value_or(false)),
      state_(settings_.on_demand ? ComponentState::unloaded : ComponentState::init),
      values_(settings_.params) {
  strand_.set_leave_condition([this] { return must_leave_lap(); });
}

ComponentInstance::~ComponentInstance() {
  ports_.unbind();  // handlers are the component's code
  if (loaded_ == nullptr) return;
  if (const auto fault = loaded_->destroy(name()))
    write_log(log::Level::error, "its destructor " + fault->text);
}

Status ComponentInstance::load() {
  Result<LoadedType> type = loader_();
  if (!type) return type.error();
  loaded_ = std::make_unique<LoadedComponent>(std::move(type).value());
  const TypeEntry* const entry = loaded_->type.entry;
  const auto fault = guarded_call({name().c_str(), "its constructor", entry},
                                  [&] { loaded_->object = static_cast<Component*>(entry->create(*this)); });
  if (fault) return fail(Code::internal, "its constructor " + fault->text, settings_.name);
  if (!settings_.on_demand) {
    for (const PortDeclaration& port : loaded_->ports) ports_.add(port.contract);
    for (const ParamDeclaration& param : loaded_->params) param_contracts_.push_back(param.contract);
  }
  apply(params());
  return ports_.bind(loaded_->ports);
}

void ComponentInstance::declare(const Contract& contract) {
  for (PortContract port : contract.ports) {
    port.name = name_in_graph(port.name);
    ports_.add(port);
  }
  param_contracts_ = contract.params;
}

const std::string& ComponentInstance::name_in_graph(const std::string& port) const {
  const auto renamed = settings_.port_names.find(port);
  return renamed == settings_.port_names.end() ? port : renamed->second;
}

void ComponentInstance::declare_port(PortDeclaration declaration) {
  declaration.contract.name = name_in_graph(declaration.contract.name);
  loaded_->ports.push_back(std::move(declaration));
}

void ComponentInstance::set_default_trigger(const Trigger& trigger) {
  loaded_->trigger = trigger;
  loaded_->trigger.port = name_in_graph(trigger.port);
}

RandomStream ComponentInstance::random(std::string_view stream) const {
  return {run_.seed, settings_.name, stream};
}

void ComponentInstance::write_log(log::Level level, std::string_view text) const {
  log::write(level, settings_.name, text);
}

void ComponentInstance::start() {
  strand_.start([this] { main(); });
}

void ComponentInstance::open_gate() {
  gate_open_.store(true, std::memory_order_release);
  strand_.wake();
}

void ComponentInstance::request_exit() {
  exit_requested_.store(true, std::memory_order_release);
  strand_.wake();
}

bool ComponentInstance::at_rest() const {
  const ComponentState now = state();
  return now != ComponentState::connect && now != ComponentState::work;
}

std::string ComponentInstance::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

std::map<std::string, ParamValue> ComponentInstance::params() const {
  const std::lock_guard lock(mutex_);
  return values_;
}

// --- On the strand: the state machine -------------------------------------------------------------------

void ComponentInstance::main() {
  if (state() == ComponentState::unloaded) {
    ports_.hold();
    run_.changed();
  } else if (configure()) {
    ports_.open();
    set_state(ComponentState::idle);
  }
  while (!exit_requested_.load(std::memory_order_acquire)) turn();
  if (state() == ComponentState::suspended) set_state(before_suspension_);
  if (state() == ComponentState::work) leave_work(ComponentState::idle);
  refuse_orders();
  ports_.close("the system is being stopped");
  set_state(ComponentState::exit);
}

bool ComponentInstance::configure() {
  Status configured;
  const auto fault = call("configure", [&] { configured = loaded_->object->configure(); });
  if (!fault && configured.ok()) configured = resolve_trigger();
  if (!fault && configured.ok()) return true;
  fail_with("configure", fault ? fault->text : "said: " + configured.error().text());
  return false;
}

Status ComponentInstance::resolve_trigger() {
  trigger_ = settings_.trigger.value_or(loaded_->trigger);
  if (trigger_.kind != Trigger::Kind::on_port) return ok();
  trigger_port_ = dynamic_cast<PushClientEndpoint*>(endpoint(trigger_.port));
  if (trigger_port_ != nullptr) return ok();
  return fail(Code::invalid_argument,
              "its laps start on port \"" + trigger_.port + "\", which is no PushProxy of it");
}

void ComponentInstance::turn() {
  if (carry_out_order()) return;
  if (state() == ComponentState::suspended) return strand_.pause_until(kForever);
  if (state() == ComponentState::unloaded) return be_unloaded();
  if (handle_one_intake()) return;
  const ComponentState before = state();
  follow_clients();
  if (state() != before) return;
  if (unload_is_due()) {
    unload();
  } else if (before == ComponentState::work && lap_is_due()) {
    lap();
  } else {
    strand_.pause_until(next_wake_up());
  }
}

void ComponentInstance::follow_clients() {
  const bool want = wanted();
  switch (state()) {
    case ComponentState::idle:
      if (want) enter_work();
      break;
    case ComponentState::work:
      if (!want) leave_work(ComponentState::idle);
      break;
    case ComponentState::work_done:  // a new client, after the last one has gone, starts the task anew
      if (!want) set_state(ComponentState::idle);
      break;
    case ComponentState::work_failed:
      if (want || !may_try_again_) break;
      ports_.open();
      set_state(ComponentState::idle);
      break;
    default: break;
  }
}

void ComponentInstance::enter_work() {
  set_state(ComponentState::connect);
  ports_.subscribe();
  Status started;
  const auto fault = call("start", [&] { started = loaded_->object->start(); });
  if (fault && fault->interrupted) {
    leave_work(ComponentState::idle);
  } else if (fault || !started.ok()) {
    fail_with("start", fault ? fault->text : "said: " + started.error().text());
    may_try_again_ = !fault;
  } else {
    next_lap_ = now();
    set_state(ComponentState::work);
  }
}

void ComponentInstance::leave_work(ComponentState next) {
  const auto fault = call("stop", [&] { loaded_->object->stop(); });
  ports_.unsubscribe();
  home_.provenance.end_task();
  if (fault && !fault->interrupted) {
    fail_with("stop", fault->text);
  } else {
    set_state(next);
  }
}

void ComponentInstance::lap() {
  if (trigger_.kind == Trigger::Kind::period) {
    next_lap_ = saturating_add(next_lap_, trigger_.period);
    if (next_lap_ < now()) next_lap_ = now();  // laps that were missed are not made up for
  }
  Outcome outcome;
  activity_before_lap_ = strand_.activity();
  home_.provenance.begin_lap();
  in_lap_ = true;
  const auto fault = call("work", [&] { outcome = loaded_->object->work(); });
  in_lap_ = false;
  if (!fault) {
    conclude(outcome);
  } else if (!fault->interrupted) {
    fail_with("work", fault->text);
  }
}

void ComponentInstance::conclude(const Outcome& outcome) {
  if (outcome.kind == Outcome::Kind::done) {
    leave_work(ComponentState::work_done);
  } else if (outcome.kind == Outcome::Kind::failed) {
    fail_with("work", "failed: " + outcome.reason);
    may_try_again_ = true;
  }
}

bool ComponentInstance::handle_one_intake() {
  if (state() == ComponentState::work_failed) return false;
  bool handled = false;
  for (const auto& intake : ports_.send_servers())
    if (!handled) handled = handle_sent(*intake.endpoint);
  for (const auto& intake : ports_.query_servers())
    if (!handled) handled = handle_asked(*intake.endpoint);
  if (handled) idle_since_ = now();
  return handled;
}

bool ComponentInstance::handle_sent(SendServerEndpoint& endpoint) {
  bool handled = false;
  Status outcome;
  const auto fault = call(endpoint.contract().name.c_str(), [&] { handled = endpoint.handle_one(outcome); });
  if (fault && !fault->interrupted) fail_with(endpoint.contract().name.c_str(), fault->text);
  if (!outcome.ok())
    write_log(log::Level::warning,
              endpoint.contract().name +
                  ": could not handle an object that it had accepted: " + outcome.error().text());
  return handled || fault;
}

bool ComponentInstance::handle_asked(QueryServerEndpoint& endpoint) {
  bool handled = false;
  const auto fault = call(endpoint.contract().name.c_str(), [&] { handled = endpoint.handle_one(); });
  if (fault && !fault->interrupted) fail_with(endpoint.contract().name.c_str(), fault->text);
  return handled || fault;
}

std::optional<PluginFault> ComponentInstance::call(const char* hook, const std::function<void()>& body) {
  hook_.store(hook, std::memory_order_release);
  const TypeEntry* const code = loaded_ != nullptr ? loaded_->type.entry : nullptr;
  std::optional<PluginFault> fault = guarded_call({name().c_str(), hook, code}, body);
  hook_.store("", std::memory_order_release);
  return fault;
}

void ComponentInstance::fail_with(const char* hook, const std::string& what) {
  const std::string text = std::string(hook) + "() " + what;
  {
    const std::lock_guard lock(mutex_);
    failure_ = text;
  }
  write_log(log::Level::error, text);
  if (state() == ComponentState::work || state() == ComponentState::connect) {
    const auto fault = call("stop", [&] { loaded_->object->stop(); });
    if (fault && !fault->interrupted) write_log(log::Level::error, "stop() " + fault->text);
  }
  ports_.unsubscribe();
  home_.provenance.end_task();
  ports_.close("it has failed: " + text);
  may_try_again_ = false;
  has_failed_.store(true, std::memory_order_release);
  set_state(ComponentState::work_failed);
}

void ComponentInstance::set_state(ComponentState state) {
  if (state == ComponentState::idle) idle_since_ = now();
  const ComponentState before = state_.exchange(state, std::memory_order_acq_rel);
  run_.trace.state_changed(settings_.name, to_string(before), to_string(state));
  run_.changed();
}

bool ComponentInstance::wanted() const {
  if (!gate_open_.load(std::memory_order_acquire)) return false;
  return stays_active_ || ports_.has_subscribers();
}

bool ComponentInstance::must_leave_lap() const {
  pause_plugin_turn();
  if (exit_requested_.load(std::memory_order_acquire)) return true;
  if (!in_lap_) return false;
  // Nothing is lost with a lap that has only waited so far.
  const bool clean = strand_.activity() == activity_before_lap_;
  return !wanted() || (clean && (order_waits_.load(std::memory_order_acquire) || ports_.has_intake()));
}

bool ComponentInstance::lap_is_due() const {
  switch (trigger_.kind) {
    case Trigger::Kind::free_running: return true;
    case Trigger::Kind::period: return now() >= next_lap_;
    case Trigger::Kind::on_port: return trigger_port_->has_new();
  }
  return false;
}

TimePoint ComponentInstance::next_wake_up() const {
  if (state() == ComponentState::work && trigger_.kind == Trigger::Kind::period) return next_lap_;
  const bool may_unload = settings_.on_demand && !settings_.stay_warm && state() == ComponentState::idle;
  return may_unload ? saturating_add(idle_since_, settings_.idle_time) : kForever;
}

// --- On the strand: loading on demand --------------------------------------------------------------------

void ComponentInstance::be_unloaded() {
  const bool asked_for = wanted() || (gate_open_.load(std::memory_order_acquire) && ports_.has_intake());
  if (!asked_for) return strand_.pause_until(kForever);
  set_state(ComponentState::init);
  Status loaded;
  if (const auto fault = call("load", [&] { loaded = load(); })) loaded = fail(Code::internal, fault->text);
  if (!loaded.ok()) return fail_with("load", "said: " + loaded.error().text());
  if (!configure()) return;
  ports_.open();
  set_state(ComponentState::idle);
}

bool ComponentInstance::unload_is_due() const {
  return settings_.on_demand && !settings_.stay_warm && state() == ComponentState::idle && !wanted() &&
         now() >= saturating_add(idle_since_, settings_.idle_time);
}

void ComponentInstance::unload() {
  ports_.hold();
  ports_.unbind();
  stays_active_ = settings_.autonomous.value_or(false);
  trigger_port_ = nullptr;
  if (const auto fault = loaded_->destroy(name()))
    write_log(log::Level::error, "its destructor " + fault->text);
  LoadedType type = std::move(loaded_->type);
  loaded_.reset();
  if (const Status gone = unloader_(std::move(type)); !gone.ok())
    write_log(log::Level::error, gone.error().text());
  set_state(ComponentState::unloaded);
}

}  // namespace orca::host
