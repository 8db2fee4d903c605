// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever is killed at whatever moment of a swap: afterwards either the old or the new code runs, and the system says which.
#include <signal.h>

#include <catch2/catch.hpp>
#include <memory>
#include <random>
#include <sstream>
#include <thread>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

const std::string kGraph =
    "<graph name=\"swap_kills\" version=\"1\" restarts=\"1000\" within=\"100 ms\" "
    "on_supervisor_loss=\"continue\" plugins=\"" ORCA_BINARY_DIR
    "/tests/host_plugins\">\n"
    "  <process name=\"counting\"/><process name=\"talking\"/>\n"
    "  <component name=\"teller\" type=\"test.Teller\" process=\"counting\"/>\n"
    "  <component name=\"talker\" type=\"test.Talker\" process=\"talking\"/>\n"
    "  <connect from=\"talker.out\" to=\"teller.in\" queue=\"1000\"/>\n"
    "  <connect from=\"talker.poke\" to=\"teller.poke\" queue=\"1000\"/>\n"
    "  <connect from=\"teller.out\" to=\"talker.back\" queue=\"1000\"/>\n"
    "</graph>\n";

std::string next_version(int number) {
  const std::string name = number == 2 ? "test_teller_2" : "test_teller_again";
  return ORCA_BINARY_DIR "/tests/next_plugins/" + name + ".so";
}

// What the teller says: its version and a count, "2:345".
struct Word {
  int version = 0;
  long count = 0;
};

std::vector<Word> words_of(const std::string& echoed) {
  std::vector<Word> words;
  for (std::size_t at = echoed.find("name=\\\""); at != std::string::npos;
       at = echoed.find("name=\\\"", at + 1)) {
    Word word;
    char colon = '\0';
    std::istringstream(echoed.substr(at + 7)) >> word.version >> colon >> word.count;
    words.push_back(word);
  }
  return words;
}

// Returns the process in which the teller works; 0 if it does not.
pid_t pid_of_teller() {
  const std::string shown = run_orcactl({"ps", "--json"}).out;
  const std::size_t begin = shown.find("\"teller\"");
  const std::string row =
      begin == std::string::npos ? "" : shown.substr(begin, shown.find('}', begin) - begin);
  const std::size_t pid = row.find("\"pid\":");
  return pid == std::string::npos || row.find("WORK") == std::string::npos ? 0
                                                                           : std::atoi(row.c_str() + pid + 6);
}

// A system that outlives its deployers.
class Telling {
 public:
  Telling() : file_(folder_.write("swap_kills.xml", kGraph)) { start(); }

  // Kills the deployer, and lets another one take over.
  void lose_deployer() {
    deployers_.back()->send(SIGKILL);
    REQUIRE(deployers_.back()->wait(Seconds(5)));
    start();
  }

  void end() {
    CHECK(run_orcactl({"stop"}).exit_code() == 0);
    CHECK(finish(*deployers_.back(), Seconds(10)).exit_code() == 0);
  }

 private:
  void start() {
    deployers_.push_back(std::make_unique<Subprocess>(deployer({file_})));
    const auto works = [] { return pid_of_teller() > 0; };
    const bool came = comes_true(works, Seconds(20));
    INFO(deployers_.back()->err());
    REQUIRE(came);
  }

  TempFolder folder_;
  std::string file_;
  std::vector<std::unique_ptr<Subprocess>> deployers_;  // the host processes are in the group of the first
};

// One version speaks, each count once, and the supervisor knows which version it is.
void check_that_one_version_runs() {
  const Run echoed = run_orcactl({"echo", "talker.back", "--count", "20", "--json"});
  INFO(echoed.out << echoed.err);
  const std::vector<Word> words = words_of(echoed.out);
  REQUIRE(words.size() == 20);
  for (std::size_t i = 1; i < words.size(); ++i) {
    CHECK(words[i].version == words[0].version);
    CHECK(words[i].count == words[i - 1].count + 1);
  }
  const std::string shown = run_orcactl({"ps", "--json"}).out;
  INFO(shown);
  CHECK((shown.find("test_teller_2.so") != std::string::npos) == (words[0].version == 2));
}

void kill_something(Telling& telling, int round, std::mt19937& random) {
  Subprocess swap(orcactl(
      {"swap", "teller", next_version(1 + round % 2), "--tryout", "100 ms", "--probation", "100 ms"}));
  std::this_thread::sleep_for(Seconds(std::uniform_real_distribution<>(0.0, 0.5)(random)));
  switch (round % 3) {
    case 0: swap.send(SIGKILL); break;
    case 1: kill(pid_of_teller(), SIGKILL); break;
    default: telling.lose_deployer(); break;
  }
  (void)finish(swap, Seconds(20));
  std::this_thread::sleep_for(Seconds(0.6 * kSlowdown));  // a swap that goes on is done by then
}

void kill_again_and_again(int times) {
  Telling telling;
  std::mt19937 random(16);  // NOLINT(cert-msc51-cpp): the same moments each time
  for (int round = 0; round < times; ++round) {
    CAPTURE(round);
    kill_something(telling, round, random);
    check_that_one_version_runs();
  }
  telling.end();
}

}  // namespace

TEST_CASE("orcactl, the host process and the deployer are killed during swaps", "[system][swap]") {
  kill_again_and_again(6);
}

TEST_CASE("two hundred kills during swaps", "[.][slow][swap]") { kill_again_and_again(200); }
