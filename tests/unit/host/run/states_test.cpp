// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>

#include "live_system.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Words = std::vector<std::string>;

namespace {

std::string life_in_mode(const std::string& mode) {
  return R"(<component name="life" type="test.Life"><param name="mode" value=")" + mode +
         R"("/></component>)";
}
const std::string kTwoUsers = R"(
  <component name="first" type="test.User"><param name="from" value="1"/><param name="until" value="2"/></component>
  <component name="second" type="test.User"><param name="from" value="3"/><param name="until" value="4"/></component>
  <connect from="life.out" to="first.push"/>
  <connect from="life.out" to="second.push"/>)";

}  // namespace

TEST_CASE("a component works from its first client to its last", "[host][states]") {
  for (const ExecutiveOptions& kind : virtual_executives()) {
    LiveSystem live(life_in_mode("") + kTwoUsers);
    live.run(kind, [](LiveSystem& run) {
      run.sleep(950ms);
      CHECK(run.state("life") == ComponentState::idle);
      CHECK(run.news() == Words{"configure"});
      run.sleep(200ms);
      CHECK(run.state("life") == ComponentState::work);
      CHECK(run.news() == Words{"start", "work 1-2", "work 1-2"});
      run.sleep(900ms);
      CHECK(run.state("life") == ComponentState::idle);
      CHECK(run.news().back() == "stop");
      run.sleep(1s);
      CHECK(run.state("life") == ComponentState::work);
    });
  }
}

TEST_CASE("after a failure that it reported itself a component is idle again when its clients have gone",
          "[host][states]") {
  const std::string mode = GENERATE("start fails", "work fails");
  LiveSystem live(life_in_mode(mode) + kTwoUsers);
  live.run(virtual_executives().front(), [&](LiveSystem& run) {
    run.sleep(1500ms);
    CHECK(run.state("life") == ComponentState::work_failed);
    CHECK(run.system().component("life")->has_failed());
    run.sleep(1s);
    CHECK(run.state("life") == ComponentState::idle);
    (void)run.news();
    run.sleep(1s);
    CHECK(run.news().front() == "start");  // the second client lets it try again
    CHECK(run.state("life") == ComponentState::work_failed);
  });
}

TEST_CASE("a component that waits in start() when the system ends is stopped and ends at once",
          "[host][states]") {
  for (const ExecutiveOptions& kind : all_executives()) {
    LiveSystem live(R"(<component name="life" type="test.Life" autonomous="true">
        <param name="mode" value="start waits"/></component>
      <component name="mute" type="test.Life"><param name="mode" value="work fails"/></component>
      <connect from="mute.out" to="life.in"/>)");
    live.run(kind, [](LiveSystem& run) {
      CHECK(eventually(run.executive(), [&] { return run.diary.has("start"); }));
      CHECK(run.state("life") == ComponentState::connect);
    });
    CHECK(live.news().back() == "stop");
  }
}

TEST_CASE("a stop() that throws is called once, and its component stays in WORK_FAILED", "[host][states]") {
  LiveSystem live(life_in_mode("stop throws") + kTwoUsers);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(5s);
    CHECK(run.state("life") == ComponentState::broken);
    CHECK(run.system().component("life")->failure() == "stop() threw std::runtime_error: no stop today");
    CHECK(std::ranges::count(run.news(), "stop") == 1);
  });
  CHECK(live.news().empty());
}

TEST_CASE("a component that threw stays in WORK_FAILED, with the text", "[host][states]") {
  LiveSystem live(life_in_mode("work throws") + kTwoUsers);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(5s);
    CHECK(run.state("life") == ComponentState::broken);
    CHECK(run.system().component("life")->failure() == "work() threw std::runtime_error: no work today");
  });
}

TEST_CASE("laps that configure() lets follow each other without a pause fail, as in a constructor",
          "[host][states]") {
  LiveSystem live(R"(<component name="life" type="test.Life" start="on_demand">
      <param name="mode" value="configure laps without a pause"/></component>)" +
                  kTwoUsers);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(5s);
    CHECK(run.state("life") == ComponentState::broken);
    CHECK(run.system().component("life")->failure() ==
          "configure() threw std::logic_error: its laps start every 0 s; a period is 1 us or longer");
  });
}

TEST_CASE("a port or parameter that is made after the constructor is named, with what to do",
          "[host][states]") {
  for (const std::string what : {"port", "parameter"}) {
    LiveSystem live(life_in_mode("work makes a " + what) + kTwoUsers);
    live.run(virtual_executives().front(), [&](LiveSystem& run) {
      run.sleep(5s);
      CHECK(run.system().component("life")->failure() ==
            "work() threw std::logic_error: it makes its " + what +
                " \"late\" after its constructor, too late for the graph; make it a member of the class");
    });
  }
}
