// SPDX-License-Identifier: GPL-3.0-or-later
// The two ends of a Query or Send edge between processes, each with a peer that the test plays.
#include "frames/request_over_frames.hpp"

#include <catch2/catch.hpp>

#include "case_in.hpp"
#include "executives.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "played_end.hpp"

using namespace orca;
using namespace orca::frames;
using namespace orca::test;
using Catch::Contains;
using Kinds = std::vector<FrameKind>;
using Reply = Result<ObjectRef>;

namespace {

ObjectRef a_command() { return ObjectRef(head(0.5, 2.0).seal()); }

RequestTypes query_types() { return {object_type<idl::MotionCommand>(), &object_type<idl::GoalPoint>()}; }

Frame answer_of(std::uint64_t id, std::uint64_t code, const std::string& message = {}) {
  Frame frame = frame_of(FrameKind::answer, id, {code});
  frame.add(message);
  frame.add(std::string{});
  return frame;
}

Frame reply_of(std::uint64_t id, ObjectRef object) {
  Frame frame = answer_of(id, 0);
  frame.add(std::move(object));
  return frame;
}

Frame offer_of(std::uint64_t id, bool may_wait) {
  Frame frame = frame_of(FrameKind::offer, id, {may_wait ? 1U : 0U});
  frame.add(a_command());
  return frame;
}

// The client's port, as the link sees it.
template <class Answer>
struct Asker final : ReplySink<Answer> {
  void reply(RequestId id, Answer answer) override {
    ids.push_back(id);
    errors.push_back(answer ? std::string("none") : answer.error().message);
  }
  std::vector<RequestId> ids;
  std::vector<std::string> errors;
};

// The server's port, as the link sees it.
template <class Answer>
struct Port final : RequestTarget<Answer> {
  std::optional<Answer> offer(const ObjectRef& /*object*/, ReplySink<Answer>& reply_to, RequestId id,
                              bool may_wait) override {
    offered.push_back(id);
    waits.push_back(may_wait);
    sink = &reply_to;
    return std::exchange(at_once, std::nullopt);
  }
  void withdraw(RequestId id) override { withdrawn.push_back(id); }
  [[nodiscard]] Duration patience() const override { return 0s; }
  [[nodiscard]] std::string path() const override { return "b.in"; }

  std::optional<Answer> at_once;
  std::vector<RequestId> offered, withdrawn;
  std::vector<bool> waits;
  ReplySink<Answer>* sink = nullptr;
};

template <class Answer>
struct Client {
  explicit Client(Executive& executive, Duration patience = Duration{0})
      : strand(executive, {"asker", 0}),
        target(std::make_unique<PlayedEnd>(peer), strand, query_types(), "b.in", patience) {}
  std::optional<Answer> offer(RequestId id, bool may_wait = false) {
    return target.offer(a_command(), asker, id, may_wait);
  }
  Played peer;
  Strand strand;
  Asker<Answer> asker;
  TargetOverFrames<Answer> target;
};

struct Served {
  Played peer;
  Port<Reply> port;
  CallerOverFrames<Reply> end{std::make_unique<PlayedEnd>(peer), query_types(), port};
};

void with_asker(const std::function<void(Client<Reply>&)>& body) {
  run_on({}, [&](Executive& executive) {
    Client<Reply> caller(executive);
    body(caller);
  });
}

}  // namespace

#define ASKER_CASE(title, tags) CASE_IN(with_asker, (Client<Reply> & caller), title, tags)

ASKER_CASE("a question goes out with its number, and says whether its asker waits", "[patterns][frames]") {
  CHECK_FALSE(caller.offer(3));
  CHECK_FALSE(caller.offer(4, true));
  REQUIRE(caller.peer.sent.size() == 2);
  CHECK(caller.peer.sent[0].kind() == FrameKind::offer);
  CHECK(caller.peer.sent[0].number() == 3);
  CHECK(caller.peer.sent[0].first_number() == 0);
  CHECK(caller.peer.sent[1].first_number() == 1);
  CHECK(caller.peer.callers == std::vector{Caller::goes_on, Caller::waits});
  CHECK(caller.peer.losses == std::vector{Loss::allowed, Loss::allowed});
}

ASKER_CASE("each answer reaches the question with its number, once", "[patterns][frames]") {
  for (const RequestId id : {3U, 4U}) CHECK_FALSE(caller.offer(id));
  const ObjectRef goal(make_object<idl::GoalPoint>().seal());
  CHECK(caller.peer.say(reply_of(4, goal)).ok());
  CHECK(caller.peer.say(reply_of(4, goal)).ok());
  CHECK(caller.peer.say(answer_of(3, 2, "it is busy")).ok());
  CHECK(caller.peer.say(answer_of(7, 2, "to nobody")).ok());
  CHECK(caller.asker.ids == std::vector<RequestId>{4, 3});
  CHECK(caller.asker.errors == std::vector<std::string>{"none", "it is busy"});
}

TEST_CASE("each kind of error travels", "[patterns][frames]") {
  run_on({}, [](Executive& executive) {
    Played peer;
    struct Codes final : ReplySink<Status> {
      void reply(RequestId /*id*/, Status answer) override { got.push_back(answer.error().code); }
      std::vector<Code> got;
    } codes;
    Strand strand(executive, {"asker", 0});
    TargetOverFrames<Status> target(std::make_unique<PlayedEnd>(peer), strand, query_types(), "b.in", 0s);
    std::vector<Code> expected;
    for (std::uint64_t code = 0; code <= static_cast<std::uint64_t>(Code::internal); ++code) {
      CHECK_FALSE(target.offer(a_command(), codes, code + 1, false));
      CHECK(peer.say(answer_of(code + 1, code + 1, "why")).ok());
      expected.push_back(static_cast<Code>(code));
    }
    CHECK(codes.got == expected);
    const Status unknown = peer.say(answer_of(1, static_cast<std::uint64_t>(Code::internal) + 2));
    REQUIRE_FALSE(unknown.ok());
    CHECK_THAT(unknown.error().message, Contains("an answer with the unknown code"));
  });
}

ASKER_CASE("a client refuses what a server of Query cannot say", "[patterns][frames]") {
  CHECK_FALSE(caller.offer(3));
  CHECK_FALSE(caller.peer.say(reply_of(3, a_command())).ok());  // no reply of this port
  CHECK_FALSE(caller.peer.say(answer_of(3, 0)).ok());           // no reply at all
  CHECK_FALSE(caller.peer.say(frame_of(FrameKind::answer, 3, {2})).ok());
  CHECK_FALSE(caller.peer.say(offer_of(3, false)).ok());
  CHECK_THAT(caller.peer.say(frame_of(FrameKind::withdraw, 3)).error().message, Contains("Query or Send"));
  CHECK(caller.asker.ids.empty());
}

ASKER_CASE("a question that cannot be sent is refused with the reason", "[patterns][frames]") {
  caller.peer.outcome = Sent::no_room;
  const auto full = caller.offer(3);
  REQUIRE(full);
  CHECK(full->error().code == Code::unavailable);
  CHECK_THAT(full->error().message,
             Contains("b.in was not reached: its queue between the processes is full"));
  caller.peer.outcome = Sent::too_large;
  const auto large = caller.offer(4);
  REQUIRE(large);
  CHECK(large->error().code == Code::invalid_argument);
  CHECK_THAT(large->error().message, Contains("larger than what the link to b.in can carry"));
  caller.peer.outcome = Sent::cut;
  CHECK_FALSE(caller.offer(5));  // the end of the link answers it
  caller.peer.handlers.cut(fail(Code::unavailable, "it is gone"));
  CHECK(caller.asker.ids == std::vector<RequestId>{5});
}

ASKER_CASE("when the link is cut all open questions are answered, and new ones refused until it stands again",
           "[patterns][frames]") {
  CHECK_FALSE(caller.offer(3));
  CHECK_FALSE(caller.offer(4));
  caller.peer.handlers.cut(fail(Code::unavailable, "it was killed"));
  CHECK(caller.asker.ids == std::vector<RequestId>{3, 4});
  CHECK(caller.asker.errors.at(0) == "b.in cannot be reached: the link was cut, because it was killed");
  const auto refused = caller.offer(5);
  REQUIRE(refused);
  CHECK(refused->error().code == Code::unavailable);
  CHECK(caller.target.renewals() == 0U);
  caller.peer.handlers.renewed();
  CHECK(caller.target.renewals() == 1U);
  CHECK_FALSE(caller.offer(6));
}

TEST_CASE("a client waits for the outcome as long as the edge says, or a second", "[patterns][frames]") {
  run_on({}, [](Executive& executive) {
    CHECK(Client<Status>(executive, 3s).target.patience() == 3s);
    CHECK(Client<Status>(executive, 1ns).target.patience() == 1ns);
    CHECK(Client<Status>(executive, 0s).target.patience() == 1s);
    CHECK(Client<Status>(executive).target.path() == "b.in");
  });
}

TEST_CASE("a question is taken back for good once the server has confirmed that, or after a second",
          "[patterns][frames]") {
  run_on(virtual_executives().front(), [](Executive& executive) {
    Client<Reply> caller(executive);
    CHECK_FALSE(caller.offer(3));
    const TimePoint before = executive.now();
    caller.target.withdraw(3);  // nobody confirms it
    CHECK(executive.now() - before == 1s);
    CHECK(caller.peer.kinds() == Kinds{FrameKind::offer, FrameKind::withdraw});
    CHECK(caller.peer.say(reply_of(3, ObjectRef(make_object<idl::GoalPoint>().seal()))).ok());
    CHECK(caller.asker.ids.empty());
    CHECK_FALSE(caller.offer(4));
    CHECK(caller.peer.say(frame_of(FrameKind::withdrawn, 4)).ok());
    const TimePoint then = executive.now();
    caller.target.withdraw(4);
    CHECK(executive.now() == then);
    CHECK_FALSE(caller.offer(5));
    caller.peer.handlers.cut(fail(Code::unavailable, "it is gone"));
    caller.target.withdraw(5);
    CHECK(executive.now() == then);  // nobody will confirm it
  });
}

TEST_CASE("a server gets each question under a number of its own, and its answer goes to the client's",
          "[patterns][frames]") {
  Served served;
  CHECK(served.peer.say(offer_of(30, false)).ok());
  CHECK(served.peer.say(offer_of(40, true)).ok());
  CHECK(served.port.offered == std::vector<RequestId>{1, 2});
  CHECK(served.port.waits == std::vector{false, true});
  served.end.reply(2, fail(Code::unavailable, "it is busy", "here"));
  served.end.reply(2, fail(Code::unavailable, "it is busy"));  // is answered already
  served.end.reply(1, ObjectRef(make_object<idl::GoalPoint>().seal()));
  REQUIRE(served.peer.sent.size() == 2);
  CHECK(served.peer.sent[0].kind() == FrameKind::answer);
  CHECK(served.peer.sent[0].number() == 40);
  CHECK(served.peer.sent[0].first_number() == static_cast<std::uint64_t>(Code::unavailable) + 1);
  CHECK_FALSE(served.peer.sent[0].object());
  CHECK(served.peer.sent[1].number() == 30);
  CHECK(served.peer.sent[1].first_number() == 0);
  CHECK(served.peer.sent[1].object());
}

TEST_CASE("what a server answers at once is sent at once", "[patterns][frames]") {
  Served served;
  served.port.at_once = fail(Code::unavailable, "it is closed");
  CHECK(served.peer.say(offer_of(30, false)).ok());
  CHECK(served.peer.kinds() == Kinds{FrameKind::answer});
}

TEST_CASE("a question that its client takes back is withdrawn from the server, and that is confirmed",
          "[patterns][frames]") {
  Served served;
  CHECK(served.peer.say(offer_of(30, true)).ok());
  CHECK(served.peer.say(frame_of(FrameKind::withdraw, 30)).ok());
  CHECK(served.port.withdrawn == std::vector<RequestId>{1});
  CHECK(served.peer.say(frame_of(FrameKind::withdraw, 30)).ok());  // not open any more
  CHECK(served.port.withdrawn.size() == 1);
  REQUIRE(served.peer.sent.size() == 2);
  for (const Frame& frame : served.peer.sent) {
    CHECK(frame.kind() == FrameKind::withdrawn);
    CHECK(frame.number() == 30);
  }
  served.end.reply(1, fail(Code::unavailable, "too late"));
  CHECK(served.peer.sent.size() == 2);
}

TEST_CASE("the open questions of a client that is lost are withdrawn", "[patterns][frames]") {
  Served served;
  CHECK(served.peer.say(offer_of(30, true)).ok());
  CHECK(served.peer.say(offer_of(40, true)).ok());
  served.end.reply(1, fail(Code::unavailable, "it is busy"));
  served.peer.handlers.cut(fail(Code::unavailable, "gone"));
  CHECK(served.port.withdrawn == std::vector<RequestId>{2});
}

TEST_CASE("an answer that is too large is replaced by an error that says so", "[patterns][frames]") {
  Served served;
  CHECK(served.peer.say(offer_of(30, false)).ok());
  served.peer.too_large = 1;
  served.end.reply(1, ObjectRef(make_object<idl::GoalPoint>().seal()));
  REQUIRE(served.peer.sent.size() == 1);
  CHECK(served.peer.sent[0].number() == 30);
  CHECK(served.peer.sent[0].first_number() == static_cast<std::uint64_t>(Code::unavailable) + 1);
}

TEST_CASE("a server refuses what a client of Query cannot say", "[patterns][frames]") {
  Served served;
  Frame other = frame_of(FrameKind::offer, 30, {0});
  other.add(ObjectRef(make_object<idl::GoalPoint>().seal()));
  CHECK_FALSE(served.peer.say(other).ok());
  CHECK_FALSE(served.peer.say(frame_of(FrameKind::offer, 30, {0})).ok());
  CHECK_THAT(served.peer.say(answer_of(30, 0)).error().message, Contains("Query or Send"));
  CHECK(served.port.offered.empty());
}
