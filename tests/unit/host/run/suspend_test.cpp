// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "live_system.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Words = std::vector<std::string>;
using Catch::Contains;

namespace {

const std::string kIdle = R"(<component name="life" type="test.Life"/>)";

}  // namespace

TEST_CASE("a suspended component does nothing until it is resumed", "[host][suspend]") {
  for (const ExecutiveOptions& kind : virtual_executives()) {
    LiveSystem live(kAutonomousLife);
    live.run(kind, [](LiveSystem& run) {
      run.sleep(150ms);
      CHECK(run.suspend("life").ok());
      CHECK(run.state("life") == ComponentState::suspended_work);
      CHECK(run.news().back() == "suspend");
      run.sleep(10s);
      CHECK(run.news().empty());
      CHECK(run.resume("life").ok());
      CHECK(run.state("life") == ComponentState::work);
      run.sleep(50ms);
      CHECK(run.news() == Words{"resume", "work 1-2"});
    });
  }
}

TEST_CASE("an object sent to a suspended component waits, and is handled once it is resumed",
          "[host][suspend]") {
  LiveSystem live(kIdle + R"(<component name="user" type="test.User"/>
    <connect from="user.send" to="life.poke"/>)");
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    CHECK(run.suspend("life").ok());
    run.sleep(1500ms);
    CHECK(run.diary.has("user sent ok"));
    CHECK_FALSE(run.diary.has("poked hello"));
    CHECK(run.resume("life").ok());
    run.sleep(1ms);
    CHECK(run.diary.has("poked hello"));
  });
}

TEST_CASE("all that waits for a component is handled before it starts to work", "[host][suspend]") {
  LiveSystem live(kAutonomousLife +
                  R"(<component name="user" type="test.User"/><component name="other" type="test.User"/>
    <connect from="user.send" to="life.poke"/><connect from="other.send" to="life.poke"/>)");
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    CHECK(run.suspend("life").ok());
    run.sleep(1500ms);
    (void)run.news();
    CHECK(run.resume("life").ok());
    run.sleep(50ms);
    CHECK(run.news() == Words{"resume", "poked hello", "poked hello", "start", "work 1-2"});
  });
}

TEST_CASE("a lap that only waits is cancelled to suspend the component", "[host][suspend]") {
  LiveSystem live(R"(<component name="life" type="test.Life" autonomous="true">
      <param name="mode" value="waits"/></component>
    <component name="other" type="test.Life"/>
    <connect from="other.out" to="life.in"/>
    <component name="mute" type="test.User"/>)");
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(1ms);
    CHECK(run.suspend("life").ok());
    CHECK(run.state("life") == ComponentState::suspended_work);
  });
}

TEST_CASE("a lap that only waits is cancelled for a sent object, and begins anew", "[host][states]") {
  LiveSystem live(R"(<component name="life" type="test.Life" autonomous="true">
      <param name="mode" value="waits"/></component>
    <component name="user" type="test.User"/>
    <connect from="user.send" to="life.poke"/><connect from="user.query" to="life.ask"/>)");
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(500ms);
    (void)run.news();
    run.sleep(1s);
    CHECK(run.news() == Words{"user sent ok", "poked hello", "work 1-2", "user answer life"});
    CHECK(run.state("life") == ComponentState::work);
  });
}

TEST_CASE("only an idle or working component can be suspended, and only a suspended one resumed",
          "[host][suspend]") {
  LiveSystem live(kIdle);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    CHECK_THAT(run.resume("life").error().text(), Contains("it is IDLE, not SUSPENDED"));
    CHECK(run.suspend("life").ok());
    CHECK_THAT(run.suspend("life").error().text(), Contains("it is SUSPENDED"));
    CHECK_THAT(run.suspend("live").error().text(),
               Contains("there is no component \"live\"; the system has: life"));
  });
}

TEST_CASE("a system with a suspended component can be taken down", "[host][suspend]") {
  LiveSystem live(kAutonomousLife);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(10ms);
    CHECK(run.suspend("life").ok());
  });
  CHECK(live.news().back() == "stop");
}
