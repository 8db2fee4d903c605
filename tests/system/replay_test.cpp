// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings that are played into the components of today.
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <thread>

#include "bags.hpp"
#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

using namespace std::chrono_literals;

const std::string kReplay = source_file("graphs/replay.xml");

// Replays a recording into GridPlanner, and records that. Returns the trace hash.
std::string replay(const std::string& recording, const std::string& to, const Words& program = deployer({})) {
  Subprocess process(program +
                     Words{kReplay, "--set", "recording=" + recording, "--until", "20s", "--record", to} +
                     virtual_clock());
  const Run run = finish(process, Seconds(60));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  return run.trace_hash().value_or("none");
}

// Returns a deployer whose plugins are those of this build, but for GridPlanner, which was built a second time.
std::string with_rebuilt_planner(const TempFolder& folder) {
  namespace fs = std::filesystem;
  const fs::path root = folder.path() / "other";
  for (const char* const name : {"bin", "plugins"}) fs::create_directories(root / name);
  fs::copy_file(ORCA_BINARY_DIR "/bin/deployer", root / "bin/deployer");
  fs::create_directory_symlink(ORCA_BINARY_DIR "/lib", root / "lib");
  for (const fs::directory_entry& file : fs::directory_iterator(ORCA_BINARY_DIR "/plugins"))
    if (file.path().stem() != "grid_planner")
      fs::create_symlink(file.path(), root / "plugins" / file.path().filename());
  for (const char* const extension : {".so", ".types"})
    fs::copy_file(std::string(ORCA_BINARY_DIR "/tests/next_plugins/grid_planner_again") + extension,
                  root / "plugins" / (std::string("grid_planner") + extension));
  return (root / "bin/deployer").string();
}

std::string build_id_of(const std::string& plugin) {
  Subprocess reader({"/usr/bin/env", "readelf", "-n", plugin});
  const std::string shown = finish(reader, Seconds(20)).out;
  const std::size_t at = shown.find("Build ID: ");
  REQUIRE(at != std::string::npos);
  return shown.substr(at, 50);
}

}  // namespace

TEST_CASE(
    "sensors of real drivers that were recorded drive GridPlanner to the same commands each time, also one "
    "that was built anew",
    "[system][recording][replay]") {
  const TempFolder folder;
  const std::string recording = folder.file("drivers.mcap");
  const Run run = run_deployer(Words{source_file("graphs/pioneer2dx_sick.xml"), "--profile", "emulate",
                                     "--until", "20s", "--record", recording} +
                                   virtual_clock(),
                               Seconds(60));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  const Run itself = bag({"diff", recording, recording});  // the current of a battery is not a number
  INFO(itself.err);
  CHECK(itself.exit_code() == 0);
  const std::string once = folder.file("once.mcap");
  const std::string again = folder.file("again.mcap");
  const std::string hash = replay(recording, once);
  CHECK(hash == replay(recording, again));
  const Run compared = bag({"diff", once, again, "planner.MotionCmdPush", "fuser.base"});
  INFO(compared.err);
  CHECK(compared.exit_code() == 0);
  CHECK(count_in(info_of(once), "/planner/MotionCmdPush") > 100);
  // What the planner saw is what the drivers had read.
  CHECK(count_in(info_of(once), "/laser/LaserRangeReadingsPush") > 100);

  // A planner that was built anew from the same source takes the place of the other one.
  const std::string rebuilt = folder.file("rebuilt.mcap");
  const std::string other_build = with_rebuilt_planner(folder);
  CHECK(build_id_of(ORCA_BINARY_DIR "/plugins/grid_planner.so") !=
        build_id_of(ORCA_BINARY_DIR "/tests/next_plugins/grid_planner_again.so"));
  CHECK(replay(recording, rebuilt, {other_build}) == hash);
  const Run same = bag({"diff", once, rebuilt, "planner.MotionCmdPush", "fuser.base"});
  INFO(same.err);
  CHECK(same.exit_code() == 0);
}

TEST_CASE("a planner that takes another one's place in the middle of a replay gives the same commands",
          "[system][recording][replay]") {
  const TempFolder folder;
  const std::string recording = folder.file("drivers.mcap");
  REQUIRE(run_deployer(Words{source_file("graphs/pioneer2dx_sick.xml"), "--profile", "emulate", "--until",
                             "20s", "--record", recording} +
                           virtual_clock(),
                       Seconds(60))
              .exit_code() == 0);
  const std::string once = folder.file("once.mcap");
  replay(recording, once);

  const std::string swapped = folder.file("swapped.mcap");
  Subprocess process(deployer(Words{kReplay, "--set", "recording=" + recording, "--until", "20s", "--record",
                                    swapped, "--pace", "0"} +
                              virtual_clock()));
  for (int tries = 0; run_orcactl({"pace"}).exit_code() != 0; ++tries) {
    REQUIRE(tries < 200);
    std::this_thread::sleep_for(50ms);
  }
  REQUIRE(run_orcactl({"step", "9s"}).exit_code() == 0);
  Subprocess swap(orcactl({"swap", "planner", ORCA_BINARY_DIR "/tests/next_plugins/grid_planner_again.so"}));
  std::this_thread::sleep_for(100ms);
  REQUIRE(run_orcactl({"pace", "4"}).exit_code() == 0);
  const Run done = finish(swap, Seconds(20));
  INFO(done.err);
  CHECK(done.exit_code() == 0);
  CHECK_THAT(done.out, Contains("orca.GridPlanner/4"));
  (void)run_orcactl({"pace", "fast"});  // unless it has ended meanwhile
  CHECK(finish(process, Seconds(60)).exit_code() == 0);
  const Run same = bag({"diff", once, swapped, "planner.MotionCmdPush", "fuser.base"});
  INFO(same.err << same.out);
  CHECK(same.exit_code() == 0);
}

TEST_CASE(
    "a replay of the planner's own sensors gives the planner's own commands, and diff finds what is not the "
    "same",
    "[system][recording][replay]") {
  const TempFolder folder;
  const std::string recording = folder.file("run.mcap");
  const Words planner{source_file("graphs/pioneer_planner.xml"), "--until", "20s", "--record"};
  REQUIRE(run_deployer(planner + Words{recording} + virtual_clock(), Seconds(60)).exit_code() == 0);
  const std::string again = folder.file("again.mcap");
  (void)replay(recording, again);
  CHECK(bag({"diff", recording, again, "planner.MotionCmdPush"}).exit_code() == 0);
  CHECK(bag({"diff", recording, again, "laser.LaserRangeReadingsPush"}).exit_code() == 0);
  const std::string other = folder.file("other.mcap");
  REQUIRE(run_deployer(planner + Words{other, "--set", "speed=0.4 m/s"} + virtual_clock(), Seconds(60))
              .exit_code() == 0);
  const Run compared = bag({"diff", recording, other, "planner.MotionCmdPush"});
  CHECK(compared.exit_code() == 1);
  CHECK_THAT(compared.err,
             Contains("the first difference, after ") && Contains("planner.MotionCmdPush number "));
}

TEST_CASE("a recording without the ports of a replay is refused by name",
          "[system][recording][replay][fault]") {
  const TempFolder folder;
  const std::string recording = folder.file("run.mcap");
  REQUIRE(run_deployer(Words{source_file("graphs/scout_goto.xml"), "--until", "1s", "--record", recording} +
                       virtual_clock())
              .exit_code() == 0);
  const Run run = run_deployer({kReplay, "--check", "--set", "recording=" + recording});
  CHECK(run.exit_code() == 2);
  CHECK(run.says("the recording has nothing of \"laser.LaserRangeReadingsPush\"; it has: "));
  CHECK(run_deployer({kReplay, "--check", "--set", "recording=/nonexistent.mcap"}).exit_code() == 2);

  // What is damaged in it may be why.
  const std::string log =
      folder.write("run.log", "ODOM 0 0 0 0 0 0 1.0 host 1.0\nFLASER 180 2.0 2.0 0 0 0 0 0 0 1.1 host 1.1\n");
  const Run damaged = run_deployer({kReplay, "--check", "--set", "recording=" + log});
  CHECK(damaged.says(
      "nothing of \"laser.LaserRangeReadingsPush\"; it has: base.OdometryPush; 1 damaged line is left "
      "out, the first in line 2: a line FLASER: "));
}

TEST_CASE("a recording that was cut off says so wherever it is read", "[system][recording][replay][fault]") {
  const TempFolder folder;
  const std::string recording = folder.file("run.mcap");
  REQUIRE(run_deployer(
              Words{source_file("graphs/pioneer_laser_goto.xml"), "--until", "1s", "--record", recording} +
              virtual_clock())
              .exit_code() == 0);
  const std::string cut = folder.file("cut.mcap");
  std::filesystem::copy_file(recording, cut);
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
  const std::string said = "only what is whole of the recording is read; byte ";
  CHECK_THAT(bag({"info", cut}).err, Contains(said) && Contains("ends in the middle of a record"));
  const Run table = bag({"csv", cut, "base.OdometryPush"});
  CHECK(table.exit_code() == 0);
  CHECK_THAT(table.err, Contains(said));
  CHECK_THAT(bag({"diff", recording, cut, "base.OdometryPush"}).err, Contains(said));
  CHECK_THAT(run_deployer({source_file("graphs/intel_log.xml"), "--check", "--set", "log=" + cut}).err,
             Contains(said));
  CHECK_THAT(bag({"csv", recording, "base.OdometryPush"}).err, !Contains(said));
}
