// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

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

  /// Adds an edge, not yet subscribed. If the port can move, all its connections are one edge, with the policy of the first.
  PushEdge& connect(PushSource& source, const QueuePolicy& policy);

  [[nodiscard]] bool connected() const { return !edges_.empty(); }
  [[nodiscard]] const std::vector<std::unique_ptr<PushEdge>>& edges() const { return edges_; }
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
  std::vector<std::unique_ptr<PushEdge>> edges_;
  std::optional<Alternatives<PushSource>> alternatives_;  // if the port can move
};

}  // namespace orca
