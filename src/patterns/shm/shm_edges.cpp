// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/shm/shm_edges.hpp"

#include <memory>
#include <utility>

#include "frames/push_over_frames.hpp"
#include "frames/request_over_frames.hpp"
#include "ring_end.hpp"

namespace orca {
namespace {

using namespace frames;
using shm::RingEnd;
using shm::Side;

std::unique_ptr<RingEnd> make_ring_end(Side side, const Endpoint& port, RingSegment segment, ShmPeer peer) {
  std::string name = port.path() + " to " + peer.path;
  return std::make_unique<RingEnd>(side, std::move(segment), port.home().strand, std::move(peer),
                                   std::move(name));
}

const ObjectType& type_of(const TypeId& id) { return *find_object_type(id.name); }

RequestTypes types_of(const Endpoint& port) {
  const std::optional<TypeId>& reply = port.contract().reply;
  return {type_of(port.contract().type), reply ? &type_of(*reply) : nullptr};
}

template <class Answer>
ShmEnd& serve(Endpoint& server, RequestTarget<Answer>& target, RingSegment segment, ShmPeer client) {
  std::string path = client.path;
  auto end = make_ring_end(Side::server, server, std::move(segment), std::move(client));
  RingEnd& made = *end;
  server.adopt(std::make_unique<CallerOverFrames<Answer>>(std::move(end), types_of(server), target),
               std::move(path));
  return made;
}

template <class Answer>
ShmEnd& call(RequestClient<Answer>& client, RingSegment segment, ShmPeer server, Duration patience) {
  std::string path = server.path;
  auto end = make_ring_end(Side::client, client, std::move(segment), std::move(server));
  RingEnd& made = *end;
  auto target = std::make_unique<TargetOverFrames<Answer>>(std::move(end), client.home().strand,
                                                           types_of(client), path, patience);
  client.connect(*target);
  client.adopt(std::move(target), std::move(path));
  return made;
}

}  // namespace

ShmEnd& make_shm_end(PushServerEndpoint& server, RingSegment segment, ShmPeer client,
                     const QueuePolicy& policy) {
  std::string path = client.path;
  auto end = make_ring_end(Side::server, server, std::move(segment), std::move(client));
  RingEnd& made = *end;
  server.adopt(std::make_unique<PushSinkOverFrames>(std::move(end), server.connect(path), policy), path);
  return made;
}

ShmEnd& make_shm_end(PushClientEndpoint& client, RingSegment segment, ShmPeer server,
                     const QueuePolicy& policy, Duration base_period) {
  std::string path = server.path;
  auto end = make_ring_end(Side::client, client, std::move(segment), std::move(server));
  RingEnd& made = *end;
  auto source = std::make_unique<PushSourceOverFrames>(std::move(end), type_of(client.contract().type), path,
                                                       base_period);
  client.connect(*source, policy);
  client.adopt(std::move(source), std::move(path));
  return made;
}

ShmEnd& make_shm_end(QueryServerEndpoint& server, RingSegment segment, ShmPeer client) {
  QueryTarget& target = server.connect(client.path);
  return serve(server, target, std::move(segment), std::move(client));
}

ShmEnd& make_shm_end(QueryClientEndpoint& client, RingSegment segment, ShmPeer server) {
  return call(client, std::move(segment), std::move(server), Duration{0});
}

ShmEnd& make_shm_end(SendServerEndpoint& server, RingSegment segment, ShmPeer client,
                     const QueuePolicy& policy) {
  SendTarget& target = server.connect(client.path, policy);
  return serve(server, target, std::move(segment), std::move(client));
}

ShmEnd& make_shm_end(SendClientEndpoint& client, RingSegment segment, ShmPeer server,
                     const QueuePolicy& policy) {
  const bool blocks = policy.overflow == QueuePolicy::Overflow::block;
  return call(client, std::move(segment), std::move(server), blocks ? policy.block_limit : Duration{0});
}

}  // namespace orca
