// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/patterns/endpoints/courier.hpp"
#include "orca/patterns/endpoints/links.hpp"

namespace orca {

/// The links between ports of one process. They hand over objects as they are, without copying or serialising
/// them, at once or after some virtual time.
///
/// Thread contract: as Links; renew() says when it can be called later, check_fit() at any time.
class LocalLinks final : public Links {
 public:
  /// Makes links that take no time.
  LocalLinks() = default;
  /// Makes links on which objects are under way for some time, and so are their answers. Subscriptions, withdrawals and the end of a
  /// connection take none; what is under way is then lost.
  /// @param courier  outlives the connections.
  /// @param delay    [s], at least 0.
  LocalLinks(Courier& courier, Duration delay) : courier_(&courier), delay_(delay) {}

  /// Connects two ports whose components run, in place of the connection that a proxy has: what waits at a PushProxy stays. If
  /// they are connected already, their connection gets the policy.
  /// @errors  invalid_argument as connect().
  /// @pre  the client is not movable (MovablePort::can_move()).
  /// @thread  the client's strand between two laps.
  Status renew(Endpoint& from, Endpoint& to, const QueuePolicy& policy);
  using Links::check_fit;

 private:
  void push(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy) override;
  void query(QueryClientEndpoint& client, QueryServerEndpoint& server) override;
  void send(SendClientEndpoint& client, SendServerEndpoint& server, const QueuePolicy& policy) override;
  [[nodiscard]] bool takes_time() const { return courier_ != nullptr && delay_ > Duration{0}; }

  Courier* courier_ = nullptr;
  Duration delay_{0};
};

}  // namespace orca
