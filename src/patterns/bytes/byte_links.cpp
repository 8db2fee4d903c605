// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/bytes/byte_links.hpp"

#include <optional>
#include <utility>

#include "byte_end.hpp"
#include "courier.hpp"
#include "frames/push_over_frames.hpp"
#include "frames/request_over_frames.hpp"

namespace orca {
namespace {

using namespace bytes;
using namespace frames;

// The two ends of a new link.
struct Pair {
  std::unique_ptr<FrameEnd> client;
  std::unique_ptr<FrameEnd> server;
};

Pair make_pair(Executive& executive, Courier& courier, Traffic& traffic, std::size_t capacity,
               const Endpoint& client, const Endpoint& server) {
  const auto to_server = std::make_shared<ByteWire>(courier, capacity);
  const auto to_client = std::make_shared<ByteWire>(courier, capacity);
  courier.serve(to_server);
  courier.serve(to_client);
  const auto end = [&](const Endpoint& from, const Endpoint& to, const auto& out, const auto& in) {
    return std::make_unique<ByteEnd>(
        Connection{executive, traffic, from.path() + " to " + to.path(), out, in});
  };
  return {end(client, server, to_server, to_client), end(server, client, to_client, to_server)};
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
  auto near = std::make_unique<TargetOverFrames<Answer>>(std::move(pair.client), client.home().strand, types,
                                                         server.path(), target.patience());
  server.adopt(std::make_unique<CallerOverFrames<Answer>>(std::move(pair.server), types, target),
               client.path());
  client.connect(*near);
  client.adopt(std::move(near), server.path());
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
  PushSource& source = server.connect(client.path());
  auto near = std::make_unique<PushSourceOverFrames>(std::move(pair.client), type_of(server.contract().type),
                                                     server.path(), server.base_period());
  server.adopt(std::make_unique<PushSinkOverFrames>(std::move(pair.server), source, policy), client.path());
  client.connect(*near, policy);
  client.adopt(std::move(near), server.path());
}

void ByteLinks::query(QueryClientEndpoint& client, QueryServerEndpoint& server) {
  connect_requests(make_pair(executive_, *courier_, *traffic_, capacity_, client, server), client, server,
                   server.connect(client.path()));
}

void ByteLinks::send(SendClientEndpoint& client, SendServerEndpoint& server, const QueuePolicy& policy) {
  connect_requests(make_pair(executive_, *courier_, *traffic_, capacity_, client, server), client, server,
                   server.connect(client.path(), policy));
}

}  // namespace orca
