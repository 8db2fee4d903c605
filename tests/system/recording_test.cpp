// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings: what they hold, that they change nothing, what they lose, and that they can be played again.
#include <signal.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <thread>

#include "bags.hpp"
#include "deployer.hpp"
#include "process_table.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
using Catch::EndsWith;
using Catch::StartsWith;

namespace {

using namespace std::chrono_literals;

const std::string kScout = source_file("graphs/scout_goto.xml");
const std::string kProcesses = source_file("graphs/scout_goto_processes.xml");

// Returns how many poses by odometry a recording holds, which may be growing.
int odometry_in(const std::string& file) {
  const Run run = run_orcactl({"--json", "bag", "info", file});
  return run.exit_code() == 0 ? count_in(run.out, "/base/OdometryPush") : 0;
}

}  // namespace

TEST_CASE("what a recording holds is one JSON document, as other answers", "[system][recording]") {
  const TempFolder folder;
  const std::string file = folder.file("short.mcap");
  REQUIRE(run_deployer(Words{kScout, "--until", "1s", "--record", file} + virtual_clock()).exit_code() == 0);
  const std::string info = info_of(file);
  CHECK_THAT(info, StartsWith("[\n") && EndsWith("]\n"));
  CHECK_THAT(info, Contains("\"graph\": \"scout_goto\"") && Contains("\"topic\": \"/base/OdometryPush\""));
}

TEST_CASE("what writes no JSON of a recording refuses to be asked for it", "[system][recording]") {
  for (const char* way : {"check", "csv", "diff"}) {
    CAPTURE(way);
    const Run run = run_orcactl({"--json", "bag", way, "any.mcap", "other.mcap"});
    CHECK(run.exit_code() == 2);
    CHECK(run.says(std::string("bag ") + way + " writes no JSON, leave out --json; bag info does"));
  }
}

TEST_CASE("names are JSON where that is asked for, and who writes none refuses", "[system][recording]") {
  CHECK(run_orcactl({"names", "system", "--json"}).out == "[]\n");
  for (const Words& words : {Words{"import", "x.xml"}, {"map", "ways", "x"}, {"keys", "x.xml"}}) {
    const Run run = run_orcactl(words + Words{"--json"});
    CHECK(run.exit_code() == 2);
    CHECK(run.says(words[0] + " writes no JSON, leave out --json"));
  }
}

TEST_CASE("recording everything of a virtual run changes nothing, and two recordings are the same file",
          "[system][recording]") {
  const TempFolder folder;
  const std::string first = folder.file("first.mcap");
  const std::string second = folder.file("second.mcap");
  const Words run = Words{kScout, "--until", "20s"} + virtual_clock();
  const Run plain = run_deployer(run);
  const Run recorded = run_deployer(run + Words{"--record", first});
  CHECK(recorded.trace_hash() == plain.trace_hash());
  CHECK(run_deployer(run + Words{"--record", second}).exit_code() == 0);
  CHECK(read_text(first) == read_text(second));
  CHECK_THAT(bag({"check", first}).out, StartsWith("in order: "));
  const std::string info = info_of(first);
  CHECK_THAT(info, Contains(*plain.trace_hash()));
  CHECK(count_in(info, "/base/OdometryPush") == 400);
  CHECK(count_in(info, "/ros/base/OdometryPush") == 400);
}

TEST_CASE("a recording is never written over another file, and nothing starts then",
          "[system][recording][fault]") {
  const TempFolder folder;
  const std::string file = folder.write("run.mcap", "precious");
  for (const Words& how : {Words{"--in-process"}, Words{}, virtual_clock()}) {
    const Run run = run_deployer(Words{kScout, "--until", "2s", "--record", file} + how);
    INFO(run.err);
    CHECK(run.exit_code() == 2);
    CHECK(run.says(file + ": there is something of this name already"));
  }
  CHECK(read_text(file) == "precious");
  CHECK(run_deployer({kScout, "--record", "run.mcap="}).exit_code() == 2);
  CHECK(run_deployer({kScout, "--check", "--record", folder.file("x.mcap") + "=base.Nothing"}).exit_code() ==
        2);
}

TEST_CASE("a system of several processes is recorded from its first object to its last, with nothing lost",
          "[system][recording]") {
  const TempFolder folder;
  const std::string file = folder.file("run.mcap");
  const Run run = run_deployer({kProcesses, "--until", "4s", "--record", file});
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  CHECK_FALSE(run.says("LOST"));
  const Run checked = bag({"check", file});
  INFO(checked.out << checked.err);
  CHECK(checked.exit_code() == 0);
  CHECK_THAT(checked.out, !Contains("remark"));  // no number is missing between its messages
  const Run table = bag({"csv", file, "command.goto", "base.OdometryPush"});
  const std::vector<std::string> lines = split_lines(table.out);
  REQUIRE(lines.size() > 60);
  CHECK_THAT(table.out, Contains("command.goto,"));
  const std::string info = info_of(file);
  CHECK(count_in(info, "/base/OdometryPush") >= 75);
  CHECK(count_in(info, "/log") >= 1);
  CHECK_THAT(info, Contains("scout_goto_processes"));
}

TEST_CASE("a recorder that is killed loses at most 0.25 s, and the rest is recovered",
          "[system][recording][quiet]") {
  const TempFolder folder;
  const std::string file = folder.file("run.mcap");
  const std::string recovered = folder.file("recovered.mcap");
  Subprocess system(deployer({kProcesses, "--until", "60s"}));
  Subprocess recorder(
      orcactl({"--system", "scout_goto_processes", "record", file, "base.OdometryPush", "--wait", "20s"}));
  const auto limit = std::chrono::steady_clock::now() + 30s;
  while (odometry_in(file) < 40 && std::chrono::steady_clock::now() < limit)
    std::this_thread::sleep_for(20ms);
  const double killed =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  recorder.send(SIGKILL);
  REQUIRE(recorder.wait(Seconds(5)));
  system.send(SIGTERM);
  CHECK(finish(system, Seconds(10)).exit_code() == 0);
  CHECK(bag({"check", file}).exit_code() == 1);
  REQUIRE(bag({"recover", file, recovered}).exit_code() == 0);
  CHECK(bag({"check", recovered}).exit_code() == 0);
  // Columns: stamp (from the beginning of the recording), port, creation_time, ... Odometry comes 20 times a second, so the
  // last one that had passed before is up to 0.05 s older than the kill.
  const std::vector<std::string> rows = split_lines(bag({"csv", recovered, "base.OdometryPush"}).out);
  REQUIRE(rows.size() > 20);
  const std::string info = info_of(recovered);
  const double last = std::stod(cell_of(info, "scout_goto_processes", "begin_s")) +
                      std::stod(cell_of(info, "scout_goto_processes", "duration_s"));
  INFO("lost: " << killed - last << " s");
  CHECK(killed - last < 0.25 + 0.05);
}

TEST_CASE("alarms and lines of the log are recorded, in one process and in several", "[system][recording]") {
  const TempFolder folder;
  const auto [how, name] = GENERATE(table<Words, std::string>(
      {{Words{"--in-process"}, "one"}, {Words{}, "several"}, {virtual_clock(), "virtual"}}));
  const std::string file = folder.file(name + ".mcap");
  const Run run = run_deployer(Words{system_graph("alarms.xml"), "--until", "2 s", "--record", file} + how +
                               with_test_plugins());
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  const std::string info = info_of(file);
  INFO(info);
  CHECK(count_in(info, "/alarms") >= 1);
  CHECK(count_in(info, "/log") >= 1);
  CHECK(count_in(info, "/rosout") == count_in(info, "/log"));
  CHECK_THAT(bag({"csv", file, "alarms"}).out, Contains("hooligan"));
}

TEST_CASE(
    "when the disk is full the recorder says so and ends, the system runs on, and what was written is whole",
    "[system][recording][fault]") {
  const TempFolder folder;
  const std::string file = folder.file("run.mcap");
  Subprocess system(deployer({kProcesses, "--until", "30s"}));
  // A limit of the size of files, in KiB, is to a program what a full disk is.
  Words command{"/bin/bash", "-c", "ulimit -f 160; exec \"$@\"", "bash"};
  Subprocess recorder(command +
                      orcactl({"--system", "scout_goto_processes", "record", file, "--wait", "20s"}));
  const Run run = finish(recorder, Seconds(20));
  CHECK(run.exit_code() == 1);
  CHECK(run.says("the recording cannot be written: File too large"));
  CHECK(run_orcactl({"ps"}).exit_code() == 0);
  const Run checked = bag({"check", file});
  INFO(checked.out);
  CHECK_THAT(checked.out, EndsWith(": the file has no end: whoever wrote it was interrupted\n"));
  CHECK(count_in(info_of(file), "/base/OdometryPush") > 10);
  system.send(SIGTERM);
  CHECK(finish(system, Seconds(10)).exit_code() == 0);
}

TEST_CASE("a process that is started again is recorded again", "[system][recording]") {
  const TempFolder folder;
  const std::string file = folder.file("run.mcap");
  Subprocess system(deployer({kProcesses, "--until", "10s", "--record", file}));
  const auto works = [] {
    return run_orcactl({"hz", "localizer.RobotPosePush", "--for", "0.5s"}).exit_code() == 0;
  };
  for (int i = 0; i < 50 && !works(); ++i) std::this_thread::sleep_for(100ms);
  REQUIRE(run_orcactl({"restart", "avoid"}).exit_code() == 0);
  const Run run = finish(system, Seconds(30));
  INFO(run.err);
  CHECK(bag({"check", file}).exit_code() == 0);
  // Numbers begin anew in the new process.
  std::vector<int> numbers;
  for (const std::string& row : split_lines(bag({"csv", file, "avoid.motion"}).out)) {
    const std::size_t at = row.find(",motion,");
    if (at != std::string::npos) numbers.push_back(std::stoi(row.substr(at + 8)));
  }
  REQUIRE(numbers.size() > 40);
  CHECK(numbers.front() == 1);
  CHECK(std::count_if(numbers.begin() + 1, numbers.end(), [](int number) { return number <= 5; }) >= 1);
  CHECK(numbers.back() < static_cast<int>(numbers.size()));
}

TEST_CASE("a recording goes on when the graph loses a component", "[system][recording]") {
  const TempFolder folder;
  const std::string file = folder.file("run.mcap");
  const int guests = GENERATE(1, 2);
  ShippedGraph graph("scout_goto_processes");
  const std::string less = folder.write("less.xml", graph.text());
  graph.add("  <process name=\"guests\"/>\n");
  for (int i = 0; i < guests; ++i)
    graph.add("  <component name=\"guest" + std::to_string(i) +
              "\" type=\"orca.AlarmCentral\" process=\"guests\" autonomous=\"true\"/>\n");
  Subprocess system(deployer({folder.write("start.xml", graph.text())}));
  Subprocess recorder(orcactl({"--system", "scout_goto_processes", "record", file, "--wait", "20s"}));
  const auto records = [&] { return odometry_in(file) >= 30; };
  for (int i = 0; i < 200 && !records(); ++i) std::this_thread::sleep_for(100ms);
  const Run applied = run_orcactl({"apply", less}, Seconds(40));
  INFO(applied.err);
  REQUIRE(applied.exit_code() == 0);
  CHECK_FALSE(recorder.wait(Seconds(2)));  // it records
  recorder.send(SIGINT);
  const Run run = finish(recorder, Seconds(10));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(count_in(info_of(file), "/base/OdometryPush") >= 30);
  CHECK(bag({"check", file}).exit_code() == 0);
  system.send(SIGTERM);
  CHECK(finish(system, Seconds(10)).exit_code() == 0);
}

TEST_CASE("ports whose process does not end its line are named, and the recording is no success",
          "[system][recording][fault]") {
  const TempFolder folder;
  const std::string file = folder.file("run.mcap");
  Subprocess system(deployer({kProcesses, "--until", "60s"}));
  Subprocess recorder(
      orcactl({"--system", "scout_goto_processes", "record", file, "base.OdometryPush", "--wait", "20s"}));
  const auto records = [&] { return odometry_in(file) >= 30; };
  for (int i = 0; i < 200 && !records(); ++i) std::this_thread::sleep_for(100ms);
  const pid_t base = children_of(system.pid()).at("base");
  system.send(SIGSTOP);  // it would end the process that does not answer
  kill(base, SIGSTOP);
  recorder.send(SIGINT);
  const Run run = finish(recorder, Seconds(10));
  system.send(SIGCONT);
  kill(base, SIGCONT);
  CHECK(run.exit_code() == 1);
  CHECK(run.says("the recording may lack the last objects of ports whose processes did not end their lines"));
  CHECK(run.says("base.OdometryPush"));
  CHECK(bag({"check", file}).exit_code() == 0);
  system.send(SIGTERM);
  (void)finish(system, Seconds(10));
}

TEST_CASE("ports of a process that never ran are named at the end, and in the recording",
          "[system][recording]") {
  const TempFolder folder;
  const std::string file = folder.file("run.mcap");
  const Run run = run_deployer(Words{system_graph("visit.xml"), "--profile", "cold_process", "--set",
                                     "plan=send 30", "--until", "1s", "--record", file} +
                               with_test_plugins());
  INFO(run.err);
  CHECK(run.says("never reached, so nothing of them is recorded: visited.out visited.ask"));
  CHECK(cell_of(info_of(file), "unreached", "unreached") == "visited.out visited.ask");
}

TEST_CASE("a port that there is not is refused when a recording begins, also among others",
          "[system][recording][fault]") {
  const TempFolder folder;
  Subprocess system(deployer({kProcesses, "--until", "60s"}));
  for (const Words& ports : {Words{"base.Nothing"}, Words{"base.OdometryPush", "base.Nothing"}}) {
    const std::string file = folder.file("run.mcap");
    Subprocess recorder(
        orcactl(Words{"--system", "scout_goto_processes", "record", file} + ports + Words{"--wait", "20s"}));
    const Run run = finish(recorder, Seconds(20));
    CHECK(run.exit_code() == 1);
    CHECK(run.says("there is no port \"base.Nothing\""));
    CHECK_FALSE(std::filesystem::exists(file));  // or the next attempt would be refused
  }
  system.send(SIGTERM);
  CHECK(finish(system, Seconds(10)).exit_code() == 0);
}

TEST_CASE("50 MB/s are recorded, and what is lost is counted", "[system][recording][quiet]") {
  const TempFolder folder;
  const std::string file = folder.file("run.mcap");
  const Run run = run_deployer(
      Words{system_graph("cameras.xml"), "--until", "5s", "--record", file} + with_test_plugins(),
      Seconds(30));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  const std::string info = info_of(file);
  const int recorded = count_in(info, "/camera/image");
  const int lost = std::stoi(cell_of(info, "/camera/image", "lost"));
  const Run checked = bag({"check", file});
  CHECK(checked.exit_code() == 0);
  CHECK(recorded + lost >= 100);
  // Numbers are missing between the pictures if, and only if, some are counted as lost.
  CHECK((checked.out.find("remark: /camera/image") != std::string::npos) == (lost > 0));
}

TEST_CASE("recordings open in the readers of others, which decode every message",
          "[system][recording][tool]") {
  const TempFolder folder;
  const std::string file = folder.file("run.mcap");
  REQUIRE(run_deployer(Words{source_file("graphs/pioneer_planner.xml"), "--until", "5s", "--record", file} +
                       virtual_clock())
              .exit_code() == 0);
  Subprocess reader({"/usr/bin/env", "python3", source_file("tests/system/read_bag.py"), file});
  const Run run = finish(reader, Seconds(60));
  if (run.exit_code() == 77) {
    std::cout << "SKIPPED: " << run.out << "\n";
    return;
  }
  INFO(run.out << run.err);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.out, EndsWith(" graph.xml office.xml pioneer_2dx.urdf\n"));
}

TEST_CASE("bag explains what is wrong with its arguments and with files that are none",
          "[system][recording]") {
  const TempFolder folder;
  const std::string text = folder.write("notes.mcap", "not a recording");
  const Run check = bag({"check", text});
  CHECK(check.exit_code() == 2);
  CHECK_THAT(check.err, Contains(text + ": this is no MCAP file: it does not begin like one"));
  CHECK_THAT(bag({"inof", text}).err, Contains("did you mean \"info\"?"));
  CHECK(bag({"recover", text}).exit_code() == 2);
  CHECK_THAT(bag({"recover", text, text}).err, Contains("recordings overwrite nothing"));
}
