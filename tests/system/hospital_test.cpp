// SPDX-License-Identifier: GPL-3.0-or-later
// The floor plan of a real hospital. The picture is not part of this repository.
#include <catch2/catch.hpp>
#include <cmath>

#include "deployer.hpp"
#include "public_data.hpp"

using namespace orca::test;

namespace {

constexpr const char* kMap = "stage_maps/hospital.png";

Run drive(const std::string& map, const Words& more = {}) {
  return run_deployer(Words{source_file("graphs/scout_hospital.xml"), "--set", "map=" + map} +
                      virtual_clock() + more);
}

}  // namespace

TEST_CASE("in the hospital the Scout reaches its goals and touches nothing", "[system][data]") {
  const std::string map = public_data(kMap);
  if (map.empty()) return;
  const Run run = drive(map);
  INFO(run.err);
  REQUIRE(run.ended);
  CHECK(run.exit_code() == 0);
  CHECK(run.contacts().empty());
  CHECK(run.trace_hash());
  const std::vector<Arrival> arrivals = run.arrivals();
  REQUIRE(arrivals.size() >= 2);
  for (std::size_t i = 1; i < arrivals.size(); ++i)
    CHECK(std::hypot(arrivals[i].x - arrivals[i - 1].x, arrivals[i].y - arrivals[i - 1].y) >= 15.0);
}

TEST_CASE("the hospital is 140 m wide unless map_width says otherwise", "[system][data]") {
  const std::string map = public_data(kMap);
  if (map.empty()) return;
  const std::optional<std::string> usual = drive(map, {"--until", "5s"}).trace_hash();
  REQUIRE(usual);
  CHECK(drive(map, {"--until", "5s", "--set", "map_width=140 m"}).trace_hash() == usual);
  CHECK(drive(map, {"--until", "5s", "--set", "map_width=139 m"}).trace_hash() != usual);
}

TEST_CASE("without a map the hospital graph says which argument to set", "[system]") {
  const Run run = run_deployer(Words{source_file("graphs/scout_hospital.xml")} + virtual_clock());
  CHECK(run.exit_code() == 2);
  CHECK(run.out.empty());
  CHECK(run.says("--set map="));
}

TEST_CASE("a map that is not there is named, and nothing starts", "[system]") {
  const Run run = drive("no_such_map.png");
  CHECK(run.exit_code() == 2);
  CHECK(run.out.empty());
  CHECK(run.says("no_such_map.png"));
}
