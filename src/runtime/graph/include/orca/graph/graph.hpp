// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/time.hpp"
#include "orca/graph/laps.hpp"
#include "orca/graph/process.hpp"
#include "orca/graph/property.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::graph {

/// Parameter values by name, in SI. Complete: those that the file does not set have their declared defaults.
using Params = std::map<std::string, ParamValue>;

/// A hardware container of the system: a device, or the simulator in its place.
struct HardwareNode {
  std::string name;
  std::string type;                    ///< E.g. "orca.hw.Sim".
  std::string process = kMainProcess;  ///< That of all components that are bound to it.
  Params params;
  Place position;
  Uncompared<Params> here{};  ///< As of a component.

  friend bool operator==(const HardwareNode&, const HardwareNode&) = default;
};

/// A port of a component of the graph, by its name in the graph.
struct PortRef {
  std::string component;
  std::string port;

  /// Returns the port as people write it: "avoid.laser".
  [[nodiscard]] std::string text() const { return component + "." + port; }
  friend auto operator<=>(const PortRef&, const PortRef&) = default;
};

/// The settings of the graph for a port of one component.
struct PortSetting {
  std::string alias;                ///< Its name in the graph; empty: the author's name.
  bool disabled = false;            ///< Nothing may be connected to it.
  std::vector<PortRef> candidates;  ///< Ports that the component may subscribe to at run time, by name.
  std::string topic;                ///< Of ROS 2, on which it speaks as well: "/scan"; empty: none.
  std::string
      message;  ///< What is said there: "sensor_msgs/msg/LaserScan"; empty: what is usual for the port's type.
  std::string
      team;  ///< Name of what it offers to the team of the system, or hears from it: "pose"; empty: nothing.

  /// Returns whether it speaks to others than ports of this system.
  [[nodiscard]] bool speaks_outside() const { return !topic.empty() || !team.empty(); }
  friend bool operator==(const PortSetting&, const PortSetting&) = default;
};

/// One peer of the system.
struct ComponentNode {
  std::string name;
  std::string type;      ///< E.g. "orca.SonarAvoid".
  std::string hardware;  ///< Name of a HardwareNode; empty: none.
  std::string process = kMainProcess;
  int priority = 0;  ///< -100 to 100; of components that are ready together, the highest goes first.
  std::optional<bool> autonomous;  ///< Works without clients; nothing: the author's choice.
  bool watchable = false;          ///< Also works while somebody looks at what it pushes.
  LapTime takes{};                 ///< Virtual time that computing a lap takes.
  bool on_demand = false;          ///< Loaded when first asked for, and unloaded when long unused.
  bool stay_warm = false;          ///< Stays in memory once it is loaded.
  Duration idle_time{0};           ///< Unloaded when not used for that long; on demand and not warm only.
  bool restore_last = false;       ///< Begins with its last state after its process was lost.
  bool may_fail = false;           ///< Its WORK_FAILED at the end of a run does not make the run a failure.
  std::optional<Trigger> trigger;  ///< Starts a lap; nothing: the author's choice.
  std::vector<std::string> start_after;  ///< Components that must be up before this one.
  std::vector<std::string> may_set;      ///< Parameters of others that it may set: "pilot.max_speed".
  std::vector<std::string> may_suspend;  ///< Other components that it may suspend.
  Params params;
  Properties properties;                     ///< Those that the graph declares.
  std::map<std::string, PortSetting> ports;  ///< By the author's name; only ports with settings.
  Place position;
  /// Defaults that are files of the folder in which the program was started. print() leaves out parameters that have
  /// them still, because a relative path in a graph starts at the graph's file.
  Uncompared<Params> here{};

  friend bool operator==(const ComponentNode&, const ComponentNode&) = default;
};

/// Returns the settings of a port by its name in the graph.
[[nodiscard]] PortSetting setting_of(const ComponentNode& node, const std::string& port);

/// Components that an operator orders about by one name.
struct GroupNode {
  std::string name;                     ///< No component has the same.
  std::vector<std::string> components;  ///< At least one, each once.
  Place position;

  friend bool operator==(const GroupNode&, const GroupNode&) = default;
};

/// The carrier of an edge's objects.
enum class Link {
  local,  ///< Queues within a process.
  shm,    ///< Memory that two processes of one machine share.
  dds,    ///< The network.
};

[[nodiscard]] constexpr const char* to_string(Link link) {
  switch (link) {
    case Link::local: return "local";
    case Link::shm: return "shm";
    case Link::dds: return "dds";
  }
  return "?";
}

/// A connection.
struct Edge {
  PortRef from;  ///< The PushServer, QueryProxy or SendProxy.
  PortRef to;    ///< The PushProxy, QueryServer or SendServer.
  Pattern pattern = Pattern::push;
  /// Policy of this edge alone, its min_interval always 0. What the graph does not set is the default of the
  /// receiving port.
  QueuePolicy queue;
  Duration interval{0};  ///< Push: deliver at most one object per interval; 0: every one.
  Place position;
  bool late_bound = false;  ///< Made from a candidate: subscribed to only once the component names it.
  Link link = Link::local;  ///< What the graph says; else chosen by the processes and machines of its ends.
  /// Rank, from 1, among the edges of a proxy that uses one of them at a time; 0: it uses this edge only, or all.
  std::uint32_t choice = 0;

  /// Returns the end that asks for objects, sends them or asks questions: the PushProxy, QueryProxy or SendProxy.
  [[nodiscard]] const PortRef& client() const { return pattern == Pattern::push ? to : from; }
  /// Returns the end that serves it.
  [[nodiscard]] const PortRef& server() const { return pattern == Pattern::push ? from : to; }

  /// Returns what people and programs call it; no other edge of the graph is called so: "avoid.motion to fuser.motion".
  [[nodiscard]] std::string name() const { return from.text() + " to " + to.text(); }

  friend bool operator==(const Edge&, const Edge&) = default;
};

/// Another graph that a run goes over to.
struct PlannedChange {
  std::string file;  ///< Absolute, if a graph names it.
  Duration at{0};    ///< [s of the run's clock] since everything was up.
  Place position;

  friend bool operator==(const PlannedChange&, const PlannedChange&) = default;
};

/// What ports of a system offer to its team, or hear from it.
struct TeamPort {
  std::string name;        ///< The same in all systems: "pose".
  std::string type;        ///< Of the objects.
  std::uint64_t hash = 0;  ///< Of the layout of that type.
  bool offers = false;     ///< Whether a port of this system offers it; else ports only hear it.

  friend bool operator==(const TeamPort&, const TeamPort&) = default;
};

/// The team that a system joins: systems of one network, each with a graph of its own, that tell each other what they offer.
struct Team {
  std::string name;             ///< Empty: it joins none.
  std::uint32_t domain = 0;     ///< DDS domain in which they meet.
  std::string interface {};     ///< Network interface, "wlan0"; empty: any.
  std::vector<TeamPort> ports;  ///< By name.

  friend bool operator==(const Team&, const Team&) = default;
};

/// A system graph that was checked against the contracts of its plugins. Every name in it exists, every edge
/// fits, and every parameter is in range. A plain value.
struct Graph {
  std::string name;
  std::vector<std::string> ends;         ///< The run ends when these components are done, or one has failed.
  std::vector<std::string> plugin_dirs;  ///< Absolute; searched after Orca's own.
  std::string default_profile;           ///< Empty: none.
  std::uint32_t domain = 0;              ///< DDS domain in which its processes and machines meet.
  Supervision supervision;
  bool records_always = false;               ///< A recording of the system is always made.
  std::uint64_t record_space = 500'000'000;  ///< Most room for it on the disk [byte].
  bool secured = false;  ///< Processes that speak over the network prove who they are, and encrypt.
  Team team;
  std::vector<MachineNode> machines;
  std::vector<ProcessNode> processes;  ///< Those that the graph declares; processes_of() returns all.
  std::vector<HardwareNode> hardware;
  std::vector<ComponentNode> components;
  std::vector<GroupNode> groups;
  std::vector<Edge> edges;
  std::vector<PlannedChange> changes;  ///< In the order of their times. The files are not read yet.

  [[nodiscard]] const HardwareNode* find_hardware(const std::string& wanted) const;
  [[nodiscard]] const ComponentNode* find_component(const std::string& wanted) const;
  [[nodiscard]] const GroupNode* find_group(const std::string& wanted) const;
  friend bool operator==(const Graph&, const Graph&) = default;
};

}  // namespace orca::graph
