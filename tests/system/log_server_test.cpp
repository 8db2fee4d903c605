// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

Run logging_to(const std::string& file) {
  return run_deployer(Words{system_graph("log_server.xml"), "--set", "file=" + file} + with_test_plugins() +
                      virtual_clock());
}

}  // namespace

TEST_CASE("the log server writes a line per record, and begins a new file when one is large enough",
          "[system][log]") {
  const TempFolder folder;
  const Run run = logging_to(folder.file("robot.log"));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  const auto newest = split_lines(read_text(folder.file("robot.log")));
  const auto older = split_lines(read_text(folder.file("robot.log.1")));
  REQUIRE_FALSE(newest.empty());
  CHECK(newest.back().ends_with(" warning wheels: record 100\\nof several lines"));
  CHECK(older.size() > newest.size());
  CHECK(std::filesystem::file_size(folder.file("robot.log.1")) <= 2000);
  CHECK_FALSE(std::filesystem::exists(folder.file("robot.log.3")));
}

TEST_CASE("a log that cannot be written stops no component, and the loss is reported once", "[system][log]") {
  const Run run = logging_to("/dev/full");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.said("records are being lost").size() == 1);
}

TEST_CASE("every line of the deployer's log is a record too, the last ones included", "[system][log]") {
  const TempFolder folder;
  const Run run = run_deployer(Words{system_graph("log_server.xml"), "--set",
                                     "file=" + folder.file("robot.log"), "--set", "own_lines=true", "--set",
                                     "most_bytes=100000", "--fail", "source=throw@0.5s", "--log", "off"} +
                               with_test_plugins() + virtual_clock());
  CHECK(run.exit_code() == 1);
  const std::string text = read_text(folder.file("robot.log"));
  INFO(text);
  CHECK(text.find(" warning wheels: record 50") != std::string::npos);
  CHECK(text.find(" error source: ") != std::string::npos);
}

TEST_CASE("the shipped graph with its profile \"log\" leaves a file that says why a goal was not reached",
          "[system][log]") {
  const TempFolder folder;
  Subprocess program(
      deployer(Words{source_file("graphs/scout_rounds.xml"), "--profile", "sim", "--profile", "log"} +
               virtual_clock()),
      {.folder = folder.path()});
  const Run run = finish(program, Seconds(30));
  INFO(run.err);
  const std::string text = read_text(folder.file("orca.log"));
  INFO(text);
  CHECK(text.find(" warning command: goal \"archive\" was not reached; blocked") != std::string::npos);
  CHECK(text.find(" error command: work() failed: not reached: archive") != std::string::npos);
}

TEST_CASE("a log in a folder that is not there keeps the system from starting", "[system][log]") {
  const Run run = logging_to("/no/such/folder/robot.log");
  CHECK(run.exit_code() == kRefusedByComponent);
  CHECK(run.says("/no/such/folder/robot.log"));
}

TEST_CASE("--check writes no log, and leaves to the start what only opening the file can tell",
          "[system][log]") {
  const TempFolder folder;
  const Words graph = Words{system_graph("log_server.xml"), "--set", "file=" + folder.file("robot.log")};
  CHECK(run_deployer(graph + with_test_plugins() + Words{"--check"}).exit_code() == 0);
  CHECK_FALSE(std::filesystem::exists(folder.file("robot.log")));
}

TEST_CASE("what configure() refuses only at the start is told once", "[system][log]") {
  const Run run = logging_to("/tmp");
  INFO(run.err);
  CHECK(run.exit_code() == 3);
  CHECK(run.said("Is a directory").size() == 1);
  CHECK(run.says("log: configure() said: parameter \"file\": /tmp: cannot be written: Is a directory"));
}

TEST_CASE("the log server keeps the lines of all processes and of the deployer, each once", "[system][log]") {
  const TempFolder folder;
  System system(Words{system_graph("flow_log.xml"), "--set", "file=" + folder.file("robot.log")} +
                with_test_plugins());
  system.when("flow ", 0, Seconds(10));
  const std::size_t mark = system.mark();
  REQUIRE(kill(system.process("relay"), SIGKILL) == 0);
  system.when("process relay is back", mark, Seconds(10));
  system.when("flow ", mark, Seconds(10));
  const auto kept = [&] { return read_text(folder.file("robot.log")); };
  const auto is_complete = [&] {
    const std::string text = kept();
    return text.find(" info deployer: process relay is back") != std::string::npos &&
           text.find(" info sink: flow ", text.find("is back")) != std::string::npos;
  };
  CHECK(comes_true(is_complete, Seconds(3)));
  stop(system);
  INFO(kept());
  const std::string first = split_lines(kept()).front();
  CHECK(first.ends_with("==== the log of a run begins ===="));
  const std::string day = first.substr(0, first.find('T'));
  CHECK(day.size() == std::string("2026-11-27").size());
  for (const std::string& line : split_lines(kept())) CHECK(line.substr(0, 4) == day.substr(0, 4));
  CHECK(kept().find(" error deployer: alarm PROCESS_ENDED: process relay was ended by SIGKILL") !=
        std::string::npos);
  for (const std::string& line : split_lines(kept())) {
    const std::size_t begin = line.find(" info sink: flow ");
    if (begin != std::string::npos)
      CHECK(kept().find(line.substr(begin), kept().find(line) + line.size()) == std::string::npos);
  }
}
