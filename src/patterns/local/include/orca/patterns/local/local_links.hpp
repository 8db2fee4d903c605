// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/patterns/endpoints/links.hpp"

namespace orca {

/// The links between ports of one process. They hand over objects as they are, without copying or serialising
/// them.
///
/// Thread contract: as Links; renew() says when it can be called later, check_fit() at any time.
class LocalLinks final : public Links {
 public:
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
};

}  // namespace orca
