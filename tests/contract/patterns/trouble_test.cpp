// SPDX-License-Identifier: GPL-3.0-or-later
// What an edge reports of its own accord when it cannot do what it is there for, for every link.
#include "query_kits.hpp"
#include "send_kits.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using Kinds = std::set<LinkTrouble>;

CONTRACT_CASE("a refused object is reported with both ends and the server's reason",
              "[contract][send][trouble]") {
  Troubles troubles;
  Line line(kit, 1);
  line.sender.home().observer = &troubles;
  line.taker.open();
  REQUIRE(line.sender.out.send(numbered(1)).ok());
  CHECK(troubles.lines().empty());
  REQUIRE_FALSE(line.sender.out.send(numbered(2)).ok());
  REQUIRE(troubles.lines().size() == 1);
  CHECK_THAT(troubles.lines()[0], Contains("sender.out to taker.in: refused: taker.in is full: 1 objects"));
  CHECK(troubles.kinds() == Kinds{LinkTrouble::refused});
  CHECK(line.sender.out.counters().failed == 1);
}

CONTRACT_CASE("an object for which there was no room in time is reported", "[contract][send][trouble]") {
  Troubles troubles;
  Line line(kit, 1);
  line.sender.home().observer = &troubles;
  line.taker.open();
  REQUIRE(line.sender.out.send(numbered(1)).ok());
  REQUIRE_FALSE(line.sender.out.send_wait_max(numbered(2), 20ms).ok());
  REQUIRE(troubles.lines().size() == 1);
  CHECK(troubles.lines()[0] ==
        "sender.out to taker.in: taker.in had no room for what sender.out sent in time");
  CHECK(line.sender.out.counters().timed_out == 1);
}

CONTRACT_CASE("a question that is answered with an error, refused or not answered is reported",
              "[contract][query][trouble]") {
  Troubles troubles;
  Counter counter(kit);
  counter.asker.home().observer = &troubles;
  CHECK_FALSE(counter.asker.ask_in_vain("early"));
  counter.answerer.open();
  CHECK_FALSE(counter.asker.question.query(counter.asker.about("time"), 20ms));
  {
    const Service service(counter.answerer);
    CHECK_FALSE(counter.asker.question.query(counter.asker.about("bad"), 5s));
    CHECK(counter.asker.question.query(counter.asker.about("good"), 5s));
  }
  const std::vector<std::string> lines = troubles.lines();
  REQUIRE(lines.size() == 3);
  CHECK_THAT(lines[0], Contains("asker.question to answerer.server: refused: ") &&
                           Contains("has not been started yet"));
  CHECK_THAT(lines[1], Contains("answerer.server did not answer asker.question in time"));
  CHECK_THAT(lines[2], Contains("refused: there is nothing to say about bad"));
  CHECK(troubles.kinds() == Kinds{LinkTrouble::refused});
}

CONTRACT_CASE("drops beyond the limit are reported, and again each time that the excess has doubled",
              "[contract][push][trouble]") {
  Troubles troubles;
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.home().observer = &troubles;
  const PushEdge& edge = listener.listen(kit, source, {.depth = 4, .drop_limit = 3});
  source.push_numbers(1, 4 + 3);
  REQUIRE(eventually(kit.executive, [&] { return edge.counters().dropped == 3; }));
  CHECK(troubles.lines().empty());
  CHECK(edge.counters().over_limit == 0);
  source.push_numbers(8, 7 + 100);
  REQUIRE(eventually(kit.executive, [&] { return edge.counters().dropped == 103; }));
  CHECK(edge.counters().over_limit == 100);
  std::vector<std::string> expected;
  for (const int drops : {4, 5, 7, 11, 19, 35, 67})
    expected.push_back("source.out to listener.in: objects dropped so far: " + std::to_string(drops) +
                       ", drop_limit: 3 (queue 4, drop_oldest)");
  CHECK(troubles.lines() == expected);
  CHECK(troubles.kinds() == Kinds{LinkTrouble::dropped});
}

CONTRACT_CASE("a queue may drop nothing, and \"the latest\" any number, unless the edge says otherwise",
              "[contract][push][trouble]") {
  // The report of a drop comes after it is counted.
  const auto reports = [&](const QueuePolicy& policy, std::size_t expected) {
    Troubles troubles;
    Source source(kit.executive);
    Listener listener(kit.executive);
    listener.home().observer = &troubles;
    const PushEdge& edge = listener.listen(kit, source, policy);
    source.push_numbers(1, static_cast<int>(policy.depth) + 1);
    CHECK(eventually(kit.executive, [&] { return edge.counters().dropped == 1; }));
    if (expected == 0) sleep(kit.executive, 20ms);
    return eventually(kit.executive, [&] { return troubles.lines().size() == expected; });
  };
  using Overflow = QueuePolicy::Overflow;
  CHECK(reports({}, 0));
  CHECK(reports({.drop_limit = 0}, 1));
  CHECK(reports({.depth = 2}, 1));
  CHECK(reports({.depth = 1, .overflow = Overflow::drop_newest}, 1));
  CHECK(reports({.depth = 2, .overflow = Overflow::block, .block_limit = 1ms}, 1));
  CHECK(reports({.depth = 2, .drop_limit = 1}, 0));
}

CONTRACT_CASE("objects that are left behind at the end of a subscription are no drops beyond a limit",
              "[contract][push][trouble]") {
  Troubles troubles;
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.home().observer = &troubles;
  const PushEdge& edge = listener.listen(kit, source, {.depth = 4});
  source.push_numbers(1, 3);
  REQUIRE(listener.has_seen(3));
  listener.in.unsubscribe();
  CHECK(edge.counters().left_behind == 3);
  CHECK(edge.counters().over_limit == 0);
  CHECK(troubles.lines().empty());
}

namespace {

// Sets up a listener whose strand looks after its deadline, as the runtime does.
template <class Kit>
PushEdge& listen_with_deadline(Kit& kit, Source& source, Listener& listener, LinkObserver& observer) {
  listener.home().observer = &observer;
  PushEdge& edge = listener.listen(kit, source, {.depth = 10, .deadline = 40ms});
  listener.strand().set_watch([&edge] { return edge.watch_deadline(); });
  return edge;
}

const std::string kLate = "source.out to listener.in: no object within the deadline of 0.04 s";

}  // namespace

CONTRACT_CASE("a missed deadline is reported while the component waits for that very object, once",
              "[contract][push][trouble][deadline]") {
  Troubles troubles;
  Source source(kit.executive);
  Listener listener(kit.executive);
  PushEdge& edge = listen_with_deadline(kit, source, listener, troubles);
  Script wait(listener, [&] {
    for (;;) (void)listener.in.get_update_wait();
  });
  REQUIRE(eventually(kit.executive, [&] { return !troubles.lines().empty(); }));
  sleep(kit.executive, 200ms);
  CHECK(troubles.lines() == std::vector{kLate});
  CHECK(troubles.kinds() == Kinds{LinkTrouble::late});
  CHECK(edge.counters().missed_deadlines >= 5);
  source.push_numbers(1, 1);
  CHECK(eventually(kit.executive, [&] { return troubles.lines().size() == 2; }));
}

CONTRACT_CASE("a deadline that was missed while the component was busy is reported at its next wait",
              "[contract][push][trouble][deadline]") {
  Troubles troubles;
  Source source(kit.executive);
  Listener listener(kit.executive);
  listen_with_deadline(kit, source, listener, troubles);
  sleep(kit.executive, 60ms);  // the listener's strand does not wait meanwhile
  source.push_numbers(1, 1);
  REQUIRE(listener.has_seen(1));
  CHECK(troubles.lines().empty());
  (void)listener.in.get_update_wait();
  CHECK_FALSE(listener.in.get_update_wait_max(1ms));
  CHECK(troubles.lines() == std::vector{kLate});
}

CONTRACT_CASE("deadlines are reported while the edge is subscribed, and anew in each subscription",
              "[contract][push][trouble][deadline]") {
  Troubles troubles;
  Source source(kit.executive);
  Listener listener(kit.executive);
  PushEdge& edge = listen_with_deadline(kit, source, listener, troubles);
  const auto wait = [&] { (void)listener.in.get_update_wait_max(100ms); };
  wait();
  CHECK(troubles.lines().size() == 1);
  wait();
  CHECK(troubles.lines().size() == 1);
  listener.in.unsubscribe();
  CHECK(edge.watch_deadline() == kForever);
  listener.in.subscribe();
  sleep(kit.executive, 60ms);  // it is late before the strand waits for the first time
  wait();
  CHECK(troubles.lines().size() == 2);
  CHECK(edge.watch_deadline() == kForever);
}
