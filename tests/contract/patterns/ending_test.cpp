// SPDX-License-Identifier: GPL-3.0-or-later
// What a component is refused while it is to end for good, because the others end too, for every link.
#include "orca/base/activity.hpp"
#include "query_kits.hpp"
#include "send_kits.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;

namespace {

constexpr const char* kReason = "the system is being stopped";

// A client that reports trouble and is to end, and its server.
template <class Pair, class Kit>
struct Ending : Pair {
  explicit Ending(Kit& kit, std::uint32_t depth = 4) : Pair(kit, depth) {}

  void end(Peer& client) {
    client.home().observer = &troubles;
    client.strand().end();
  }

  Troubles troubles;
};

template <class Kit>
using EndingLine = Ending<Line<Kit>, Kit>;
template <class Kit>
using EndingCounter = Ending<Counter<Kit>, Kit>;

}  // namespace

CONTRACT_CASE("a refused object interrupts a component that is to end, and is no trouble",
              "[contract][send][ending]") {
  EndingLine<TestType> line(kit, 1);
  line.taker.open();
  line.end(line.sender);
  SendProxy<MotionCommand>& out = line.sender.out;
  CHECK(out.send(numbered(1)).ok());
  CHECK_THROWS_AS(out.send(numbered(2)), Interrupted);
  CHECK_THROWS_AS(out.send_wait_max(numbered(2), 1ms), Interrupted);
  line.taker.close(kReason);
  CHECK_THROWS_AS(out.send(numbered(3)), Interrupted);
  CHECK_THROWS_AS(out.send_wait(numbered(3)), Interrupted);
  const Result<SendId> id = out.send_request(numbered(3));
  REQUIRE(id.has_value());
  CHECK_THROWS_AS(out.send_receive_wait(*id, 5s), Interrupted);
  CHECK(line.troubles.lines().empty());
  CHECK(out.counters().failed + out.counters().timed_out == 0);
  CHECK(out.counters().answered == 1);
}

CONTRACT_CASE("a question that is refused or answered with an error interrupts a component that is to end",
              "[contract][query][ending]") {
  EndingCounter<TestType> counter(kit);
  counter.end(counter.asker);
  CHECK_THROWS_AS((void)counter.asker.ask_in_vain("early"), Interrupted);
  counter.answerer.open();
  auto& question = counter.asker.question;
  CHECK_THROWS_AS((void)question.query(counter.asker.about("time"), 20ms), Interrupted);
  {
    const Service service(counter.answerer);
    CHECK_THROWS_AS((void)question.query(counter.asker.about("bad"), 5s), Interrupted);
    CHECK(number_of(question.query(counter.asker.about("good"), 5s).value()) == 4);
  }
  CHECK(counter.troubles.lines().empty());
  CHECK(question.counters().failed + question.counters().timed_out == 0);
  CHECK(question.counters().answered == 1);
}

CONTRACT_CASE("a server that closes interrupts the clients that wait for it and are to end",
              "[contract][query][ending]") {
  EndingCounter<TestType> counter(kit);
  counter.answerer.open();
  Script script(counter.asker,
                [&] { (void)counter.asker.question.query(counter.asker.about("waiting"), 1h); });
  REQUIRE(counter.has_been_asked(1));
  counter.end(counter.asker);
  counter.answerer.close(kReason);
  REQUIRE(script.ends_within(5s));
  CHECK(script.interrupted());
  CHECK(counter.troubles.lines().empty());
}

CONTRACT_CASE("what is refused to stop() is returned to it, so that it can go on",
              "[contract][send][query][ending]") {
  EndingLine<TestType> line(kit);
  EndingCounter<TestType> counter(kit);
  line.end(line.sender);
  counter.end(counter.asker);
  line.taker.close(kReason);
  counter.answerer.close(kReason);
  const Activity stop("client", Hook::stop, nullptr);
  const Status sent = line.sender.out.send(numbered(1));
  REQUIRE_FALSE(sent.ok());
  CHECK_THAT(sent.error().text(), Contains(kReason));
  const auto answer = counter.asker.ask_in_vain("late");
  REQUIRE_FALSE(answer.has_value());
  CHECK_THAT(answer.error().text(), Contains(kReason));
  CHECK(line.sender.out.counters().failed == 1);
}
