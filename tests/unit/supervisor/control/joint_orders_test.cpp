// SPDX-License-Identifier: GPL-3.0-or-later
// Orders that several components obey together or not at all.
#include "control/joint_orders.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <deque>

using namespace orca;
using namespace orca::supervisor;
using Words = std::vector<std::string>;
using Answers = std::deque<Status>;

namespace {

const Error kRefusal = fail(Code::failed_precondition, "it is WORK_DONE");
const Error kTooLate = fail(Code::deadline_exceeded, "it has not come to the end of a lap in time");
const Error kUnreachable = fail(Code::unavailable, "its process does not work");

// Components that note what they are asked, and answer as the test has said: the first order gets the first answer.
class Components {
 public:
  // Orders all of these to suspend. Returns how that ends.
  std::string suspend(const Words& names) {
    std::vector<JointStep> steps;
    for (const std::string& name : names) steps.push_back(step(name));
    const Status end = orders_.carry_out(steps);
    return end.ok() ? "ok" : end.error().text();
  }

  Conductor conductor{[] {}};
  Answers answers;
  bool is_quick = true;  // else they answer when there is an answer
  Words asked;           // "suspend a", "resume a"
  Words changes;         // "a changed", "a is back"
  Words left_alone;
  Words unable;
  bool may_obey_late = true;

 private:
  JointStep step(const std::string& name) {
    return {name,
            [this, name]() -> Result<std::optional<ThereAndBack>> {
              if (std::ranges::find(unable, name) != unable.end()) return kRefusal;
              if (std::ranges::find(left_alone, name) != left_alone.end())
                return std::optional<ThereAndBack>();
              return std::optional(ThereAndBack{Suspend{name}, Resume{name}});
            },
            [this, name](bool has_gone) { changes.push_back(name + (has_gone ? " changed" : " is back")); },
            may_obey_late};
  }

  Status send(const std::string& name, const Order& order) {
    asked.push_back((std::holds_alternative<Suspend>(order) ? "suspend " : "resume ") + name);
    if (!is_quick) conductor.wait([this] { return !answers.empty(); });
    REQUIRE_FALSE(answers.empty());
    Status answer = std::move(answers.front());
    answers.pop_front();
    return answer;
  }

  JointOrders orders_{conductor,
                      [this](const std::string& name, const Order& order) { return send(name, order); }};
};

}  // namespace

TEST_CASE("components obey a joint order one after the other", "[supervisor][joint]") {
  Components all;
  all.answers = {ok(), ok()};
  CHECK(all.suspend({"a", "b"}) == "ok");
  CHECK(all.asked == Words{"suspend a", "suspend b"});
  CHECK(all.changes == Words{"a changed", "b changed"});
}

TEST_CASE("if one refuses, those before it go back, the last one first", "[supervisor][joint]") {
  Components all;
  all.answers = {ok(), ok(), kRefusal, ok(), ok()};
  CHECK(all.suspend({"a", "b", "c", "d"}) == "c: it is WORK_DONE; all others are as before the order");
  CHECK(all.asked == Words{"suspend a", "suspend b", "suspend c", "resume b", "resume a"});
  CHECK(all.changes == Words{"a changed", "b changed", "b is back", "a is back"});
}

TEST_CASE("the refusal of a single component says only why", "[supervisor][joint]") {
  Components all;
  all.answers = {kRefusal};
  CHECK(all.suspend({"a"}) == "a: it is WORK_DONE");
}

TEST_CASE("a component that is to be left alone is neither asked nor brought back", "[supervisor][joint]") {
  Components all;
  all.left_alone = {"a"};
  all.answers = {ok(), kRefusal, ok()};
  CHECK(all.suspend({"a", "b", "c"}) == "c: it is WORK_DONE; all others are as before the order");
  CHECK(all.asked == Words{"suspend b", "suspend c", "resume b"});
}

TEST_CASE("a component that cannot obey as it is then has refused", "[supervisor][joint]") {
  Components all;
  all.unable = {"b"};
  all.answers = {ok(), ok()};
  CHECK(all.suspend({"a", "b", "c"}) == "b: it is WORK_DONE; all others are as before the order");
  CHECK(all.asked == Words{"suspend a", "resume a"});
}

TEST_CASE("who cannot go back is named, and the others go back nevertheless", "[supervisor][joint]") {
  Components all;
  all.answers = {ok(), ok(), kRefusal, kUnreachable, ok()};
  CHECK(all.suspend({"a", "b", "c"}) ==
        "c: it is WORK_DONE; not all could go back: b: its process does not work");
  CHECK(all.asked.back() == "resume a");
  CHECK(all.changes == Words{"a changed", "b changed", "a is back"});
}

TEST_CASE("a component that is late is ordered back too, because it may obey later", "[supervisor][joint]") {
  Components all;
  const std::string late = "b: " + kTooLate.message;
  SECTION("in time") {
    all.answers = {ok(), kTooLate, ok(), ok()};
    CHECK(all.suspend({"a", "b"}) == late + "; all others are as before the order");
  }
  SECTION("late as well") {
    all.answers = {ok(), kTooLate, kTooLate, ok()};
    CHECK(all.suspend({"a", "b"}) == late +
                                         "; it obeys once its lap has ended, and goes back at once"
                                         "; all others are as before the order");
  }
  CHECK(all.asked == Words{"suspend a", "suspend b", "resume b", "resume a"});
}

TEST_CASE("a component that is late and never obeys then is left as it is", "[supervisor][joint]") {
  Components all;
  all.may_obey_late = false;
  const std::string late = "b: " + kTooLate.message;
  SECTION("and the others go back") {
    all.answers = {ok(), kTooLate, ok()};
    CHECK(all.suspend({"a", "b"}) == late + "; all others are as before the order");
  }
  SECTION("and another one that is late on the way back stays changed") {
    all.answers = {ok(), kTooLate, kTooLate};
    CHECK(all.suspend({"a", "b"}) == late + "; not all could go back: a: " + kTooLate.message);
  }
  CHECK(all.asked == Words{"suspend a", "suspend b", "resume a"});
}

TEST_CASE("joint orders wait for each other, in the order in which they were given", "[supervisor][joint]") {
  Components all;
  all.is_quick = false;
  Words ends;
  all.conductor.run([&] {
    for (const Words& names : {Words{"a", "b"}, Words{"c"}, Words{"d"}})
      all.conductor.begin("suspend", [&, names] { ends.push_back(all.suspend(names)); });
    all.answers = {ok(), kRefusal};
    all.conductor.go_on(Moment{});
    CHECK(all.asked == Words{"suspend a", "suspend b", "resume a"});
    all.answers = {ok(), kRefusal};
    all.conductor.go_on(Moment{});
    CHECK(all.asked == Words{"suspend a", "suspend b", "resume a", "suspend c", "suspend d"});
    all.answers = {ok()};
    all.conductor.go_on(Moment{});
  });
  CHECK(ends == Words{"b: it is WORK_DONE; all others are as before the order", "c: it is WORK_DONE", "ok"});
}
