// SPDX-License-Identifier: GPL-3.0-or-later
// A peer may write anything into the shared memory of an edge: the reader gives frames or cuts it off. The first byte
// chooses the pattern and the side; the rest is what stands in the segment, in pieces: where (2 bytes), how much (1 byte),
// and what.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <span>

#include "all_ports.hpp"
#include "bulk_pools.hpp"
#include "orca/base/log.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/patterns/shm/shm_edges.hpp"
#include "shm/bulk_loans.hpp"

namespace {

using namespace orca;
using test::AllPorts;
using test::port;
using Input = std::span<const std::uint8_t>;

constexpr std::size_t kCapacity = 4096;  // [bytes]

struct Node : AllPorts {
  using AllPorts::AllPorts;
  PushProxy<idl::Image> pictures{*this, "pictures"};
};

ShmEnd& make_end(Node& node, std::uint8_t choice, RingSegment segment, const ShmPeer& peer) {
  switch (choice % 7) {
    case 0: return make_shm_end(port<PushServerEndpoint>(node, "out"), std::move(segment), peer, {});
    case 1:
      return make_shm_end(port<PushClientEndpoint>(node, "in"), std::move(segment), peer, {.depth = 4},
                          Duration{0});
    case 2: return make_shm_end(port<SendServerEndpoint>(node, "taker"), std::move(segment), peer, {});
    case 3: return make_shm_end(port<SendClientEndpoint>(node, "sender"), std::move(segment), peer, {});
    case 4: return make_shm_end(port<QueryServerEndpoint>(node, "answerer"), std::move(segment), peer);
    case 5: return make_shm_end(port<QueryClientEndpoint>(node, "question"), std::move(segment), peer);
    default:
      return make_shm_end(port<PushClientEndpoint>(node, "pictures"), std::move(segment), peer, {.depth = 4},
                          Duration{0});
  }
}

// Lets the component do whatever may make it write, or look at what it has received.
void act(Node& node) {
  node.out.push(full_stop());
  if (node.in.connected()) (void)node.in.get_update_wait_max(Duration{0});
  if (node.pictures.connected())
    if (const auto image = node.pictures.get_update_wait_max(Duration{0}))
      (void)std::accumulate(image->data().begin(), image->data().end(), 0U);
  if (const auto id = node.sender.send_request(full_stop())) (void)node.sender.send_receive(*id);
  if (const auto id = node.question.query_request(node.question.loan()))
    (void)node.question.query_receive(*id);
  node.strand().take_in();
  while (node.handle_one()) {
  }
}

// Writes the next piece of the input into the segment.
void write_piece(std::span<std::byte> segment, Input& input) {
  const std::size_t at = (input[0] + std::size_t{256} * input[1]) % segment.size();
  const std::size_t count = std::min<std::size_t>({input[2], input.size() - 3, segment.size() - at});
  std::memcpy(segment.data() + at, input.data() + 3, count);
  input = input.subspan(3 + count);
}

void run(Executive& executive, Input input) {
  const MemoryFile file = RingSegment::create("fuzz", kCapacity).value();
  const RingSegment theirs = RingSegment::map(file.descriptor()).value();
  DoorbellWord own{0};
  DoorbellWord others{0};
  test::provide_to_itself();
  // A peer that has a pool says so.
  shm::loans_in(theirs.memory().bytes(), 1).pool = BulkPool::own().identity();
  Node node(executive, "node");
  node.strand().set_doorbell(own);
  ShmEnd& end = make_end(node, input[0], RingSegment::map(file.descriptor()).value(), {"peer.port", &others});
  node.open();
  if (node.in.connected()) node.in.subscribe();
  if (node.pictures.connected()) node.pictures.subscribe();
  input = input.subspan(1);
  while (input.size() > 3) {
    write_piece(theirs.memory().bytes(), input);
    act(node);
  }
  if (end.counters().peers_cut_off > 1) std::abort();
  end.renew(RingSegment::map(RingSegment::create("fuzz", kCapacity).value().descriptor()).value());
  node.strand().take_in();
  if (end.is_cut()) std::abort();
  node.close("the end");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  log::set_level(log::Level::error);  // being cut off is a warning
  static const auto executive = make_executive({}).value();
  executive->run([&] { run(*executive, Input(data, size)); });
  return 0;
}
