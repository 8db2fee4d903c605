// SPDX-License-Identifier: GPL-3.0-or-later
#include "inspection/plugin_layouts.hpp"

#include <catch2/catch.hpp>

#include "inspection/plugin_file.hpp"
#include "orca/component/generated/plugin_layouts.hpp"
#include "places.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace std::string_view_literals;
using Catch::Contains;

namespace {

constexpr std::string_view kOurs =
    "orca::Component 000000000000000a\0orca::Param<double> 000000000000000b\0"sv;

std::optional<std::string> fault_against_ours(std::string_view theirs) {
  return layout_fault(theirs, hash_of_layouts(theirs), kOurs);
}

}  // namespace

TEST_CASE("a plugin that was built for our layouts fits, and so does one that knows fewer types",
          "[plugin][layouts]") {
  CHECK_FALSE(fault_against_ours(kOurs).has_value());
  CHECK_FALSE(fault_against_ours("orca::Param<double> 000000000000000b\0"sv).has_value());
}

TEST_CASE("a plugin that was built for another layout is refused with the type and both hashes",
          "[plugin][layouts]") {
  const auto fault =
      fault_against_ours("orca::Component 000000000000000c\0orca::Param<double> 000000000000000b\0"sv);
  REQUIRE(fault.has_value());
  CHECK(
      *fault ==
      "was built for other layouts of what crosses the plugin boundary: orca::Component (000000000000000c in "
      "the plugin, 000000000000000a in this Orca); build it again with this Orca");
}

TEST_CASE("of many other layouts four are named and the rest is counted", "[plugin][layouts]") {
  const auto fault = fault_against_ours("A 1\0B 2\0C 3\0D 4\0E 5\0F 6\0"sv);
  REQUIRE(fault.has_value());
  CHECK_THAT(*fault,
             Contains("D (4 in the plugin, none in this Orca)") && !Contains("E (5") && Contains("2 more"));
}

TEST_CASE("a plugin that was built with a type that has gone is refused", "[plugin][layouts]") {
  const auto fault = fault_against_ours("orca::Gone 000000000000000c\0"sv);
  REQUIRE(fault.has_value());
  CHECK_THAT(*fault, Contains("orca::Gone (000000000000000c in the plugin, none in this Orca)"));
}

TEST_CASE("a plugin whose list of layouts is missing or not that of its manifest is refused",
          "[plugin][layouts]") {
  const auto none = layout_fault("", 0, kOurs);
  REQUIRE(none.has_value());
  CHECK_THAT(*none, Contains("no section orca_plugin_layouts") && Contains("orca_add_component()"));
  const auto damaged = layout_fault(kOurs, hash_of_layouts(kOurs) + 1, kOurs);
  REQUIRE(damaged.has_value());
  CHECK_THAT(*damaged, Contains("is damaged"));
}

TEST_CASE("the build lists the layouts of components, hosts and ports, and hashes them as the loader does",
          "[plugin][layouts]") {
  CHECK(hash_of_layouts(our_layouts()) == detail::plugin_layouts_hash);
  for (const std::string type :
       {"orca::Component", "orca::ComponentHost", "orca::PushServerHandle", "orca::Param<double>",
        "orca::detail::Slot", "orca::hw::HardwareContainer", "orca::hw::HardwareServer"})
    CHECK_THAT(std::string(our_layouts()), Contains(type + " "));
}

TEST_CASE("no endpoint, edge or host of the runtime crosses the plugin boundary", "[plugin][layouts]") {
  for (const std::string type : {"Endpoint ", "PushEdge", "RequestClient", "PortHome", "ComponentInstance"})
    CHECK_THAT(std::string(our_layouts()), !Contains("orca::" + type) && !Contains("::Push" + type));
}
