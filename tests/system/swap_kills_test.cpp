// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever is killed at whatever moment of a swap or an apply: afterwards either the old or the new code runs, and the system
// says which.
#include <signal.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <memory>
#include <random>
#include <sstream>
#include <thread>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
namespace fs = std::filesystem;

namespace {

std::string graph_of(const std::string& type, const std::string& plugins) {
  return "<graph name=\"swap_kills\" version=\"1\" restarts=\"1000\" within=\"100 ms\" "
         "on_supervisor_loss=\"continue\" plugins=\"" +
         plugins +
         "\">\n"
         "  <process name=\"counting\"/><process name=\"talking\"/>\n"
         "  <component name=\"teller\" type=\"" +
         type +
         "\" process=\"counting\"/>\n"
         "  <component name=\"talker\" type=\"test.Talker\" process=\"talking\"/>\n"
         "  <connect from=\"talker.out\" to=\"teller.in\" queue=\"1000\"/>\n"
         "  <connect from=\"talker.poke\" to=\"teller.poke\" queue=\"1000\"/>\n"
         "  <connect from=\"teller.out\" to=\"talker.back\" queue=\"1000\"/>\n"
         "</graph>\n";
}

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
  Telling() {
    const fs::path plugins = folder_.file("plugins");
    fs::create_directory(plugins);
    for (const std::string name :
         {"host_plugins/test_talker", "host_plugins/test_teller", "next_plugins/test_teller_other"})
      for (const std::string kind : {".so", ".types"}) {
        const fs::path file = ORCA_BINARY_DIR "/tests/" + name + kind;
        fs::copy_file(file, plugins / file.filename());
      }
    file_ = write("test.Teller");
    start();
  }

  // Writes the graph with this type of teller, and returns its file.
  [[nodiscard]] std::string write(const std::string& type) const {
    return folder_.write(type + ".xml", graph_of(type, folder_.file("plugins")));
  }

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

// One version speaks, and each count once. Returns which.
int version_that_runs() {
  const Run echoed = run_orcactl({"echo", "talker.back", "--count", "20", "--json"});
  INFO(echoed.out << echoed.err);
  const std::vector<Word> words = words_of(echoed.out);
  REQUIRE(words.size() == 20);
  for (std::size_t i = 1; i < words.size(); ++i) {
    CHECK(words[i].version == words[0].version);
    CHECK(words[i].count == words[i - 1].count + 1);
  }
  return words[0].version;
}

bool shows(const Words& words, const std::string& text) {
  const std::string shown = run_orcactl(words).out;
  return shown.find(text) != std::string::npos;
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
  std::this_thread::sleep_for(Seconds(kSanitized ? 12.0 : 1.5));  // a swap that goes on is done by then
}

void kill_again_and_again(int times) {
  Telling telling;
  std::mt19937 random(16);  // NOLINT(cert-msc51-cpp): the same moments each time
  for (int round = 0; round < times; ++round) {
    CAPTURE(round);
    kill_something(telling, round, random);
    const int version = version_that_runs();
    CHECK(shows({"ps", "--json"}, "test_teller_2.so") == (version == 2));
  }
  telling.end();
}

// Kills what has ordered an apply, or the process that it changes, and returns when that is over.
void kill_during_apply(const std::string& file, int round, std::mt19937& random) {
  Subprocess order(orcactl({"apply", file}));
  std::this_thread::sleep_for(Seconds(std::uniform_real_distribution<>(0.0, 1.5)(random)));
  if (round % 2 == 0)
    order.send(SIGKILL);
  else
    kill(pid_of_teller(), SIGKILL);
  (void)finish(order, Seconds(30));
  const auto is_over = [&] { return run_orcactl({"diff", file}).exit_code() == 0 && pid_of_teller() > 0; };
  REQUIRE(comes_true(is_over, Seconds(20)));
}

void kill_appliers(int times) {
  Telling telling;
  std::mt19937 random(17);  // NOLINT(cert-msc51-cpp): the same moments each time
  for (int round = 0; round < times; ++round) {
    CAPTURE(round);
    kill_during_apply(telling.write(round / 2 % 2 == 0 ? "test.OtherTeller" : "test.Teller"), round, random);
    const bool is_other = version_that_runs() == 7;
    for (const std::string shown : {"ps", "graph"}) {
      CAPTURE(shown);
      CHECK(shows({shown, "--json"}, "test.OtherTeller") == is_other);
    }
  }
  telling.end();
}

}  // namespace

TEST_CASE("orcactl, the host process and the deployer are killed during swaps", "[system][swap]") {
  kill_again_and_again(6);
}

TEST_CASE("two hundred kills during swaps", "[.][slow][swap]") { kill_again_and_again(200); }

TEST_CASE("orcactl and the host process are killed while a graph is applied", "[system][apply]") {
  kill_appliers(4);
}

TEST_CASE("a hundred kills while graphs are applied", "[.][slow][apply]") { kill_appliers(100); }
