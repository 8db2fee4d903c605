// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>

#include "orca/patterns/endpoints/courier.hpp"
#include "orca/patterns/endpoints/links.hpp"

namespace orca {

/// The transport between two ports: who carries the objects, and how long each is under way [s of virtual time].
struct Transport {
  Courier& courier;
  Duration delay;
};

/// Connect two ports so that everything between them is under way for some time: objects, answers, and the confirmation for a publisher
/// that waits for room. Subscriptions, withdrawals and the end of a connection take none; what is under way is then lost. The client
/// owns the end of the link.
/// @pre  as Links::connect().
void connect_delayed(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy,
                     const Transport& transport);
void connect_delayed(QueryClientEndpoint& client, QueryServerEndpoint& server, const Transport& transport);
void connect_delayed(SendClientEndpoint& client, SendServerEndpoint& server, const QueuePolicy& policy,
                     const Transport& transport);

}  // namespace orca
