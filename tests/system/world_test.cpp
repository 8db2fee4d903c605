// SPDX-License-Identifier: GPL-3.0-or-later
// The simulated world seen and changed while a system runs: by a component in virtual time, and by orcactl.
#include <catch2/catch.hpp>

#include <functional>
#include <string>
#include <thread>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

Run drive(const Words& more) {
  return run_deployer(Words{system_graph("world.xml"), "--until", "60 s"} + more + with_test_plugins() +
                      virtual_clock());
}

const Words kGotoOnly{"--set", "behaviours=goto"};

// The scout's graph in host processes.
class Scout {
 public:
  Scout() : program_(deployer({source_file("graphs/scout_goto_processes.xml")})) {
    REQUIRE(comes_true([] { return run_orcactl({"ps"}).out.find(" WORK ") != std::string::npos; }));
  }
  ~Scout() {
    (void)run_orcactl({"stop"});
    (void)finish(program_, Seconds(10));
  }

  // Sends a change and returns what is said to it.
  static Run change(const std::string& attributes) {
    return run_orcactl({"send", "world.ChangeSend", "<WorldChange " + attributes + "/>"});
  }
  static std::string scene() {
    const Run run = run_orcactl({"echo", "world.ScenePush", "--count", "1", "--for", "10s"});
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    return run.out;
  }
  static bool comes_true(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return true;
  }
  static bool world_is(const std::string& state) {
    for (const std::string& line : split_lines(run_orcactl({"ps"}).out))
      if (line.rfind("world ", 0) == 0) return line.find(" " + state + " ") != std::string::npos;
    return false;
  }

 private:
  Subprocess program_;
};

}  // namespace

TEST_CASE("a robot drives round an obstacle that comes while it drives, and touches it without avoider",
          "[system][world]") {
  const Run alone = drive(kGotoOnly + Words{"--profile", "alone"});
  INFO(alone.err);
  CHECK(alone.contacts().empty());
  CHECK(alone.arrivals().size() == 1);
  const Run blind = drive(kGotoOnly);
  INFO(blind.err);
  CHECK(blind.says("by order of meddler: crate comes to (5, 3) m"));
  CHECK(blind.says("the crate is there"));
  REQUIRE_FALSE(blind.contacts().empty());
  CHECK(blind.says("Dewey touches crate"));
  CHECK(blind.arrivals().empty());
  const Run seeing = drive({});
  INFO(seeing.err);
  CHECK(seeing.contacts().empty());
  CHECK(seeing.arrivals().size() == 1);
}

TEST_CASE("a run in which the world is changed repeats exactly", "[system][world]") {
  const Run first = drive({});
  INFO(first.err);
  REQUIRE(first.trace_hash());
  CHECK(drive({}).trace_hash() == first.trace_hash());
  CHECK(drive({"--set", "x=5.2 m"}).trace_hash() != first.trace_hash());
}

TEST_CASE("a change in the robot's way is refused to the component that sends it", "[system][world]") {
  const Run run = drive({"--set", "meddler.at=0.01 s", "--set", "x=2.1 m"});
  INFO(run.err);
  CHECK(run.says("meddler: refused: obstacle 'crate' cannot stand at (2.10, 3.00) m: robot"));
  CHECK(run.arrivals().size() == 1);
}

TEST_CASE("with real hardware there is no world to see or change, and the graph is refused",
          "[system][world]") {
  const TempFolder folder;
  const std::string graph =
      folder.write("real.xml", R"(<graph name="real" version="1" plugins=")" ORCA_BINARY_DIR
                               R"(/tests/plugins">
  <hardware name="pioneer" type="orca.hw.P2os"><param name="device" value="/dev/null"/></hardware>
  <component name="base" type="orca.RobotBaseServer" hardware="pioneer" autonomous="true"/>
  <component name="world" type="orca.WorldServer" hardware="pioneer"/>
  <component name="meddler" type="test.Meddler"/>
  <connect from="meddler.world" to="world.ChangeSend"/>
</graph>)");
  const Run run = run_deployer({graph, "--check"});
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.says("port \"ChangeSend\" does not exist"));
}

TEST_CASE("a recording that has the scene makes the world server work, and changes nothing",
          "[system][world]") {
  const TempFolder folder;
  const Run plain = drive({});
  REQUIRE(plain.trace_hash());
  const std::string file = folder.file("scene.csv");
  const Run recorded = drive({"--record", file + "=world.ScenePush"});
  INFO(recorded.err);
  CHECK(recorded.trace_hash() == plain.trace_hash());
  REQUIRE(recorded.arrivals().size() == 1);
  const auto scenes = static_cast<double>(split_lines(read_text(file)).size() - 1);
  CHECK(scenes / 10.0 == Approx(recorded.arrivals()[0].t).margin(2.0));
}

TEST_CASE("orcactl sees the world and changes it, and is refused with the reason", "[system][world]") {
  const Scout scout;
  CHECK(Scout::world_is("IDLE"));
  CHECK_THAT(Scout::scene(), Contains("name=\"Dewey\""));
  CHECK(Scout::comes_true([] { return Scout::world_is("IDLE"); }));

  const Run plan = run_orcactl({"query", "world.PlanQuery", "<Ask/>"});
  INFO(plan.err);
  CHECK_THAT(plan.out, Contains("name=\"kitchen\"") && Contains("walls"));

  const std::string crate =
      R"(kind="PUT_OBSTACLE" name="crate" x="14 m" y="2 m" length="0.5 m" width="0.4 m")";
  const Run put = Scout::change(crate);
  INFO(put.err);
  CHECK(put.exit_code() == 0);
  CHECK_THAT(Scout::scene(), Contains("name=\"crate\"") && Contains("crate comes to (14, 2) m"));
  CHECK_THAT(Scout::scene(), Contains("mission=\"0\""));  // It answers nobody.
  const Run again = Scout::change(crate);
  CHECK(again.exit_code() == 1);
  CHECK_THAT(again.err, Contains("there is a 'crate' already; choose another name"));
  CHECK(Scout::change(R"(kind="TAKE_OBSTACLE" name="crate")").exit_code() == 0);
  CHECK_THAT(Scout::scene(), !Contains("name=\"crate\" "));

  CHECK(Scout::change(R"(kind="SILENCE_SENSOR" name="Dewey" sensor="sonar")").exit_code() == 0);
  CHECK_THAT(Scout::scene(), Contains("sonar of Dewey fails"));
}
