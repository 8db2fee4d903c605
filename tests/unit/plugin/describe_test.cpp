// SPDX-License-Identifier: GPL-3.0-or-later
// Describing a type constructs it and nothing else. A fault of its constructor is reported as an error with
// the fault's text.
#include "orca/plugin/describe.hpp"
#include "orca/hw/container.hpp"
#include "places.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace orca::test;
using Catch::Contains;

namespace {

// Returns the error of the only component type of a test plugin, after the plugin has been unloaded.
Error describing_fails(const std::string& plugin) {
  const auto library = loaded(test_plugin(plugin));
  REQUIRE(library->types().size() == 1);
  const auto contract = describe_component(*library->types().front(), library->path(), nullptr);
  if (contract) FAIL(plugin << " was described");
  return contract.error();
}

}  // namespace

TEST_CASE("a constructor that throws is an error that outlives the plugin", "[plugin][describe]") {
  const Error error = describing_fails("test_throws");
  CHECK_FALSE(is_mapped(test_plugin("test_throws")));
  CHECK(error.code == Code::internal);
  CHECK_THAT(error.text(), Contains("test.Throws") && Contains("the constructor smokes"));
}

TEST_CASE("a constructor that throws no std::exception is an error too", "[plugin][describe]") {
  const Error error = describing_fails("test_throws_int");
  CHECK_FALSE(is_mapped(test_plugin("test_throws_int")));
  CHECK_THAT(error.text(), Contains("test.ThrowsInt") && Contains("threw the int 7"));
}

TEST_CASE("a constructor that asks for the time gets the error that it may only declare",
          "[plugin][describe]") {
  const Error error = describing_fails("test_asks_time");
  CHECK_THAT(error.text(), Contains("test.AsksTime") && Contains("asked for the time") &&
                               Contains("may only declare ports and parameters"));
}

TEST_CASE("a constructor that reads a parameter gets an error that names it", "[plugin][describe]") {
  const Error error = describing_fails("test_reads_param");
  CHECK_THAT(error.text(), Contains("test.ReadsParam") && Contains("it read its parameter \"reach\"") &&
                               Contains("read it in configure() or later"));
}

TEST_CASE("a plugin may hold several types, each found by its kind and name", "[plugin][describe]") {
  const auto library = loaded(test_plugin("test_two"));
  CHECK(library->types().size() == 2);
  CHECK(library->find(PluginKind::component, "test.First") != nullptr);
  CHECK(library->find(PluginKind::hardware, "test.hw.Second") != nullptr);
  CHECK(library->find(PluginKind::hardware, "test.First") == nullptr);
  CHECK(library->find(PluginKind::component, "test.Third") == nullptr);
}

TEST_CASE("a contract holds what the members declare", "[plugin][describe]") {
  const auto library = loaded(test_plugin("test_two"));
  const auto contract =
      describe_component(*library->find(PluginKind::component, "test.First"), library->path(), nullptr);
  REQUIRE(contract.has_value());
  CHECK(contract->type == "test.First");
  CHECK(contract->library == "test_two.so");
  CHECK(contract->kind == PluginKind::component);
  CHECK_FALSE(contract->needs_hardware);
  const ParamContract* const laps = contract->param("laps");
  REQUIRE(laps != nullptr);
  CHECK(laps->type == ParamType::integer);
  CHECK(laps->min == 1.0);
  CHECK(laps->max == 9.0);
  CHECK(laps->default_value == ParamValue(std::int64_t{3}));
  CHECK(laps->text == "How many.");
}

TEST_CASE("hardware is described without opening it, and its preparation reports what is wrong",
          "[plugin][describe]") {
  const auto library = loaded(test_plugin("test_two"));
  const TypeEntry& type = *library->find(PluginKind::hardware, "test.hw.Second");
  const auto hardware = describe_hardware(type, library->path(), "scout");
  REQUIRE(hardware.has_value());
  CHECK((*hardware)->contract().kind == PluginKind::hardware);
  CHECK((*hardware)->contract().param("mode") != nullptr);
  const std::vector<HardwareFault> faults = (*hardware)->prepare({});
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].param.empty());
  CHECK(faults[0].text == "robot.xml:3:1: there is no radius");
  CHECK((*hardware)->prepare({{"mode", std::string("good")}}).empty());
  CHECK((*hardware)->container().state() == hw::HardwareState::closed);
}

TEST_CASE("hardware whose preparation throws is an error with its text", "[plugin][describe]") {
  const auto library = loaded(test_plugin("test_two"));
  const TypeEntry& type = *library->find(PluginKind::hardware, "test.hw.Second");
  const auto hardware = describe_hardware(type, library->path(), "scout");
  REQUIRE(hardware.has_value());
  const auto errors = (*hardware)->prepare({{"mode", std::string("throw")}});
  REQUIRE(errors.size() == 1);
  CHECK_THAT(errors.front().text, Contains("test.hw.Second") && Contains("the robot file smokes"));
}
