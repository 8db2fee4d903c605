// SPDX-License-Identifier: GPL-3.0-or-later
// A question to another process that is killed while it answers, without anybody who tells of it.
#include <catch2/catch.hpp>

#include <chrono>
#include <thread>

#include "dds_links.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"
#include "two_processes.hpp"

using namespace orca;
using namespace orca::test;
using idl::Ask;
using idl::MotionCommand;

namespace {

const std::string kRun = fresh_run();

struct Asker : Peer {
  explicit Asker(Executive& executive) : Peer(executive, "asker") {}
  [[nodiscard]] Loan<Ask> about(const std::string& text) const {
    Loan<Ask> request = question.loan();
    request->about() = text;
    return request;
  }
  QueryProxy<Ask, MotionCommand> question{*this, "question"};
};

// Answers; falls silent at "hang".
struct Answerer : Peer {
  explicit Answerer(Executive& executive) : Peer(executive, "answerer") {}
  Result<Loan<MotionCommand>> on_ask(const ObjectPtr<Ask>& ask) {
    if (ask->about() == "hang")
      for (;;) pause();
    return make_object<MotionCommand>();
  }
  QueryServer<Ask, MotionCommand> server{*this, "server", &Answerer::on_ask};
};

void answer_for_ever(Executive& executive) {
  const std::unique_ptr<DdsBackend> dds = make_dds("answers", kRun);
  Answerer answerer(executive);
  const Status connected =
      dds->connect(answerer.endpoint("server"), {"asker.question", "asks", {}}, {}, Duration{0});
  if (!connected.ok()) _exit(1);
  serve_for_ever(answerer);
}

}  // namespace

TEST_CASE(
    "a server that dies while it answers is missed within its liveliness time, and its successor answers",
    "[patterns][dds][processes]") {
  (void)dds_test_domain();  // the same for all
  SharedPage page;
  OtherProcess first([](Executive& there) { answer_for_ever(there); });
  const OtherProcess second([&](Executive& there) {
    while (page->parent.load() == 0) std::this_thread::sleep_for(1ms);
    answer_for_ever(there);
  });
  const auto executive = make_executive({}).value();
  executive->run([&] {
    const std::unique_ptr<DdsBackend> dds = make_dds("asks", kRun);
    Asker asker(*executive);
    REQUIRE(
        dds->connect(asker.endpoint("question"), {"answerer.server", "answers", {}}, {}, Duration{0}).ok());
    REQUIRE(asker.question.query(asker.about("anything"), 10s));
    const Result<QueryId> id = asker.question.query_request(asker.about("hang"));
    REQUIRE(id);
    std::this_thread::sleep_for(100ms);
    first.kill_now();
    const auto killed = std::chrono::steady_clock::now();
    const auto answer = asker.question.query_receive_wait(*id, 5s);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - killed;
    REQUIRE_FALSE(answer);
    CHECK(answer.error().code == Code::unavailable);
    CHECK_THAT(answer.error().message, Catch::Contains("no sign of life for 300 ms"));
    CHECK(taken.count() > 0.2);
    CHECK(taken.count() < 1.0);
    page->parent.store(1);
    const auto limit = std::chrono::steady_clock::now() + 10s;
    bool answered = false;
    while (!answered && std::chrono::steady_clock::now() < limit)
      answered = asker.question.query(asker.about("again"), 1s).has_value();
    CHECK(answered);
    CHECK(asker.question.server_restarts() == 1U);
  });
}
