// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "fake_actor.hpp"
#include "orca/component/state.hpp"

using namespace orca::tasks;
using namespace orca::tasks::test;

TEST_CASE("a sequence does its steps in order and ends with the first that fails", "[components][tasks]") {
  Run good(R"(<Drive to="a"/><Say text="here"/><Drive to="b"/>)");
  CHECK(good.to_the_end() == State::done);
  CHECK(good.actor.log == Strings{"begin a", "at a", "say here", "begin b", "at b"});

  Run bad(R"(<Drive to="a"/><Drive to="b"/>)");
  bad.actor.failures["a"] = {"blocked: a wall"};
  CHECK(bad.to_the_end() == State::failed);
  CHECK(reason_of(bad) == "blocked: a wall");
  CHECK(bad.actor.log == Strings{"begin a"});
}

TEST_CASE("a fallback tries one step after the other until one succeeds", "[components][tasks]") {
  Run run(R"(<Fallback><Drive to="a"/><Drive to="b"/><Drive to="c"/></Fallback>)");
  run.actor.failures["a"] = {"undone: nothing there"};
  CHECK(run.to_the_end() == State::done);
  CHECK(run.actor.log == Strings{"begin a", "begin b", "at b"});
  CHECK(run.run.last_failure() == "undone: nothing there");

  Run none(R"(<Fallback><Drive to="a"/><Drive to="b"/></Fallback>)");
  none.actor.failures = {{"a", {"blocked: x"}}, {"b", {"lost: y"}}};
  CHECK(none.to_the_end() == State::failed);
  CHECK(reason_of(none) == "lost: y");
}

TEST_CASE("a parallel step ends when enough branches are done, or can no longer be", "[components][tasks]") {
  Run all(R"(<Parallel><Drive to="a"/><Wait for="1 s"/></Parallel>)");
  CHECK(all.to_the_end() == State::done);
  CHECK(all.time == Approx(1.1));

  Run one(R"(<Parallel need="1"><Drive to="a"/><Wait for="1 s"/></Parallel>)");
  one.actor.endless = {"a"};
  CHECK(one.to_the_end() == State::done);
  CHECK(one.actor.log == Strings{"begin a", "halt a"});

  Run bad(R"(<Parallel><Drive to="a"/><Check when="alarm LOST"/></Parallel>)");
  bad.actor.endless = {"a"};
  CHECK(bad.to_the_end() == State::failed);
  CHECK(reason_of(bad) == "unmet: alarm LOST");
  CHECK(bad.actor.log == Strings{"begin a", "halt a"});
}

TEST_CASE("a repeat ends after so many rounds, or with the round in which its time is over",
          "[components][tasks]") {
  Run times(R"(<Repeat times="3"><Say text="x"/></Repeat>)");
  CHECK(times.to_the_end() == State::done);
  CHECK(times.actor.log == Strings{"say x", "say x", "say x"});

  Run timed(R"(<Repeat for="1 s"><Wait for="0.3 s"/><Say text="x"/></Repeat>)");
  CHECK(timed.to_the_end() == State::done);
  CHECK(timed.time == Approx(1.2));
  CHECK(timed.actor.log.size() == 3);
}

TEST_CASE("a retry tries again what has failed, so many times", "[components][tasks]") {
  Run run(R"(<Retry attempts="3"><Drive to="a"/></Retry>)");
  run.actor.failures["a"] = {"blocked: 1", "blocked: 2"};
  CHECK(run.to_the_end() == State::done);
  CHECK(run.actor.begun == 3);

  Run never(R"(<Retry attempts="2"><Drive to="a"/></Retry>)");
  never.actor.failures["a"] = {"blocked: 1", "blocked: 2", "blocked: 3"};
  CHECK(never.to_the_end() == State::failed);
  CHECK(reason_of(never) == "blocked: 2");
}

TEST_CASE("a timeout ends what takes too long", "[components][tasks]") {
  Run run(R"(<Timeout after="2 s"><Drive to="a"/></Timeout>)");
  run.actor.endless = {"a"};
  CHECK(run.to_the_end() == State::failed);
  CHECK(reason_of(run) == "timed out: not done within 2 s");
  CHECK(run.actor.log == Strings{"begin a", "halt a"});
  CHECK(run.time == Approx(2.1));
}

TEST_CASE("a check waits for its condition as long as it may", "[components][tasks]") {
  Run run(R"(<Check when="not alarm LOST" within="1 s"/>)");
  run.actor.alarms = {"LOST"};
  run.tick(5);
  CHECK(run.run.state() == State::running);
  run.actor.alarms.clear();
  CHECK(run.to_the_end() == State::done);
}

TEST_CASE("a question is a step, whose failure is the answer no", "[components][tasks]") {
  Run run(R"(<Fallback><Ask text="May I?" within="10 s"/><Drive to="home"/></Fallback>)");
  run.actor.answer = false;
  CHECK(run.to_the_end() == State::done);
  CHECK(run.actor.log == Strings{"begin May I?", "begin home", "at home"});
}

TEST_CASE("a watching handler interrupts what is on the way, which then begins again",
          "[components][tasks]") {
  Run run(
      R"(<Try><Drive to="a"/><Drive to="b"/><On when="alarm BATTERY_LOW" then="resume"><Drive to="dock"/></On></Try>)");
  run.tick(2);
  run.actor.endless = {"b"};
  run.tick(3);
  run.actor.alarms = {"BATTERY_LOW"};
  run.tick(3);
  run.actor.alarms.clear();
  run.actor.endless.clear();
  CHECK(run.to_the_end() == State::done);
  CHECK(run.actor.log ==
        Strings{"begin a", "at a", "begin b", "halt b", "begin dock", "at dock", "begin b", "at b"});
}

TEST_CASE("what a handler has seen it handles once, until it has ceased", "[components][tasks]") {
  Run run(R"(<Try><Drive to="a"/><On when="alarm X" then="resume"><Say text="x"/></On></Try>)");
  run.actor.endless = {"a"};
  run.actor.alarms = {"X"};
  run.tick(20);
  CHECK(run.actor.log == Strings{"say x", "begin a"});
  run.actor.alarms.clear();
  run.tick(2);
  run.actor.alarms = {"X"};
  run.tick(5);
  CHECK(run.actor.log == Strings{"say x", "begin a", "halt a", "say x", "begin a"});
}

TEST_CASE("the ways on after a handler", "[components][tasks]") {
  const auto end_of = [](const std::string& then) {
    Run run(R"(<Try><Say text="1"/><Drive to="a"/><On when="alarm X" then=")" + then +
            R"("><Say text="x"/></On></Try>)");
    run.tick(1);
    run.actor.alarms = {"X"};
    run.to_the_end();
    return std::pair(run.actor.log, reason_of(run));
  };
  CHECK(end_of("resume").first == Strings{"say 1", "begin a", "halt a", "say x", "begin a", "at a"});
  CHECK(end_of("again").first == Strings{"say 1", "begin a", "halt a", "say x", "say 1", "begin a", "at a"});
  CHECK(end_of("done") == std::pair(Strings{"say 1", "begin a", "halt a", "say x"}, std::string()));
  CHECK(end_of("fail") ==
        std::pair(Strings{"say 1", "begin a", "halt a", "say x"}, std::string("interrupted: alarm X")));
}

TEST_CASE("of two handlers the first may interrupt the second, which is then done again",
          "[components][tasks]") {
  Run run(R"(<Try><Drive to="a"/>
    <On when="alarm FIRE" then="resume"><Drive to="exit"/></On>
    <On when="alarm BATTERY_LOW" then="resume"><Drive to="dock"/></On></Try>)");
  run.actor.alarms = {"BATTERY_LOW"};
  run.actor.endless = {"dock"};
  run.tick(3);
  run.actor.alarms.insert("FIRE");
  run.tick(3);
  run.actor.endless.clear();
  CHECK(run.to_the_end() == State::done);
  CHECK(run.actor.log == Strings{"begin dock", "halt dock", "begin exit", "at exit", "begin dock", "at dock",
                                 "begin a", "at a"});
}

TEST_CASE("a watching handler interrupts one that has caught a failure, which then is caught again",
          "[components][tasks]") {
  Run run(R"(<Try><Drive to="a"/>
    <On when="alarm LOST" then="resume"><Say text="wait"/></On>
    <Catch reason="any" then="done"><Drive to="home"/></Catch></Try>)");
  run.actor.failures["a"] = {"blocked: x"};
  run.actor.endless = {"home"};
  run.tick(4);
  run.actor.alarms = {"LOST"};
  run.tick(3);
  run.actor.endless.clear();
  CHECK(run.to_the_end() == State::done);
  CHECK(run.actor.log == Strings{"begin a", "begin home", "halt home", "say wait", "begin home", "at home"});
}

TEST_CASE("the step on the way is that of the handler, also to skip it", "[components][tasks]") {
  Run run(
      R"(<Try><Wait for="1 h"/><On when="alarm X" then="done"><Check when="alarm Y" within="1 h"/></On></Try>)");
  run.actor.alarms = {"X"};
  run.tick(2);
  REQUIRE(run.run.active().size() == 1);
  CHECK(run.task.steps[run.run.active()[0]].kind == Kind::check);
  CHECK(run.run.skip(run.actor));
  CHECK(run.to_the_end() == State::done);
}

TEST_CASE("a pause counts for no step, and its drive can be skipped", "[components][tasks]") {
  Run run(R"(<Timeout after="10 s"><Drive to="a"/><Drive to="b"/></Timeout>)");
  run.actor.endless = {"a", "b"};
  run.tick(50);
  run.run.halt(run.actor);
  run.ticks += 600;
  run.run.delay(60.0);
  CHECK(run.task.steps[run.run.skip(run.actor).value()].trip.name == "a");
  run.tick(40);
  CHECK(run.run.state() == State::running);
  CHECK(run.actor.log.back() == "begin b");
  run.tick(20);
  CHECK(reason_of(run) == "timed out: not done within 10 s");
}

TEST_CASE("a handler around another task part interrupts its handlers, too", "[components][tasks]") {
  Run run(R"(<Try><Try><Drive to="a"/><On when="alarm IN" then="resume"><Drive to="b"/></On></Try>
    <On when="alarm OUT" then="fail"><Say text="out"/></On></Try>)");
  run.actor.alarms = {"IN"};
  run.actor.endless = {"b"};
  run.tick(3);
  run.actor.alarms.insert("OUT");
  CHECK(run.to_the_end() == State::failed);
  CHECK(run.actor.log == Strings{"begin b", "halt b", "say out"});
}

TEST_CASE("a failure climbs to the nearest part that catches its kind", "[components][tasks]") {
  Run run(
      R"(<Try><Try><Sequence><Drive to="a"/><Drive to="b"/></Sequence><Catch reason="lost" then="resume"><Say text="inner"/></Catch></Try>
    <Catch reason="blocked" then="resume"><Say text="outer"/></Catch></Try>)");
  run.actor.failures["b"] = {"blocked: a door"};
  CHECK(run.to_the_end() == State::done);
  CHECK(run.actor.log ==
        Strings{"begin a", "at a", "begin b", "say outer", "begin a", "at a", "begin b", "at b"});
}

TEST_CASE("after a failure in a sequence it goes on with the step that has failed", "[components][tasks]") {
  Run run(
      R"(<Try><Drive to="a"/><Drive to="b"/><Catch reason="timed_out" then="resume" times="2"><Say text="again"/></Catch></Try>)");
  run.actor.failures["b"] = {"timed out: 1", "timed out: 2", "timed out: 3"};
  CHECK(run.to_the_end() == State::failed);
  CHECK(run.actor.log ==
        Strings{"begin a", "at a", "begin b", "say again", "begin b", "say again", "begin b"});
  CHECK(reason_of(run) == "timed out: 3");
}

TEST_CASE("a handler that fails is the failure", "[components][tasks]") {
  Run run(R"(<Try><Drive to="a"/><Catch reason="any" then="again"><Drive to="b"/></Catch></Try>)");
  run.actor.failures = {{"a", {"blocked: a"}}, {"b", {"lost: b"}}};
  CHECK(run.to_the_end() == State::failed);
  CHECK(reason_of(run) == "lost: b");
}

TEST_CASE("a goal that nobody takes has failed at once", "[components][tasks]") {
  Run run(R"(<Drive to="a"/>)");
  run.actor.refused = {"a"};
  run.tick();
  CHECK(run.run.state() == State::failed);
}

TEST_CASE("an operator lets a task wait, skips a step, or ends it", "[components][tasks]") {
  Run run(R"(<Drive to="a"/><Drive to="b"/><Drive to="c"/>)");
  run.actor.endless = {"a", "b", "c"};
  run.tick(2);
  run.run.halt(run.actor);
  CHECK(run.actor.log == Strings{"begin a", "halt a"});
  run.tick(2);
  CHECK(run.actor.log.back() == "begin a");
  CHECK(run.task.steps[run.run.skip(run.actor).value()].trip.name == "a");
  run.tick(2);
  CHECK(run.actor.log.back() == "begin b");
  run.run.end(run.actor, "ended: by \"orcactl\"");
  CHECK(run.run.state() == State::failed);
  CHECK(run.actor.log.back() == "halt b");
  CHECK(reason_of(run) == "ended: by \"orcactl\"");
  CHECK_FALSE(run.run.skip(run.actor));
}

TEST_CASE("a task goes on in another object where it was, at whatever tick it is handed over",
          "[components][tasks]") {
  const std::string steps =
      R"(<Try><Repeat times="2"><Retry attempts="2"><Drive to="a"/></Retry><Wait for="0.5 s"/></Repeat>
         <On when="alarm X" then="resume"><Drive to="dock"/></On></Try><Drive to="c"/>)";
  for (int at = 0; at < 40; ++at) {
    Run first(steps);
    first.actor.failures["a"] = {"blocked: once"};
    const auto go = [&](Run& run, int ticks) {
      for (int i = 0; i < ticks; ++i) {
        if (run.time > 0.35 && run.time < 0.85) run.actor.alarms = {"X"};
        if (run.time > 0.85) run.actor.alarms.clear();
        run.tick();
      }
    };
    go(first, at);
    orca::StateWriter writer;
    writer.write(first.run.memories(), first.run.last_failure());
    Run second(steps);
    second.actor = first.actor;
    second.ticks = first.ticks;
    second.time = first.time;
    std::vector<TaskRun::Memory> memories;
    std::string failure;
    orca::StateReader reader({"t", 1}, writer.bytes());
    REQUIRE(reader.read(memories, failure).ok());
    second.run.go_on_from(std::move(memories), std::move(failure));
    go(second, 60);
    CHECK(second.run.state() == State::done);
    CHECK(std::ranges::count(second.actor.log, "at a") == 2);
    CHECK(std::ranges::count(second.actor.log, "at dock") == 1);
    CHECK(std::ranges::count(second.actor.log, "at c") == 1);
  }
}

TEST_CASE("a robot that gets hot stands until it has cooled, and drives on to where it was driving",
          "[components][tasks]") {
  for (const std::string name : {"patrol", "deliver", "fetch"}) {
    CAPTURE(name);
    Run run(shipped_task(name));
    const std::string place = name == "deliver" ? "office_2" : name == "fetch" ? "kitchen_can" : "kitchen";
    run.actor.endless = {place};
    run.actor.fields["battery.temperature"] = "nan";  // not known, as most robots have it
    run.tick(20);
    run.actor.fields["battery.temperature"] = "59";
    run.tick(20);
    CHECK(run.actor.log == Strings{"begin " + place});
    run.actor.fields["battery.temperature"] = "61";
    run.tick(20);
    CHECK(run.actor.log.back() == "say I am hot: I stand until I have cooled.");
    CHECK(run.actor.log[1] == "halt " + place);
    run.actor.fields["battery.temperature"] = "55";
    run.tick(600);
    CHECK(run.actor.begun == 1);
    run.actor.fields["battery.temperature"] = "49";
    run.tick(20);
    CHECK(run.actor.log.back() == "begin " + place);
  }
}
