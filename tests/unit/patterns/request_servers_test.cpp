// SPDX-License-Identifier: GPL-3.0-or-later
// The servers of Query and Send when a client's connection is removed while its request is in the handler. The client may be
// destroyed right afterwards, so nothing may reach it any more.
#include <catch2/catch.hpp>

#include <functional>
#include <utility>

#include "executives.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"
#include "peer.hpp"

using namespace orca;
using namespace orca::test;
using idl::MotionCommand;

namespace {

constexpr const char* kClient = "client.port";
constexpr QueuePolicy kHandled{.depth = 4, .confirm = QueuePolicy::Confirm::handled};

/// Answers and takes; what the handlers do besides is the test's.
struct Server : Peer {
  explicit Server(Executive& executive) : Peer(executive, "server") {}

  Result<Loan<MotionCommand>> on_ask(const ObjectPtr<idl::Ask>& /*ask*/) {
    in_handler();
    if (fails) return fail(Code::internal, "nothing to say");
    return full_stop();
  }
  Status on_command(const ObjectPtr<MotionCommand>& /*command*/) {
    in_handler();
    return ok();
  }

  [[nodiscard]] QueryServerEndpoint& asked() const {
    return static_cast<QueryServerEndpoint&>(endpoint("answers"));
  }
  [[nodiscard]] SendServerEndpoint& sent() const { return static_cast<SendServerEndpoint&>(endpoint("in")); }

  std::function<void()> in_handler = [] {};
  bool fails = false;
  QueryServer<idl::Ask, MotionCommand> answers{*this, "answers", &Server::on_ask};
  SendServer<MotionCommand> in{*this, "in", &Server::on_command};
};

/// Counts the answers that reach a client.
template <class Answer>
struct Sink : ReplySink<Answer> {
  void reply(RequestId /*id*/, Answer answer) override { ++(answer ? good : bad); }
  int good = 0;
  int bad = 0;
};

template <class Answer, class Object>
void offer(RequestTarget<Answer>& target, Loan<Object> object, Sink<Answer>& client) {
  CHECK_FALSE(target.offer(std::move(object).seal(), client, 1, false));
}

}  // namespace

TEST_CASE("a client whose connection goes while its question is in the handler gets no answer",
          "[patterns][leave]") {
  run_on({}, [](Executive& executive) {
    Server server(executive);
    server.open();
    server.fails = GENERATE(false, true);
    Sink<Result<ObjectRef>> gone;
    Sink<Result<ObjectRef>> other;
    offer(server.asked().connect(kClient), make_object<idl::Ask>(), gone);
    offer(server.asked().connect("other.port"), make_object<idl::Ask>(), other);
    server.in_handler = [&] { server.asked().disconnect(kClient); };
    CHECK(server.handle_one());
    CHECK(server.handle_one());
    CHECK(gone.good + gone.bad == 0);
    CHECK(other.good + other.bad == 1);
    CHECK(server.asked().counters().failed == (server.fails ? 2 : 0));
  });
}

TEST_CASE(
    "a client that is connected anew while its question is in the handler gets the answers to new ones only",
    "[patterns][leave]") {
  run_on({}, [](Executive& executive) {
    Server server(executive);
    server.open();
    Sink<Result<ObjectRef>> before;
    Sink<Result<ObjectRef>> after;
    offer(server.asked().connect(kClient), make_object<idl::Ask>(), before);
    bool is_first = true;
    server.in_handler = [&] {
      if (!std::exchange(is_first, false)) return;
      server.asked().disconnect(kClient);
      offer(server.asked().connect(kClient), make_object<idl::Ask>(), after);
    };
    CHECK(server.handle_one());
    CHECK(before.good == 0);
    CHECK(after.good == 0);
    CHECK(server.handle_one());
    CHECK(after.good == 1);
  });
}

TEST_CASE("a client whose connection goes while its object is in the handler gets no confirmation",
          "[patterns][leave]") {
  run_on({}, [](Executive& executive) {
    Server server(executive);
    server.open();
    Sink<Status> gone;
    Sink<Status> other;
    offer(server.sent().connect(kClient, kHandled), full_stop(), gone);
    offer(server.sent().connect("other.port", kHandled), full_stop(), other);
    server.in_handler = [&] { server.sent().disconnect(kClient); };
    CHECK(server.handle_one());
    CHECK(server.handle_one());
    CHECK(gone.good + gone.bad == 0);
    CHECK(other.good == 1);
  });
}
