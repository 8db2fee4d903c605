// SPDX-License-Identifier: LGPL-3.0-or-later
#include "component_instance.hpp"

#include <algorithm>
#include <utility>

namespace orca {

const char* to_string(ComponentState state) {
  switch (state) {
    case ComponentState::init: return "INIT";
    case ComponentState::idle: return "IDLE";
    case ComponentState::connect: return "CONNECT";
    case ComponentState::work: return "WORK";
    case ComponentState::work_done: return "WORK_DONE";
    case ComponentState::work_failed: return "WORK_FAILED";
    case ComponentState::exit: return "EXIT";
  }
  return "?";
}

ComponentInstance::ComponentInstance(RunContext& run, ComponentSettings settings, const TypeEntry& type,
                                     hw::HardwareContainer* hardware)
    : run_(run),
      settings_(std::move(settings)),
      type_(type),
      hardware_(hardware),
      strand_(run.executive, {settings_.name, settings_.priority}),
      home_{strand_, settings_.name, &run.trace, {}},
      component_(nullptr, type.destroy_component),
      stays_active_(settings_.autonomous.value_or(false)) {
  strand_.set_leave_condition([this] {
    pause_plugin_turn();
    return exit_requested_.load(std::memory_order_acquire) || (in_lap_ && !wanted());
  });
}

ComponentInstance::~ComponentInstance() {
  if (const auto fault = guarded_call({name().c_str(), "its destructor", &type_},
                                      [this] { type_.destroy_component(component_.release()); }))
    write_log(log::Level::error, "its destructor " + fault->text);
}

Status ComponentInstance::construct() {
  if (const auto fault = guarded_call({name().c_str(), "its constructor", &type_},
                                      [this] { component_.reset(type_.create_component(*this)); }))
    return fail(Code::internal, "its constructor " + fault->text, settings_.name);
  for (const ParamDeclaration& param : params_) {
    const auto value = settings_.params.find(param.contract.name);
    if (value != settings_.params.end()) param.set(value->second);
  }
  return ok();
}

Status ComponentInstance::resolve_trigger() {
  if (settings_.trigger) trigger_ = *settings_.trigger;
  if (trigger_.kind != Trigger::Kind::on_port) return ok();
  trigger_port_ = dynamic_cast<PushClientEndpoint*>(endpoint(trigger_.port));
  if (trigger_port_ != nullptr) return ok();
  return fail(Code::invalid_argument,
              "its laps start on port \"" + trigger_.port + "\", which is no PushProxy of it");
}

template <class Kind>
Kind& ComponentInstance::add_endpoint(const PortContract& contract) {
  auto endpoint = std::make_unique<Kind>(home_, contract);
  Kind& added = *endpoint;
  endpoints_.push_back(std::move(endpoint));
  return added;
}

void ComponentInstance::declare_port(PortDeclaration declaration) {
  const PortContract& contract = declaration.contract;
  const bool server = contract.role == Role::server;
  if (contract.pattern == Pattern::push && server) {
    push_servers_.push_back(&add_endpoint<PushServerEndpoint>(contract));
  } else if (contract.pattern == Pattern::push) {
    push_clients_.push_back(&add_endpoint<PushClientEndpoint>(contract));
    if (!declaration.manual) automatic_clients_.push_back(push_clients_.back());
  } else if (contract.pattern == Pattern::send && server) {
    send_servers_.push_back({&add_endpoint<SendServerEndpoint>(contract), std::move(declaration.on_object)});
  } else if (contract.pattern == Pattern::send) {
    add_endpoint<SendClientEndpoint>(contract);
  } else if (server) {
    query_servers_.push_back(
        {&add_endpoint<QueryServerEndpoint>(contract), std::move(declaration.on_request)});
  } else {
    add_endpoint<QueryClientEndpoint>(contract);
  }
  *declaration.slot = endpoints_.back().get();
}

void ComponentInstance::declare_param(ParamDeclaration declaration) {
  params_.push_back(std::move(declaration));
}

Endpoint* ComponentInstance::endpoint(const std::string& port) const {
  for (const auto& endpoint : endpoints_)
    if (endpoint->contract().name == port) return endpoint.get();
  return nullptr;
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
  const std::lock_guard lock(failure_mutex_);
  return failure_;
}

// --- On the strand
// -------------------------------------------------------------------------------------------------

void ComponentInstance::main() {
  if (configure()) {
    open_intakes();
    set_state(ComponentState::idle);
  }
  while (!exit_requested_.load(std::memory_order_acquire)) turn();
  if (state() == ComponentState::work) leave_work(ComponentState::idle);
  close_intakes("the system is being stopped");
  set_state(ComponentState::exit);
}

bool ComponentInstance::configure() {
  Status configured;
  const auto fault = call("configure", [&] { configured = component_->configure(); });
  if (!fault && configured.ok()) configured = resolve_trigger();
  if (!fault && configured.ok()) return true;
  fail_with("configure", fault ? fault->text : "said: " + configured.error().text());
  return false;
}

void ComponentInstance::turn() {
  if (handle_one_intake()) return;
  const ComponentState before = state();
  follow_clients();
  if (state() != before) return;
  if (before == ComponentState::work && lap_is_due()) {
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
    default: break;
  }
}

void ComponentInstance::enter_work() {
  set_state(ComponentState::connect);
  for (PushClientEndpoint* client : automatic_clients_) client->subscribe_all();
  Status started;
  const auto fault = call("start", [&] { started = component_->start(); });
  if (fault && fault->interrupted) {
    leave_work(ComponentState::idle);
  } else if (fault || !started.ok()) {
    fail_with("start", fault ? fault->text : "said: " + started.error().text());
  } else {
    next_lap_ = now();
    set_state(ComponentState::work);
  }
}

void ComponentInstance::leave_work(ComponentState next) {
  const auto fault = call("stop", [&] { component_->stop(); });
  release_clients();
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
  in_lap_ = true;
  const auto fault = call("work", [&] { outcome = component_->work(); });
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
  }
}

bool ComponentInstance::handle_one_intake() {
  if (state() == ComponentState::work_failed) return false;
  for (const auto& intake : send_servers_)
    if (handle_sent(*intake.endpoint)) return true;
  for (const auto& intake : query_servers_)
    if (handle_asked(*intake.endpoint)) return true;
  return false;
}

bool ComponentInstance::handle_sent(SendServerEndpoint& endpoint) {
  bool handled = false;
  Status outcome;
  const auto fault = call(endpoint.contract().name.c_str(), [&] { handled = endpoint.handle_one(outcome); });
  if (fault && !fault->interrupted) fail_with(endpoint.contract().name.c_str(), fault->text);
  if (!outcome.ok())
    write_log(log::Level::warning,
              endpoint.contract().name + ": refused an object: " + outcome.error().text());
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
  std::optional<PluginFault> fault = guarded_call({name().c_str(), hook, &type_}, body);
  hook_.store("", std::memory_order_release);
  return fault;
}

void ComponentInstance::fail_with(const char* hook, const std::string& what) {
  const std::string text = std::string(hook) + "() " + what;
  {
    const std::lock_guard lock(failure_mutex_);
    failure_ = text;
  }
  write_log(log::Level::error, text);
  if (state() == ComponentState::work || state() == ComponentState::connect) {
    const auto fault = call("stop", [&] { component_->stop(); });
    if (fault && !fault->interrupted) write_log(log::Level::error, "stop() " + fault->text);
  }
  release_clients();
  close_intakes("it has failed: " + text);
  set_state(ComponentState::work_failed);
}

void ComponentInstance::set_state(ComponentState state) {
  const ComponentState before = state_.exchange(state, std::memory_order_acq_rel);
  run_.trace.state_changed(settings_.name, to_string(before), to_string(state));
  run_.changed();
}

void ComponentInstance::open_intakes() {
  for (const auto& intake : send_servers_) intake.endpoint->open(intake.handler);
  for (const auto& intake : query_servers_) intake.endpoint->open(intake.handler);
}

void ComponentInstance::close_intakes(const std::string& reason) {
  for (const auto& intake : send_servers_) intake.endpoint->close(reason);
  for (const auto& intake : query_servers_) intake.endpoint->close(reason);
}

void ComponentInstance::release_clients() {
  for (PushClientEndpoint* client : push_clients_) client->unsubscribe_all();
}

bool ComponentInstance::wanted() const {
  if (!gate_open_.load(std::memory_order_acquire)) return false;
  if (stays_active_) return true;
  return std::any_of(push_servers_.begin(), push_servers_.end(),
                     [](const PushServerEndpoint* server) { return server->subscriber_count() > 0; });
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
  const bool timed = state() == ComponentState::work && trigger_.kind == Trigger::Kind::period;
  return timed ? next_lap_ : kForever;
}

}  // namespace orca
