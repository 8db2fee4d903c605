// SPDX-License-Identifier: GPL-3.0-or-later
// Sending on an edge that confirms what was handled, for every link.
#include "send_kits.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;

namespace {

constexpr QueuePolicy kHandled{
    .depth = 2, .overflow = QueuePolicy::Overflow::refuse, .confirm = QueuePolicy::Confirm::handled};

// A line whose server is open.
template <class Kit>
struct ConfirmingLine : Line<Kit> {
  explicit ConfirmingLine(Kit& kit) : Line<Kit>(kit, kHandled) { this->taker.open(); }

  [[nodiscard]] bool server_holds(std::uint32_t objects) {
    return eventually(this->sender.executive(), [&] { return this->taker.counters().queued == objects; });
  }
};

}  // namespace

CONTRACT_CASE("send returns what the handler returned, when it has", "[contract][send][confirm]") {
  ConfirmingLine line(kit);
  std::vector<Status> outcomes;
  Script script(line.sender, [&] {
    for (const int number : {1, 13}) outcomes.push_back(line.sender.out.send(numbered(number)));
  });
  REQUIRE(line.server_holds(1));
  CHECK_FALSE(script.ends_within(20ms));
  CHECK(line.taker.handle_one());
  REQUIRE(line.server_holds(1));
  CHECK(line.taker.handle_one());
  REQUIRE(script.ends_within(5s));
  REQUIRE(outcomes.size() == 2);
  CHECK(outcomes[0].ok());
  REQUIRE_FALSE(outcomes[1].ok());
  CHECK(outcomes[1].error().code == Code::invalid_argument);
  CHECK_THAT(outcomes[1].error().text(), Contains("thirteen is refused"));
  CHECK(line.taker.counters().accepted == 2);
  CHECK(line.taker.counters().failed == 1);
}

CONTRACT_CASE("the sender learns that a handler came to no end", "[contract][send][confirm]") {
  ConfirmingLine line(kit);
  Status outcome = ok();
  Script script(line.sender, [&] { outcome = line.sender.out.send(numbered(14)); });
  REQUIRE(line.server_holds(1));
  CHECK_THROWS_WITH(line.taker.handle_one(), "fourteen is too much");
  REQUIRE(script.ends_within(5s));
  REQUIRE_FALSE(outcome.ok());
  CHECK(outcome.error().code == Code::internal);
  CHECK_THAT(outcome.error().text(), Contains("taker.in") && Contains("did not come to the end"));
}

CONTRACT_CASE("what is not handled in time is taken back, and makes room", "[contract][send][confirm]") {
  ConfirmingLine line(kit);
  const Status late = line.sender.out.send_wait_max(numbered(1), 30ms);
  REQUIRE_FALSE(late.ok());
  CHECK(late.error().code == Code::deadline_exceeded);
  CHECK_FALSE(line.taker.handle_one());
  const IntakeCounters counters = line.taker.counters();
  CHECK(counters.accepted == 0);
  CHECK(counters.withdrawn == 1);
  CHECK(counters.queued == 0);
}

CONTRACT_CASE("an object that waits for room gets the place of one that was taken back",
              "[contract][send][confirm]") {
  ConfirmingLine line(kit);
  const SendId first = line.sender.out.send_request(numbered(1)).value();
  const SendId second = line.sender.out.send_request(numbered(2)).value();
  REQUIRE(line.server_holds(2));
  Status third = fail(Code::internal, "not sent yet");
  {
    Script script(line.sender, [&] {
      CHECK_FALSE(line.sender.out.send_receive_wait(first, 10ms).ok());
      third = line.sender.out.send_wait(numbered(3));
    });
    REQUIRE(eventually(line.sender.executive(), [&] { return line.taker.counters().withdrawn == 1; }));
    REQUIRE(line.server_holds(2));
    CHECK(line.taker.handle_one());
    CHECK(line.taker.handle_one());
    REQUIRE(script.ends_within(5s));
  }
  CHECK(third.ok());
  CHECK(line.sender.out.send_receive_wait(second, 5s).ok());
  CHECK(line.taker.taken == std::vector{2, 3});
}
