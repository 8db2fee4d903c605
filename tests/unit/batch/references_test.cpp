// SPDX-License-Identifier: GPL-3.0-or-later
// Lengths of ways from tables, and in experiments.
#include "experiment/references.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "orca/batch/experiment.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::batch;
using Catch::Contains;
using orca::test::TempFolder;

namespace {

const std::string kTable = "world,count,length\n4,200,12.5\n7,210,13.25\r\n";

std::string error_of(const std::string& table, const std::string& column = "length") {
  const TempFolder folder;
  const auto read = read_references(folder.write("t.csv", table), column);
  REQUIRE_FALSE(read);
  return read.error().message;
}

}  // namespace

TEST_CASE("lengths are read by the numbers of the worlds", "[batch][references]") {
  const TempFolder folder;
  const auto read = read_references(folder.write("t.csv", kTable), "length");
  REQUIRE(read);
  CHECK(*read == std::map<std::uint64_t, double>{{4, 12.5}, {7, 13.25}});
}

TEST_CASE("a table without the column, or with a line that is no length, is refused with its place",
          "[batch][references]") {
  CHECK_THAT(error_of(kTable, "lenght"), Contains("has no column \"lenght\"; it has world, count, length") &&
                                             Contains("did you mean \"length\"?"));
  CHECK_THAT(error_of("number,length\n1,2\n"), Contains("has no column \"world\""));
  CHECK_THAT(error_of("world,length\n1,2\n2,far\n"), Contains("line 3"));
  CHECK_THAT(error_of("world,length\n1,-2\n"), Contains("line 2"));
  CHECK_THAT(error_of("world,length\n1\n"), Contains("line 2"));
  CHECK_THAT(error_of(""), Contains("cannot be read"));
  CHECK_THAT(read_references("/nowhere/t.csv", "length").error().message, Contains("cannot be read"));
  const TempFolder folder;
  REQUIRE(mkfifo(folder.file("pipe").c_str(), 0600) == 0);
  CHECK_THAT(read_references(folder.file("pipe"), "length").error().message, Contains("no regular file"));
}

TEST_CASE("worlds have the length that they name, or that a table has for their number",
          "[batch][references]") {
  const TempFolder folder;
  folder.write("t.csv", kTable);
  xml::Diagnostics diagnostics;
  const auto experiment = read_experiment(R"(<experiment name="e" graph="g.xml" seeds="1" until="60 s">
    <variant name="a"/>
    <world name="w" reference="250 cm"/>
    <worlds name="n" arg="world" file="many.csv" numbers="4 6-7" references="t.csv" column="length"/>
  </experiment>)",
                                          folder.file("e.xml"), diagnostics);
  INFO(diagnostics.text());
  REQUIRE(experiment);
  REQUIRE(experiment->worlds.size() == 4);
  CHECK(experiment->worlds[0].reference == 2.5);
  CHECK(experiment->worlds[1].reference == 12.5);
  CHECK_FALSE(experiment->worlds[2].reference);
  CHECK(experiment->worlds[3].reference == 13.25);
}

TEST_CASE("without numbers the worlds are those of the table; without either there are none",
          "[batch][references]") {
  const TempFolder folder;
  folder.write("t.csv", kTable);
  const auto read = [&](const std::string& attributes, xml::Diagnostics& diagnostics) {
    return read_experiment(R"(<experiment name="e" graph="g.xml" seeds="1" until="60 s"><variant name="a"/>
      <worlds name="n" arg="world" file="many.csv" )" +
                               attributes + "/></experiment>",
                           folder.file("e.xml"), diagnostics);
  };
  xml::Diagnostics none;
  const auto experiment = read("references=\"t.csv\" column=\"length\"", none);
  INFO(none.text());
  REQUIRE(experiment);
  REQUIRE(experiment->worlds.size() == 2);
  CHECK(experiment->worlds[1].name == "n_7");
  CHECK(experiment->worlds[1].reference == 13.25);
  xml::Diagnostics found;
  CHECK_FALSE(read("", found));
  CHECK_THAT(found.text(), Contains("E004") && Contains("needs numbers, or a table of references"));
}

TEST_CASE("a table that is not there is an error of the experiment", "[batch][references]") {
  xml::Diagnostics diagnostics;
  CHECK_FALSE(read_experiment(R"(<experiment name="e" graph="g.xml" seeds="1" until="60 s"><variant name="a"/>
    <worlds name="n" arg="w" file="m.csv" numbers="1" references="none.csv"/>
    <worlds name="m" arg="w" file="m.csv" numbers="1" column="length"/></experiment>)",
                              "e.xml", diagnostics));
  CHECK_THAT(diagnostics.text(), Contains("E012") && Contains("none.csv\" cannot be read") &&
                                     Contains("a column needs the table"));
}
