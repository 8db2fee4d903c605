// SPDX-License-Identifier: GPL-3.0-or-later
// The same seed, graph and binaries give the same run, whatever the load and the back end.
#include <catch2/catch.hpp>
#include <map>
#include <memory>
#include <thread>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

constexpr int kRunsEach = kSanitized ? 1 : 5;  // with two executors, idle and under load: twenty

std::string hash_of(const Words& more) {
  const Words graph{source_file("graphs/scout_goto.xml"), "--clock", "virtual"};
  const Run run = run_deployer(graph + more, Seconds(120));
  INFO(run.err);
  REQUIRE(run.ended);
  REQUIRE(run.exit_code() == 0);
  REQUIRE(run.trace_hash());
  return *run.trace_hash();
}

std::vector<std::string> executors() {
  if (kThreadSanitizer) return {"baton"};  // ThreadSanitizer does not support fibers
  return {"fiber", "baton"};
}

// Starts a busy program per core.
std::vector<std::unique_ptr<Subprocess>> cpu_hogs() {
  std::vector<std::unique_ptr<Subprocess>> hogs;
  for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i)
    hogs.push_back(std::make_unique<Subprocess>(Words{"/bin/sh", "-c", "while :; do :; done"}));
  return hogs;
}

std::map<std::string, int> count_hashes() {
  std::map<std::string, int> hashes;
  for (const std::string& executor : executors())
    for (int i = 0; i < kRunsEach; ++i) ++hashes[hash_of({"--executor", executor})];
  return hashes;
}

}  // namespace

TEST_CASE("twenty runs have one trace hash, with fiber and baton, idle and with a busy program per core",
          "[system][determinism]") {
  std::map<std::string, int> hashes = count_hashes();
  {
    const auto hogs = cpu_hogs();
    for (const auto& [hash, count] : count_hashes()) hashes[hash] += count;
  }
  CAPTURE(hashes);
  REQUIRE(hashes.size() == 1);
  CHECK(hashes.begin()->second == 2 * kRunsEach * static_cast<int>(executors().size()));
}

TEST_CASE("another seed gives another trace hash, and seed 1 is the default", "[system][determinism]") {
  const std::string executor = executors().back();
  const std::string usual = hash_of({"--executor", executor});
  CHECK(hash_of({"--executor", executor, "--seed", "1"}) == usual);
  CHECK(hash_of({"--executor", executor, "--seed", "2"}) != usual);
}

TEST_CASE("two traces of the same run are the same, byte for byte", "[system][determinism]") {
  const TempFolder folder;
  for (const char* name : {"a", "b"})
    hash_of({"--executor", executors().back(), "--until", "10s", "--trace", folder.file(name)});
  const std::string trace = read_text(folder.file("a"));
  CHECK(trace.size() > 10000);
  CHECK(trace == read_text(folder.file("b")));
}

TEST_CASE("neither the folder in which a run starts nor tracing changes its hash", "[system][determinism]") {
  const TempFolder folder;
  const Words words{source_file("graphs/scout_goto.xml"),
                    "--clock",
                    "virtual",
                    "--executor",
                    executors().back(),
                    "--until",
                    "10s"};
  const Run plain = run_deployer(words, Seconds(60));
  Subprocess elsewhere(deployer(words + Words{"--trace", folder.file("trace"), "--log", "debug"}),
                       {.folder = folder.path().string()});
  const Run other = finish(elsewhere, Seconds(60));
  REQUIRE(plain.trace_hash());
  CHECK(plain.trace_hash() == other.trace_hash());
}

TEST_CASE("the number of threads that compute sensor readings changes nothing, and no thread is left behind",
          "[system][determinism]") {
  std::map<std::string, int> hashes;
  for (const char* threads : {"1", "2", "3"}) {
    const Run run =
        run_deployer(Words{system_graph("two_walkers.xml"), "--clock", "virtual", "--executor",
                           executors().back(), "--until", "20 s", "--set", std::string("threads=") + threads},
                     Seconds(60));
    CAPTURE(threads, run.err);
    REQUIRE(run.exit_code() == 0);
    REQUIRE(run.trace_hash());
    CHECK(run.err.empty());
    ++hashes[*run.trace_hash()];
  }
  CAPTURE(hashes);
  CHECK(hashes.size() == 1);
}
