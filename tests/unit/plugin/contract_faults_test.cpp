// SPDX-License-Identifier: GPL-3.0-or-later
// What a type may declare of ports and parameters.
#include "contract_faults.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace orca;
using namespace orca::plugin;
using Catch::Contains;

namespace {

PortContract port(const std::string& name) {
  PortContract port;
  port.name = name;
  return port;
}

ParamContract param(const std::string& unit, ParamValue value) {
  ParamContract param;
  param.name = "x";
  param.unit = unit;
  param.default_value = std::move(value);
  return param;
}

std::string contract_fault(std::vector<PortContract> ports, std::vector<ParamContract> params) {
  Contract contract;
  contract.ports = std::move(ports);
  contract.params = std::move(params);
  const std::vector<std::string> faults = faults_of(contract);
  CHECK(faults.size() <= 1);
  return faults.empty() ? "" : faults.front();
}

std::string contract_fault(const ParamContract& param) { return contract_fault({}, {param}); }

ParamContract between(double min, double max, ParamValue value) {
  ParamContract made = param("m", std::move(value));
  made.min = min;
  made.max = max;
  return made;
}

}  // namespace

TEST_CASE("names of ports and of parameters are there once each", "[plugin][contract]") {
  CHECK(contract_fault({port("motion"), port("sonar")}, {}).empty());
  CHECK(contract_fault({port("motion"), port("motion")}, {}) ==
        "it has two ports of the name \"motion\"; give one of them another name");
  CHECK_THAT(contract_fault({}, {param("m", 1.0), param("m", 2.0)}),
             Contains("two parameters of the name \"x\""));
  CHECK(contract_fault({port("x")}, {param("m", 1.0)}).empty());
}

TEST_CASE("a name is a letter, then letters, digits and underscores", "[plugin][contract]") {
  CHECK(contract_fault({port("Motion_2Push")}, {}).empty());
  for (const char* name : {"", "2nd", "_a", "my port", "a.b", "a/b", "a[]", "caf\xc3\xa9"}) {
    CAPTURE(name);
    CHECK_THAT(contract_fault({port(name)}, {}),
               Contains("port is called") && Contains("a name is a letter"));
  }
}

TEST_CASE("a name has at most two hundred characters, and is shown shortened", "[plugin][contract]") {
  CHECK(contract_fault({port(std::string(200, 'a'))}, {}).empty());
  const std::string fault = contract_fault({port(std::string(1'000'000, 'a'))}, {});
  CHECK_THAT(fault, Contains("port is called") && Contains("at most 200"));
  CHECK(fault.size() < 1000);
}

TEST_CASE("laps start at a period of a microsecond or more, and no time is negative", "[plugin][contract]") {
  const auto fault_of = [](Trigger::Kind kind, Duration period) {
    Contract contract;
    contract.default_trigger = {kind, period, {}};
    const std::vector<std::string> faults = faults_of(contract);
    return faults.empty() ? std::string() : faults.front();
  };
  CHECK(fault_of(Trigger::Kind::period, 1us).empty());
  CHECK(fault_of(Trigger::Kind::free_running, 0s).empty());
  CHECK(fault_of(Trigger::Kind::on_any, 0s).empty());
  CHECK_THAT(fault_of(Trigger::Kind::period, -1s), Contains("every -1 s; a period is 1 us or longer"));
  CHECK_THAT(fault_of(Trigger::Kind::period, 0s), Contains("a period is 1 us or longer"));
  CHECK_THAT(fault_of(Trigger::Kind::on_all, -1s), Contains("is negative"));
  PortContract slow = port("a");
  slow.queue.deadline = -1s;
  CHECK_THAT(contract_fault({slow}, {}), Contains("a time of the port \"a\" is negative"));
  PortContract narrow = port("a");
  narrow.queue.depth = 0;
  CHECK_THAT(contract_fault({narrow}, {}), Contains("a queue of 0 objects"));
}

TEST_CASE("a unit is one of SI, a product or a quotient of them", "[plugin][contract]") {
  for (const char* unit : {"", "m", "s", "rad", "m/s", "rad/s2", "1/s", "m2", "N m", "kg m2", "%", "Hz"})
    CHECK(contract_fault(param(unit, 1.0)).empty());
  for (const char* unit : {"furlong", "mm", "deg", "m/", "/s", "m//s", " ", "m s-1", "2"}) {
    CAPTURE(unit);
    CHECK_THAT(contract_fault(param(unit, 1.0)), Contains("which is none of SI; write for example m, rad"));
  }
}

TEST_CASE("a default lies within its own range", "[plugin][contract]") {
  CHECK(contract_fault(between(0.0, 1.0, 0.0)).empty());
  CHECK(contract_fault(between(0.0, 1.0, 1.0)).empty());
  CHECK(contract_fault(between(0.0, 1.0, std::int64_t{1})).empty());
  for (const double wrong : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THAT(contract_fault(between(0.0, 1.0, wrong)),
               Contains("the default of the parameter \"x\" is outside of its own range"));
  CHECK_THAT(contract_fault(between(0.0, 1.0, std::int64_t{2})), Contains("outside of its own range"));
  CHECK(faults_of([] {
          Contract contract;
          contract.params = {between(2.0, 1.0, 1.5)};
          return contract;
        }())
            .front() == "the parameter \"x\" has a min above its max; exchange them");
}

TEST_CASE("a default text is one of its choices", "[plugin][contract]") {
  ParamContract mode = param("", std::string("fast"));
  mode.choices = {"slow", "fast"};
  CHECK(contract_fault(mode).empty());
  mode.default_value = std::string("fats");
  CHECK(contract_fault(mode) ==
        "the default \"fats\" of the parameter \"x\" is none of its choices: slow, fast");
}
