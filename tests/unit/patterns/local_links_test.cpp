// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "all_ports.hpp"
#include "case_in.hpp"
#include "executives.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/patterns/local/local_links.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using idl::MotionCommand;

namespace {

struct Ends : AllPorts {
  using AllPorts::AllPorts;
  PushProxy<idl::Odometry> odometry{*this, "odometry"};
  PushProxyArray<MotionCommand> many{*this, "many"};
  QueryProxy<idl::Ask, idl::Odometry> asks_odometry{*this, "asks_odometry"};
};

// Runs `check` with two unconnected peers, `a` and `b`.
void with_ends(const std::function<void(Ends&, Ends&)>& check) {
  run_on({}, [&](Executive& executive) {
    Ends a(executive, "a");
    Ends b(executive, "b");
    check(a, b);
  });
}

Status connect(const Peer& a, const std::string& from, const Peer& b, const std::string& to) {
  return LocalLinks().connect(a.endpoint(from), b.endpoint(to), {});
}

}  // namespace

#define ENDS_CASE(title, tags) CASE_IN(with_ends, (Ends & a, Ends & b), title, tags)

ENDS_CASE("ends of one pattern and one type are connected from the side that starts the flow",
          "[patterns][local]") {
  CHECK(connect(a, "out", b, "in").ok());
  CHECK(connect(a, "sender", b, "taker").ok());
  CHECK(connect(a, "question", b, "answerer").ok());
  CHECK(b.in.connected());
  CHECK(a.sender.connected());
  CHECK(a.question.connected());
}

ENDS_CASE("ends of different type, pattern or side are refused, and both are described",
          "[patterns][local]") {
  const Status wrong_type = connect(a, "out", b, "odometry");
  REQUIRE_FALSE(wrong_type.ok());
  CHECK(wrong_type.error().code == Code::invalid_argument);
  CHECK_THAT(wrong_type.error().text(), Contains("a.out (PushServer of MotionCommand)") &&
                                            Contains("b.odometry (PushProxy of Odometry)"));
  CHECK_FALSE(connect(b, "in", a, "out").ok());
  CHECK_FALSE(connect(a, "out", b, "out").ok());
  CHECK_FALSE(connect(a, "out", b, "taker").ok());
  CHECK_FALSE(connect(a, "sender", b, "sender").ok());
  CHECK_FALSE(connect(a, "answerer", b, "question").ok());
  CHECK_FALSE(connect(a, "asks_odometry", b, "answerer").ok());
  CHECK_FALSE(b.in.connected());
}

ENDS_CASE("within a process a server refuses a question at once", "[patterns][local]") {
  REQUIRE(connect(a, "question", b, "answerer").ok());
  const Result<QueryId> refused = a.question.query_request(a.question.loan());
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().code == Code::unavailable);
  CHECK_THAT(refused.error().text(), Contains("b.answerer") && Contains("has not been started yet"));
  CHECK(a.question.counters().sent == 1);
  CHECK(a.question.counters().failed == 1);
}

ENDS_CASE("a proxy that is connected already is not connected again, but a port array takes any number",
          "[patterns][local]") {
  for (const auto& [from, to] :
       {std::pair{"out", "in"}, std::pair{"sender", "taker"}, std::pair{"question", "answerer"}}) {
    REQUIRE(connect(a, from, b, to).ok());
    const Status again = connect(a, from, b, to);
    REQUIRE_FALSE(again.ok());
    CHECK(again.error().code == Code::already_exists);
  }
  REQUIRE(connect(a, "out", b, "many").ok());
  REQUIRE(connect(b, "out", b, "many").ok());
  CHECK(b.many.sources().size() == 2);
}

ENDS_CASE("the edges of a port array are told apart by their sources and subscribed one by one",
          "[patterns][local]") {
  REQUIRE(connect(a, "out", b, "many").ok());
  REQUIRE(connect(b, "out", b, "many").ok());
  const auto from_a = b.many.sources()[0];
  const auto from_b = b.many.sources()[1];
  CHECK(from_a.path() == "a.out");
  CHECK(from_b.path() == "b.out");
  CHECK_FALSE(from_a == from_b);
  from_a.subscribe();
  a.out.push(head(0.0, 1.0));
  a.out.push(head(0.0, 2.0));
  b.out.push(head(0.0, 3.0));
  CHECK(from_a.latest()->speed() == 2.0);
  CHECK(from_a.new_data_arrived());
  const auto newest = from_a.take_latest();
  REQUIRE(newest);
  CHECK(newest->speed() == 2.0);
  CHECK_FALSE(from_a.new_data_arrived());
  CHECK(from_b.take_latest() == nullptr);
  b.many.unsubscribe_all();
  CHECK(a.out.subscriber_count() == 0);
}

ENDS_CASE("what each source of a port array has brought is counted by itself", "[patterns][local]") {
  REQUIRE(connect(a, "out", b, "many").ok());
  REQUIRE(connect(b, "out", b, "many").ok());
  for (const auto& source : b.many.sources()) source.subscribe();
  a.out.push(head(0.0, 1.0));
  a.out.push(head(0.0, 2.0));
  b.out.push(head(0.0, 3.0));
  const auto& many = static_cast<const PushClientEndpoint&>(b.endpoint("many"));
  REQUIRE(many.counters_from("a.out"));
  REQUIRE(many.counters_from("b.out"));
  CHECK(many.counters_from("a.out")->delivered == 2);
  CHECK(many.counters_from("b.out")->delivered == 1);
  CHECK_FALSE(many.counters_from("c.out"));
}

TEST_CASE("no edge can make a device wait", "[patterns][local]") {
  run_on({}, [](Executive& executive) {
    struct Driver : Peer {
      using Peer::Peer;
      PushServer<MotionCommand> out{*this, "out", {.from_device = true}};
    };
    Driver driver(executive, "driver");
    Ends b(executive, "b");
    const Status refused = LocalLinks().connect(driver.endpoint("out"), b.endpoint("in"),
                                                {.depth = 2, .overflow = QueuePolicy::Overflow::block});
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().code == Code::invalid_argument);
    CHECK_THAT(refused.error().text(), Contains("driver.out") && Contains("a device"));
    CHECK(connect(driver, "out", b, "in").ok());
  });
}

TEST_CASE("without a policy an edge has the policy of the receiving port's author", "[patterns][local]") {
  run_on({}, [](Executive& executive) {
    struct In : Peer {
      using Peer::Peer;
      PushProxy<MotionCommand> in{*this, "in", {.depth = 5}};
    };
    Ends a(executive, "a");
    In in(executive, "b");
    REQUIRE(LocalLinks().connect(a.endpoint("out"), in.endpoint("in")).ok());
    CHECK(in.edges("in").front()->policy().depth == 5);
  });
}

TEST_CASE("an edge has a deadline as soon as it is longer than nothing", "[patterns][local]") {
  for (const Duration deadline : {0ns, 1ns}) {
    with_ends([&](Ends& a, Ends& b) {
      REQUIRE(LocalLinks().connect(a.endpoint("out"), b.endpoint("in"), {.deadline = deadline}).ok());
      CHECK(port<PushClientEndpoint>(b, "in").has_deadline() == (deadline > 0ns));
    });
  }
}

namespace {

struct Notes : LinkObserver {
  void delivered(std::string_view component, std::string_view port, const ObjectRef& object) override {
    lines.push_back(std::string(component) + "." + std::string(port) + " got " +
                    std::string(object.type().name) + " " + std::to_string(object.header().seq()));
  }
  void link_changed(std::string_view client, std::string_view server, bool connected) override {
    lines.push_back(std::string(client) + (connected ? " uses " : " leaves ") + std::string(server));
  }
  std::vector<std::string> lines;
};

}  // namespace

TEST_CASE("an observer sees subscriptions and every object that gets into a queue, and no dropped one",
          "[patterns][local]") {
  run_on({}, [](Executive& executive) {
    struct Out : Peer {
      using Peer::Peer;
      PushServer<MotionCommand> out{*this, "out"};
    };
    struct In : Peer {
      using Peer::Peer;
      PushProxy<MotionCommand> in{*this, "in"};
    };
    Notes notes;
    Out out(executive, "a");
    In in(executive, "b", &notes);
    REQUIRE(LocalLinks()
                .connect(out.endpoint("out"), in.endpoint("in"),
                         {.depth = 1, .overflow = QueuePolicy::Overflow::drop_newest})
                .ok());
    in.in.subscribe();
    out.out.push(full_stop());
    out.out.push(full_stop());
    in.in.unsubscribe();
    CHECK(notes.lines ==
          std::vector<std::string>{"b.in uses a.out", "b.in got MotionCommand 1", "b.in leaves a.out"});
  });
}

// ---- While the components run

namespace {

QueuePolicy deep(std::uint32_t depth) { return {.depth = depth}; }

Status renew(const Peer& a, const std::string& from, const Peer& b, const std::string& to,
             const QueuePolicy& policy) {
  return LocalLinks().renew(a.endpoint(from), b.endpoint(to), policy);
}

void push_speeds(Ends& ends, int first, int last) {
  for (int speed = first; speed <= last; ++speed) ends.out.push(head(0.0, speed));
}

std::vector<int> take_speeds(Ends& ends) {
  std::vector<int> speeds;
  while (ends.in.new_data_arrived()) speeds.push_back(static_cast<int>(ends.in.get_update()->speed()));
  return speeds;
}

}  // namespace

ENDS_CASE("a connection that is renewed with a smaller queue keeps the newest objects",
          "[patterns][local][renew]") {
  REQUIRE(renew(a, "out", b, "in", deep(4)).ok());
  b.in.subscribe();
  push_speeds(a, 1, 4);
  REQUIRE(renew(a, "out", b, "in", deep(2)).ok());
  CHECK(a.out.subscriber_count() == 1);
  CHECK(b.in.counters().dropped_oldest == 2);
  CHECK(take_speeds(b) == std::vector<int>{3, 4});
  REQUIRE(renew(a, "out", b, "in", deep(3)).ok());
  push_speeds(a, 5, 8);
  CHECK(take_speeds(b) == std::vector<int>{6, 7, 8});
}

ENDS_CASE("a connection that is renewed with an interval gets the new rate", "[patterns][local][renew]") {
  REQUIRE(renew(a, "out", b, "in", deep(1)).ok());
  b.in.subscribe();
  a.out.start(10ms);
  QueuePolicy slower = deep(1);
  slower.min_interval = 30ms;
  REQUIRE(renew(a, "out", b, "in", slower).ok());
  CHECK(b.in.granted().multiple == 3);
}

TEST_CASE("deadlines that were missed stay counted when the connection gets another one, or none",
          "[patterns][local][renew]") {
  run_on(virtual_executives().front(), [](Executive& executive) {
    Ends a(executive, "a");
    Ends b(executive, "b");
    const auto missed = [&] { return b.in.counters().missed_deadlines; };
    REQUIRE(renew(a, "out", b, "in", {.deadline = 10ms}).ok());
    b.in.subscribe();
    sleep(executive, 55ms);
    CHECK(missed() == 5);
    REQUIRE(renew(a, "out", b, "in", {.deadline = 20ms}).ok());
    CHECK(missed() == 5);
    sleep(executive, 45ms);
    CHECK(missed() == 7);
    REQUIRE(renew(a, "out", b, "in", {}).ok());
    CHECK(missed() == 7);
    sleep(executive, 1s);
    CHECK(missed() == 7);
    b.in.unsubscribe();
    CHECK(missed() == 7);
  });
}

ENDS_CASE("a connection in place of another one keeps what waits", "[patterns][local][renew]") {
  REQUIRE(renew(a, "out", b, "in", deep(4)).ok());
  b.in.subscribe();
  push_speeds(a, 1, 1);
  REQUIRE(renew(b, "out", b, "in", deep(4)).ok());
  CHECK(a.out.subscriber_count() == 0);
  CHECK(b.out.subscriber_count() == 1);
  push_speeds(b, 2, 2);
  CHECK(take_speeds(b) == std::vector<int>{1, 2});
  REQUIRE(renew(a, "out", b, "in", deep(4)).ok());  // and back
  CHECK(a.out.subscriber_count() == 1);
  CHECK(b.out.subscriber_count() == 0);
}

ENDS_CASE("a port without a connection that the runtime has subscribed hears the first one",
          "[patterns][local][renew]") {
  b.in.subscribe();
  REQUIRE(renew(a, "out", b, "in", deep(1)).ok());
  CHECK(a.out.subscriber_count() == 1);
}

ENDS_CASE("a Send connection that is renewed has room for more", "[patterns][local][renew]") {
  QueuePolicy policy{.depth = 1, .overflow = QueuePolicy::Overflow::refuse};
  REQUIRE(renew(a, "sender", b, "taker", policy).ok());
  b.open();
  CHECK(a.sender.send(full_stop()).ok());
  policy.depth = 2;
  REQUIRE(renew(a, "sender", b, "taker", policy).ok());
  CHECK(a.sender.send(full_stop()).ok());
  const IntakeCounters counters = port<SendServerEndpoint>(b, "taker").counters();
  CHECK(counters.accepted == 2);
  CHECK(counters.waits == 0);
}

ENDS_CASE("ends that do not fit are not renewed", "[patterns][local][renew]") {
  const Status refused = renew(a, "out", b, "odometry", deep(1));
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == Code::invalid_argument);
}

ENDS_CASE("a connection that is renewed with another queue stays the one it was", "[patterns][local]") {
  REQUIRE(connect(a, "sender", b, "taker").ok());
  b.open();
  REQUIRE(a.sender.send(MotionCommand()).ok());
  QueuePolicy longer;
  longer.depth = 8;
  REQUIRE(LocalLinks().renew(a.endpoint("sender"), b.endpoint("taker"), longer).ok());
  // What waits is still counted as waiting, and handled.
  CHECK(port<SendServerEndpoint>(b, "taker").counters().queued == 1);
  CHECK(b.handle_one());
}
