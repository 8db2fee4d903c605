// SPDX-License-Identifier: GPL-3.0-or-later
// The exchange of a component's code in one process, in virtual time unless a case says otherwise.
#include <catch2/catch.hpp>
#include <optional>

#include "orca/plugin/library.hpp"
#include "run/swap/fit.hpp"
#include "swap_order.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Catch::Contains;
using Words = std::vector<std::string>;

TEST_CASE(
    "a new version takes over the state, and nothing that was pushed or sent is lost, doubled or out of "
    "order",
    "[host][swap]") {
  for (const ExecutiveOptions& kind : all_executives()) {
    LiveSystem live(kPair);
    live.run(kind, [](LiveSystem& run) {
      run.sleep(200ms);
      const Result<SwapReport> done = swap(run, next_teller("test_teller_2"));
      INFO((done ? "" : done.error().text()));
      REQUIRE(done);
      CHECK(done->state == "test.Teller/1");
      run.sleep(200ms);
    });
    const Words said = live.news();
    CHECK(beginning(said, "gap").empty());
    CHECK(beginning(said, "poke").empty());
    CHECK(beginning(said, "not sent").empty());
    const Words heard = beginning(said, "heard ");
    REQUIRE(heard.size() > (kind.clock == ClockKind::steady ? 20U : 200U));  // a busy machine says less
    const auto first_new =
        std::ranges::find_if(heard, [](const auto& h) { return h.starts_with("heard 2:"); });
    REQUIRE(first_new != heard.end());
    const auto count = [](const std::string& word) { return std::stol(word.substr(word.find(':') + 1)); };
    CHECK(count(*first_new) == count(*std::prev(first_new)) + 1);
    CHECK(std::none_of(first_new, heard.end(), [](const auto& h) { return h.starts_with("heard 1:"); }));
  }
}

TEST_CASE(
    "the new object is started where the old one worked, and the old one is stopped after the probation",
    "[host][swap]") {
  LiveSystem live(kPair);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(100ms);
    (void)run.news();
    REQUIRE(swap(run, next_teller("test_teller_2")));
    CHECK(beginning(run.news(), "st") == Words{"start 2"});
  });
}

TEST_CASE("after the probation the old code is no longer in memory, and after many swaps only one copy is",
          "[host][swap]") {
  LiveSystem live(kPair);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    std::string first;
    for (int i = 0; i < 20; ++i) {
      SwapOrder next = next_teller(i % 2 == 0 ? "test_teller_2" : "test_teller_again");
      const std::string name = next.plugin.mapped_name();
      REQUIRE(swap(run, std::move(next)));
      CHECK(plugin::is_mapped(name));
      CHECK_FALSE((!first.empty() && plugin::is_mapped(first)));
      first = name;
      run.sleep(50ms);
    }
  });
}

TEST_CASE("a newer version reads the state of an older one that it accepts, and not the other way round",
          "[host][swap]") {
  LiveSystem live(kPair);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(100ms);
    const Result<SwapReport> newer = swap(run, next_teller("test_teller_state_2"));
    REQUIRE(newer);
    CHECK(newer->state == "test.Teller/1");
    CHECK_THAT(refusal(run, next_teller("test_teller_2")),
               Contains("it cannot read the state test.Teller/2: its own version is 1"));
    run.sleep(100ms);
  });
  CHECK(beginning(live.news(), "gap").empty());
}

TEST_CASE("a component of another type takes the place if its ports fit, and begins afresh", "[host][swap]") {
  LiveSystem live(kPair);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(100ms);
    SwapOrder other = next_teller("test_teller_other");
    other.type = "test.OtherTeller";
    const Result<SwapReport> done = swap(run, std::move(other));
    REQUIRE(done);
    CHECK(done->old_type == "test.Teller");
    CHECK(done->new_type == "test.OtherTeller");
    CHECK(done->state.empty());
    run.sleep(100ms);
    CHECK(run.diary.has("heard 7:1"));
    SwapOrder back = next_teller("test_teller_2");
    back.type = "test.Teller";
    CHECK(swap(run, std::move(back)));
  });
}

TEST_CASE("a parameter keeps its value unless the order gives another one", "[host][swap]") {
  LiveSystem live(R"(<component name="teller" type="test.Teller"><param name="step" value="3"/></component>
    <component name="talker" type="test.Talker"/>
    <connect from="talker.out" to="teller.in"/><connect from="talker.poke" to="teller.poke"/>
    <connect from="teller.out" to="talker.back"/>)");
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    REQUIRE(swap(run, next_teller("test_teller_2")));
    CHECK(std::get<std::int64_t>(run.system().component("teller")->parts().params.values().at("step")) == 3);
    SwapOrder next = next_teller("test_teller_again");
    next.params["step"] = "5";
    REQUIRE(swap(run, std::move(next)));
    CHECK(std::get<std::int64_t>(run.system().component("teller")->parts().params.values().at("step")) == 5);
    CHECK(run.set("teller", {{"step", "7"}}).ok());
    SwapOrder wrong = next_teller("test_teller_again");
    wrong.params["step"] = "70";
    CHECK_THAT(refusal(run, std::move(wrong)), Contains("step"));
  });
}

TEST_CASE(
    "values that the new type cannot take are named, all of them, and those that it does not have are "
    "dropped",
    "[host][swap]") {
  ParamContract speed;
  speed.name = "speed";
  speed.max = 1.0;
  speed.default_value = 0.5;
  ParamContract mode;
  mode.name = "mode";
  mode.type = ParamType::text;
  mode.choices = {"calm", "bold"};
  mode.default_value = std::string("calm");
  const Result<ParamValues> kept =
      inherited({speed, mode}, {{"speed", 0.8}, {"mode", std::string("bold")}, {"gone", 1.0}}, {});
  REQUIRE(kept);
  CHECK(*kept == ParamValues{{"speed", 0.8}, {"mode", std::string("bold")}});
  CHECK(inherited({speed}, {{"speed", std::string("fast")}}, {{"speed", "0.3"}}).value() ==
        ParamValues{{"speed", 0.3}});
  CHECK_FALSE(inherited({speed}, {}, {{"speed", "1.3"}}));
  ParamContract size = speed;
  size.name = "size";
  size.fixed = true;  // while an object runs
  CHECK(inherited({size}, {{"size", 0.8}}, {{"size", "0.3"}}).value() == ParamValues{{"size", 0.3}});
  const Result<ParamValues> wrong =
      inherited({speed, mode}, {{"speed", 1.2}, {"mode", std::string("wild")}}, {});
  REQUIRE_FALSE(wrong);
  CHECK_THAT(wrong.error().message, Contains("\"speed\" is out of the new one's range"));
  CHECK_THAT(wrong.error().message, Contains("\"mode\" is \"wild\", which is not one of: calm, bold"));
  CHECK_THAT(inherited({speed}, {{"speed", std::string("fast")}}, {}).error().message,
             Contains("\"speed\" is number in the new one"));
}

TEST_CASE("a bad new version is refused with a reason, and the old one goes on as if nothing had been",
          "[host][swap]") {
  struct Case {
    std::string plugin;
    std::string type;
    std::string text;
  };
  const std::vector<Case> cases{
      {"test_teller_constructor", "", "no teller today"},
      {"test_teller_configure", "", "configure() said: parameter \"step\": is not liked today"},
      {"test_teller_start", "",
       "the new one was not taken: start() threw std::runtime_error: no start today"},
      {"test_teller_load", "",
       "the new one was not taken: load_state() threw std::runtime_error: no state for me"},
      {"test_teller_short", "", "values are left in the state after the 1 that were read"},
      {"test_teller_odd", "", "value 1 of the state is a whole number, where a text is expected"},
      {"test_teller_port", "", "it has no port \"in\", a PushProxy of MotionCommand, which is connected"},
      {"test_teller_2", "test.Unknown", "has no component type \"test.Unknown\"; it has: test.Teller"}};
  LiveSystem calm(kPair);
  calm.run(virtual_executives().front(), [](LiveSystem& run) { run.sleep(200ms); });
  const Words expected = beginning(calm.news(), "heard");
  for (const Case& bad : cases) {
    INFO(bad.plugin);
    LiveSystem live(kPair);
    live.run(virtual_executives().front(), [&](LiveSystem& run) {
      run.sleep(100ms);
      SwapOrder wanted = next_teller(bad.plugin);
      wanted.type = bad.type;
      CHECK_THAT(refusal(run, std::move(wanted)), Contains(bad.text));
      run.sleep(100ms);
      CHECK(run.state("teller") == ComponentState::work);
    });
    const Words said = live.news();
    CHECK(beginning(said, "gap").empty());
    CHECK(beginning(said, "poke").empty());
    CHECK(beginning(said, "heard") == expected);
  }
}

TEST_CASE("an old version that cannot say its state stays where it is", "[host][swap]") {
  LiveSystem live(
      R"(<component name="teller" type="test.MuteTeller"/><component name="talker" type="test.Talker"/>
    <connect from="talker.out" to="teller.in"/><connect from="talker.poke" to="teller.poke"/>
    <connect from="teller.out" to="talker.back"/>)");
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(50ms);
    SwapOrder other = next_teller("test_teller_2");
    other.type = "test.Teller";
    CHECK_THAT(refusal(run, std::move(other)),
               Contains("save_state() threw std::runtime_error: no state today"));
    CHECK(run.state("teller") == ComponentState::work);
  });
}

TEST_CASE("a new version that fails on probation goes, and the old one is back before the next object",
          "[host][swap]") {
  for (const std::string plugin : {"test_teller_first_lap", "test_teller_third_lap", "test_teller_handler"}) {
    LiveSystem live(kPair);
    live.run(virtual_executives().front(), [&](LiveSystem& run) {
      run.sleep(100ms);
      CHECK_THAT(refusal(run, next_teller(plugin)),
                 Contains("the new one failed, and the old one is back: "));
      run.sleep(100ms);
      CHECK(run.state("teller") == ComponentState::work);
      CHECK_FALSE(run.system().component("teller")->has_failed());
      CHECK(swap(run, next_teller("test_teller_2")));
    });
    CHECK(beginning(live.news(), "not sent").empty());
  }
}

TEST_CASE("a new version that fails after its probation has failed", "[host][swap]") {
  LiveSystem live(kPair);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    SwapOrder quick = next_teller("test_teller_third_lap");
    quick.probation = 5ms;
    run.sleep(100ms);
    CHECK(swap(run, std::move(quick)));
    run.sleep(100ms);
    CHECK(run.system().component("teller")->has_failed());
    CHECK(swap(run, next_teller("test_teller_2")));
    run.sleep(100ms);
    CHECK(run.state("teller") == ComponentState::work);
  });
}

TEST_CASE("the component that pushes and sends is exchanged, and its receivers miss and repeat nothing",
          "[host][swap]") {
  for (const ExecutiveOptions& kind : all_executives()) {
    LiveSystem live(kPair);
    live.run(kind, [](LiveSystem& run) {
      run.sleep(100ms);
      SwapOrder sender = next_teller("test_talker_again");
      sender.component = "talker";
      sender.probation = 50ms;
      const Result<SwapReport> done = swap(run, std::move(sender));
      REQUIRE(done);
      CHECK(done->state == "test.Talker/1");
      run.sleep(100ms);
    });
    const Words said = live.news();
    CHECK(beginning(said, "gap").empty());
    CHECK(beginning(said, "poke").empty());
    CHECK(beginning(said, "not sent").empty());
    CHECK(beginning(said, "heard twice").empty());
    CHECK(beginning(said, "heard").size() > 15);
  }
}

TEST_CASE("a second swap of a component waits until the first one is done: it is refused", "[host][swap]") {
  LiveSystem live(kPair);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    Swaps swaps(run.graph(), run.context(), run.catalogue(), run.system());
    std::vector<std::string> outcomes;
    const auto note = [&](const Result<SwapReport>& result) {
      outcomes.push_back(result ? "taken" : result.error().text());
    };
    swaps.begin(next_teller("test_teller_2"), note);
    swaps.begin(next_teller("test_teller_2"), note);
    while (outcomes.size() < 2) {
      const TimePoint next = swaps.go_on();
      if (outcomes.size() < 2) run.changed().wait_until(next);
    }
    CHECK_THAT(outcomes[0], Contains("another swap of it is under way"));
    CHECK(outcomes[1] == "taken");
    SwapOrder unknown = next_teller("test_teller_2");
    unknown.component = "taly";
    swaps.begin(std::move(unknown), note);
    CHECK_THAT(outcomes[2], Contains("there is no component \"taly\""));
  });
}

TEST_CASE("runs in virtual time with a swap repeat each other", "[host][swap]") {
  std::vector<Words> runs;
  for (const ExecutiveOptions& kind : virtual_executives()) {
    LiveSystem live(kPair);
    live.run(kind, [](LiveSystem& run) {
      run.sleep(100ms);
      CHECK(swap(run, next_teller("test_teller_2")));
      run.sleep(100ms);
    });
    runs.push_back(live.news());
  }
  for (const Words& other : runs) CHECK(other == runs.front());
}

TEST_CASE("a suspended component is exchanged too, and the new object is suspended until it is resumed",
          "[host][swap]") {
  LiveSystem live(kPair);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(100ms);
    REQUIRE(run.suspend("teller").ok());
    (void)run.news();
    SwapOrder next = next_teller("test_teller_2");
    next.probation = 10ms;
    const Result<SwapReport> done = swap(run, std::move(next));
    REQUIRE(done);
    CHECK(done->state == "test.Teller/1");
    CHECK(run.state("teller") == ComponentState::suspended_work);
    run.sleep(50ms);
    const Words before = run.news();
    CHECK(beginning(before, "s") == Words{"start 2", "suspend 2"});
    CHECK(beginning(before, "heard").empty());
    REQUIRE(run.resume("teller").ok());
    run.sleep(50ms);
    CHECK(beginning(run.news(), "resume") == Words{"resume 2"});
  });
  const Words said = live.news();
  CHECK(beginning(said, "gap").empty());
  CHECK(beginning(said, "poke").empty());
}

TEST_CASE("an old object that comes back after a pause is resumed as the component was", "[host][swap]") {
  LiveSystem live(kPair);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(100ms);
    REQUIRE(run.suspend("teller").ok());
    std::optional<Result<SwapReport>> outcome;
    host::Swaps swaps(run.graph(), run.context(), run.catalogue(), run.system());
    swaps.begin(next_teller("test_teller_first_lap"),
                [&](const Result<SwapReport>& result) { outcome = result; });
    for (const TimePoint end = run.executive().now() + 100ms; run.executive().now() < end;) {
      (void)swaps.go_on();
      run.changed().wait_until(end);
    }
    REQUIRE_FALSE(outcome);
    (void)run.news();
    REQUIRE(run.resume("teller").ok());
    while (!outcome) {
      const TimePoint next = swaps.go_on();
      if (!outcome) run.changed().wait_until(next);
    }
    CHECK_FALSE(*outcome);
    run.sleep(50ms);
    CHECK(run.state("teller") == ComponentState::work);
    const Words said = run.news();
    CHECK(beginning(said, "resume") == Words{"resume 2", "resume 1"});
    CHECK_FALSE(beginning(said, "heard 1").empty());
  });
}

TEST_CASE("a component that is not loaded begins with the new code when somebody needs it", "[host][swap]") {
  LiveSystem live(R"(<component name="teller" type="test.Teller" start="on_demand"/>
    <component name="talker" type="test.Talker" autonomous="false"/>
    <connect from="talker.out" to="teller.in"/><connect from="talker.poke" to="teller.poke"/>
    <connect from="teller.out" to="talker.back"/>)");
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(100ms);
    REQUIRE(run.state("teller") == ComponentState::unloaded);
    SwapOrder next = next_teller("test_teller_2");
    next.params["step"] = "4";
    const std::string name = next.plugin.mapped_name();
    const Result<SwapReport> done = swap(run, std::move(next));
    INFO((done ? "" : done.error().text()));
    REQUIRE(done);
    CHECK(run.state("teller") == ComponentState::unloaded);
    CHECK(plugin::is_mapped(name));
    CHECK(std::get<std::int64_t>(run.system().component("teller")->parts().params.values().at("step")) == 4);
    REQUIRE(swap(run, next_teller("test_teller_again")));
    CHECK_FALSE(plugin::is_mapped(name));
  });
}

namespace {

const std::string kPeriodicPair = R"(<component name="teller" type="test.Teller" period="10 ms"/>
  <component name="talker" type="test.Talker"/>
  <connect from="talker.out" to="teller.in" queue="100"/>
  <connect from="talker.poke" to="teller.poke" queue="100"/>
  <connect from="teller.out" to="talker.back" queue="100"/>)";

}  // namespace

TEST_CASE("new code is not blamed for late laps if those of the old one were as late", "[host][swap]") {
  LiveSystem live(kPeriodicPair);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    SwapOrder slow = next_teller("test_teller_laps_slow");
    slow.probation = Duration{0};
    REQUIRE(swap(run, std::move(slow)));
    run.sleep(5s);
    CHECK(swap(run, next_teller("test_teller_laps_slow")));
  });
}

TEST_CASE("new code whose laps take longer than their period goes, and the old one is back", "[host][swap]") {
  LiveSystem live(kPeriodicPair);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(100ms);
    CHECK_THAT(refusal(run, next_teller("test_teller_laps_slow")),
               Contains("3 of its laps took longer than their period of 0.01 s"));
    run.sleep(100ms);
    CHECK(run.state("teller") == ComponentState::work);
  });
}
