// SPDX-License-Identifier: GPL-3.0-or-later
// A port whose edge is moved from one server to another while its component runs, for every link.
#include "query_kits.hpp"
#include "send_kits.hpp"

using namespace orca;
using namespace orca::test;

namespace {

MovablePort& movable(Peer& peer, const std::string& port) {
  return dynamic_cast<MovablePort&>(peer.endpoint(port));
}

// A listener with two sources, of which it hears the first.
template <class Kit>
struct Moving {
  explicit Moving(Kit& kit)
      : first(kit.executive, "first"), second(kit.executive, "second"), listener(kit.executive) {
    movable(listener, "in").allow_moves();
    kit.connect(first.endpoint("out"), listener.endpoint("in"), {.depth = 4});
    kit.connect(second.endpoint("out"), listener.endpoint("in"), {.depth = 4});
    listener.in.subscribe();
    CHECK(is_heard(first, second));
  }

  // Waits until one source has a subscriber and the other has none.
  bool is_heard(Source& source, Source& other) {
    return eventually(listener.executive(), [&] {
      return source.out.subscriber_count() == 1 && other.out.subscriber_count() == 0;
    });
  }
  // Waits for the same after a move, which a look at the port makes.
  bool is_heard_now(Source& source, Source& other) {
    (void)listener.in.new_data_arrived();
    return is_heard(source, other);
  }

  Source first;
  Source second;
  Listener listener;
};

// Answers every question with its own number.
struct Clerk : Peer {
  Clerk(Executive& executive, const std::string& name, int own) : Peer(executive, name), number(own) {}
  Result<Loan<MotionCommand>> on_ask(const ObjectPtr<Ask>& /*ask*/) { return numbered(number); }

  const int number;
  QueryServer<Ask, MotionCommand> server{*this, "server", &Clerk::on_ask, {.depth = 4}};
};

struct Store : Peer {
  Store(Executive& executive, const std::string& name) : Peer(executive, name) {}
  Status on_command(const ObjectPtr<MotionCommand>& command) {
    taken = number_of(command);
    return ok();
  }

  std::atomic<int> taken{0};
  SendServer<MotionCommand> in{*this, "in", &Store::on_command, {.depth = 4}};
};

}  // namespace

CONTRACT_CASE("a moved port hears its new server only, and keeps what waits", "[contract][move]") {
  Moving<TestType> moving(kit);
  moving.first.push_numbers(1, 2);
  REQUIRE(moving.listener.has_seen(2));
  CHECK(number_of(moving.listener.in.get_update()) == 1);
  CHECK(movable(moving.listener, "in").move_to("second.out"));
  CHECK(moving.is_heard_now(moving.second, moving.first));
  CHECK(moving.listener.edge().source_path() == "second.out");
  moving.first.push_numbers(3, 3);
  moving.second.push_numbers(4, 4);
  REQUIRE(moving.listener.has_seen(3));
  CHECK(moving.listener.take_all() == std::vector<int>{2, 4});
}

CONTRACT_CASE("the newest object stays until the new server has pushed", "[contract][move]") {
  Moving<TestType> moving(kit);
  moving.first.push_numbers(1, 1);
  REQUIRE(moving.listener.has_seen(1));
  CHECK(moving.listener.take_all() == std::vector<int>{1});
  CHECK(movable(moving.listener, "in").move_to("second.out"));
  CHECK(moving.is_heard_now(moving.second, moving.first));
  CHECK(number_of(moving.listener.in.latest()) == 1);
}

CONTRACT_CASE("a port can be moved in the middle of a wait, and back", "[contract][move]") {
  Moving<TestType> moving(kit);
  std::atomic<int> last{0};
  Script script(moving.listener, [&] {
    while (last < 2) last = number_of(moving.listener.in.get_update_wait());
  });
  sleep(kit.executive, 20ms);
  CHECK(movable(moving.listener, "in").move_to("second.out"));
  CHECK(moving.is_heard(moving.second, moving.first));
  moving.second.push_numbers(1, 1);
  CHECK(eventually(kit.executive, [&] { return last == 1; }));
  CHECK(movable(moving.listener, "in").move_to("first.out"));
  CHECK(moving.is_heard(moving.first, moving.second));
  moving.first.push_numbers(2, 2);
  CHECK(script.ends_within(5s));
}

CONTRACT_CASE("a port that is not subscribed is moved all the same", "[contract][move]") {
  Moving<TestType> moving(kit);
  moving.listener.in.unsubscribe();
  CHECK(movable(moving.listener, "in").move_to("second.out"));
  moving.listener.in.subscribe();
  CHECK(moving.is_heard(moving.second, moving.first));
}

CONTRACT_CASE("a port is moved only to a server that it is connected to", "[contract][move]") {
  Moving<TestType> moving(kit);
  CHECK_FALSE(movable(moving.listener, "in").move_to("third.out"));
  Listener fixed(kit.executive, "fixed");
  kit.connect(moving.first.endpoint("out"), fixed.endpoint("in"));
  CHECK_FALSE(movable(fixed, "in").move_to("first.out"));
}

CONTRACT_CASE("after a move questions go to the new server, and open ones are answered by the old one",
              "[contract][move]") {
  Asker asker(kit.executive);
  Clerk one(kit.executive, "one", 1);
  Clerk two(kit.executive, "two", 2);
  movable(asker, "question").allow_moves();
  kit.connect(asker.endpoint("question"), one.endpoint("server"));
  kit.connect(asker.endpoint("question"), two.endpoint("server"));
  one.open();
  const Result<QueryId> open = asker.question.query_request(asker.about("x"));
  REQUIRE(open);
  const auto restarts = asker.question.server_restarts();
  REQUIRE(restarts.has_value());
  CHECK(movable(asker, "question").move_to("two.server"));
  const Service at_one(one);
  const Service at_two(two);
  const auto later = asker.question.query(asker.about("y"), 5s);
  REQUIRE(later);
  CHECK(number_of(*later) == 2);
  const auto earlier = asker.question.query_receive_wait(*open, 5s);
  REQUIRE(earlier);
  CHECK(number_of(*earlier) == 1);
  CHECK(asker.question.server_restarts() == *restarts + 1);
}

CONTRACT_CASE("an object that waits at the old server is withdrawn from there", "[contract][move]") {
  Sender sender(kit.executive);
  Store one(kit.executive, "one");
  Store two(kit.executive, "two");
  movable(sender, "out").allow_moves();
  const QueuePolicy policy{
      .depth = 4, .overflow = QueuePolicy::Overflow::refuse, .confirm = QueuePolicy::Confirm::handled};
  kit.connect(sender.endpoint("out"), one.endpoint("in"), policy);
  kit.connect(sender.endpoint("out"), two.endpoint("in"), policy);
  one.open();
  two.open();
  const auto& server = static_cast<SendServerEndpoint&>(one.endpoint("in"));
  const Result<SendId> sent = sender.out.send_request(numbered(1));
  REQUIRE(sent);
  REQUIRE(eventually(kit.executive, [&] { return server.counters().queued == 1; }));
  CHECK(movable(sender, "out").move_to("two.in"));
  CHECK_FALSE(sender.out.send_receive_wait(*sent, 10ms).ok());
  CHECK(eventually(kit.executive, [&] { return server.counters().withdrawn == 1; }));
  CHECK_FALSE(one.handle_one());
}

CONTRACT_CASE("after a move objects are sent to the new server", "[contract][move]") {
  Sender sender(kit.executive);
  Store one(kit.executive, "one");
  Store two(kit.executive, "two");
  movable(sender, "out").allow_moves();
  kit.connect(sender.endpoint("out"), one.endpoint("in"));
  kit.connect(sender.endpoint("out"), two.endpoint("in"));
  const Service at_one(one);
  const Service at_two(two);
  CHECK(sender.out.send(numbered(1)).ok());
  CHECK(movable(sender, "out").move_to("two.in"));
  CHECK(sender.out.send(numbered(2)).ok());
  CHECK(eventually(kit.executive, [&] { return one.taken == 1 && two.taken == 2; }));
}
