// SPDX-License-Identifier: GPL-3.0-or-later
// Orders that several components obey together or not at all.
#include "control/joint_orders.hpp"

#include <catch2/catch.hpp>
#include <deque>

using namespace orca;
using namespace orca::supervisor;
using Words = std::vector<std::string>;

namespace {

const Error kRefusal = fail(Code::failed_precondition, "it is WORK_DONE");
const Error kTooLate = fail(Code::deadline_exceeded, "it has not come to the end of a lap in time");

// Components that keep what they are asked, and answer when the test says so.
class Components {
 public:
  // Adds a joint order to suspend these.
  void suspend(const Words& names) {
    std::vector<JointStep> steps;
    for (const std::string& name : names) steps.push_back(step(name));
    orders_.add(std::move(steps),
                [this](const Status& end) { ends.push_back(end ? "ok" : end.error().text()); });
  }

  // Answers the oldest order.
  void answer(const Status& status = ok()) {
    REQUIRE_FALSE(open_.empty());
    const JointOrders::Answered answered = std::move(open_.front());
    open_.pop_front();
    answered(status);
  }
  [[nodiscard]] bool await_answer() const { return !open_.empty(); }

  Words asked;    // "suspend a", "resume a"
  Words changes;  // "a changed", "a is back"
  Words ends;
  Words left_alone;
  Words unable;
  Words unreachable;
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

  Status send(const std::string& name, const Order& order, JointOrders::Answered answered) {
    if (std::ranges::find(unreachable, name) != unreachable.end())
      return fail(Code::unavailable, "its process does not work");
    asked.push_back((std::holds_alternative<Suspend>(order) ? "suspend " : "resume ") + name);
    open_.push_back(std::move(answered));
    return ok();
  }

  std::deque<JointOrders::Answered> open_;
  JointOrders orders_{[this](const std::string& name, const Order& order, JointOrders::Answered answered) {
    return send(name, order, std::move(answered));
  }};
};

}  // namespace

TEST_CASE("components obey a joint order one after the other", "[supervisor][joint]") {
  Components all;
  all.suspend({"a", "b"});
  CHECK(all.asked == Words{"suspend a"});
  all.answer();
  CHECK(all.asked == Words{"suspend a", "suspend b"});
  CHECK(all.ends.empty());
  all.answer();
  CHECK(all.changes == Words{"a changed", "b changed"});
  CHECK(all.ends == Words{"ok"});
}

TEST_CASE("if one refuses, those before it go back, the last one first", "[supervisor][joint]") {
  Components all;
  all.suspend({"a", "b", "c", "d"});
  all.answer();
  all.answer();
  all.answer(kRefusal);
  all.answer();
  all.answer();
  CHECK(all.asked == Words{"suspend a", "suspend b", "suspend c", "resume b", "resume a"});
  CHECK(all.changes == Words{"a changed", "b changed", "b is back", "a is back"});
  CHECK(all.ends == Words{"c: it is WORK_DONE; all others are as before the order"});
}

TEST_CASE("the refusal of a single component says only why", "[supervisor][joint]") {
  Components all;
  all.suspend({"a"});
  all.answer(kRefusal);
  CHECK(all.ends == Words{"a: it is WORK_DONE"});
}

TEST_CASE("a component that is to be left alone is neither asked nor brought back", "[supervisor][joint]") {
  Components all;
  all.left_alone = {"a"};
  all.suspend({"a", "b", "c"});
  all.answer();
  all.answer(kRefusal);
  all.answer();
  CHECK(all.asked == Words{"suspend b", "suspend c", "resume b"});
}

TEST_CASE("a component that cannot obey as it is then has refused", "[supervisor][joint]") {
  Components all;
  all.unable = {"b"};
  all.suspend({"a", "b", "c"});
  all.answer();
  all.answer();
  CHECK(all.asked == Words{"suspend a", "resume a"});
  CHECK(all.ends == Words{"b: it is WORK_DONE; all others are as before the order"});
}

TEST_CASE("a component that cannot be reached has refused", "[supervisor][joint]") {
  Components all;
  all.unreachable = {"b"};
  all.suspend({"a", "b"});
  all.answer();
  all.answer();
  CHECK(all.asked == Words{"suspend a", "resume a"});
  CHECK(all.ends == Words{"b: its process does not work; all others are as before the order"});
}

TEST_CASE("who cannot go back is named, and the others go back nevertheless", "[supervisor][joint]") {
  Components all;
  all.suspend({"a", "b", "c"});
  all.answer();
  all.answer();
  all.unreachable = {"b"};
  all.answer(kRefusal);
  all.answer();
  CHECK(all.asked.back() == "resume a");
  CHECK(all.ends == Words{"c: it is WORK_DONE; not all could go back: b: its process does not work"});
}

TEST_CASE("a component that is late is ordered back too, because it may obey later", "[supervisor][joint]") {
  Components all;
  all.suspend({"a", "b"});
  all.answer();
  all.answer(kTooLate);
  CHECK(all.asked == Words{"suspend a", "suspend b", "resume b"});
  SECTION("in time") {
    all.answer();
    all.answer();
    CHECK(all.ends == Words{"b: " + kTooLate.message + "; all others are as before the order"});
  }
  SECTION("late as well") {
    all.answer(kTooLate);
    all.answer();
    CHECK(all.ends == Words{"b: " + kTooLate.message +
                            "; it obeys once its lap has ended, and goes back at once"
                            "; all others are as before the order"});
  }
}

TEST_CASE("a component that is late and never obeys then is left as it is", "[supervisor][joint]") {
  Components all;
  all.may_obey_late = false;
  all.suspend({"a", "b"});
  all.answer();
  all.answer(kTooLate);
  CHECK(all.asked == Words{"suspend a", "suspend b", "resume a"});
  SECTION("and the others go back") {
    all.answer();
    CHECK(all.ends == Words{"b: " + kTooLate.message + "; all others are as before the order"});
  }
  SECTION("and another one that is late on the way back stays changed") {
    all.answer(kTooLate);
    CHECK(all.ends == Words{"b: " + kTooLate.message + "; not all could go back: a: " + kTooLate.message});
  }
}

TEST_CASE("a joint order waits for the one before it", "[supervisor][joint]") {
  Components all;
  all.suspend({"a", "b"});
  all.suspend({"c"});
  all.answer();
  all.answer(kRefusal);
  CHECK(all.asked == Words{"suspend a", "suspend b", "resume a"});
  all.answer();
  CHECK(all.asked.back() == "suspend c");
  all.answer();
  CHECK(all.ends.back() == "ok");
}

TEST_CASE("an answer that comes when nobody waits any more does no harm", "[supervisor][joint]") {
  JointOrders::Answered late;
  {
    JointOrders orders([&](const std::string&, const Order&, JointOrders::Answered answered) {
      late = std::move(answered);
      return ok();
    });
    orders.add({{"a",
                 [] {
                   return std::optional(ThereAndBack{Suspend{"a"}, Resume{"a"}});
                 },
                 [](bool) {}}},
               [](const Status&) { FAIL("the order has not ended"); });
  }
  REQUIRE(late != nullptr);
  late(ok());
}
