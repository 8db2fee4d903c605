// SPDX-License-Identifier: GPL-3.0-or-later
// record="always": what a robot keeps of itself, while it runs, after it was killed, and when its recorder is.
#include <signal.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <thread>

#include "bags.hpp"
#include "deployer.hpp"
#include "process_table.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

using namespace std::chrono_literals;

const std::string kName = "pioneer2dx_sick";
const Words kRobot{source_file("graphs/pioneer2dx_sick.xml"), "--until", "60s"};

// Waits until something is so. Returns whether it is.
template <class Question>
bool comes(const Question& question) {
  for (int i = 0; i < 300; ++i, std::this_thread::sleep_for(100ms))
    if (question()) return true;
  return false;
}

// Returns how many messages of a topic `bag info` of a system lists.
int count_of(const std::string& topic) {
  return count_in(run_orcactl({"--json", "bag", "info", kName}).out, topic);
}

pid_t recorder_of(const Subprocess& system) {
  const auto children = children_of(system.pid());
  const auto recorder = children.find("orcactl");
  return recorder == children.end() ? 0 : recorder->second;
}

// Returns whether the alarm RECORDING_LOST is there, and active.
bool is_lost() {
  for (const std::string& line : split_lines(run_orcactl({"alarms"}).out))
    if (line.find("RECORDING_LOST") != std::string::npos) return line.find(" true ") != std::string::npos;
  return false;
}

void end(Subprocess& system) {
  system.send(SIGTERM);
  CHECK(finish(system, Seconds(10)).exit_code() == 0);
}

}  // namespace

TEST_CASE("a graph that is always recorded keeps its runs, and they can be read while they are written",
          "[system][always]") {
  const TempFolder folder;
  Subprocess system(deployer(kRobot));
  CHECK(comes(
      [] { return count_of("/base/OdometryPush") > 20 && count_of("/laser/LaserRangeReadingsPush") > 5; }));
  const int before = count_of("/base/OdometryPush");
  CHECK(comes([&] { return count_of("/base/OdometryPush") > before; }));
  const Run info = bag({"info", kName});
  INFO(info.out);
  CHECK_THAT(info.out,
             Contains("/recordings/" + kName) && Contains("dropped_rest: 0") && Contains("begin: 20"));
  end(system);
  // Cut out by time, it is a recording like others.
  const std::string first = folder.file("first.mcap");
  const Run cut = bag({"cut", kName, first, "0s", "1.5s"});
  INFO(cut.err);
  REQUIRE(cut.exit_code() == 0);
  CHECK(bag({"check", first}).exit_code() == 0);
  const Run shown = bag({"info", first});
  CHECK_THAT(shown.out, Contains("attachment: graph.xml") && Contains("/laser/LaserRangeReadingsPush") &&
                            Contains("/base/OdometryPush") && Contains("graph: " + kName));
  const std::vector<std::string> rows = split_lines(bag({"csv", first, "base.OdometryPush"}).out);
  REQUIRE(rows.size() > 5);
  CHECK(std::atof(rows.back().c_str()) < 1.6);
  // A time of day that is to come ends it: there is no more yet.
  const auto time_of_day = [](std::time_t moment) {
    char text[6];
    std::strftime(text, sizeof text, "%H:%M", std::localtime(&moment));
    return std::string(text);
  };
  const std::time_t now = std::time(nullptr);
  const std::string all = folder.file("all.mcap");
  const Run open_end = bag({"cut", kName, all, time_of_day(now - 120), time_of_day(now + 3600)});
  INFO(open_end.err);
  CHECK(open_end.exit_code() == 0);
  CHECK(split_lines(bag({"csv", all, "base.OdometryPush"}).out).size() >= rows.size());
  const Run nothing = bag({"cut", kName, folder.file("none.mcap"), "1999-01-01T00:00", "1999-01-01T00:01"});
  CHECK(nothing.exit_code() == 1);
  CHECK_THAT(nothing.err, Contains("nothing of that time is there; the recording goes from 20"));
  const Run turned = bag({"cut", kName, folder.file("none.mcap"), "1.5s", "1s"});
  CHECK(turned.exit_code() == 2);
  CHECK_THAT(turned.err, Contains("TO, 1s, is not after FROM, 1.5s"));
  CHECK_THAT(bag({"cut", kName, folder.file("none.mcap"), "noon"}).err, Contains("\"noon\" is no time"));
}

TEST_CASE("what a robot has kept is there after everything was killed, and the next run goes on with it",
          "[system][always][fault]") {
  int before = 0;
  {
    Subprocess system(deployer(kRobot));
    REQUIRE(comes([] { return count_of("/base/OdometryPush") > 40; }));
    kill(recorder_of(system), SIGKILL);
    system.send(SIGKILL);
    (void)finish(system, Seconds(10));
    before = count_of("/base/OdometryPush");
    CHECK(before > 40);
  }
  Subprocess system(deployer(kRobot));
  CHECK(comes([&] { return count_of("/base/OdometryPush") > before + 20; }));
  end(system);
}

TEST_CASE("a recorder that dies is an alarm until another one records, and one of --record is not replaced",
          "[system][always][fault]") {
  Subprocess system(deployer(kRobot));
  const bool is_up = comes([&] { return count_of("/base/OdometryPush") > 0 && recorder_of(system) != 0; });
  REQUIRE(is_up);
  const pid_t first = recorder_of(system);
  kill(first, SIGKILL);
  CHECK(comes([] { return is_lost(); }));
  CHECK(comes([&] { return recorder_of(system) != 0 && recorder_of(system) != first; }));
  CHECK(comes([] { return !is_lost(); }));
  const int before = count_of("/base/OdometryPush");
  CHECK(comes([&] { return count_of("/base/OdometryPush") > before + 20; }));
  end(system);

  const TempFolder folder;
  const std::string file = folder.file("run.mcap");
  Subprocess other(
      deployer({source_file("graphs/scout_goto_processes.xml"), "--until", "60s", "--record", file}));
  REQUIRE(comes([&] {
    return std::filesystem::exists(file) && std::filesystem::file_size(file) > 20'000 &&
           recorder_of(other) != 0;
  }));
  kill(recorder_of(other), SIGKILL);
  CHECK(comes([] { return is_lost(); }));
  CHECK_THAT(run_orcactl({"alarms"}).out, Contains(file) && Contains("(signal 9)"));
  other.send(SIGTERM);
  const Run run = finish(other, Seconds(10));
  CHECK(run.exit_code() == 1);
  CHECK(run.says("the recording is not complete"));
}

TEST_CASE("--ring wants a folder and room", "[system][always][fault]") {
  CHECK_THAT(run_orcactl({"record", "x.mcap", "--ring", "1 GB"}).err, Contains("name a folder for them"));
  CHECK_THAT(run_orcactl({"record", "x", "--ring", "1 MB"}).err, Contains("--ring: "));
  CHECK_THAT(run_orcactl({"record", "x"}).err, Contains("name a file that ends in .mcap"));
}
