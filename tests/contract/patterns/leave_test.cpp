// SPDX-License-Identifier: GPL-3.0-or-later
// A connection that is removed while the components of its ends run, for every link that can.
#include "query_kits.hpp"
#include "send_kits.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;

namespace {

// The link through DDS stays until the ports go.
using LeavingKits = std::tuple<LocalKit, DelayedKit, ShmKit>;

// Removes a connection: the client leaves first.
void part(Endpoint& client, Endpoint& server) {
  Links::leave(client, server.path());
  Links::leave(server, client.path());
}

struct Merger : Peer {
  explicit Merger(Executive& executive) : Peer(executive, "merger") {}

  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& source : in.sources()) all.push_back(source.path());
    return all;
  }

  PushProxyArray<MotionCommand> in{*this, "in"};
};

}  // namespace

CONTRACT_CASE_OF(LeavingKits, "a port whose connection is removed hears nothing, and has nothing left",
                 "[contract][leave]") {
  Source source(kit.executive, "source");
  Listener listener(kit.executive);
  kit.connect(source.endpoint("out"), listener.endpoint("in"), {.depth = 4});
  listener.in.subscribe();
  REQUIRE(eventually(kit.executive, [&] { return source.out.subscriber_count() == 1; }));
  source.push_numbers(1, 2);
  REQUIRE(listener.has_seen(2));
  part(listener.endpoint("in"), source.endpoint("out"));
  CHECK(source.out.subscriber_count() == 0);
  CHECK_FALSE(listener.in.connected());
  CHECK_FALSE(listener.in.new_data_arrived());
  CHECK(listener.in.latest() == nullptr);
  CHECK(listener.edge().counters().left_behind == 2);
  source.push_numbers(3, 3);
  sleep(kit.executive, 20ms);
  CHECK_FALSE(listener.in.new_data_arrived());
}

TEST_CASE("objects that are under way when their connection is removed never arrive", "[contract][leave]") {
  on_each_executive<DelayedKit>([](DelayedKit& kit) {
    Source source(kit.executive, "source");
    Listener listener(kit.executive);
    const PushEdge& edge = listener.listen(kit, source, {.depth = 4});
    source.push_numbers(1, 1);
    sleep(kit.executive, DelayedKit::kDelay);
    source.push_numbers(2, 3);
    part(listener.endpoint("in"), source.endpoint("out"));
    listener.listen(kit, source, {.depth = 4});
    source.push_numbers(4, 4);
    sleep(kit.executive, 20ms);
    CHECK(listener.take_all() == std::vector{4});
    CHECK(edge.counters().delivered == 2);
    CHECK(edge.counters().left_behind == 1);
  });
}

CONTRACT_CASE_OF(LeavingKits,
                 "deadlines that were missed stay counted when the connection is removed, and made again",
                 "[contract][leave]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  const QueuePolicy policy{.depth = 1, .deadline = 10ms};
  const PushEdge& edge = listener.listen(kit, source, policy);
  sleep(kit.executive, 55ms);
  const std::uint64_t missed = edge.counters().missed_deadlines;
  REQUIRE(missed >= 5);
  part(listener.endpoint("in"), source.endpoint("out"));
  const std::uint64_t at_the_end = edge.counters().missed_deadlines;
  CHECK(at_the_end >= missed);
  sleep(kit.executive, 55ms);
  CHECK(edge.counters().missed_deadlines == at_the_end);  // nobody is late
  kit.connect(source.endpoint("out"), listener.endpoint("in"), policy);
  CHECK(edge.counters().missed_deadlines >= at_the_end);
}

CONTRACT_CASE_OF(LeavingKits, "a subscribed port that is connected anew hears its new server at once",
                 "[contract][leave]") {
  Source first(kit.executive, "first");
  Source second(kit.executive, "second");
  Listener listener(kit.executive);
  kit.connect(first.endpoint("out"), listener.endpoint("in"), {.depth = 4});
  listener.in.subscribe();
  part(listener.endpoint("in"), first.endpoint("out"));
  kit.connect(second.endpoint("out"), listener.endpoint("in"), {.depth = 2});
  REQUIRE(eventually(kit.executive, [&] { return second.out.subscriber_count() == 1; }));
  second.push_numbers(1, 3);
  REQUIRE(listener.has_seen(3));
  CHECK(listener.take_all() == std::vector<int>{2, 3});  // the new connection's queue holds two
  CHECK(listener.edge().source_path() == "second.out");
}

CONTRACT_CASE_OF(LeavingKits, "the other sources of an array keep their places", "[contract][leave]") {
  Source a(kit.executive, "a");
  Source b(kit.executive, "b");
  Source c(kit.executive, "c");
  Merger merger(kit.executive);
  kit.connect(a.endpoint("out"), merger.endpoint("in"));
  kit.connect(b.endpoint("out"), merger.endpoint("in"));
  const auto of_b = merger.in.sources().at(1);
  of_b.subscribe();
  part(merger.endpoint("in"), a.endpoint("out"));
  CHECK(merger.names() == std::vector<std::string>{"b.out"});
  kit.connect(c.endpoint("out"), merger.endpoint("in"));
  CHECK(merger.names() == std::vector<std::string>{"b.out", "c.out"});
  kit.connect(a.endpoint("out"), merger.endpoint("in"));
  CHECK(merger.names() == std::vector<std::string>{"a.out", "b.out", "c.out"});
  REQUIRE(eventually(kit.executive, [&] { return b.out.subscriber_count() == 1; }));
  b.push_numbers(7, 7);
  REQUIRE(eventually(kit.executive, [&] { return of_b.new_data_arrived(); }));
  CHECK(number_of(of_b.take_latest()) == 7);
  CHECK(a.out.subscriber_count() == 0);  // nobody has subscribed anew
}

CONTRACT_CASE_OF(LeavingKits,
                 "what was sent and not answered gets an error, and what was accepted is handled",
                 "[contract][leave]") {
  Sender sender(kit.executive);
  Taker taker(kit.executive);
  kit.connect(sender.endpoint("out"), taker.endpoint("in"));
  taker.open();
  REQUIRE(sender.out.send(numbered(1)).ok());  // accepted
  part(sender.endpoint("out"), taker.endpoint("in"));
  CHECK(taker.handle_one());
  CHECK(taker.taken == std::vector<int>{1});
  const Status unconnected = sender.out.send(numbered(2));
  REQUIRE_FALSE(unconnected.ok());
  CHECK_THAT(unconnected.error().message, Contains("is not connected"));
  CHECK(taker.counters().accepted == 1);
}

CONTRACT_CASE_OF(LeavingKits, "what waits for a confirmation gets an error and is not handled any more",
                 "[contract][leave]") {
  Sender sender(kit.executive);
  Taker taker(kit.executive);
  kit.connect(
      sender.endpoint("out"), taker.endpoint("in"),
      {.depth = 1, .overflow = QueuePolicy::Overflow::block, .confirm = QueuePolicy::Confirm::handled});
  taker.open();
  const SendId accepted = sender.out.send_request(numbered(1)).value();
  const SendId held = sender.out.send_request(numbered(2)).value();
  REQUIRE(eventually(kit.executive, [&] { return taker.counters().waits == 1; }));
  part(sender.endpoint("out"), taker.endpoint("in"));
  for (const SendId id : {accepted, held}) {
    const Status outcome = sender.out.send_receive_wait(id, 5s);
    REQUIRE_FALSE(outcome.ok());
    CHECK_THAT(outcome.error().message, Contains("was removed before the answer came"));
  }
  CHECK_FALSE(taker.handle_one());
  CHECK(taker.counters().accepted == 0);
  CHECK(taker.counters().withdrawn == 2);
}

CONTRACT_CASE_OF(LeavingKits, "an open question is answered with an error when its connection is removed",
                 "[contract][leave]") {
  Counter<TestType> counter(kit);
  counter.answerer.open();
  const Result<QueryId> open = counter.asker.question.query_request(counter.asker.about("x"));
  REQUIRE(open);
  REQUIRE(counter.has_been_asked(1));
  part(counter.asker.endpoint("question"), counter.answerer.endpoint("server"));
  const auto answer = counter.asker.question.query_receive_wait(*open, 5s);
  REQUIRE_FALSE(answer);
  CHECK(answer.error().code == Code::unavailable);
  CHECK_THAT(answer.error().message, Contains("was removed before the answer came"));
  CHECK_FALSE(counter.answerer.handle_one());
  CHECK(counter.answerer.counters().withdrawn == 1);
  Answerer other(kit.executive);
  kit.connect(counter.asker.endpoint("question"), other.endpoint("server"));
  const Service at_other(other);
  const auto later = counter.asker.question.query(counter.asker.about("four"), 5s);
  REQUIRE(later);
  CHECK(number_of(*later) == 4);
}

CONTRACT_CASE_OF(LeavingKits, "to leave a peer that was never there changes nothing", "[contract][leave]") {
  Source source(kit.executive, "source");
  Listener listener(kit.executive);
  kit.connect(source.endpoint("out"), listener.endpoint("in"));
  listener.in.subscribe();
  Links::leave(listener.endpoint("in"), "nobody.out");
  Links::leave(source.endpoint("out"), "nobody.in");
  REQUIRE(eventually(kit.executive, [&] { return source.out.subscriber_count() == 1; }));
  source.push_numbers(1, 1);
  CHECK(listener.has_seen(1));
}
