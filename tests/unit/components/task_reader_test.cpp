// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "task_tree/task.hpp"

using namespace orca::tasks;
using Catch::Contains;

namespace {

const std::vector<Sight>& sights() {
  static const std::vector<Sight> all{
      {"battery", {"name", "voltage", "charge", "charging"}},
      {"gripper", {"open", "holds"}, {{"open", {"true", "false"}}, {"holds", {"true", "false"}}}},
      {"localization", {"state", "share", "places"}, {{"state", {"LOST", "LOCALIZED"}}}}};
  return all;
}

std::string faults_of(const std::string& text) {
  orca::xml::Diagnostics diagnostics;
  const auto task = read_task_text(text, "t.xml", sights(), diagnostics);
  CHECK((task || diagnostics.has_errors()));
  return diagnostics.text();
}

// Returns the one fault of a task of these steps.
std::string fault_of(const std::string& steps) {
  const std::string text = faults_of("<task name=\"t\" version=\"1\">\n" + steps + "\n</task>");
  INFO(steps << '\n' << text);
  CHECK(std::ranges::count(text, '\n') == 1);
  return text;
}

struct Case {
  const char* steps;
  const char* place;  // line:column and code
  const char* words;
};

// Sixty task files, each with a fault of its own.
const std::array kCases{
    Case{R"(<Drve to="a"/>)", "2:1: error K002", "did you mean \"Drive\""},
    Case{R"(<drive to="a"/>)", "2:1: error K002", "did you mean \"Drive\""},
    Case{R"(<Sequnce><Wait for="1 s"/></Sequnce>)", "2:1: error K002", "Sequence"},
    Case{R"(<SubTree ID="x"/>)", "2:1: error K002", "it may contain"},
    Case{R"(<Inverter><Wait for="1 s"/></Inverter>)", "2:1: error K002", "there is no element"},
    Case{R"(<On when="alarm X" then="resume"><Wait for="1 s"/></On>)", "2:1: error K003", "<Try>"},
    Case{R"(<Catch reason="any" then="done"><Wait for="1 s"/></Catch>)", "2:1: error K003", "<Try>"},
    Case{R"(<Sequence><Catch reason="any" then="done"><Wait for="1 s"/></Catch></Sequence>)",
         "2:11: error K003", "<Try>"},
    Case{R"(<Fallback><task name="x" version="1"/></Fallback>)", "2:11: error K003", "task"},
    Case{R"(<Drive too="a"/>)", "2:8: error K004", "did you mean \"to\""},
    Case{R"(<Drive to="a" speed="1"/>)", "2:15: error K004", "within"},
    Case{R"(<Wait for="1 s" until="2 s"/>)", "2:17: error K004", "until"},
    Case{R"(<Sequence name="x"><Wait for="1 s"/></Sequence>)", "2:11: error K004", "name"},
    Case{R"(<Try times="2"><Wait for="1 s"/><Catch reason="any" then="done"><Say text="a"/></Catch></Try>)",
         "2:6: error K004", "times"},
    Case{R"(<Drive/>)", "2:1: error K005", "to"},
    Case{R"(<Wait/>)", "2:1: error K005", "for"},
    Case{R"(<Say/>)", "2:1: error K005", "text"},
    Case{R"(<Ask text="ok?"/>)", "2:1: error K005", "within"},
    Case{R"(<Ask within="1 s"/>)", "2:1: error K005", "text"},
    Case{R"(<Check/>)", "2:1: error K005", "when"},
    Case{R"(<Retry><Wait for="1 s"/></Retry>)", "2:1: error K005", "attempts"},
    Case{R"(<Timeout><Wait for="1 s"/></Timeout>)", "2:1: error K005", "after"},
    Case{R"(<Try><Wait for="1 s"/><On then="done"><Say text="a"/></On></Try>)", "2:23: error K005", "when"},
    Case{R"(<Try><Wait for="1 s"/><On when="alarm X"><Say text="a"/></On></Try>)", "2:23: error K005",
         "then"},
    Case{R"(<Try><Wait for="1 s"/><Catch then="done"><Say text="a"/></Catch></Try>)", "2:23: error K005",
         "reason"},
    Case{R"(<Sequence>go!<Wait for="1 s"/></Sequence>)", "2:11: error K006", "text"},
    Case{R"(<Say text="a">hello</Say>)", "2:15: error K006", "text"},
    Case{R"(<Wait for="soon"/>)", "2:12: error K007", "soon"},
    Case{R"(<Wait for="1 m"/>)", "2:12: error K007", "s"},
    Case{R"(<Wait for="-1 s"/>)", "2:12: error K007", "-1"},
    Case{R"(<Wait for="0 s"/>)", "2:12: error K007", "0"},
    Case{R"(<Wait for="1e9 s"/>)", "2:12: error K007", "1e9"},
    Case{R"(<Drive to="a" within="0 s"/>)", "2:23: error K007", "0"},
    Case{R"(<Repeat times="0"><Wait for="1 s"/></Repeat>)", "2:16: error K007", "0"},
    Case{R"(<Repeat times="2.5"><Wait for="1 s"/></Repeat>)", "2:16: error K007", "2.5"},
    Case{R"(<Retry attempts="many"><Wait for="1 s"/></Retry>)", "2:18: error K007", "many"},
    Case{R"(<Parallel need="3"><Wait for="1 s"/><Wait for="1 s"/></Parallel>)", "2:17: error K007",
         "2 branches only"},
    Case{R"(<Try><Wait for="1 s"/><On when="alarm X" then="go_on"><Say text="a"/></On></Try>)",
         "2:48: error K007", "resume"},
    Case{R"(<Try><Wait for="1 s"/><Catch reason="blokced" then="done"><Say text="a"/></Catch></Try>)",
         "2:38: error K007", "blocked"},
    Case{R"(<Sequence/>)", "2:1: error K008", "nothing to do"},
    Case{R"(<Fallback></Fallback>)", "2:1: error K008", "nothing to do"},
    Case{R"(<Repeat times="2"/>)", "2:1: error K008", "nothing to do"},
    Case{R"(<Try><Catch reason="any" then="done"><Say text="a"/></Catch></Try>)", "2:1: error K008",
         "nothing to do"},
    Case{R"(<Try><Wait for="1 s"/><On when="alarm X" then="done"/></Try>)", "2:23: error K008",
         "nothing to do"},
    Case{R"(<Check when=""/>)", "2:14: error K009", "no condition"},
    Case{R"(<Check when="not"/>)", "2:14: error K009", "no condition"},
    Case{R"(<Check when="alarm"/>)", "2:14: error K009", "no alarm"},
    Case{R"(<Check when="alarm battery_low"/>)", "2:14: error K009", "capitals"},
    Case{R"(<Check when="alarm X by base"/>)", "2:14: error K009", "no alarm"},
    Case{R"(<Check when="batery.charge below 0.3"/>)", "2:14: error K009", "did you mean \"battery\""},
    Case{R"(<Check when="battery below 0.3"/>)", "2:14: error K009", "no field"},
    Case{R"(<Check when="battery.chrage below 0.3"/>)", "2:14: error K009", "did you mean \"charge\""},
    Case{R"(<Check when="battery.charge under 0.3"/>)", "2:14: error K009", "compares nothing"},
    Case{R"(<Check when="battery.charge below 30 %"/>)", "2:14: error K009", "no condition"},
    Case{R"(<Check when="battery.charge below low"/>)", "2:14: error K009", "low"},
    Case{R"(<Check when="localization.state is LOCALISED"/>)", "2:14: error K009",
         "never \"LOCALISED\"; it is one of: LOST, LOCALIZED; did you mean \"LOCALIZED\""},
    Case{R"(<Check when="not localization.state is lost"/>)", "2:14: error K009", "did you mean \"LOST\""},
    Case{R"(<Check when="gripper.holds is yes"/>)", "2:14: error K009", "one of: true, false"},
    Case{R"(<Check when="localization.state above 0.5"/>)", "2:14: error K009", "is no number"},
    Case{R"(<Drive to=""/>)", "2:12: error K010", "name"},
    Case{R"(<Drive to="3.1 2"/>)", "2:12: error K010", "a goal looks like"},
    Case{R"(<Drive to="a > door 1 2"/>)", "2:12: error K010", "door"},
    Case{R"(<Parallel><Drive to="a"/><Sequence><Drive to="b"/></Sequence></Parallel>)", "2:1: error K011",
         "one robot"},
    Case{R"(<Parallel><Ask text="a" within="1 s"/><Ask text="b" within="1 s"/></Parallel>)",
         "2:1: error K011", "both"},
    Case{R"(<With set="max_speed" to="0.3 m/s"><Wait for="1 s"/></With>)", "2:12: error K007",
         "COMPONENT.PARAM"},
    Case{R"(<With set="pilot.max_speed"><Wait for="1 s"/></With>)", "2:1: error K005", "\"to\""},
    Case{R"(<With set="pilot.max_speed" to="0.3 m/s"/>)", "2:1: error K008", "nothing to do"},
    Case{
        R"(<Parallel><With set="a.b" to="1"><Wait for="1 s"/></With><With set="a.b" to="2"><Say text="a"/></With></Parallel>)",
        "2:1: error K011", "set a.b"},
    Case{R"(<Try><Wait for="1 s"/></Try>)", "2:1: error K012", "no <On>"},
    Case{R"(<Repeat times="2" for="1 s"><Wait for="1 s"/></Repeat>)", "2:24: error K012", "not both"},
    Case{R"(<Repeat><Say text="a"/></Repeat>)", "2:1: error K013", "no time"},
};

}  // namespace

TEST_CASE("each fault of a task file is one error with its place and what to do", "[components][tasks]") {
  STATIC_REQUIRE(kCases.size() >= 60);
  for (const Case& fault : kCases) {
    const std::string text = fault_of(fault.steps);
    CHECK_THAT(text, Contains(std::string("t.xml:") + fault.place));
    CHECK_THAT(text, Contains(fault.words));
  }
}

TEST_CASE("all faults of a task file are reported at once", "[components][tasks]") {
  std::string steps;
  std::size_t wanted = 0;
  for (const Case& fault : kCases) {
    steps += std::string(fault.steps) + "\n";
    ++wanted;
  }
  orca::xml::Diagnostics diagnostics;
  CHECK(read_task_text("<task name=\"t\" version=\"1\">\n" + steps + "</task>", "t.xml", sights(),
                       diagnostics));
  CHECK(diagnostics.error_count() == wanted);
  int line = 1;
  for (const auto& fault : diagnostics.sorted()) CHECK(fault.position.line == ++line);
}

TEST_CASE("a task has a name and a version, and is nothing else", "[components][tasks]") {
  CHECK_THAT(faults_of("<graph name=\"x\" version=\"1\"/>"), Contains("K001") && Contains("not <task>"));
  CHECK_THAT(faults_of("<task version=\"1\"><Wait for=\"1 s\"/></task>"), Contains("K005"));
  CHECK_THAT(faults_of("<task name=\"t\"><Wait for=\"1 s\"/></task>"), Contains("K005"));
  CHECK_THAT(faults_of("<task name=\"t\" version=\"2\"><Wait for=\"1 s\"/></task>"), Contains("K007"));
  CHECK_THAT(faults_of("<task name=\"t\" version=\"1\"/>"), Contains("K008"));
  CHECK_THAT(faults_of("<task name=\"t\" version=\"1\">"), Contains("G1"));
}

TEST_CASE("README.md explains every code of a task file, and no other", "[components][tasks][docs]") {
  const auto codes_in = [](const std::string& path, const std::string& before) {
    std::ifstream file(std::string(ORCA_SOURCE_DIR) + "/src/components/task_tree/" + path);
    std::stringstream text;
    text << file.rdbuf();
    std::set<std::string> codes;
    const std::string all = text.str();
    for (std::size_t at = 0; (at = all.find(before + "K0", at)) != std::string::npos; ++at)
      codes.insert(all.substr(at + before.size(), 4));
    return codes;
  };
  const auto declared = codes_in("task_rules.hpp", "\"");
  CHECK(declared.size() == 14);
  CHECK(codes_in("README.md", "\n| ") == declared);
}

TEST_CASE("a condition holds only if something has come that says so", "[components][tasks]") {
  const auto condition = [](const char* text) { return parse_condition(text, sights()).value(); };
  const Outlook none{[](const std::string&, const std::string&) { return false; },
                     [](const std::string&, const std::string&) { return std::nullopt; }};
  const Outlook some{[](const std::string& kind, const std::string& source) {
                       return kind == "STALLED" && (source.empty() || source == "base");
                     },
                     [](const std::string& port, const std::string& field) -> std::optional<std::string> {
                       if (port == "battery" && field == "charge") return "0.25";
                       if (port == "battery" && field == "voltage") return "nan";
                       if (port == "gripper" && field == "holds") return "true";
                       return std::nullopt;
                     }};
  CHECK(holds(condition("battery.charge below 0.3"), some));
  CHECK_FALSE(holds(condition("not battery.charge below 0.3"), some));
  CHECK_FALSE(holds(condition("battery.charge above 0.3"), some));
  CHECK_FALSE(holds(condition("battery.charge below 0.3"), none));
  CHECK_FALSE(holds(condition("not battery.charge below 0.3"), none));
  CHECK_FALSE(holds(condition("battery.voltage below 11"), some));
  CHECK_FALSE(holds(condition("not battery.voltage below 11"), some));
  CHECK(holds(condition("gripper.holds is true"), some));
  CHECK(holds(condition("not gripper.holds is false"), some));
  CHECK(holds(condition(" alarm  STALLED "), some));
  CHECK(holds(condition("alarm STALLED of base"), some));
  CHECK_FALSE(holds(condition("alarm STALLED of laser"), some));
  CHECK(holds(condition("not alarm STALLED"), none));
}
