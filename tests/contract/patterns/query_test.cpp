// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of Query (thesis 7.3, Fig. 7.4-7.6), for every link: an answer, a refusal, or a timeout.
#include "query_kits.hpp"

using namespace orca;
using namespace orca::test;

CONTRACT_CASE("query blocks until the answer is there", "[contract][query]") {
  Counter counter(kit);
  const Service service(counter.answerer);
  const auto answer = counter.asker.question.query(counter.asker.about("three"), 5s);
  REQUIRE(answer.has_value());
  CHECK(number_of(*answer) == 5);
}

CONTRACT_CASE("query_receive gives nothing while there is no answer, then the answer, once",
              "[contract][query]") {
  Counter counter(kit);
  counter.answerer.open();
  auto& question = counter.asker.question;
  const auto id = question.query_request(counter.asker.about("four"));
  REQUIRE(id.has_value());
  REQUIRE(counter.has_been_asked(1));
  CHECK_FALSE(question.query_receive(*id).has_value());
  CHECK(counter.answerer.handle_one());
  std::optional<Result<ObjectPtr<MotionCommand>>> answer;
  CHECK(eventually(kit.executive, [&] { return (answer = question.query_receive(*id)).has_value(); }));
  REQUIRE(answer);
  CHECK(number_of(answer->value()) == 4);
  answer = question.query_receive(*id);
  REQUIRE(answer);
  CHECK(answer->error().code == Code::not_found);
}

CONTRACT_CASE("query_receive_wait blocks until the answer to that question is there", "[contract][query]") {
  Counter counter(kit);
  auto& question = counter.asker.question;
  const Service service(counter.answerer);
  const auto first = question.query_request(counter.asker.about("1"));
  const auto second = question.query_request(counter.asker.about("22"));
  REQUIRE(first.has_value());
  REQUIRE(second.has_value());
  CHECK(number_of(question.query_receive_wait(*second, 5s).value()) == 2);
  CHECK(number_of(question.query_receive_wait(*first, 5s).value()) == 1);
}

CONTRACT_CASE("each answer of a server goes to the client that asked", "[contract][query]") {
  Counter counter(kit);
  Asker other(kit.executive, "other");
  kit.connect(other.endpoint("question"), counter.answerer.endpoint("server"));
  const Service service(counter.answerer);
  std::vector<int> wrong;
  Script script(other, [&] {
    for (std::size_t size = 0; size < 50; ++size) {
      const auto answer = other.question.query(other.about(std::string(size, 'x')), 20s);
      if (number_of(answer.value_or(nullptr)) != static_cast<int>(size))
        wrong.push_back(static_cast<int>(size));
    }
  });
  for (std::size_t size = 50; size < 100; ++size) {
    const auto answer = counter.asker.question.query(counter.asker.about(std::string(size, 'x')), 20s);
    CHECK(number_of(answer.value_or(nullptr)) == static_cast<int>(size));
  }
  CHECK(script.ends_within(20s));
  CHECK(wrong.empty());
}

CONTRACT_CASE("the answer names the question as its cause, also when the handler took other objects",
              "[contract][query]") {
  Counter counter(kit);
  Source source(kit.executive);
  kit.connect(source.endpoint("out"), counter.answerer.endpoint("hint"));
  counter.answerer.hint.subscribe();
  CHECK(eventually(kit.executive, [&] { return source.out.subscriber_count() == 1; }));
  auto hint = numbered(0);
  hint->mission(1);
  source.out.push(std::move(hint));
  const Service service(counter.answerer);
  auto request = counter.asker.about("cause");
  request->mission(9);
  const auto answer = counter.asker.question.query(std::move(request), 5s);
  REQUIRE(answer.has_value());
  CHECK((*answer)->origin() == "answerer");
  CHECK((*answer)->seq() == 1);
  CHECK((*answer)->mission() == 9);
  CHECK((*answer)->cause().origin() == "asker");
  CHECK((*answer)->cause().seq() == 1);
}

TEST_CASE("a QueryProxy that the graph does not connect names its port and what to write",
          "[contract][query]") {
  run_on_each(all_executives(), [](Executive& executive) {
    Asker asker(executive);
    CHECK_FALSE(asker.question.connected());
    const auto answer = asker.question.query(asker.about("anything"));
    REQUIRE_FALSE(answer.has_value());
    CHECK(answer.error().code == Code::failed_precondition);
    CHECK_THAT(answer.error().text(), Catch::Contains("<connect from=\"asker.question\""));
  });
}
