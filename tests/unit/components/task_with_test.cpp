// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters that a task sets for a while.
#include <catch2/catch.hpp>

#include "fake_actor.hpp"

using namespace orca::tasks;
using namespace orca::tasks::test;

TEST_CASE("a parameter is set while the steps in a With are done, and set back however they end",
          "[components][tasks]") {
  const std::string slow = R"(<With set="pilot.max_speed" to="0.3 m/s">)";
  const auto done_by = [&](const std::string& steps, const auto& prepare) {
    Run run(slow + steps + "</With>" + R"(<Drive to="b"/>)");
    prepare(run.actor);
    run.to_the_end();
    return run;
  };
  const auto nothing = [](FakeActor&) {};
  CHECK(done_by(R"(<Drive to="a"/><Say text="x"/>)", nothing).actor.log ==
        Strings{"set max_speed 0.3 m/s", "begin a", "at a", "say x", "back max_speed 0.5 m/s", "begin b",
                "at b"});
  const Run fails = done_by(R"(<Drive to="a"/>)", [](FakeActor& a) { a.failures["a"] = {"blocked: x"}; });
  CHECK(fails.actor.log == Strings{"set max_speed 0.3 m/s", "begin a", "back max_speed 0.5 m/s"});
  CHECK(reason_of(fails) == "blocked: x");
  const Run forbidden = done_by(R"(<Drive to="a"/>)", [](FakeActor& a) { a.may_set = false; });
  CHECK(forbidden.actor.log == Strings{"set max_speed 0.3 m/s"});
  CHECK(reason_of(forbidden) == "refused: no right");
  const Run unheard = done_by(R"(<Drive to="a"/>)", [](FakeActor& a) { a.is_deaf = true; });
  CHECK(reason_of(unheard) == "timed out: nobody has set max_speed");
  CHECK(unheard.actor.log == Strings{"set max_speed 0.3 m/s", "back max_speed after its order"});
}

TEST_CASE("what interrupts a With sets its parameter back, and going on sets it again",
          "[components][tasks]") {
  Run run(R"(<Try><With set="pilot.max_speed" to="0.3 m/s"><Drive to="a"/></With>
             <On when="alarm X" then="resume"><Drive to="dock"/></On></Try>)");
  run.actor.endless = {"a"};
  run.tick(3);
  run.actor.alarms = {"X"};
  run.tick();
  CHECK(run.actor.log ==
        Strings{"set max_speed 0.3 m/s", "begin a", "halt a", "back max_speed 0.5 m/s", "begin dock"});
  run.actor.alarms.clear();
  run.actor.endless.clear();
  CHECK(run.to_the_end() == State::done);
  CHECK(Strings(run.actor.log.begin() + 5, run.actor.log.end()) ==
        Strings{"at dock", "set max_speed 0.3 m/s", "begin a", "at a", "back max_speed 0.5 m/s"});

  SECTION("also before it was set") {
    Run early(
        R"(<Timeout after="1 s"><With set="pilot.max_speed" to="0.3 m/s"><Drive to="a"/></With></Timeout>)");
    early.actor.is_deaf = true;
    CHECK(early.to_the_end() == State::failed);
    CHECK(early.actor.log == Strings{"set max_speed 0.3 m/s", "back max_speed after its order"});
  }
}

TEST_CASE("a With goes on in another object, sets its parameter once more and back to the first value",
          "[components][tasks]") {
  const std::string steps = R"(<With set="pilot.max_speed" to="0.3 m/s"><Drive to="a"/></With>)";
  Run first(steps);
  first.actor.endless = {"a"};
  first.tick(3);
  Run second(steps);
  second.run.go_on_from(first.run.memories(), "");
  CHECK(second.to_the_end() == State::done);
  CHECK(second.actor.log == Strings{"set max_speed 0.3 m/s", "begin a", "at a", "back max_speed 0.5 m/s"});
}

TEST_CASE("a component is suspended while the steps in a Suspend are done, and resumed however they end",
          "[components][tasks]") {
  const auto done_by = [&](const auto& prepare) {
    Run run(R"(<Suspend component="walk"><Drive to="a"/><Say text="x"/></Suspend><Drive to="b"/>)");
    prepare(run.actor);
    run.to_the_end();
    return run;
  };
  CHECK(done_by([](FakeActor&) {}).actor.log ==
        Strings{"suspend walk", "begin a", "at a", "say x", "back walk 0.5 m/s", "begin b", "at b"});
  const Run fails = done_by([](FakeActor& a) { a.failures["a"] = {"blocked: x"}; });
  CHECK(fails.actor.log == Strings{"suspend walk", "begin a", "back walk 0.5 m/s"});
  CHECK(reason_of(fails) == "blocked: x");
  const Run forbidden = done_by([](FakeActor& a) { a.may_set = false; });
  CHECK(forbidden.actor.log == Strings{"suspend walk"});
  CHECK(reason_of(forbidden) == "refused: no right");
  const Run unheard = done_by([](FakeActor& a) { a.is_deaf = true; });
  CHECK(reason_of(unheard) == "timed out: nobody has suspended walk");
  CHECK(unheard.actor.log == Strings{"suspend walk", "back walk after its order"});

  SECTION("also while something interrupts it, and suspended again after that") {
    Run run(R"(<Try><Suspend component="walk"><Drive to="a"/></Suspend>
               <On when="alarm X" then="resume"><Drive to="dock"/></On></Try>)");
    run.actor.endless = {"a"};
    run.tick(3);
    run.actor.alarms = {"X"};
    run.tick();
    CHECK(run.actor.log == Strings{"suspend walk", "begin a", "halt a", "back walk 0.5 m/s", "begin dock"});
    run.actor.alarms.clear();
    run.actor.endless.clear();
    CHECK(run.to_the_end() == State::done);
    CHECK(Strings(run.actor.log.begin() + 5, run.actor.log.end()) ==
          Strings{"at dock", "suspend walk", "begin a", "at a", "back walk 0.5 m/s"});
  }
}
