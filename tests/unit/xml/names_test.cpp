// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <vector>

#include "orca/xml/names.hpp"

using namespace orca::xml;

TEST_CASE("the nearest name is the one with the fewest typing errors", "[xml][names]") {
  const std::vector<std::string> ports{"sonar", "laser", "odometry", "goal"};
  CHECK(nearest_name("lazer", ports) == "laser");       // replaced
  CHECK(nearest_name("lasre", ports) == "laser");       // swapped
  CHECK(nearest_name("odmetry", ports) == "odometry");  // left out
  CHECK(nearest_name("goall", ports) == "goal");        // doubled
  CHECK(nearest_name("SONAR", ports) == "sonar");       // other case
}

TEST_CASE("a word that resembles nothing has no nearest name", "[xml][names]") {
  const std::vector<std::string> ports{"sonar", "laser"};
  CHECK_FALSE(nearest_name("wheel", ports));
  CHECK_FALSE(nearest_name("", ports));
  CHECK_FALSE(nearest_name("x", std::vector<std::string>{"y"}));
  CHECK_FALSE(nearest_name("laser", {}));
}

TEST_CASE("the first of equally near names is taken", "[xml][names]") {
  CHECK(nearest_name("port3", std::vector<std::string>{"port1", "port2"}) == "port1");
}

TEST_CASE("a name that was cut short or made longer is still known", "[xml][names]") {
  const std::vector<std::string> names{"sim", "stop_distance", "stopwatch"};
  CHECK(nearest_name("stop_dist", names) == "stop_distance");
  CHECK(nearest_name("simulation", names) == "sim");
  CHECK_FALSE(nearest_name("si", std::vector<std::string>{"sideways"}));
}

TEST_CASE("a hint is a question, or nothing", "[xml][names]") {
  CHECK(did_you_mean("laser") == "; did you mean \"laser\"?");
  CHECK(did_you_mean(std::nullopt).empty());
}
