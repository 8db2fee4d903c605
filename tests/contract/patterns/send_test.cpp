// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of Send (thesis 7.3, Fig. 7.7-7.9), for every link: accepted or refused, never silently lost.
#include "send_kits.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;

CONTRACT_CASE("send returns when the server has accepted the object, which is handled later",
              "[contract][send]") {
  Line line(kit);
  line.taker.open();
  REQUIRE(line.sender.out.send(numbered(1)).ok());
  CHECK(line.taker.counters().accepted == 1);
  CHECK(line.taker.taken.empty());
  CHECK(line.taker.handle_one());
  CHECK(line.taker.taken == std::vector{1});
  CHECK_FALSE(line.taker.handle_one());
}

CONTRACT_CASE("a client knows whether its server can be replaced, and that it was not", "[contract][send]") {
  Line line(kit);
  const bool apart = !TestType::kSharesObjects;
  CHECK(line.sender.out.server_restarts().has_value() == apart);
  CHECK(line.sender.out.server_restarts().value_or(0) == 0);
  CHECK_FALSE(Sender(kit.executive, "alone").out.server_restarts());
}

CONTRACT_CASE("a value is sent as a copy of it", "[contract][send]") {
  Line line(kit);
  line.taker.open();
  MotionCommand command;
  command.speed(3.0);
  REQUIRE(line.sender.out.send(command).ok());
  command.speed(4.0);
  CHECK(line.taker.handle_one());
  CHECK(line.taker.taken == std::vector{3});
}

CONTRACT_CASE("a full server refuses with the reason, and accepts again when it has room",
              "[contract][send]") {
  Line line(kit, 2);
  line.taker.open();
  CHECK(line.sender.out.send(numbered(1)).ok());
  CHECK(line.sender.out.send(numbered(2)).ok());
  const Status refused = line.sender.out.send(numbered(3));
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == Code::unavailable);
  CHECK_THAT(refused.error().text(), Contains("taker.in is full: 2 objects") && Contains("send again"));
  CHECK(line.taker.counters().refused == 1);
  CHECK(line.taker.handle_one());
  CHECK(line.sender.out.send(numbered(4)).ok());
  while (line.taker.handle_one()) continue;
  CHECK(line.taker.taken == std::vector{1, 2, 4});
}

CONTRACT_CASE("a server that has not been opened, or was closed, refuses and says why", "[contract][send]") {
  Line line(kit);
  const Status early = line.sender.out.send(numbered(1));
  REQUIRE_FALSE(early.ok());
  CHECK(early.error().code == Code::unavailable);
  CHECK_THAT(early.error().text(), Contains("taker.in") && Contains("has not been started yet"));
  line.taker.open();
  line.taker.close("the system is being stopped");
  const Status late = line.sender.out.send(numbered(2));
  REQUIRE_FALSE(late.ok());
  CHECK_THAT(late.error().text(), Contains("because the system is being stopped"));
  CHECK(line.taker.counters().refused == 2);
  CHECK(line.taker.counters().accepted == 0);
}

CONTRACT_CASE("objects accepted before the server closed are handled when it opens again",
              "[contract][send]") {
  Line line(kit);
  line.taker.open();
  REQUIRE(line.sender.out.send(numbered(1)).ok());
  line.taker.close("it is being exchanged");
  CHECK_FALSE(line.taker.handle_one());
  line.taker.open();
  CHECK(line.taker.handle_one());
  CHECK(line.taker.taken == std::vector{1});
}

CONTRACT_CASE("everything that was accepted is handled, once and in order, however full the server",
              "[contract][send]") {
  Line line(kit, 3);
  std::uint64_t refused = 0;
  {
    const Service service(line.taker);
    for (int number = 100; number < 600; ++number) {
      while (!line.sender.out.send(numbered(number)).ok()) {
        ++refused;
        sleep(kit.executive, 50us);
      }
    }
    CHECK(eventually(kit.executive, [&] { return line.taker.counters().accepted == 500; }));
    sleep(kit.executive, 50ms);
  }
  std::vector<int> all(500);
  std::iota(all.begin(), all.end(), 100);
  CHECK(line.taker.taken == all);
  CHECK(line.taker.counters().refused == refused);
  CHECK(line.taker.counters().failed == 0);
}

CONTRACT_CASE("an error of the handler is counted, but the sender learns only that the object was accepted",
              "[contract][send]") {
  Line line(kit);
  line.taker.open();
  CHECK(line.sender.out.send(numbered(13)).ok());
  Status outcome;
  CHECK(static_cast<SendServerEndpoint&>(line.taker.endpoint("in")).handle_one(outcome));
  REQUIRE_FALSE(outcome.ok());
  CHECK(outcome.error().text() == "thirteen is refused");
  CHECK(line.taker.counters().accepted == 1);
  CHECK(line.taker.counters().failed == 1);
}

CONTRACT_CASE("an exception of the handler is counted and reaches whoever runs the server",
              "[contract][send]") {
  Line line(kit);
  line.taker.open();
  CHECK(line.sender.out.send(numbered(14)).ok());
  CHECK_THROWS_WITH(line.taker.handle_one(), "fourteen is too much");
  CHECK(line.taker.counters().failed == 1);
  CHECK(line.sender.out.send(numbered(15)).ok());
  CHECK(line.taker.handle_one());
  CHECK(line.taker.taken == std::vector{15});
}

TEST_CASE("a SendProxy that the graph does not connect names its port and what to write",
          "[contract][send]") {
  run_on_each(all_executives(), [](Executive& executive) {
    Sender sender(executive);
    CHECK_FALSE(sender.out.connected());
    const Status refused = sender.out.send(numbered(1));
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().code == Code::failed_precondition);
    CHECK_THAT(refused.error().text(), Contains("sender.out") && Contains("<connect from=\"sender.out\""));
  });
}
