// SPDX-License-Identifier: GPL-3.0-or-later
// A system that gives no more memory, threads or descriptors is exit status 3 with a sentence, never a crash.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
namespace fs = std::filesystem;

namespace {

Run run_with(const std::string& limit, const Words& words, const Words& shell = {"/bin/sh", "-c"}) {
  Subprocess program(shell + Words{limit + " && exec \"$@\"", "sh"} + deployer(words));
  return finish(program, Seconds(20));
}

Words short_run(const std::string& executor) {
  return {source_file("graphs/scout_goto.xml"), "--executor", executor, "--until", "0.2 s"};
}

// Returns whether the run was refused for want of something; otherwise it must have gone well.
bool is_refused(const Run& run) {
  INFO(run.err);
  CHECK(run.ended);
  CHECK(run.ending.signal == 0);
  CHECK((run.exit_code() == 0 || run.exit_code() == 3));
  if (run.exit_code() == 3) CHECK(run.says("the system gives no more"));
  return run.exit_code() == 3;
}

}  // namespace

TEST_CASE("with too little memory the run is refused with exit status 3 and a sentence",
          "[system][exhaustion]") {
  if (kSanitized) return;  // a sanitizer needs terabytes of addresses, and threads of its own
  for (const std::string executor : {"thread", "fiber", "baton"}) {
    int refused = 0;
    for (int kilobytes = 30'000; kilobytes <= 120'000; kilobytes += 5'000) {
      CAPTURE(executor, kilobytes);
      refused += is_refused(run_with("ulimit -v " + std::to_string(kilobytes), short_run(executor))) ? 1 : 0;
    }
    CHECK(refused > 0);
  }
}

TEST_CASE("with too few descriptors the run is refused with exit status 3 and a sentence",
          "[system][exhaustion]") {
  if (kSanitized) return;
  int refused = 0;
  for (int descriptors = 5; descriptors <= 12; ++descriptors) {
    CAPTURE(descriptors);
    refused += is_refused(run_with("ulimit -n " + std::to_string(descriptors), short_run("thread"))) ? 1 : 0;
  }
  CHECK(refused > 0);
}

TEST_CASE("with too few threads the run is refused with exit status 3 and a sentence",
          "[system][exhaustion]") {
  if (kSanitized) return;
  // The limit counts all processes of a user and does not hold for root. Another user has a runtime folder of their own.
  constexpr uid_t kUser = 61234;
  const TempFolder folder;
  if (geteuid() == 0) REQUIRE(chown(folder.path().c_str(), kUser, kUser) == 0);
  const Words shell = geteuid() == 0 ? Words{"/usr/bin/setpriv", "--reuid",   std::to_string(kUser),
                                             "--clear-groups",   "/bin/bash", "-c"}
                                     : Words{"/bin/bash", "-c"};
  int refused = 0;
  for (int threads = 1; threads <= 8; ++threads) {
    CAPTURE(threads);
    const Run run = run_with(
        "export XDG_RUNTIME_DIR=" + folder.path().string() + "; ulimit -u " + std::to_string(threads),
        short_run("thread"), shell);
    if (run.exit_code() == 126 || run.exit_code() == 127) {
      WARN("this user cannot run the program");
      return;
    }
    refused += is_refused(run) ? 1 : 0;
  }
  CHECK(refused > 0);
}

TEST_CASE("a plugin larger than any plugin is refused without being read", "[system][exhaustion]") {
  const TempFolder folder;
  folder.write("big.types", "component test.Big\n");
  fs::resize_file(folder.write("big.so", ""), 100'000'000'000);
  const Run described = run_deployer({"--describe", folder.file("big.so")});
  CHECK(described.exit_code() == 2);
  CHECK(described.says("has 100000000000 bytes; a plugin has at most 1 GB"));
  const std::string graph = folder.write(
      "graph.xml",
      R"(<graph name="a" version="1" plugins="."><component name="big" type="test.Big"/></graph>)");
  const Run checked = run_deployer({graph, "--check"});
  INFO(checked.err);
  CHECK(checked.exit_code() == 2);
  CHECK(checked.says("error G028"));
  CHECK(checked.says("a plugin has at most 1 GB"));
}
