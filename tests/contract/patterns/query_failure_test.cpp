// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of Query when something goes wrong, for every link.
#include "query_kits.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;

CONTRACT_CASE("a query that is not answered in time fails and names both ends", "[contract][query]") {
  Counter counter(kit);
  counter.answerer.open();
  const TimePoint before = kit.executive.now();
  const auto answer = counter.asker.question.query(counter.asker.about("time"), 20ms);
  const Duration waited = kit.executive.now() - before;
  REQUIRE_FALSE(answer.has_value());
  CHECK(answer.error().code == Code::deadline_exceeded);
  CHECK_THAT(answer.error().text(), Contains("answerer.server") && Contains("asker.question"));
  CHECK(waited >= 20ms);
  if (kit.executive.is_virtual()) CHECK(waited == 20ms);
}

CONTRACT_CASE("a late answer is discarded and does not answer the next question", "[contract][query]") {
  Counter counter(kit);
  counter.answerer.open();
  auto& question = counter.asker.question;
  const auto late = question.query_request(counter.asker.about("late"));
  REQUIRE(late.has_value());
  REQUIRE(counter.has_been_asked(1));
  CHECK_FALSE(question.query_receive_wait(*late, 1ms).has_value());
  CHECK(counter.answerer.handle_one());
  const Service service(counter.answerer);
  CHECK(number_of(question.query(counter.asker.about("next one"), 5s).value()) == 8);
  const auto again = question.query_receive(*late);
  REQUIRE(again.has_value());
  CHECK(again->error().code == Code::not_found);
}

CONTRACT_CASE("the answer to a forgotten question is discarded, before and after it comes, and is no trouble",
              "[contract][query]") {
  Counter counter(kit);
  counter.answerer.open();
  auto& question = counter.asker.question;
  const auto early = question.query_request(counter.asker.about("early"));
  REQUIRE(early.has_value());
  question.query_forget(*early);
  const Service service(counter.answerer);
  const auto late = question.query_request(counter.asker.about("late"));
  REQUIRE(late.has_value());
  CHECK(question.query(counter.asker.about("behind it"), 5s).has_value());  // so the one before is answered
  question.query_forget(*late);
  for (const QueryId id : {*early, *late}) CHECK(question.query_receive(id)->error().code == Code::not_found);
  CHECK(question.counters().failed == 0);
  CHECK(question.counters().timed_out == 0);
}

CONTRACT_CASE("a query that its component had to leave forgets its answer", "[contract][query]") {
  Counter counter(kit);
  counter.answerer.open();
  const std::size_t live = pool_statistics(object_type<MotionCommand>()).live;
  Script script(counter.asker,
                [&] { (void)counter.asker.question.query(counter.asker.about("interrupted"), 1h); });
  REQUIRE(counter.has_been_asked(1));
  counter.asker.leave();
  REQUIRE(script.ends_within(5s));
  CHECK(script.interrupted());
  CHECK(counter.answerer.handle_one());
  CHECK(
      eventually(kit.executive, [&] { return pool_statistics(object_type<MotionCommand>()).live == live; }));
}

CONTRACT_CASE("a server that is full or closed refuses the question with the reason", "[contract][query]") {
  Counter counter(kit, 1);
  auto& question = counter.asker.question;
  const auto early = counter.asker.ask_in_vain("early");
  REQUIRE_FALSE(early.has_value());
  CHECK(early.error().code == Code::unavailable);
  CHECK_THAT(early.error().text(), Contains("has not been started yet"));
  counter.answerer.open();
  CHECK(question.query_request(counter.asker.about("first")).has_value());
  const auto full = counter.asker.ask_in_vain("second");
  REQUIRE_FALSE(full.has_value());
  CHECK(full.error().code == Code::unavailable);
  CHECK_THAT(full.error().text(), Contains("answerer.server is full: 1 questions"));
  CHECK(counter.answerer.counters().refused == 2);
  CHECK(counter.answerer.counters().accepted == 1);
}

CONTRACT_CASE("an error of the handler is the answer, code and text, and is counted", "[contract][query]") {
  Counter counter(kit);
  const Service service(counter.answerer);
  const auto answer = counter.asker.question.query(counter.asker.about("bad"), 5s);
  REQUIRE_FALSE(answer.has_value());
  CHECK(answer.error().code == Code::invalid_argument);
  CHECK(answer.error().message == "there is nothing to say about bad");
  CHECK(counter.answerer.counters().failed == 1);
}

CONTRACT_CASE("an exception of the handler is an answer too, and reaches whoever runs the server",
              "[contract][query]") {
  Counter counter(kit);
  counter.answerer.open();
  auto& question = counter.asker.question;
  const auto id = question.query_request(counter.asker.about("worse"));
  REQUIRE(id.has_value());
  REQUIRE(counter.has_been_asked(1));
  CHECK_THROWS_WITH(counter.answerer.handle_one(), "worse");
  const auto answer = question.query_receive_wait(*id, 5s);
  REQUIRE_FALSE(answer.has_value());
  CHECK(answer.error().code == Code::internal);
  CHECK_THAT(answer.error().text(), Contains("answerer.server threw"));
  CHECK(counter.answerer.counters().failed == 1);
}

CONTRACT_CASE("a server that closes answers the questions that still wait, with the reason",
              "[contract][query]") {
  Counter counter(kit);
  counter.answerer.open();
  Error told;
  Script script(counter.asker, [&] {
    const auto answer = counter.asker.question.query(counter.asker.about("waiting"), 1h);
    if (!answer) told = answer.error();
  });
  REQUIRE(counter.has_been_asked(1));
  counter.answerer.close("it has failed");
  REQUIRE(script.ends_within(5s));
  CHECK(told.code == Code::unavailable);
  CHECK_THAT(told.text(), Contains("answerer.server") && Contains("because it has failed"));
  CHECK_FALSE(counter.answerer.handle_one());
}

CONTRACT_CASE("an answer to a question that was never asked is not found", "[contract][query]") {
  Counter counter(kit);
  const auto answer = counter.asker.question.query_receive(77);
  REQUIRE(answer.has_value());
  CHECK(answer->error().code == Code::not_found);
  CHECK(counter.asker.question.query_receive_wait(77, 1h).error().code == Code::not_found);
}
