// SPDX-License-Identifier: GPL-3.0-or-later
// Sending to a server that has no room, and sending without waiting, for every link.
#include "send_kits.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using Overflow = QueuePolicy::Overflow;

namespace {

// A line whose server is open and whose only place is taken.
template <class Kit>
struct FullLine : Line<Kit> {
  explicit FullLine(Kit& kit) : Line<Kit>(kit, {.depth = 1, .overflow = Overflow::refuse}) {
    this->taker.open();
    CHECK(this->sender.out.send(numbered(1)).ok());
  }
  FullLine(Kit& kit, const QueuePolicy& policy) : Line<Kit>(kit, policy) {
    this->taker.open();
    CHECK(this->sender.out.send(numbered(1)).ok());
  }

  [[nodiscard]] bool sender_waits() {
    return eventually(this->sender.executive(), [this] { return this->taker.counters().waits == 1; });
  }
};

}  // namespace

CONTRACT_CASE("send_wait waits until the server has room", "[contract][send]") {
  FullLine line(kit);
  bool sent = false;
  Script script(line.sender, [&] { sent = line.sender.out.send_wait(numbered(2)).ok(); });
  REQUIRE(line.sender_waits());
  CHECK_FALSE(script.ends_within(20ms));
  CHECK(line.taker.handle_one());
  REQUIRE(script.ends_within(5s));
  CHECK(sent);
  CHECK(line.taker.handle_one());
  CHECK(line.taker.taken == std::vector{1, 2});
}

CONTRACT_CASE("send_wait_max gives up at its limit, and then the object never reaches the handler",
              "[contract][send]") {
  FullLine line(kit);
  const TimePoint before = kit.executive.now();
  const Status refused = line.sender.out.send_wait_max(numbered(2), 30ms);
  const Duration waited = kit.executive.now() - before;
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == Code::deadline_exceeded);
  CHECK_THAT(refused.error().text(), Contains("taker.in") && Contains("sender.out"));
  CHECK(waited >= 30ms);
  if (kit.executive.is_virtual()) CHECK(waited == 30ms);
  CHECK(line.taker.handle_one());
  CHECK_FALSE(line.taker.handle_one());
  CHECK(line.taker.taken == std::vector{1});
  CHECK(line.taker.counters().withdrawn == 1);
  CHECK(line.sender.out.counters().timed_out == 1);
}

CONTRACT_CASE("send_wait_max returns at once when the server is closed or has room", "[contract][send]") {
  Line line(kit);
  const Status closed = line.sender.out.send_wait_max(numbered(1), 1h);
  REQUIRE_FALSE(closed.ok());
  CHECK(closed.error().code == Code::unavailable);
  line.taker.open();
  CHECK(line.sender.out.send_wait_max(numbered(2), 1h).ok());
  CHECK(line.taker.counters().refused_closed == 1);
}

CONTRACT_CASE("an edge that blocks lets a plain send wait, at most for its block limit",
              "[contract][send][block]") {
  FullLine line(kit, {.depth = 1, .overflow = Overflow::block, .block_limit = 30ms});
  const TimePoint before = kit.executive.now();
  const Status late = line.sender.out.send(numbered(2));
  const Duration waited = kit.executive.now() - before;
  REQUIRE_FALSE(late.ok());
  CHECK(late.error().code == Code::deadline_exceeded);
  CHECK(waited >= 30ms);
  if (kit.executive.is_virtual()) CHECK(waited == 30ms + 2 * TestType::kDelay);
  bool sent = false;
  Script script(line.sender, [&] { sent = line.sender.out.send_wait(numbered(3)).ok(); });
  CHECK(eventually(kit.executive, [&] { return line.taker.counters().waits == 2; }));
  CHECK(line.taker.handle_one());
  REQUIRE(script.ends_within(5s));
  CHECK(sent);
  CHECK(line.taker.handle_one());
  CHECK(line.taker.taken == std::vector{1, 3});
}

CONTRACT_CASE("a sender that waits gets an error when the server closes", "[contract][send]") {
  FullLine line(kit);
  Status outcome;
  Script script(line.sender, [&] { outcome = line.sender.out.send_wait(numbered(2)); });
  REQUIRE(line.sender_waits());
  line.taker.close("it has failed");
  REQUIRE(script.ends_within(5s));
  REQUIRE_FALSE(outcome.ok());
  CHECK_THAT(outcome.error().text(), Contains("taker.in") && Contains("because it has failed"));
}

CONTRACT_CASE("a full server does not hold a component that must leave its lap, and the object is withdrawn",
              "[contract][send]") {
  FullLine line(kit);
  Script script(line.sender, [&] { (void)line.sender.out.send_wait(numbered(2)); });
  REQUIRE(line.sender_waits());
  line.sender.leave();
  REQUIRE(script.ends_within(5s));
  CHECK(script.interrupted());
  CHECK(line.taker.handle_one());
  CHECK_FALSE(line.taker.handle_one());
  CHECK(line.taker.taken == std::vector{1});
}

CONTRACT_CASE("send_request does not wait, and send_receive returns the outcome of the object",
              "[contract][send]") {
  FullLine line(kit, {.depth = 1, .overflow = Overflow::block, .block_limit = 1h});
  SendProxy<MotionCommand>& out = line.sender.out;
  const Result<SendId> id = out.send_request(numbered(2));
  REQUIRE(id.has_value());
  REQUIRE(line.sender_waits());
  CHECK_FALSE(out.send_receive(*id).has_value());
  CHECK(line.taker.handle_one());
  CHECK(out.send_receive_wait(*id, 5s).ok());
  const auto again = out.send_receive(*id);
  REQUIRE(again.has_value());
  CHECK(again->error().code == Code::not_found);
  CHECK(line.taker.handle_one());
  CHECK(line.taker.taken == std::vector{1, 2});
}

CONTRACT_CASE("send_request to a full server that refuses gives its reason through send_receive",
              "[contract][send]") {
  FullLine line(kit);
  const Result<SendId> id = line.sender.out.send_request(numbered(2));
  REQUIRE(id.has_value());
  const Status outcome = line.sender.out.send_receive_wait(*id, 5s);
  REQUIRE_FALSE(outcome.ok());
  CHECK_THAT(outcome.error().text(), Contains("taker.in is full"));
  CHECK(line.taker.counters().refused_full == 1);
}

CONTRACT_CASE("an object whose outcome nobody waited for long enough is withdrawn", "[contract][send]") {
  FullLine line(kit, {.depth = 1, .overflow = Overflow::block, .block_limit = 1h});
  const Result<SendId> id = line.sender.out.send_request(numbered(2));
  REQUIRE(id.has_value());
  REQUIRE(line.sender_waits());
  CHECK(line.sender.out.send_receive_wait(*id, 10ms).error().code == Code::deadline_exceeded);
  CHECK(line.taker.handle_one());
  CHECK_FALSE(line.taker.handle_one());
}

CONTRACT_CASE("a sender that floods a server takes no room from the others", "[contract][send]") {
  Taker taker(kit.executive, 3);
  Sender flood(kit.executive, "flood");
  Sender calm(kit.executive, "calm");
  kit.connect(flood.endpoint("out"), taker.endpoint("in"));
  kit.connect(calm.endpoint("out"), taker.endpoint("in"));
  taker.open();
  for (int number = 100; number < 110; ++number) (void)flood.out.send(numbered(number));
  CHECK(calm.out.send(numbered(1)).ok());
  CHECK(taker.counters().refused_full == 7);
  const auto& server = static_cast<const SendServerEndpoint&>(taker.endpoint("in"));
  CHECK(server.counters(0).refused_full == 7);
  CHECK(server.counters(1).refused == 0);
  CHECK(flood.out.counters().failed == 7);
  CHECK(calm.out.counters().answered == 1);
  while (taker.handle_one()) continue;
  CHECK(taker.taken == std::vector{100, 101, 102, 1});
}
