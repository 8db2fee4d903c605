// SPDX-License-Identifier: LGPL-3.0-or-later
#include "fit.hpp"

#include <algorithm>
#include <optional>

#include "orca/base/layout.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/port_list.hpp"
#include "orca/graph/settings.hpp"
#include "orca/hw/description.hpp"
#include "orca/xml/number.hpp"
#include "run/component/parts/port_set.hpp"

namespace orca::host {
namespace {

const PortContract* find(const std::vector<PortContract>& ports, const std::string& name) {
  const auto found = std::ranges::find(ports, name, &PortContract::name);
  return found == ports.end() ? nullptr : &*found;
}

std::string quoted(const PortContract& port) { return "\"" + port.name + "\""; }

// Returns in what two ports of one name differ.
std::string difference(const PortContract& present, const PortContract& offered) {
  const std::string is = graph::described(offered);
  const std::string was = graph::described(present);
  const std::string text = "its port " + quoted(offered) + " is a " + is;
  if (is != was) return text + ", and the connected one is a " + was;
  return text + " as well, but " +
         layout_difference(present.type.layout, offered.type.layout,
                           {"in the component that runs", "in the new one"});
}

std::set<std::string> connected_ports(const graph::Graph& graph, const std::string& component) {
  std::set<std::string> ports;
  for (const graph::Edge& edge : graph.edges) {
    if (edge.from.component == component) ports.insert(edge.from.port);
    if (edge.to.component == component) ports.insert(edge.to.port);
  }
  if (const graph::ComponentNode* const node = graph.find_component(component))
    for (const auto& [name, setting] : node->ports)
      if (setting.speaks_outside()) ports.insert(setting.alias.empty() ? name : setting.alias);
  return ports;
}

std::vector<PortContract> named_as_in_graph(std::vector<PortContract> ports,
                                            const ComponentSettings& settings) {
  for (PortContract& port : ports) port.name = settings.name_in_graph(port.name);
  return ports;
}

std::optional<std::string> misfit(const ParamContract& contract, const ParamValue& value) {
  if (value.index() != contract.default_value.index())
    return "is " + std::string(to_string(contract.type)) + " in the new one";
  double number = 0.0;
  if (const auto* real = std::get_if<double>(&value)) number = *real;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) number = static_cast<double>(*whole);
  if ((contract.min && number < *contract.min) || (contract.max && number > *contract.max))
    return "is out of the new one's range";
  const auto* text = std::get_if<std::string>(&value);
  if (text != nullptr && !contract.choices.empty() &&
      std::ranges::find(contract.choices, *text) == contract.choices.end())
    return "is \"" + *text + "\", which is not one of: " + listed(contract.choices);
  return std::nullopt;
}

}  // namespace

std::vector<std::string> misfits(const std::vector<PortContract>& present,
                                 const std::set<std::string>& connected,
                                 const std::vector<PortContract>& offered) {
  std::vector<std::string> all;
  for (const PortContract& port : present)
    if (connected.contains(port.name) && find(offered, port.name) == nullptr)
      all.push_back("it has no port " + quoted(port) + ", a " + graph::described(port) +
                    ", which is connected");
  for (const PortContract& port : offered) {
    const PortContract* const there = find(present, port.name);
    if (there != nullptr && !same_port(*there, port)) all.push_back(difference(*there, port));
    if (port.required && !connected.contains(port.name))
      all.push_back("its port " + quoted(port) + " must be connected, and is not");
  }
  return all;
}

std::vector<std::string> misfits_in(const graph::Graph& graph, const ComponentSettings& settings,
                                    const std::vector<PortContract>& present,
                                    const std::vector<PortContract>& offered) {
  return misfits(present, connected_ports(graph, settings.name), named_as_in_graph(offered, settings));
}

Result<ParamValues> inherited(const std::vector<ParamContract>& offered, ParamValues values,
                              const std::map<std::string, std::string>& given) {
  for (const auto& [name, text] : given) values.erase(name);
  ParamValues kept;
  std::vector<std::string> faults;
  for (const ParamContract& contract : offered) {
    const auto value = values.find(contract.name);
    if (value == values.end()) continue;
    if (const auto fault = misfit(contract, value->second))
      faults.push_back("parameter \"" + contract.name + "\" " + *fault);
    kept.insert(*value);
  }
  if (!faults.empty()) return fail(Code::invalid_argument, joined(faults, "; ") + "; give it another value");
  std::vector<ParamContract> at_start = offered;  // Nothing is fixed before the new object runs.
  for (ParamContract& contract : at_start) contract.fixed = false;
  const Result<graph::Params> read = graph::read_settings(at_start, given);
  if (!read) return read.error();
  for (const auto& [name, value] : *read) kept[name] = value;
  return kept;
}

namespace {

using Texts = std::vector<std::string>;

std::string seconds(Duration time) { return xml::number_text(to_seconds(time)) + " s"; }

const hw::SensorEndpoint* sensor_like(const hw::SensorEndpoint& wanted,
                                      const hw::HardwareContainer& offered) {
  const auto found = std::ranges::find_if(offered.sensors(), [&](const hw::SensorEndpoint* sensor) {
    return sensor->port_stem() == wanted.port_stem() && sensor->source() == wanted.source();
  });
  return found == offered.sensors().end() ? nullptr : *found;
}

void compare_sensors(const hw::HardwareContainer& present, const hw::HardwareContainer& offered,
                     Texts& faults) {
  for (const hw::SensorEndpoint* const sensor : present.sensors()) {
    const std::string type = sensor->port_stem();
    const hw::SensorEndpoint* const other = sensor_like(*sensor, offered);
    if (other == nullptr) {
      faults.push_back(std::string("it has no ") +
                       (sensor->source() == hw::Source::truth ? "knowledge of the true " : "sensor of ") +
                       type);
    } else if (other->period() != sensor->period()) {
      faults.push_back("it delivers " + type + " every " + seconds(other->period()) +
                       ", and the present one every " + seconds(sensor->period()));
    }
  }
}

void compare_bases(const hw::HardwareContainer& present, const hw::HardwareContainer& offered,
                   Texts& faults) {
  if (present.motion() == nullptr) return;
  if (offered.motion() == nullptr) return faults.push_back("it moves nothing");
  const hw::DriveLimits& is = offered.motion()->limits();
  const hw::DriveLimits& was = present.motion()->limits();
  if (is.type != was.type)
    faults.push_back(std::string("its drive is ") + hw::name_of(is.type) + ", and the present one's is " +
                     hw::name_of(was.type));
}

void compare_actuators(const hw::HardwareContainer& present, const hw::HardwareContainer& offered,
                       Texts& faults) {
  for (const hw::ActuatorEndpoint* const actuator : present.actuators()) {
    const bool is_there = std::ranges::any_of(offered.actuators(), [&](const hw::ActuatorEndpoint* other) {
      return other->port_stem() == actuator->port_stem();
    });
    if (!is_there) faults.push_back("it has nothing that takes a " + actuator->port_stem());
  }
}

template <class Device>
void compare_devices(const std::vector<Device>& present, const std::vector<Device>& offered,
                     const std::string& kind, Texts& faults) {
  for (const Device& device : present) {
    const bool is_there =
        std::ranges::any_of(offered, [&](const Device& d) { return d.name() == device.name(); });
    if (!is_there) faults.push_back("it describes no " + kind + " " + in_quotes(device.name()));
  }
}

void compare_descriptions(const idl::Robot& present, const idl::Robot& offered, Texts& faults) {
  compare_devices(present.drives(), offered.drives(), "drive", faults);
  compare_devices(present.actuators(), offered.actuators(), "actuator", faults);
  compare_devices(present.sonar_rings(), offered.sonar_rings(), "ring of sonars", faults);
  compare_devices(present.laser_sensors(), offered.laser_sensors(), "laser", faults);
  compare_devices(present.sensors(), offered.sensors(), "sensor", faults);
}

}  // namespace

std::vector<std::string> driver_misfits(HardwareInstance& present, HardwareInstance& offered) {
  Texts faults;
  compare_sensors(present.container(), offered.container(), faults);
  compare_bases(present.container(), offered.container(), faults);
  compare_actuators(present.container(), offered.container(), faults);
  compare_descriptions(present.description(), offered.description(), faults);
  if (offered.robot() != present.robot() && !offered.robot().empty())
    faults.push_back("it moves the robot " + in_quotes(offered.robot()) + ", and the present one " +
                     in_quotes(present.robot()));
  return faults;
}

}  // namespace orca::host
