// SPDX-License-Identifier: GPL-3.0-or-later
// Lines from the ports of a running system to whoever looks on.
#include <catch2/catch.hpp>
#include <chrono>
#include <regex>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "client.hpp"
#include "deployer.hpp"
#include "hosted_system.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using orca::orcactl::Client;

namespace {

// A talker says something a hundred times a second.
constexpr const char* kGraph = "<graph name=\"lines_test\" version=\"1\" plugins=\"" ORCA_BINARY_DIR
                               "/tests/host_plugins\"><component name=\"teller\" type=\"test.Teller\"/>"
                               "<component name=\"talker\" type=\"test.Talker\"/>"
                               "<connect from=\"talker.out\" to=\"teller.in\" queue=\"1000\"/>"
                               "<connect from=\"talker.poke\" to=\"teller.poke\" queue=\"1000\"/>"
                               "<connect from=\"teller.out\" to=\"talker.back\" queue=\"1000\"/></graph>";

}  // namespace

TEST_CASE("recorders that do not read hold up the end of a process once, not one after the other",
          "[system][lines]") {
  constexpr int kLines = 12;
  const TempFolder folder;
  Subprocess program(deployer({folder.write("lines.xml", kGraph), "--log", "debug"}));
  REQUIRE(program.wait_for_output("heard 1:10", Seconds(20) * kSlowdown));
  std::vector<orca::supervisor::LineAnswer> lines;
  auto connected = Client::connect(orca::apps::Call{});
  REQUIRE(std::holds_alternative<Client>(connected));
  const std::vector<std::string> recorded{"--tap", "--objects", "--bound", "100000000"};
  for (int i = 0; i < kLines; ++i) {
    auto line = std::get<Client>(connected).open_line("talker.out", recorded);
    INFO((line ? "" : line.error().text()));
    REQUIRE(line);
    lines.push_back(std::move(line).value());
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(10.0));  // the sockets fill
  const Seconds began = since_boot();
  REQUIRE(run_orcactl({"stop"}).exit_code() == 0);
  CHECK(finish(program, Seconds(15)).exit_code() == 0);
  constexpr double kLimit = 0.3;  // [s] of one recorder
  CHECK((since_boot() - began).count() < kLines * kLimit / 2);
}

TEST_CASE("connections show how old objects are when they arrive, and components how long laps compute",
          "[system][lines]") {
  const TempFolder folder;
  Subprocess program(deployer({folder.write("lines.xml", kGraph), "--log", "debug"}));
  REQUIRE(program.wait_for_output("heard 1:100", Seconds(20) * kSlowdown));
  const std::string live = run_orcactl({"counters", "--json"}).out;
  INFO(live);
  const auto shows = [&](const char* pattern) { return std::regex_search(live, std::regex(pattern)); };
  CHECK(shows(R"re("from": "talker.out"[^}]*"age_p50_ms": 0\.\d+,\s*"age_p99_ms": \d+\.\d+)re"));
  CHECK(shows(
      R"re("component": "talker",\s*"laps": \d\d+,\s*"lap_p50_ms": \d+\.\d+,\s*"lap_p99_ms": \d+\.\d+)re"));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
  CHECK(finish(program, Seconds(10)).exit_code() == 0);
}
