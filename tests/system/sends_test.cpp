// SPDX-License-Identifier: GPL-3.0-or-later
// What is sent to another process while that is killed again and again: on an edge that confirms what was handled,
// each object that counts as sent was handled, and none twice.
#include <signal.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "number_file.hpp"
#include "process_table.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

std::uintmax_t size_of(const std::filesystem::path& path) {
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(path, none);
  return none ? 0 : size;
}

// Returns what the deployer has to be told for a tally in a folder.
Words tally(const TempFolder& folder, int count, const std::string& link) {
  return Words{system_graph("tally.xml")} + with_test_plugins() +
         Words{"--set", "count=" + std::to_string(count),    "--set", "sent=" + folder.file("sent"),
               "--set", "handled=" + folder.file("handled"), "--set", "link=" + link};
}

// Waits until so many numbers were handled, then kills the taker.
void kill_taker_after(Subprocess& program, const std::filesystem::path& handled, int numbers) {
  const auto end = std::chrono::steady_clock::now() + Seconds(60) * kSlowdown;
  while (size_of(handled) < static_cast<std::uintmax_t>(numbers) * sizeof(std::int64_t)) {
    INFO(program.err());
    REQUIRE(std::chrono::steady_clock::now() < end);
    std::this_thread::sleep_for(Seconds(0.0005));
  }
  const auto children = children_of(program.pid());
  const auto taker = children.find("taker");
  REQUIRE(taker != children.end());
  REQUIRE(kill(taker->second, SIGKILL) == 0);
}

// Sends so many numbers, kills the taker so often meanwhile, and compares what both say.
void send_and_kill(int count, int kills, const std::string& link) {
  const TempFolder folder;
  Subprocess program(deployer(tally(folder, count, link)));
  for (int i = 1; i <= kills; ++i)
    kill_taker_after(program, folder.path() / "handled", count * i / (kills + 1));
  const Run run = finish(program, Seconds(120));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  const Numbers sent = read_numbers(folder.path() / "sent");
  Numbers handled = read_numbers(folder.path() / "handled");
  std::sort(handled.begin(), handled.end());
  CHECK(std::adjacent_find(handled.begin(), handled.end()) == handled.end());
  Numbers lost;
  std::set_difference(sent.begin(), sent.end(), handled.begin(), handled.end(), std::back_inserter(lost));
  CHECK(lost == Numbers{});
  std::printf("%s: %d numbers, %d kills: %zu sent, %zu handled\n", link.c_str(), count, kills, sent.size(),
              handled.size());
  CHECK(sent.size() > static_cast<std::size_t>(count) / 2);
  CHECK(handled.size() <
        static_cast<std::size_t>(count));  // some came while nobody was there, and the sender was told
}

}  // namespace

TEST_CASE("nothing that counts as sent is lost or doubled while the receiver is killed", "[system][send]") {
  const std::string link = GENERATE("shm", "dds");
  send_and_kill(10'000, 4, link);
}

TEST_CASE("nothing of 100,000 is lost or doubled while the receiver is killed 20 times",
          "[system][.][slow]") {
  const std::string link = GENERATE("shm", "dds");
  send_and_kill(100'000, 20, link);
}

TEST_CASE("an operator whose object is refused when it is handled reads why", "[system][orcactl]") {
  Subprocess program(deployer({source_file("graphs/scout_goto_processes.xml")}));
  const auto is_up = [] {
    return run_orcactl({"send", "fuser.ClientListSend", "<ClientList/>"}).exit_code() == 0;
  };
  REQUIRE(comes_true(is_up, Seconds(20) * kSlowdown));
  const auto send = [](const std::string& port, const std::string& object) {
    const Run run = run_orcactl({"send", port, object});
    INFO(object << run.err);
    CHECK((run.exit_code() == 0) == run.err.empty());
    return run.err;
  };
  CHECK_THAT(send("fuser.ClientListSend", R"(<ClientList><clients value="nobody"/></ClientList>)"),
             Contains("nobody"));
  CHECK_THAT(
      send("goto.GotoCoordinateSend", R"(<GoalPoint name="far"><reach_radius distance="-1 m"/></GoalPoint>)"),
      Contains("negative reach_radius"));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}
