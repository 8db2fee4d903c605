// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/time.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::graph {

/// Parameter values by name, in SI. Complete: what the file does not set has its declared default.
using Params = std::map<std::string, ParamValue>;

/// A hardware container of the system: a device, or the simulator in its place.
struct HardwareNode {
  std::string name;
  std::string type;  ///< E.g. "orca.hw.Sim".
  Params params;
  xml::Position position;  ///< Of its element; takes no part in comparisons.

  friend bool operator==(const HardwareNode& a, const HardwareNode& b);
};

/// A port of a component of the graph, by its name in the graph.
struct PortRef {
  std::string component;
  std::string port;

  /// "avoid.laser"
  [[nodiscard]] std::string text() const { return component + "." + port; }
  friend auto operator<=>(const PortRef&, const PortRef&) = default;
};

/// What the graph says about a port of one component.
struct PortSetting {
  std::string alias;                ///< Its name in the graph; empty: the one its author gave it.
  bool disabled = false;            ///< Nothing may be connected to it.
  std::vector<PortRef> candidates;  ///< Ports that the component may subscribe to at run time, by name.

  friend bool operator==(const PortSetting&, const PortSetting&) = default;
};

/// One peer of the system.
struct ComponentNode {
  std::string name;
  std::string type;      ///< E.g. "orca.SonarAvoid".
  std::string hardware;  ///< Name of a HardwareNode; empty: none.
  std::string process;   ///< Name of the process it lives in; empty: the graph does not say.
  int priority = 0;      ///< -100 to 100; of components that are ready together the higher goes first.
  std::optional<bool> autonomous;        ///< Works without clients; nothing: as its author wants.
  bool on_demand = false;                ///< Loaded when first asked for, and unloaded when long unused.
  bool stay_warm = false;                ///< Once loaded it stays.
  Duration idle_time{0};                 ///< So long unused it is unloaded; on demand and not warm only.
  std::optional<Trigger> trigger;        ///< What starts a lap; nothing: as its author wants.
  std::vector<std::string> start_after;  ///< Components that must be up before.
  Params params;
  std::map<std::string, std::string> properties;  ///< Exported for trading.
  std::map<std::string, PortSetting> ports;  ///< By the author's name; those the graph says something about.
  xml::Position position;                    ///< Of its element; takes no part in comparisons.

  friend bool operator==(const ComponentNode& a, const ComponentNode& b);
};

/// A connection.
struct Edge {
  PortRef from;  ///< The PushServer, QueryProxy or SendProxy.
  PortRef to;    ///< The PushProxy, QueryServer or SendServer.
  Pattern pattern = Pattern::push;
  QueuePolicy queue;     ///< Of this edge alone, its min_interval always 0; where the graph does not say, the
                         ///< receiving port's default.
  Duration interval{0};  ///< Push: deliver at most one object per interval; 0: every one.
  xml::Position position;   ///< Of its element; takes no part in comparisons.
  bool late_bound = false;  ///< From a candidate: subscribed to only once the component names it.

  friend bool operator==(const Edge& a, const Edge& b);
};

/// A system graph that was checked against the contracts of its plugins: every name in it exists, every edge
/// fits, every parameter is in range. A plain value.
struct Graph {
  std::string name;
  std::vector<std::string> ends;         ///< The run ends when these components are done, or one has failed.
  std::vector<std::string> plugin_dirs;  ///< Absolute; searched after Orca's own.
  std::string default_profile;           ///< Empty: none.
  std::optional<std::uint64_t> seed;     ///< For random numbers, unless the command line gives one.
  std::vector<HardwareNode> hardware;
  std::vector<ComponentNode> components;
  std::vector<Edge> edges;

  [[nodiscard]] const HardwareNode* find_hardware(const std::string& wanted) const;
  [[nodiscard]] const ComponentNode* find_component(const std::string& wanted) const;
  friend bool operator==(const Graph&, const Graph&) = default;
};

}  // namespace orca::graph
