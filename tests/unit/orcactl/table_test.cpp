// SPDX-License-Identifier: GPL-3.0-or-later
#include "table.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::orcactl;
using supervisor::Cell;
using supervisor::Record;

namespace {

Record component(const std::string& name, int pid, const std::string& text) {
  return {{"name", name}, {"pid", pid}, {"text", text}};
}

}  // namespace

TEST_CASE("records of one form are one table, with numbers flush right", "[orcactl]") {
  const std::vector<Record> records{
      component("goto", 7, "a"), component("av", 4711, "b"), {{"from_port", "x"}, {"late", true}}};
  CHECK(table_text(records, 0) ==
        "NAME   PID  TEXT\n"
        "goto     7  a\n"
        "av    4711  b\n"
        "\n"
        "FROM PORT  LATE\n"
        "x          true\n");
  CHECK(table_text({}, 80).empty());
}

TEST_CASE("records of one form are one table wherever they come", "[orcactl]") {
  const std::vector<Record> records{{{"a", "1"}}, {{"b", "2"}}, {{"a", "3"}}};
  CHECK(table_text(records, 0) == "A\n1\n3\n\nB\n2\n");
}

TEST_CASE("lines fit the terminal: the longest texts are cut, never numbers", "[orcactl]") {
  const std::vector<Record> records{component("goto", 1234567, std::string(100, 'x'))};
  const std::string text = table_text(records, 40);
  const std::string line = text.substr(text.find('\n') + 1);
  CHECK(line.size() == 41);
  CHECK(line.find("1234567") != std::string::npos);
  CHECK(line.find("...") != std::string::npos);
}

TEST_CASE("what a terminal would obey is shown instead", "[orcactl]") {
  CHECK(table_text(std::vector<Record>{{{"text", "\x1b[31m"}}}, 0).find('\x1b') == std::string::npos);
}

TEST_CASE("JSON has numbers, flags and null as such", "[orcactl]") {
  Cell none{"pid", ""};
  none.kind = Cell::Kind::number;
  const Record record{{"name", "go \"to\"\nb"}, {"pid", 7}, {"age", 1.5, 2}, {"active", true}, none};
  CHECK(record_json(record) ==
        "{\"name\": \"go \\\"to\\\"\\nb\",\"pid\": 7,\"age\": 1.5,\"active\": true,\"pid\": null}\n");
  CHECK(table_json({}) == "[]\n");
}
