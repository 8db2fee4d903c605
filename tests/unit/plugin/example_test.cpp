// SPDX-License-Identifier: GPL-3.0-or-later
// The component author's example: short, and all that a component needs.
#include <fstream>

#include "orca/plugin/describe.hpp"
#include "places.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace orca::test;

TEST_CASE("the example component has at most 25 lines of code", "[plugin][example]") {
  std::ifstream source(ORCA_SOURCE_DIR "/templates/component/@NAME@.cpp");
  int code_lines = 0;
  for (std::string line; std::getline(source, line);) {
    const auto first = line.find_first_not_of(' ');
    if (first != std::string::npos && line.compare(first, 2, "//") != 0) ++code_lines;
  }
  CHECK(code_lines > 15);
  CHECK(code_lines <= 25);
}

TEST_CASE("the example component declares its two ports and its parameter", "[plugin][example]") {
  const auto library = loaded(kExample);
  const TypeEntry* const type = library->find(PluginKind::component, "orca.Avoid");
  REQUIRE(type != nullptr);
  const auto contract = describe_component(*type, library->path(), nullptr);
  REQUIRE(contract.has_value());
  REQUIRE(contract->ports.size() == 2);
  CHECK(contract->port("ranges")->type.name == "RangeReadings");
  CHECK(contract->port("ranges")->role == Role::proxy);
  CHECK(contract->port("motion")->type.name == "MotionCommand");
  CHECK(contract->port("motion")->role == Role::server);
  REQUIRE(contract->param("stop_distance") != nullptr);
  CHECK(contract->param("stop_distance")->unit == "m");
  CHECK(contract->param("stop_distance")->min == 0.0);
  CHECK(contract->param("stop_distance")->default_value == ParamValue(0.5));
}
