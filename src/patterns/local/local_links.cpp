// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/local/local_links.hpp"

namespace orca {

void LocalLinks::push(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy) {
  client.connect(server.connect(), policy);
}

void LocalLinks::query(QueryClientEndpoint& client, QueryServerEndpoint& server) {
  client.connect(server.connect());
}

void LocalLinks::send(SendClientEndpoint& client, SendServerEndpoint& server, const QueuePolicy& policy) {
  client.connect(server.connect(client.path(), policy));
}

}  // namespace orca
