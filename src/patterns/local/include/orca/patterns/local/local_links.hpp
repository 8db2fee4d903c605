// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/patterns/endpoints/links.hpp"

namespace orca {

/// The links between ports of one process. They hand over objects as they are, without copying or serialising
/// them.
///
/// Thread contract: as Links.
class LocalLinks final : public Links {
 private:
  void push(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy) override;
  void query(QueryClientEndpoint& client, QueryServerEndpoint& server) override;
  void send(SendClientEndpoint& client, SendServerEndpoint& server, const QueuePolicy& policy) override;
};

}  // namespace orca
