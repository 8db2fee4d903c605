// SPDX-License-Identifier: GPL-3.0-or-later
// orcactl map save: the map of a running system as files.
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <thread>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
using Catch::StartsWith;

namespace {

// A running system with maps.
class System {
 public:
  /// @param working  components to wait for.
  System(const Words& words, std::size_t working) : program_(deployer(words)) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    for (;;) {
      const Run run = run_orcactl({"ps"});
      if (run.exit_code() == 0 && count_of(run.out, " WORK ") >= working) return;
      INFO(program_.err());
      REQUIRE(std::chrono::steady_clock::now() < end);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
  ~System() { (void)run_orcactl({"stop"}); }
  System(const System&) = delete;
  System& operator=(const System&) = delete;

 private:
  static std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
  }

  Subprocess program_;
};

}  // namespace

TEST_CASE("orcactl map save writes the map of a running system, and never over another", "[system][maps]") {
  const System system({system_graph("maps.xml")}, 1);
  const TempFolder folder;
  const Run saved = run_orcactl({"map", "save", folder.file("hall")});
  INFO(saved.err);
  REQUIRE(saved.exit_code() == 0);
  CHECK_THAT(saved.err, Contains("cells of 0.05 m, 100 % of them known"));
  const std::string text = read_text(folder.path() / "hall.yaml");
  CHECK_THAT(text, Contains("image: \"hall.png\"\n") && Contains("resolution: 0.05\n"));
  CHECK(std::filesystem::exists(folder.path() / "hall.png"));

  const Run again = run_orcactl({"map", "save", folder.file("hall")});
  CHECK(again.exit_code() == 1);
  CHECK_THAT(again.err, Contains("hall.png: it is there already; choose another name, or remove it first"));
  CHECK(read_text(folder.path() / "hall.yaml") == text);

  // It is one room, without a door that could be proposed.
  const Run none = run_orcactl({"map", "ways", folder.file("hall.yaml")});
  CHECK(none.exit_code() == 1);
  CHECK_THAT(none.err, Contains("no doors found in " + folder.file("hall.yaml")));
  CHECK_THAT(run_orcactl({"map", "ways", folder.file("hull.yaml")}).err, Contains("hull.yaml"));

  // What was saved is served.
  const Run checked =
      run_deployer({system_graph("maps.xml"), "--check", "--set", "map=" + folder.file("hall.yaml")});
  CHECK(checked.exit_code() == 0);
}

TEST_CASE("orcactl map save asks which map if there are several, and takes any port that answers with one",
          "[system][maps]") {
  const System system(
      {system_graph("maps.xml"), "--profile", "two", "--set", "map=" + source_file("sim/worlds/office.xml")},
      2);
  const TempFolder folder;
  const Run unclear = run_orcactl({"map", "save", folder.file("hall")});
  CHECK(unclear.exit_code() == 1);
  CHECK_THAT(unclear.err, Contains("office.OccupancyGridQuery, other.OccupancyGridQuery; name one"));
  CHECK(run_orcactl({"map", "save", folder.file("hall"), "other.OccupancyGridQuery"}).exit_code() == 0);
  CHECK_THAT(read_text(folder.path() / "hall.yaml"), Contains("resolution: 0.1\n"));
  // Rooms and doors of what was saved are proposed, without a system.
  const Run ways = run_orcactl({"map", "ways", folder.file("hall.yaml")});
  CHECK(ways.exit_code() == 0);
  CHECK_THAT(ways.out, Contains("<ways name=\"hall\" version=\"1\">"));

  CHECK_THAT(run_orcactl({"map", "save", folder.file("x"), "office.OccupancyGridPush"}).err,
             Contains("answers no questions"));
  CHECK(run_orcactl({"map", "load", folder.file("hall")}).exit_code() == 2);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "x.png"));
}

TEST_CASE("the map that a robot has made is a YAML file and a picture for programs of others",
          "[system][maps][tool]") {
  const TempFolder folder;
  {
    const System system({source_file("graphs/pioneer_slam.xml"), "--clock", "virtual", "--pace", "0"}, 0);
    REQUIRE(run_orcactl({"step", "30s"}).exit_code() == 0);
    REQUIRE(run_orcactl({"map", "save", folder.file("office")}).exit_code() == 0);
  }
  Subprocess reader(
      {"/usr/bin/python3", source_file("tests/unit/maps/read_map.py"), folder.file("office.yaml")});
  const Run read = finish(reader, Seconds(20));
  if (read.exit_code() == 77) {
    std::cout << "SKIPPED: " << read.out;
    return;
  }
  INFO(read.err);
  REQUIRE(read.exit_code() == 0);
  CHECK_THAT(read.out, StartsWith("L (") && Contains(" 0.05 [") && Contains(" 254") && Contains(" 205") &&
                           Contains(" 0,"));
}

TEST_CASE("a MapServer warns of maps without walls, exchanged colours and light grey walls",
          "[system][maps]") {
  const TempFolder folder;
  const std::string rest =
      "image: hall.pgm\nresolution: 0.05\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  folder.write("hall.pgm", "P2 3 1 255 0 254 254\n");
  const auto log_of = [&](const std::string& file, const std::string& resolution) {
    return run_deployer({system_graph("maps.xml"), "--clock", "virtual", "--until", "10 ms", "--set",
                         "map=" + file, "--set", "office.resolution=" + resolution})
        .err;
  };
  CHECK_THAT(log_of(folder.write("right.yaml", rest + "negate: 0\n"), "0"), !Contains("warning"));
  CHECK_THAT(log_of(folder.write("wrong.yaml", rest + "negate: 1\n"), "0"),
             Contains("wrong.yaml: more cells are occupied (2) than free (1)"));
  CHECK_THAT(log_of(folder.write("white.pgm", "P2 3 1 255 255 255 255\n"), "0.1"),
             Contains("white.pgm: no cell is occupied"));
  CHECK_THAT(log_of(folder.write("grey.pgm", "P2 5 1 255 0 255 255 180 180\n"), "0.1"),
             Contains("grey.pgm: 40 % of the pixels are light grey"));
}
