// SPDX-License-Identifier: GPL-3.0-or-later
// Tasks that set parameters of other components, by a right that the graph gives.
#include <catch2/catch.hpp>

#include <cmath>
#include <regex>
#include <string>
#include <utility>

#include "deployer.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

Run do_task(const std::string& file, const Words& more = {}) {
  return run_deployer(
      Words{source_file("graphs/pioneer_tasks.xml"), "--set", "task=" + file} + virtual_clock() + more,
      Seconds(120));
}

Run run_task(const std::string& steps, const Words& more = {}) {
  const TempFolder folder;
  return do_task(folder.write("task.xml", "<task name=\"test\" version=\"1\">\n" + steps + "\n</task>\n"),
                 more);
}

}  // namespace

TEST_CASE("a robot leads a slow visitor slowly, and comes back at its own speed", "[system][rights]") {
  constexpr double kWalks = 0.3;  // [m/s]
  const auto legs = [](const Run& run) {
    REQUIRE(run.goals() == Words{"office_2", "start"});
    return std::pair{run.arrivals()[0].t, run.arrivals()[1].t - run.arrivals()[0].t};
  };
  const std::string guide = source_file("graphs/tasks/guide.xml");
  const Run run = do_task(guide);
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.contacts().empty());
  CHECK(run.says("task has set max_speed to 0.3"));
  CHECK(run.says("task has set max_speed to 0.5"));
  CHECK(do_task(guide).trace_hash() == run.trace_hash());
  std::string unled = read_text(source_file("graphs/tasks/guide.xml"));
  unled.replace(unled.find(R"(to="0.3 m/s")"), 12, R"(to="0.5 m/s")");
  const TempFolder folder;
  const Run fast = do_task(folder.write("guide.xml", unled));
  const auto [there, back] = legs(run);
  const auto [there_fast, back_fast] = legs(fast);
  // Who walks behind the fast one at 0.3 m/s is left behind by so much.
  const double left_behind = kWalks * (there - there_fast);
  CAPTURE(there, back, there_fast, back_fast, left_behind);
  CHECK(left_behind > 3.0);
  CHECK(back < 0.75 * there);
  CHECK(std::fabs(back - back_fast) < 3.0);
}

TEST_CASE("a robot that roams drives to rooms sooner because its task suspends what makes it roam",
          "[system][rights]") {
  const auto roam = [](const std::string& task) {
    Run run =
        run_deployer(Words{source_file("graphs/pioneer_roam.xml"), "--set", "task=" + task} + virtual_clock(),
                     Seconds(120));
    INFO(run.err);
    CHECK(run.goals() == Words{"kitchen", "library", "office_2", "start"});
    CHECK(run.contacts().empty());
    return run;
  };
  constexpr double kRoams = 240.0;  // [s] in four parts, before each drive
  const std::string file = source_file("graphs/tasks/roam.xml");
  const Run run = roam(file);
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("walk: task has suspended it"));
  CHECK(run.says("walk: task has let it go on"));
  if (is_slow_run()) CHECK(roam(file).trace_hash() == run.trace_hash());

  const TempFolder folder;
  const std::string unquiet = std::regex_replace(read_text(file), std::regex("</?Suspend[^>]*>"), "");
  const Run pulled = roam(folder.write("roam.xml", unquiet));
  CHECK_FALSE(pulled.says("suspended"));
  CHECK(pulled.arrivals().back().t - kRoams > 1.25 * (run.arrivals().back().t - kRoams));
}

TEST_CASE("a task may suspend only what its graph lets it", "[system][rights]") {
  const Run refused = run_task(R"(<Suspend component="gate"><Wait for="1 s"/></Suspend>
<Suspend component=""><Wait for="1 s"/></Suspend>
<Parallel><Suspend component="a"><Wait for="1 s"/></Suspend><Suspend component="a"><Wait for="1 s"/></Suspend></Parallel>)",
                               {"--check"});
  INFO(refused.err);
  CHECK(refused.exit_code() == 2);
  CHECK(refused.says(
      "task.xml:2:1: error K014: the graph does not let this task suspend gate; add may_suspend="));
  CHECK(refused.says("task.xml:3:21: error K007"));
  CHECK(refused.says("task.xml:4:1: error K011: two branches of <Parallel> suspend a at the same time"));
}

TEST_CASE("a task may set only what its graph lets it", "[system][rights]") {
  const Run refused = run_task(R"(<With set="pilot.margin" to="0.1 m"><Wait for="1 s"/></With>
<With set="pilot.max_speed" to="0.3 m/s"><Wait for="1 s"/></With>
<With set="plot.max_speed" to="0.3 m/s"><Wait for="1 s"/></With>)",
                               {"--check"});
  INFO(refused.err);
  CHECK(refused.exit_code() == 2);
  CHECK(refused.says(
      "task.xml:2:1: error K014: the graph does not let this task set pilot.margin; add may_set="));
  CHECK(refused.says("task.xml:4:1: error K014"));
  CHECK_FALSE(refused.says("task.xml:3:1"));

  SECTION("and no value that the parameter does not take") {
    const Run run = run_task(R"(<With set="pilot.max_speed" to="0.3 kg"><Wait for="1 s"/></With>)");
    INFO(run.err);
    CHECK(run.exit_code() == 1);
    CHECK(run.says("refused: "));
  }
}
