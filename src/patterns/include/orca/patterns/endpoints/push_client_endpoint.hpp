// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/mutex.hpp"
#include "orca/patterns/endpoints/alternatives.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"
#include "orca/patterns/endpoints/push_edge.hpp"

namespace orca {

/// The client side of Push: the edges that end at one PushProxy. There is at most one unless the port is an
/// array.
class PushClientEndpoint final : public Endpoint, public MovablePort {
 public:
  PushClientEndpoint(PortHome& home, PortContract contract);
  ~PushClientEndpoint() override { cut_links(); }

  void allow_moves() override;
  [[nodiscard]] bool can_move() const override { return alternatives_.has_value(); }
  bool move_to(const std::string& server) override;

  /// Connects the port. If it can move, all its connections are one edge, with the policy of the first. Otherwise an edge
  /// whose server is gone takes the new one; that of a port which is no array does so also if it has a server, and keeps what
  /// waits. A new edge is subscribed if the runtime has subscribed the port.
  PushEdge& connect(PushSource& source, const QueuePolicy& policy);
  /// Gives a port array the places of another one: an edge without a server for each of its edges, in their order.
  /// connect() gives a server its place.
  /// @pre  the port has no edges yet.
  void take_places_of(const PushClientEndpoint& other);
  /// Lets the edge from a server have none any more. The edge stays for the next connect(). Nothing if there is none.
  void disconnect(const std::string& server);
  /// Returns the edge from a server; null if there is none.
  [[nodiscard]] PushEdge* edge_from(const std::string& server) const;

  /// Returns whether an edge has a server.
  [[nodiscard]] bool connected() const;
  /// Returns all edges, with those whose server is gone.
  [[nodiscard]] const std::vector<std::unique_ptr<PushEdge>>& edges() const { return edges_; }
  /// Returns the counters of the edge from a server; nothing if there is none.
  /// @thread  any.
  [[nodiscard]] std::optional<EdgeCounters> counters_from(const std::string& server) const;
  /// Returns how old objects from a server were lately when they arrived: see PushEdge::ages().
  /// @thread  any.
  [[nodiscard]] std::optional<TimeFigures> ages_from(const std::string& server) const;
  /// Returns whether an object waits, from any server.
  [[nodiscard]] bool has_new() const;
  /// Returns whether an object waits from every server that the port is subscribed to, and there is one.
  [[nodiscard]] bool has_new_from_all() const;

  /// Returns whether one of its edges has a deadline.
  [[nodiscard]] bool has_deadline() const;
  /// Does what PushEdge::watch_deadline() does, for all edges.
  TimePoint watch_deadlines();

  void subscribe_all();
  void unsubscribe_all();

 private:
  [[nodiscard]] PushEdge* vacancy_for(const PushSource& source) const;

  mutable Mutex mutex_;  // held while the strand changes the vector, and while others read it
  std::vector<std::unique_ptr<PushEdge>> edges_;
  bool subscribes_ = false;                               // the runtime has subscribed all edges
  std::optional<Alternatives<PushSource>> alternatives_;  // if the port can move
};

}  // namespace orca
