// SPDX-License-Identifier: GPL-3.0-or-later
// One trace hash on every x86-64 processor: docs/adr/0032-one-arithmetic.md and 0047-own-functions.md.
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>

#include "deployer.hpp"
#include "shipped_graph.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

#if defined(__x86_64__)

using namespace orca::test;

namespace {

const Words kWalk{source_file("graphs/random_walk.xml"), "--until", is_slow_run() ? "600 s" : "100 s"};

bool fuses() { return __builtin_cpu_supports("fma") != 0 || __builtin_cpu_supports("fma4") != 0; }

// Runs a command with the C library told to use fewer of the processor's instructions.
Words with_tunables(const std::string& tunables, const Words& command) {
  return Words{"/usr/bin/env", "GLIBC_TUNABLES=" + tunables} + command;
}

std::string hash_with(const std::string& tunables) {
  Subprocess program(with_tunables(tunables, deployer(kWalk + virtual_clock())));
  const Run run = finish(program, Seconds(60));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  REQUIRE(run.trace_hash());
  return *run.trace_hash();
}

// The trace hashes of the first seconds of all shipped graphs that run in virtual time, by graph.
using Hashes = std::map<std::string, std::string>;

// @param before  words in front of the deployer's command, such as env and its assignments.
Hashes hashes_of_shipped_graphs(const Words& before) {
  const TempFolder folder;
  Hashes hashes;
  for (const std::string& graph : shipped_graphs()) {
    if (graph == "scout_teleop" || graph == "scout_player") continue;  // driven from outside
    if (graph == "emulated_devices") continue;                         // they live in real time
    CAPTURE(graph);
    const Words words{source_file("graphs/" + graph + ".xml"), "--until", "5 s"};
    Subprocess program(before + deployer(words + virtual_clock() + needed_arguments(graph, folder)));
    const Run run = finish(program, Seconds(60));
    INFO(run.err);
    REQUIRE(run.exit_code() == 0);
    REQUIRE(run.trace_hash());
    hashes[graph] = *run.trace_hash();
  }
  return hashes;
}

std::string of_process(const std::string& file) {
  std::ifstream stream("/proc/" + file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Returns the number of the only process whose command line contains a text.
std::string process_with(const std::string& text) {
  std::string found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string number = entry.path().filename().string();
    if (number.find_first_not_of("0123456789") == std::string::npos &&
        of_process(number + "/cmdline").find(text) != std::string::npos)
      found = number;
  }
  return found;
}

// Returns whether the program has blocked SIGINT to read it in its own time: from then on it ends as it should when it
// is interrupted.
bool awaits_interrupts(const std::string& process) {
  const std::string status = of_process(process + "/status");
  const std::string mark = "SigBlk:\t";
  const auto found = status.find(mark);
  return found != std::string::npos &&
         (std::stoull(status.substr(found + mark.size(), 16), nullptr, 16) >> (SIGINT - 1) & 1) != 0;
}

}  // namespace

TEST_CASE("the trace hash is that of a processor without fused multiply-add", "[system][arithmetic][tool]") {
  if (!fuses()) {
    std::cout << "SKIPPED: this processor cannot fuse, so there is nothing to compare\n";
    return;
  }
  const std::string usual = hash_with("");
  for (const char* fewer : {"-FMA", "-FMA,-FMA4", "-AVX2", "-AVX,-AVX2,-FMA,-FMA4", "-SSE4_1,-FMA"}) {
    CAPTURE(fewer);
    CHECK(hash_with(std::string("glibc.cpu.hwcaps=") + fewer) == usual);
  }
}

// The mark tells the deployer that it has been started anew already, so the C library keeps its choice: only Orca's own
// functions can make these equal.
TEST_CASE("shipped graphs have one trace hash even if the C library fuses", "[system][arithmetic][tool]") {
  if (!fuses()) {
    std::cout << "SKIPPED: this processor cannot fuse, so there is nothing to compare\n";
    return;
  }
  const Words as_it_is{"/usr/bin/env", "ORCA_PORTABLE_ARITHMETIC=1"};
  const Hashes fusing = hashes_of_shipped_graphs(as_it_is);
  CHECK(hashes_of_shipped_graphs(as_it_is + Words{"GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4"}) == fusing);
  CHECK(hashes_of_shipped_graphs(
            as_it_is + Words{"GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-AVX,-FMA,-FMA4,-SSE4_2,-SSE4_1"}) ==
        fusing);
}

TEST_CASE("shipped graphs have the same trace hash on an old processor", "[system][arithmetic][tool]") {
  if (kSanitized || std::system("qemu-x86_64 --version >/dev/null 2>&1") != 0) {
    std::cout << "SKIPPED: qemu-x86_64, of Debian's package qemu-user, is not installed, or cannot run this "
                 "build\n";
    return;
  }
  const Hashes here = hashes_of_shipped_graphs({});
  CHECK(hashes_of_shipped_graphs({"/usr/bin/env", "qemu-x86_64", "-cpu", "core2duo"}) == here);
  CHECK(hashes_of_shipped_graphs({"/usr/bin/env", "qemu-x86_64", "-cpu", "Nehalem"}) == here);
}

TEST_CASE("a run in virtual time is the same by any path of the program", "[system][arithmetic]") {
  const Words walk = Words{source_file("graphs/random_walk.xml"), "--until", "10 s"} + virtual_clock();
  const Run usual = run_deployer(walk);
  Words command = deployer(walk);
  const std::string folder = std::filesystem::path(command.front()).parent_path().string();
  command.front() = "./deployer";
  Subprocess program(command, {.folder = folder});
  const Run other = finish(program, Seconds(30));
  INFO(other.err);
  CHECK(other.exit_code() == 0);
  REQUIRE(usual.trace_hash());
  CHECK(other.trace_hash() == usual.trace_hash());
}

TEST_CASE("the new start keeps the user's arguments, tunables and process", "[system][arithmetic][tool]") {
  if (!fuses()) {
    std::cout << "SKIPPED: this processor cannot fuse, so there is no new start\n";
    return;
  }
  const std::string seed = "900" + std::to_string(getpid());
  Words command = deployer(Words{source_file("graphs/random_walk.xml"), "--seed", seed} + virtual_clock());
  const std::string folder = std::filesystem::path(command.front()).parent_path().string();
  command.front() = "./deployer";
  Subprocess program(with_tunables("glibc.malloc.perturb=0:glibc.cpu.hwcaps=-AVX512F", command),
                     {.folder = folder});
  std::string process;
  std::string environment;
  while (environment.find("-FMA") == std::string::npos) {
    REQUIRE_FALSE(program.wait(Seconds(0.02)));
    process = process_with(seed);
    environment = of_process(process + "/environ");
  }
  // The C library puts a zero for each colon when it reads the tunables.
  std::replace(environment.begin(), environment.end(), '\0', ':');
  const std::string tunables = environment.substr(environment.find("GLIBC_TUNABLES="), 80);
  CHECK_THAT(tunables, Catch::StartsWith(
                           "GLIBC_TUNABLES=glibc.malloc.perturb=0:glibc.cpu.hwcaps=-AVX512F,-FMA,-FMA4:"));
  CHECK_THAT(of_process(process + "/cmdline"), Catch::StartsWith("./deployer"));
  CHECK(of_process(process + "/comm") == "deployer\n");
  for (int look = 0; look < 1500 && !awaits_interrupts(process); ++look)
    REQUIRE_FALSE(program.wait(Seconds(0.02)));
  REQUIRE(awaits_interrupts(process));
  program.send(SIGINT);
  const Run run = finish(program, Seconds(10));
  CHECK(run.exit_code() == 0);
  CHECK(run.trace_hash());
}

#endif
