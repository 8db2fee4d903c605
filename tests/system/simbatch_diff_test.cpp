// SPDX-License-Identifier: GPL-3.0-or-later
// What depends on more than its seed is found and named, and so is what differs between two batches.
#include <catch2/catch.hpp>

#include <cstdio>
#include <string>

#include "batches.hpp"
#include "deployer.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

TEST_CASE(
    "a variant that depends on addresses, environment, folder or memory that was never set is named with its "
    "first "
    "differing delivery before the batch goes on",
    "[system][batch]") {
  const TempFolder folder;
  const Words guilty{"addresses", "hashes", "environment", "folder", "garbage"};
  const Run run = run_simbatch(
      {dependents(folder, "e.xml", Words{"nothing"} + guilty), "--out", folder.file("out"), "--jobs", "1"});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(split_lines(exported(folder.file("out"))).size() == 13);
  CHECK_FALSE(run.says("variant nothing in world"));
  if (kSanitized) return;  // the sanitizers' own memory has one order
  for (const std::string& variant : guilty) {
    CAPTURE(variant);
    const std::size_t named = run.err.find("warning: variant " + variant +
                                           " in world here with seed 1 depends on more than its seed");
    REQUIRE(named != std::string::npos);
    const std::string line = run.err.substr(named, run.err.find('\n', named) - named);
    CHECK_THAT(line, Contains("delivery 1, MotionCommand 1 of teller to sink.motion at ") &&
                         Contains("speed is ") && Contains(" in the first run and ") &&
                         Contains(" in the second"));
    CHECK(named < run.err.find("12 of 12 runs"));
  }
}

TEST_CASE("what depends on one bit of an address is found in nearly all batches of a hundred runs",
          "[system][batch]") {
  if (kSanitized) return;  // the sanitizers' own memory has one order
  const TempFolder folder;
  const std::string experiment = dependents(folder, "e.xml", {"bit"}, "1-100");
  const int batches = is_slow_run() ? 100 : 6;
  int found = 0;
  for (int i = 0; i < batches; ++i) {
    const Run run = run_simbatch({experiment, "--out", folder.file("out" + std::to_string(i))});
    REQUIRE(run.exit_code() == 0);
    if (run.says("warning: variant bit in world here with seed ")) ++found;
  }
  std::fprintf(stderr, "found in %d of %d batches\n", found, batches);
  CHECK(found >= (is_slow_run() ? 96 : 4));  // of each batch 1 in 128 is missed
}

TEST_CASE("two batches that are the same are the same for diff, too", "[system][batch]") {
  const TempFolder folder;
  const std::string experiment = dependents(folder, "e.xml", {"nothing"});
  (void)batch(experiment, folder.file("a"));
  (void)batch(experiment, folder.file("b"));
  const Run run = run_simbatch({"diff", folder.file("a"), folder.file("b")});
  CHECK(run.exit_code() == 0);
  CHECK(run.out == "all 2 runs are the same\n");
}

TEST_CASE("diff names the first run that differs between two batches, and its first differing delivery",
          "[system][batch]") {
  const TempFolder folder;
  const std::string experiment = dependents(folder, "e.xml", {"addresses"});
  const std::string a = folder.file("a");
  const std::string b = folder.file("b");
  (void)batch(experiment, a);
  // Without the caches for small blocks, memory comes in another order.
  Subprocess other(Words{"/usr/bin/env", "GLIBC_TUNABLES=glibc.malloc.tcache_count=0"} +
                   simbatch({experiment, "--out", b}));
  REQUIRE(finish(other, Seconds(60)).exit_code() == 0);
  const Run run = run_simbatch({"diff", a, b});
  INFO(run.out + run.err);
  if (kSanitized) {
    CHECK(run.exit_code() < 2);
    return;
  }
  CHECK(run.exit_code() == 1);
  CHECK_THAT(run.out, Contains("2 of 2 runs that both have differ") &&
                          Contains("the first is variant addresses, world here, seed 1:") &&
                          Contains("trace_hash is ") &&
                          Contains("first delivery that differs: delivery 1, ") &&
                          Contains(" of teller to sink.motion at ") && Contains("speed is ") &&
                          Contains(" in " + a + " and ") && Contains(" in " + b));
}

TEST_CASE("diff shows what a changed parameter changes first", "[system][batch]") {
  const TempFolder folder;
  const auto at = [&](const std::string& name, const std::string& speed) {
    const std::string experiment =
        folder.write(name + ".xml", "<experiment name=\"e\" seeds=\"1\" until=\"10 s\" graph=\"" +
                                        source_file("graphs/pioneer_laser_goto.xml") +
                                        "\"><set arg=\"goto.max_speed\" value=\"" + speed +
                                        "\"/><variant name=\"v\"/><world name=\"w\"/></experiment>");
    (void)batch(experiment, folder.file(name));
    return folder.file(name);
  };
  const Run run = run_simbatch({"diff", at("slow", "0.2 m/s"), at("fast", "0.3 m/s")});
  INFO(run.out + run.err);
  CHECK(run.exit_code() == 1);
  CHECK_THAT(run.out, Contains("first delivery that differs: delivery ") && Contains(" of goto to ") &&
                          Contains(": speed is ") && Contains(" in " + folder.file("slow") + " and "));
}

TEST_CASE("diff says which runs only one batch has, and why a run cannot be made again", "[system][batch]") {
  const TempFolder folder;
  const std::string experiment = dependents(folder, "e.xml", {"hashes"});
  (void)batch(experiment, folder.file("a"));
  (void)batch(dependents(folder, "e.xml", {"hashes", "nothing"}), folder.file("b"));
  const Run run = run_simbatch({"diff", folder.file("a"), folder.file("b")});
  CHECK(run.exit_code() == 1);
  CHECK_THAT(run.out, Contains("2 runs are in " + folder.file("b") + " only"));
  if (kSanitized) return;
  CHECK_THAT(run.out, Contains("2 runs are in " + folder.file("b") + " only") &&
                          Contains("it cannot be made again: \"" + experiment +
                                   "\", or a graph that it names, was changed since " + folder.file("a") +
                                   " was made"));
}
