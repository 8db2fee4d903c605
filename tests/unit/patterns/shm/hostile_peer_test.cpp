// SPDX-License-Identifier: GPL-3.0-or-later
// A peer that writes rubbish into the shared memory costs its link, and nothing else.
#include <catch2/catch.hpp>

#include <random>

#include "all_ports.hpp"
#include "executives.hpp"
#include "orca/base/log.hpp"
#include "two_processes.hpp"

using namespace orca;
using namespace orca::test;

namespace {

// Writes random words at random places of a segment, most of them near its beginning, for ever.
[[noreturn]] void scribble(const MemoryFile& file, SharedPage& page, std::uint64_t seed) {
  const RingSegment segment = map(file);
  const auto bytes = segment.memory().bytes();
  std::mt19937_64 random(seed);
  for (;;) {
    const std::size_t range = random() % 2 == 0 ? 256 : random() % 2 == 0 ? 4096 + 512 : bytes.size();
    const std::size_t at = random() % (range / 8) * 8;
    const std::uint64_t value = random() % 3 == 0   ? random()
                                : random() % 2 == 0 ? random() % 16
                                                    : random() % 600 * 8;
    std::atomic_ref(*reinterpret_cast<std::uint64_t*>(bytes.data() + at))
        .store(value, std::memory_order_relaxed);
    if (random() % 8 == 0) page->parent = static_cast<std::uint32_t>(random() % 5);
    if (random() % 8 == 0) ring(page->parent);
  }
}

struct Quiet {
  Quiet() { log::set_level(log::Level::error); }  // being cut off is a warning
  ~Quiet() { log::set_level(log::Level::info); }
};

}  // namespace

TEST_CASE("a peer that writes rubbish all over the segment is cut off, and no call hangs",
          "[patterns][shm][processes]") {
  const Quiet quiet;
  const auto seed = GENERATE(range(1U, 21U));
  SharedPage page;
  const MemoryFile files[] = {RingSegment::create("a", 4096).value(), RingSegment::create("b", 4096).value(),
                              RingSegment::create("c", 4096).value(), RingSegment::create("d", 4096).value()};
  OtherProcess enemy([&](Executive&) { scribble(files[seed % 4], page, seed); });
  run_on({}, [&](Executive& executive) {
    AllPorts node(executive, "node");
    node.strand().set_doorbell(page->parent);
    Error reason;
    const ShmPeer peer{"enemy.port", &page->child, [&](const Error& why) { reason = why; }};
    ShmEnd* const ends[] = {
        &make_shm_end(port<PushServerEndpoint>(node, "out"), map(files[0]), peer, {}),
        &make_shm_end(port<PushClientEndpoint>(node, "in"), map(files[1]), peer, {}, Duration{0}),
        &make_shm_end(port<SendServerEndpoint>(node, "taker"), map(files[2]), peer, {}),
        &make_shm_end(port<SendClientEndpoint>(node, "sender"), map(files[3]), peer, {})};
    node.open();
    node.in.subscribe();
    const ShmEnd& attacked = *ends[seed % 4];
    const TimePoint limit = executive.now() + 5s;
    while (!attacked.is_cut() && executive.now() < limit) {
      node.out.push(full_stop());
      (void)node.in.get_update_wait_max(100us);
      if (const auto id = node.sender.send_request(full_stop())) (void)node.sender.send_receive(*id);
      (void)node.handle_one();
    }
    REQUIRE(attacked.is_cut());
    // A peer that happens to say first that it is closed has gone, and is not cut off.
    CHECK((attacked.counters().peers_cut_off == 1) == (reason.code == Code::data_loss));
    for (const ShmEnd* other : ends)
      if (other != &attacked) CHECK(other->counters().peers_cut_off == 0);
  });
}
