// SPDX-License-Identifier: LGPL-3.0-or-later
#include "system.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "component_making.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"
#include "orca/graph/settings.hpp"

namespace orca::host {
namespace {

// A device may hang at another port than the graph says.
std::string cannot_open(const hw::HardwareContainer& device) {
  const std::string advice =
      device.line_name().empty() ? "" : "; \"hwprobe\" tells which device is at which port";
  return "the hardware cannot be opened: " + device.fault() + advice;
}

}  // namespace

Status System::build(PluginCatalogue& catalogue) {
  std::vector<std::string> types;
  for (const graph::HardwareNode& node : graph_.hardware) types.push_back(node.type);
  for (const graph::ComponentNode& node : graph_.components) types.push_back(node.type);
  catalogue.expect(types);
  if (Status built = build_hardware(catalogue); !built.ok()) return built;
  if (Status built = build_components(catalogue); !built.ok()) return built;
  catalogue.forget_answers();
  return connect(
      graph_, [this](const std::string& name) { return components_.find(name); },
      [this](const graph::Edge& edge) { return links_of(graph_, edge, run_); });
}

Status System::build_hardware(PluginCatalogue& catalogue) {
  for (const graph::HardwareNode& node : graph_.hardware) {
    Result<LoadedType> type = catalogue.acquire(PluginKind::hardware, node.type);
    if (!type) return type.error();
    auto instance = std::make_unique<HardwareInstance>(run_, node.name, std::move(type).value());
    if (Status made = instance->construct(node.params); !made.ok()) return made;
    hardware_.push_back(std::make_unique<HardwarePlace>(std::move(instance)));
  }
  return ok();
}

Status System::build_components(PluginCatalogue& catalogue) {
  for (const graph::ComponentNode& node : graph_.components) {
    ComponentSettings settings = settings_of(node, run_.failures);
    if (const auto kept = run_.states.find(node.name); kept != run_.states.end())
      settings.state = kept->second;
    Result<std::unique_ptr<ComponentInstance>> instance = make(node, std::move(settings), catalogue);
    if (!instance) return instance.error();
    components_.add(std::move(instance).value());
  }
  return ok();
}

Result<std::unique_ptr<ComponentInstance>> System::make(const graph::ComponentNode& node,
                                                        ComponentSettings settings,
                                                        PluginCatalogue& catalogue) {
  HardwarePlace* const place = hardware(node.hardware);
  settings.cores = cores_of(graph_, node.process, run_.cores);
  auto instance = std::make_unique<ComponentInstance>(
      run_, std::move(settings),
      [&catalogue, type = node.type] { return catalogue.acquire(PluginKind::component, type); },
      [&catalogue](LoadedType type) { return catalogue.release(std::move(type)); },
      place != nullptr ? &place->seat() : nullptr);
  if (run_.doorbell) instance->set_doorbell(*run_.doorbell(node.name));
  const Status made = node.on_demand ? declare(graph_, node, *instance, catalogue) : instance->load();
  if (!made.ok()) return made.error();
  // In virtual time nobody of ROS 2 is there.
  const Status connected =
      run_.executive.is_virtual() ? connect_silence(node, *instance) : topics_.connect(node, *instance);
  if (!connected.ok()) return connected.error();
  return instance;
}

Status System::add(const graph::ComponentNode& node, PluginCatalogue& catalogue) {
  if (components_.find(node.name) != nullptr)
    return fail(Code::already_exists,
                "an earlier one of this name has not ended; start its process again to be rid of it",
                node.name);
  Result<std::unique_ptr<ComponentInstance>> instance =
      make(node, settings_of(node, run_.failures), catalogue);
  if (!instance) return instance.error();
  components_.add(std::move(instance).value());
  fresh_.insert(node.name);
  return ok();
}

Result<std::unique_ptr<ComponentInstance>> System::remove(const std::string& name, TimePoint deadline) {
  const Result<ComponentInstance*> component = instance(name);
  if (!component) return component.error();
  fresh_.erase(name);
  (*component)->announce_exit();
  (*component)->request_exit();
  if ((*component)->join_until(deadline)) return components_.take(name);
  const std::string hook = (*component)->current_hook();
  return fail(Code::deadline_exceeded, "it does not end" + (hook.empty() ? "" : "; it is in " + hook), name);
}

Status System::bring_up(Event& changed, TimePoint deadline) {
  if (Status opened = open_hardware(changed, deadline); !opened.ok()) return opened;
  for (const std::string& name : graph::start_order(graph_))
    if (Status configured = configure(name, changed, deadline); !configured.ok()) return configured;
  return ok();
}

Status System::open_hardware(Event& changed, TimePoint deadline) {
  for (const auto& hardware : hardware_) hardware->run(hardware->driver());
  for (const auto& hardware : hardware_) {
    hw::HardwareSeat& device = hardware->seat();
    wait_until_holds(run_.executive, changed, deadline, [&] {
      return give_up_() || device.state() == hw::HardwareState::ready ||
             device.state() == hw::HardwareState::fault;
    });
    if (device.state() == hw::HardwareState::fault)
      return fail(Code::unavailable, cannot_open(hardware->driver().container()), hardware->name());
    if (device.state() != hw::HardwareState::ready)
      return fail(
          Code::deadline_exceeded,
          "the hardware did not open in time; a device that was just switched on may need longer, as a "
          "laser half a minute: start again when it is ready",
          hardware->name());
  }
  return ok();
}

Status System::configure(const std::string& name, Event& changed, TimePoint deadline) {
  const Result<ComponentInstance*> found = instance(name);
  if (!found) return found.error();
  ComponentInstance& component = **found;
  fresh_.erase(name);
  component.start();
  wait_until_holds(run_.executive, changed, deadline,
                   [&] { return give_up_() || component.state() != ComponentState::init; });
  if (component.state() == ComponentState::init)
    return fail(Code::deadline_exceeded, "configure() did not return in time", name);
  if (component.has_failed()) return fail(Code::failed_precondition, component.failure(), name);
  return ok();
}

void System::open_gates() {
  for (const auto& component : components_.all()) component->open_gate();
}

bool System::at_rest() const {
  return std::ranges::all_of(components_.all(), [](const auto& c) { return c->at_rest(); }) &&
         std::all_of(hardware_.begin(), hardware_.end(),
                     [](const auto& h) { return h->seat().state() != hw::HardwareState::active; });
}

Status System::check_unused() const {
  for (const auto& component : components_.all())
    if (component->is_in_use()) return fail(Code::failed_precondition, "it is in use", component->name());
  return ok();
}

std::vector<std::string> System::take_down(TimePoint deadline, bool keeps_states) {
  for (const auto& component : components_.all()) component->announce_exit();
  for (const auto& hardware : hardware_) hardware->shut_down();
  for (const auto& component : components_.all()) component->request_exit(keeps_states);
  std::vector<std::string> stuck;
  for (const auto& component : components_.all()) {
    if (component->join_until(deadline)) continue;
    const std::string hook = component->current_hook();
    stuck.push_back(component->name() + (hook.empty() ? "" : " (in " + hook + ")"));
  }
  for (const auto& hardware : hardware_)
    if (!hardware->join_until(deadline)) stuck.push_back(hardware->name());
  run_.courier.end();
  return stuck;
}

void System::stop_hardware(Duration limit) {
  for (const auto& hardware : hardware_) hardware->shut_down();
  const auto closed = [](const auto& hardware) { return hardware->is_closed(); };
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!std::ranges::all_of(hardware_, closed) && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(1ms);
}

bool System::hold(const std::string& reason, Movers what) {
  bool are_there = false;
  for (const auto& hardware : hardware_) {
    if (what == Movers::on_lines && !(hardware->seat().has_line() && hardware->seat().moves())) continue;
    hardware->seat().hold(reason);
    are_there = true;
  }
  return are_there;
}

bool System::let_go() {
  bool was_held = false;
  for (const auto& hardware : hardware_) was_held = hardware->seat().let_go() || was_held;
  return was_held;
}

Status System::on_strand(const std::string& component, Event& changed, TimePoint deadline,
                         std::function<Status()> rewire) {
  const Result<ComponentInstance*> found = instance(component);
  if (!found) return found.error();
  if (fresh_.contains(component)) return rewire();
  const std::shared_ptr<Order> order = (*found)->order_rewiring(std::move(rewire));
  const Status outcome = await(**found, *order, changed, deadline);
  if (order->is_withdrawn())
    return fail(outcome.error().code, outcome.error().message + "; its connections stay as they are",
                component);
  wait_until_holds(run_.executive, changed, kForever, [&] { return order->done(); });  // it is under way
  return order->result();
}

Endpoint* System::endpoint(const graph::PortRef& port) const {
  const ComponentInstance* const owner = components_.find(port.component);
  return owner == nullptr ? nullptr : owner->endpoint(port.port);
}

Status System::suspend(const std::string& name, Event& changed, TimePoint deadline) {
  const Result<ComponentInstance*> component = instance(name);
  if (!component) return component.error();
  return await(**component, *(*component)->order_suspend(), changed, deadline);
}

Status System::resume(const std::string& name, Event& changed, TimePoint deadline) {
  const Result<ComponentInstance*> component = instance(name);
  if (!component) return component.error();
  return await(**component, *(*component)->order_resume(), changed, deadline);
}

Status System::set_params(const std::string& name, const std::map<std::string, std::string>& texts,
                          Event& changed, TimePoint deadline) {
  const Result<ComponentInstance*> component = instance(name);
  if (!component) return component.error();
  Result<graph::Params> values = graph::read_settings((*component)->parts().params.contracts(), texts);
  if (!values) return values.error();
  return await(**component, *(*component)->order_params(std::move(values).value()), changed, deadline);
}

// An order that is refused here is never carried out later.
Status System::await(const ComponentInstance& component, Order& order, Event& changed, TimePoint deadline) {
  const bool came =
      wait_until_holds(run_.executive, changed, deadline, [&] { return order.done() || give_up_(); });
  const bool is_withdrawn = order.withdraw();
  if (order.done()) return order.result();
  if (came) return fail(Code::failed_precondition, "the system is being taken down", component.name());
  const std::string hook = component.current_hook();
  const std::string where = hook.empty() ? "" : "; it is in " + hook;
  if (!is_withdrawn)
    return fail(Code::deadline_exceeded, "it has begun to do that, and has not ended in time" + where,
                component.name());
  return fail(Code::deadline_exceeded, "it has not come to the end of a lap in time" + where,
              component.name());
}

Result<ComponentInstance*> System::instance(const std::string& name) const {
  if (ComponentInstance* const found = components_.find(name)) return found;
  std::vector<std::string> names;
  for (const auto& component : components_.all()) names.push_back(component->name());
  return fail(Code::not_found, "there is no component \"" + name + "\"; the system has: " + listed(names));
}

const ComponentInstance* System::component(const std::string& name) const { return components_.find(name); }

HardwarePlace* System::hardware(const std::string& name) const {
  for (const auto& hardware : hardware_)
    if (hardware->name() == name) return hardware.get();
  return nullptr;
}

std::map<std::string, std::string> System::robots() const {
  std::map<std::string, std::string> robots;
  for (const auto& hardware : hardware_)
    if (!hardware->driver().robot().empty()) robots[hardware->name()] = hardware->driver().robot();
  return robots;
}

std::vector<RunGlance::Unwell> System::unwell() const {
  std::vector<RunGlance::Unwell> unwell = components_.unwell();
  for (const auto& hardware : hardware_) {
    const hw::HardwareState state = hardware->seat().state();
    if (state != hw::HardwareState::ready && state != hw::HardwareState::active &&
        state != hw::HardwareState::closed)
      unwell.push_back({hardware->name(), hw::to_string(state)});
  }
  return unwell;
}

void System::draw(Scene& scene) {
  for (const auto& hardware : hardware_)
    if (hw::Drawable* const drawable = hardware->driver().container().drawable()) drawable->draw(scene);
}

namespace {

// Adds the Push edge that ends at a port.
void add_edge(const graph::Edge& node, const PushClientEndpoint& to, RunCounters& counters) {
  if (const auto counted = to.counters_from(node.from.text()))
    counters.edges.push_back({node.from.text(), to.path(), *counted, to.ages_from(node.from.text())});
}

void add_client(const Endpoint& port, RunCounters& counters) {
  if (const auto* sender = dynamic_cast<const SendClientEndpoint*>(&port))
    counters.clients[port.path()] = sender->counters();
  if (const auto* asker = dynamic_cast<const QueryClientEndpoint*>(&port))
    counters.clients[port.path()] = asker->counters();
}

void add_server(const Endpoint& port, RunCounters& counters) {
  if (const auto* taker = dynamic_cast<const SendServerEndpoint*>(&port))
    counters.servers[port.path()] = taker->counters();
  if (const auto* answerer = dynamic_cast<const QueryServerEndpoint*>(&port))
    counters.servers[port.path()] = answerer->counters();
}

}  // namespace

RunCounters collect_counters(const graph::Graph& graph, const System& system) {
  RunCounters counters;
  for (const graph::Edge& edge : graph.edges) {
    const Endpoint* const from = system.endpoint(edge.from);
    const Endpoint* const to = system.endpoint(edge.to);
    if (const auto* subscriber = dynamic_cast<const PushClientEndpoint*>(to))
      add_edge(edge, *subscriber, counters);
    if (from != nullptr) add_client(*from, counters);
    if (to != nullptr) add_server(*to, counters);
  }
  for (const auto& component : system.components().all()) {
    const ComponentParts& parts = component->parts();
    if (const ComputingCounters counted = parts.home.computing.counters(); counted.laps > 0)
      counters.computing[component->name()] = counted;
    if (parts.recent_laps) counters.laps[component->name()] = parts.recent_laps->figures(parts.now());
  }
  return counters;
}

}  // namespace orca::host
