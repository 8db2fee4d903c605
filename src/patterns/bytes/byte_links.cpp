// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/bytes/byte_links.hpp"

#include <optional>
#include <utility>

#include "courier.hpp"
#include "push_over_bytes.hpp"
#include "request_over_bytes.hpp"
#include "traffic.hpp"

namespace orca {
namespace {

using namespace bytes;

// The two ends of a new link.
struct Pair {
  Connection client;
  Connection server;
};

Pair make_pair(Executive& executive, Courier& courier, Traffic& traffic, std::size_t capacity,
               const Endpoint& client, const Endpoint& server) {
  const auto to_server = std::make_shared<ByteWire>(courier, capacity);
  const auto to_client = std::make_shared<ByteWire>(courier, capacity);
  courier.serve(to_server);
  courier.serve(to_client);
  return {{executive, traffic, client.path() + " to " + server.path(), to_server, to_client},
          {executive, traffic, server.path() + " to " + client.path(), to_client, to_server}};
}

const ObjectType& type_of(const TypeId& id) { return *find_object_type(id.name); }

// The types that the senders of both ways declare; the objects may be of types derived from them.
RequestTypes types_of(const Endpoint& client, const Endpoint& server) {
  const std::optional<TypeId>& reply = server.contract().reply;
  return {type_of(client.contract().type), reply ? &type_of(*reply) : nullptr};
}

template <class Answer>
void connect_requests(Pair pair, RequestClient<Answer>& client, Endpoint& server,
                      RequestTarget<Answer>& target) {
  const RequestTypes types = types_of(client, server);
  auto near = std::make_unique<TargetOverBytes<Answer>>(std::move(pair.client), types, server.path(),
                                                        target.patience());
  server.adopt(std::make_unique<CallerOverBytes<Answer>>(std::move(pair.server), types, target));
  client.connect(*near);
  client.adopt(std::move(near));
}

}  // namespace

ByteLinks::ByteLinks(Executive& executive, std::size_t capacity)
    : executive_(executive),
      capacity_(capacity),
      traffic_(std::make_unique<Traffic>()),
      courier_(std::make_unique<Courier>()) {}

ByteLinks::~ByteLinks() = default;

ByteLinkCounters ByteLinks::counters() const {
  return {traffic_->frames_received, traffic_->objects_lost, traffic_->peers_cut_off};
}

void ByteLinks::push(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy) {
  Pair pair = make_pair(executive_, *courier_, *traffic_, capacity_, client, server);
  PushSource& source = server.connect();
  auto near = std::make_unique<PushSourceOverBytes>(std::move(pair.client), type_of(server.contract().type),
                                                    server.path(), server.base_period());
  server.adopt(std::make_unique<PushSinkOverBytes>(std::move(pair.server), source, policy));
  client.connect(*near, policy);
  client.adopt(std::move(near));
}

void ByteLinks::query(QueryClientEndpoint& client, QueryServerEndpoint& server) {
  connect_requests(make_pair(executive_, *courier_, *traffic_, capacity_, client, server), client, server,
                   server.connect());
}

void ByteLinks::send(SendClientEndpoint& client, SendServerEndpoint& server, const QueuePolicy& policy) {
  connect_requests(make_pair(executive_, *courier_, *traffic_, capacity_, client, server), client, server,
                   server.connect(client.path(), policy));
}

}  // namespace orca
