// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "live_system.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Words = std::vector<std::string>;

namespace {

std::string sleepy_life(const std::string& attributes) {
  return R"(<component name="life" type="test.Life" start="on_demand" )" + attributes + "/>";
}
std::string busy_user(const std::string& name, double from, double until) {
  return "<component name=\"" + name + R"(" type="test.User"><param name="from" value=")" +
         std::to_string(from) + R"("/><param name="until" value=")" + std::to_string(until) +
         R"("/></component>)";
}
bool in_memory() { return plugin::is_mapped(host_plugin("test_life")); }

}  // namespace

TEST_CASE("a component on demand is loaded by its first client and unloaded when long unused",
          "[host][on_demand]") {
  for (const ExecutiveOptions& kind : virtual_executives()) {
    LiveSystem live(sleepy_life("idle_time=\"2 s\"") + busy_user("user", 1, 2) + busy_user("late", 5, 6) +
                    R"(<connect from="life.out" to="user.push"/><connect from="life.out" to="late.push"/>)");
    live.run(kind, [](LiveSystem& run) {
      run.sleep(500ms);
      CHECK(run.state("life") == ComponentState::unloaded);
      CHECK_FALSE(in_memory());
      run.sleep(1s);
      CHECK(run.state("life") == ComponentState::work);
      CHECK(in_memory());
      run.sleep(1s);  // 2.5 s: the client has gone
      CHECK(run.state("life") == ComponentState::idle);
      CHECK(in_memory());
      run.sleep(2s);  // 4.5 s
      CHECK(run.state("life") == ComponentState::unloaded);
      CHECK_FALSE(in_memory());
      (void)run.news();
      run.sleep(1s);  // 5.5 s
      CHECK(run.state("life") == ComponentState::work);
      const Words news = run.news();
      CHECK(Words(news.begin(), news.begin() + 3) == Words{"configure", "start", "work 1-2"});
    });
    CHECK_FALSE(in_memory());
  }
}

TEST_CASE("objects and queries to an unloaded component wait until it is loaded", "[host][on_demand]") {
  LiveSystem live(sleepy_life("idle_time=\"1 s\"") + busy_user("user", 1, 2) +
                  R"(<connect from="user.send" to="life.poke"/><connect from="user.query" to="life.ask"/>)");
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(1500ms);
    CHECK(run.diary.has("user sent ok"));
    CHECK(run.diary.has("poked hello"));
    CHECK(run.diary.has("user answer life"));
    CHECK(run.state("life") == ComponentState::idle);
    run.sleep(1s);
    CHECK(run.state("life") == ComponentState::unloaded);
  });
}

TEST_CASE("a component that is to stay warm stays loaded once it has been used", "[host][on_demand]") {
  LiveSystem live(sleepy_life("stay=\"warm\"") + busy_user("user", 1, 2) +
                  R"(<connect from="life.out" to="user.push"/>)");
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    CHECK_FALSE(in_memory());
    run.sleep(1h);
    CHECK(run.state("life") == ComponentState::idle);
    CHECK(in_memory());
  });
}

TEST_CASE("changed parameters keep their values after unloading", "[host][on_demand]") {
  LiveSystem live(sleepy_life("idle_time=\"1 s\"") + busy_user("user", 1, 2) +
                  R"(<connect from="life.out" to="user.push"/>)");
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    CHECK(run.set("life", {{"low", "3"}, {"high", "4"}}).ok());  // not even loaded yet
    run.sleep(1500ms);
    CHECK(run.diary.has("work 3-4"));
  });
}

TEST_CASE("an on-demand component runs on threads of its own, too", "[host][on_demand]") {
  LiveSystem live(sleepy_life("idle_time=\"10 ms\"") + busy_user("user", 0.01, 0.02) +
                  R"(<connect from="life.out" to="user.push"/>)");
  live.run({ClockKind::steady, Backend::thread}, [](LiveSystem& run) {
    CHECK(eventually(run.executive(), [&] { return run.diary.has("start"); }));
    CHECK(eventually(run.executive(), [&] { return run.state("life") == ComponentState::unloaded; }));
    CHECK_FALSE(in_memory());
  });
}
