// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <string>

#include "orca/graph/graph.hpp"
#include "run/component/component_instance.hpp"
#include "trial_servers.hpp"

namespace orca::host {

/// Stands for the peers of a component while another object for it is configured: the object finds its ports connected as
/// they are in the running system, but whatever it says reaches nobody.
///
/// Thread contract: one thread, before the object's strand starts; push() later as well, from tasks of the executive.
class Backdrop {
 public:
  explicit Backdrop(Executive& executive) : executive_(executive) {}

  /// Gives the sources of an object's port arrays the places that they have at the component whose ports the object will take
  /// over, because the object knows them by their places. Connections that changed while it ran have left others there than
  /// the graph's order would. Call before connect().
  static void keep_places(const ComponentInstance& running, const ComponentInstance& object);

  /// Connects an object's ports as the graph connects those of the component of that name.
  /// @param servers  take what it asks and sends, and outlive the object; null: nobody does.
  /// @errors  those of Links::connect().
  Status connect(const graph::Graph& graph, ComponentInstance& object, TrialServers* servers = nullptr);

  /// Lets a peer push an object, if it is connected.
  /// @param from  the peer's port.
  void push(const graph::PortRef& from, ObjectRef object);

 private:
  // One peer. Its strand never runs.
  struct Peer {
    Peer(Executive& executive, const std::string& name)
        : strand(executive, {name, 0}), home{strand, name, nullptr, {}}, ports(home) {}
    Strand strand;
    PortHome home;
    PortSet ports;
  };

  Status connect(const graph::Edge& edge, bool comes_from, Endpoint& own);
  Endpoint* counterpart(const graph::PortRef& ref, const Endpoint& of);

  Executive& executive_;
  std::map<std::string, std::unique_ptr<Peer>> peers_;
};

}  // namespace orca::host
