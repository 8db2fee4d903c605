// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of graphs/random_walk.xml: a robot that drives about.
#include <catch2/catch.hpp>

#include "deployer.hpp"

using namespace orca::test;

namespace {

Run walk(const Words& more) {
  return run_deployer(Words{source_file("graphs/random_walk.xml"), "--until", "300 s"} + virtual_clock() +
                      more);
}

}  // namespace

TEST_CASE("the Scout drives about the office for five minutes and touches nothing, at every realism",
          "[system][walk]") {
  for (const char* realism : {"ideal", "nominal", "harsh"}) {
    for (const char* seed : {"1", "2", "3"}) {
      const Run run = walk({"--set", std::string("realism=") + realism, "--seed", seed});
      INFO(run.err);
      CAPTURE(realism, seed);
      CHECK(run.exit_code() == 0);
      CHECK(run.contacts().empty());
    }
  }
}

TEST_CASE("the same seed gives the same walk, another seed another", "[system][walk]") {
  const auto hash = walk({"--seed", "5"}).trace_hash();
  REQUIRE(hash.has_value());
  CHECK(walk({"--seed", "5"}).trace_hash() == hash);
  CHECK(walk({"--seed", "6"}).trace_hash() != hash);
}
