// SPDX-License-Identifier: GPL-3.0-or-later
// The fields that the framework writes into the header of every object that travels (DESIGN 3), for every
// link.
#include "link_kits.hpp"

using namespace orca;
using namespace orca::test;

namespace {

// Pushes an answer to each object that it receives by Push or by Send.
struct Relay : Peer {
  explicit Relay(Executive& executive) : Peer(executive, "relay") {}

  Status on_command(const ObjectPtr<MotionCommand>& command) {
    out.push(numbered(number_of(command) + 100));
    return refuses ? Status(fail(Code::invalid_argument, "no")) : ok();
  }

  bool refuses = false;
  PushProxy<MotionCommand> in{*this, "in"};
  SendServer<MotionCommand> sent{*this, "sent", &Relay::on_command};
  PushServer<MotionCommand> out{*this, "out"};
};

// Sends motion commands.
struct CommandSender : Peer {
  explicit CommandSender(Executive& executive) : Peer(executive, "sender") {}
  SendProxy<MotionCommand> out{*this, "out"};
};

// Pushes motion commands through two ports.
struct TwoSources : Peer {
  explicit TwoSources(Executive& executive) : Peer(executive, "source") {}
  PushServer<MotionCommand> left{*this, "left"};
  PushServer<MotionCommand> right{*this, "right"};
};

// Receives from both.
struct TwoListeners : Peer {
  explicit TwoListeners(Executive& executive) : Peer(executive, "relay") {}
  PushProxy<MotionCommand> left{*this, "left"};
  PushProxy<MotionCommand> right{*this, "right"};
  PushServer<MotionCommand> out{*this, "out"};
};

// Subscribes the relay, and waits until the server knows: over bytes that takes a while.
template <class Kit>
void subscribe_relay(Kit& kit, Relay& relay, const Source& source) {
  relay.in.subscribe();
  CHECK(eventually(kit.executive, [&] { return source.out.subscriber_count() == 1; }));
}

template <class Kit, class AnyRelay>
void listen_to_relay(Kit& kit, AnyRelay& relay, Listener& listener) {
  kit.connect(relay.endpoint("out"), listener.endpoint("in"));
  listener.in.subscribe();
  CHECK(eventually(kit.executive, [&] { return relay.out.subscriber_count() == 1; }));
}

}  // namespace

CONTRACT_CASE("an object carries the name of its sender, its number and the time it was made",
              "[contract][header]") {
  Source source(kit.executive, "Platforms/Dewey/base");
  Listener listener(kit.executive);
  listener.listen(kit, source, {.depth = 3});
  for (std::uint64_t seq = 1; seq <= 3; ++seq) {
    sleep(kit.executive, 1ms);
    const TimePoint before = kit.executive.now();
    source.push_numbers(0, 0);
    const TimePoint after = kit.executive.now();
    const auto got = listener.in.get_update_wait_max(5s);
    REQUIRE(got);
    CHECK(got->origin() == "Platforms/Dewey/base");
    CHECK(got->origin_port() == "out");
    CHECK(got->seq() == seq);
    CHECK(got->creation_time().ns() >= before.time_since_epoch().count());
    CHECK(got->creation_time().ns() <= after.time_since_epoch().count());
  }
}

CONTRACT_CASE("objects that a component pushes after it took an object belong to that object's mission",
              "[contract][header]") {
  Source source(kit.executive);
  Relay relay(kit.executive);
  Listener listener(kit.executive);
  kit.connect(source.endpoint("out"), relay.endpoint("in"), {.depth = 4});
  subscribe_relay(kit, relay, source);
  listen_to_relay(kit, relay, listener);
  source.push_numbers(0, 0);
  auto of_mission = numbered(1);
  of_mission->mission(42);
  source.out.push(std::move(of_mission));
  for (const std::uint64_t mission : {0U, 42U}) {
    REQUIRE(relay.in.get_update_wait_max(5s));
    relay.out.push(numbered(2));
    const auto answer = listener.in.get_update_wait_max(5s);
    REQUIRE(answer);
    CHECK(answer->mission() == mission);
    CHECK(answer->cause().origin() == "source");
    CHECK(answer->cause().port() == "out");
    CHECK(answer->cause().seq() == (mission == 42U ? 2U : 1U));
    CHECK(answer->origin() == "relay");
  }
}

CONTRACT_CASE("an object that a handler sends names the handled object as its cause", "[contract][header]") {
  CommandSender sender(kit.executive);
  Relay relay(kit.executive);
  Listener listener(kit.executive);
  kit.connect(sender.endpoint("out"), relay.endpoint("sent"));
  listen_to_relay(kit, relay, listener);
  const Service service(relay);
  auto command = numbered(1);
  command->mission(7);
  REQUIRE(sender.out.send(std::move(command)).ok());
  const auto answer = listener.in.get_update_wait_max(5s);
  REQUIRE(answer);
  CHECK(number_of(answer) == 101);
  CHECK(answer->mission() == 7);
  CHECK(answer->cause().origin() == "sender");
  CHECK(answer->cause().port() == "out");
  CHECK(answer->cause().seq() == 1);
}

CONTRACT_CASE("causes of one number from two ports of a component are told apart by their ports",
              "[contract][header]") {
  TwoSources source(kit.executive);
  TwoListeners relay(kit.executive);
  Listener listener(kit.executive);
  listen_to_relay(kit, relay, listener);
  const auto cause_of_answer_to = [&](PushServer<MotionCommand>& from, PushProxy<MotionCommand>& to) {
    kit.connect(source.endpoint(to.name()), relay.endpoint(to.name()));
    to.subscribe();
    CHECK(eventually(kit.executive, [&] { return from.subscriber_count() == 1; }));
    from.push(numbered(1));
    REQUIRE(to.get_update_wait_max(5s));
    relay.out.push(numbered(2));
    const auto answer = listener.in.get_update_wait_max(5s);
    REQUIRE(answer);
    CHECK(answer->cause().seq() == 1);
    return answer->cause().port();
  };
  CHECK(cause_of_answer_to(source.left, relay.left) == "left");
  CHECK(cause_of_answer_to(source.right, relay.right) == "right");
}

CONTRACT_CASE("an object that answers nothing has no cause and no mission", "[contract][header]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.listen(kit, source);
  source.push_numbers(1, 1);
  const auto got = listener.in.get_update_wait_max(5s);
  REQUIRE(got);
  CHECK(got->mission() == 0);
  CHECK(got->cause().origin().empty());
  CHECK(got->cause().seq() == 0);
}

CONTRACT_CASE("an object without a mission is a cause, but leaves the mission at hand",
              "[contract][header]") {
  Source source(kit.executive);
  Relay relay(kit.executive);
  Listener listener(kit.executive);
  kit.connect(source.endpoint("out"), relay.endpoint("in"), {.depth = 4});
  subscribe_relay(kit, relay, source);
  listen_to_relay(kit, relay, listener);
  auto of_mission = numbered(1);
  of_mission->mission(42);
  source.out.push(std::move(of_mission));
  source.push_numbers(2, 2);
  REQUIRE(relay.in.get_update_wait_max(5s));
  REQUIRE(relay.in.get_update_wait_max(5s));
  relay.out.push(numbered(3));
  const auto answer = listener.in.get_update_wait_max(5s);
  REQUIRE(answer);
  CHECK(answer->mission() == 42);
  CHECK(answer->cause().seq() == 2);
}

namespace {

// A relay that gets tasks by Send and objects by Push, and a listener to what it pushes in its laps.
template <class Kit>
struct Workplace {
  explicit Workplace(Kit& of) : kit(of) {
    kit.connect(sender.endpoint("out"), relay.endpoint("sent"));
    kit.connect(source.endpoint("out"), relay.endpoint("in"), {.depth = 4});
    subscribe_relay(kit, relay, source);
    listen_to_relay(kit, relay, listener);
    relay.open();
  }

  // Returns the mission of an object that is pushed in a new lap, after the relay has taken one of `taken`.
  std::uint64_t mission_of_next_lap(std::uint64_t taken = 0) {
    relay.home().provenance.begin_lap();
    if (taken != 0) {
      auto other = numbered(1);
      other->mission(taken);
      source.out.push(std::move(other));
      REQUIRE(relay.in.get_update_wait_max(5s));
    }
    return mission_of_push();
  }

  std::uint64_t mission_of_push() {
    relay.out.push(numbered(3));
    const auto pushed = listener.in.get_update_wait_max(5s);
    return pushed ? pushed->mission() : 999;
  }

  void send_task(std::uint64_t mission, bool refused = false) {
    relay.refuses = refused;
    auto task = numbered(1);
    task->mission(mission);
    REQUIRE(sender.out.send(std::move(task)).ok());
    REQUIRE(eventually(kit.executive, [&] { return relay.handle_one(); }));
    REQUIRE(listener.in.get_update_wait_max(5s));  // what the handler pushed
  }

  Kit& kit;
  CommandSender sender{kit.executive};
  Source source{kit.executive};
  Relay relay{kit.executive};
  Listener listener{kit.executive};
};

}  // namespace

CONTRACT_CASE("the mission of a task holds in all its laps, until the task ends or another comes",
              "[contract][header]") {
  Workplace<TestType> work(kit);
  CHECK(work.mission_of_next_lap() == 0);
  work.send_task(7);
  CHECK(work.mission_of_next_lap() == 7);
  work.send_task(8);
  CHECK(work.mission_of_next_lap() == 8);
  work.relay.home().provenance.end_task();
  CHECK(work.mission_of_next_lap() == 0);
}

CONTRACT_CASE("objects of other missions do not lead a component away from its task", "[contract][header]") {
  Workplace<TestType> work(kit);
  CHECK(work.mission_of_next_lap(42) == 42);
  work.send_task(7);
  CHECK(work.mission_of_next_lap(42) == 7);
  work.relay.home().provenance.end_task();
  CHECK(work.mission_of_next_lap(42) == 42);
}

CONTRACT_CASE("an object that a Send handler refuses is no task: the one before goes on",
              "[contract][header]") {
  Workplace<TestType> work(kit);
  work.send_task(7);
  work.send_task(8, true);
  CHECK(work.mission_of_push() == 8);  // the refusal itself, and the line in the log about it
  CHECK(work.mission_of_next_lap() == 7);
}

CONTRACT_CASE("a mission that a component begins is its task from that moment", "[contract][header]") {
  Workplace<TestType> work(kit);
  work.relay.home().provenance.begin_mission(5);
  CHECK(work.mission_of_push() == 5);
  CHECK(work.mission_of_next_lap(42) == 5);
  work.relay.home().provenance.begin_mission(6);
  CHECK(work.mission_of_next_lap() == 6);
  work.relay.home().provenance.end_task();
  CHECK(work.mission_of_push() == 0);
}
