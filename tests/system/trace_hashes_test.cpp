// SPDX-License-Identifier: GPL-3.0-or-later
// Every shipped graph that runs in virtual time does exactly what it did before, even while the code is
// restructured.
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "deployer.hpp"
#include "public_data.hpp"

using namespace orca::test;

namespace {

struct Expected {
  std::string graph;
  std::string seed;
  std::string hash;
};

std::vector<Expected> expected_hashes() {
  std::ifstream list(source_file("tests/data/trace_hashes.txt"));
  std::vector<Expected> all;
  for (std::string line; std::getline(list, line);) {
    if (line.empty() || line.front() == '#') continue;
    Expected one;
    std::istringstream(line) >> one.graph >> one.seed >> one.hash;
    all.push_back(one);
  }
  return all;
}

// Compares all seeds of one graph.
void compare(const std::string& graph, const Words& more) {
  std::size_t compared = 0;
  for (const Expected& expected : expected_hashes()) {
    if (expected.graph != graph) continue;
    const Run run = run_deployer(Words{source_file("graphs/" + graph + ".xml")} + virtual_clock() + more +
                                 Words{"--seed", expected.seed, "--until", "60s"});
    INFO(graph << ", seed " << expected.seed << "\n" << run.err);
    CHECK(run.trace_hash() == expected.hash);
    ++compared;
  }
  CHECK(compared == 3);
}

}  // namespace

TEST_CASE("the shipped graphs keep their trace hashes", "[system]") {
  compare("scout_goto", {});
  compare("pioneer_laser_goto", {});
  compare("random_walk", {});
}

TEST_CASE("the hospital's run keeps its trace hashes", "[system][data]") {
  if (const std::string map = public_data("stage_maps/hospital.png"); !map.empty())
    compare("scout_hospital", {"--set", "map=" + map});
}
