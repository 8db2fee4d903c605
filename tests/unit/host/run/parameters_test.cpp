// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "live_system.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Words = std::vector<std::string>;
using Catch::Contains;

namespace {

std::int64_t number_param(LiveSystem& run, const std::string& param) {
  return std::get<std::int64_t>(run.system().component("life")->parts().params.values().at(param));
}

}  // namespace

TEST_CASE("parameters change together between two laps", "[host][params]") {
  for (const ExecutiveOptions& kind : virtual_executives()) {
    LiveSystem live(kAutonomousLife);
    live.run(kind, [](LiveSystem& run) {
      run.sleep(50ms);
      CHECK(run.set("life", {{"low", "5"}, {"high", "7"}, {"size", "250 cm"}}).ok());
      run.sleep(100ms);
      CHECK(run.news() == Words{"configure", "start", "work 1-2", "params 5-7", "work 5-7"});
      CHECK(number_param(run, "high") == 7);
      CHECK(std::get<double>(run.system().component("life")->parts().params.values().at("size")) == 2.5);
    });
  }
}

TEST_CASE("values that the component does not accept leave all as it was", "[host][params]") {
  LiveSystem live(kAutonomousLife);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    const Status set = run.set("life", {{"low", "9"}, {"size", "2 m"}});
    CHECK_THAT(set.error().text(), Contains("low is above high"));
    CHECK(number_param(run, "low") == 1);
    run.sleep(10ms);
    CHECK(run.news().back() == "work 1-2");
    CHECK(run.state("life") == ComponentState::work);
  });
}

TEST_CASE("all wrong values are reported at once, and none is taken", "[host][params]") {
  LiveSystem live(kAutonomousLife);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    const Status set = run.set("life", {{"hihg", "1"}, {"low", "1000"}, {"size", "2 s"}, {"label", "b"}});
    CHECK(set.error().code == Code::invalid_argument);
    CHECK_THAT(set.error().text(), Contains("there is no parameter \"hihg\"") &&
                                       Contains("did you mean \"high\"?") &&
                                       Contains("\"1000\" is out of range: 0 to 100 is allowed") &&
                                       Contains("parameter \"size\"") &&
                                       Contains("\"label\" cannot change while the component runs"));
    CHECK(number_param(run, "low") == 1);
  });
}

TEST_CASE("an exception at new values fails the component, which keeps the old ones", "[host][params]") {
  LiveSystem live(kAutonomousLife);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    CHECK_THAT(run.set("life", {{"mode", "params throw"}}).error().text(),
               Contains("params_changed() threw"));
    CHECK(run.state("life") == ComponentState::broken);
    CHECK(std::get<std::string>(run.system().component("life")->parts().params.values().at("mode")).empty());
  });
}

TEST_CASE("values are refused by a lap that does not end in time, and not taken when it ends",
          "[host][params]") {
  LiveSystem live(R"(<component name="slow" type="test.User">
    <param name="from" value="0 s"/><param name="until" value="60 s"/></component>
    <component name="life" type="test.Life"/><connect from="slow.send" to="life.poke"/>)");
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(1s);  // it has sent something: its lap is not given up
    const Status set = run.set("slow", {{"until", "70 s"}});
    CHECK(set.error().code == Code::deadline_exceeded);
    CHECK_THAT(set.error().text(), Contains("it is in work()"));
    run.sleep(60s);
    CHECK(std::get<double>(run.system().component("slow")->parts().params.values().at("until")) == 60.0);
  });
}
