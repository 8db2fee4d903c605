// SPDX-License-Identifier: GPL-3.0-or-later
// Cameras in a system: the real driver where no camera is, and the same driver with a camera that plays pictures.
#include <catch2/catch.hpp>

#include <numbers>

#include "deployer.hpp"
#include "record_table.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

const Words kPlayed{"--set", "type=test.PlayedCamera", "--plugins", ORCA_BINARY_DIR "/tests/plugins"};

Run run(const Words& more) { return run_deployer(Words{system_graph("camera.xml")} + more); }

}  // namespace

TEST_CASE("a CameraServer offers the pictures of a camera by Push and Query, and the counters of its line",
          "[system][camera]") {
  const Run ports = run(Words{"--list-ports"} + kPlayed);
  INFO(ports.err);
  CHECK(ports.exit_code() == 0);
  for (const char* port : {"camera.ImagePush", "camera.ImageQuery", "camera.DeviceStatisticsQuery"})
    CHECK_THAT(ports.out, Contains(port));
  CHECK(ports.lines().size() == 3);
}

TEST_CASE("the pictures of a camera pass through a system as they were taken", "[system][camera]") {
  const TempFolder folder;
  const Run played =
      run(Words{"--until", "3s", "--record", folder.file("run.csv") + "=camera.ImagePush"} + kPlayed);
  INFO(played.err);
  CHECK(played.exit_code() == 0);
  CHECK_THAT(played.err, Contains("connected to Fake Camera: 32 x 16, RGB3 at 5 Hz"));
  const auto pictures = RecordTable(folder.file("run.csv")).rows("camera.ImagePush");
  REQUIRE(pictures.size() >= 5);
  double stamp = 0.0;
  for (const RecordTable::Row& picture : pictures) {
    CHECK(number(picture, "width") == 32);
    CHECK(number(picture, "height") == 16);
    CHECK(number(picture, "step") == 96);
    CHECK(number(picture, "focal_length") == Approx(16.0));
    CHECK(number(picture, "pose.rotation.pitch") == Approx(10.0 * std::numbers::pi / 180.0));
    CHECK(numbers(picture, "data").size() == std::size_t{32} * 16 * 3);
    if (stamp != 0.0) CHECK(number(picture, "pose.stamp") - stamp == Approx(0.2).margin(0.001));
    stamp = number(picture, "pose.stamp");
  }
}

TEST_CASE("a graph with a camera is checked without the camera, and does not start without it",
          "[system][camera]") {
  const Run checked = run({"--check"});
  CHECK(checked.exit_code() == 0);
  const Run started = run({});
  CHECK(started.exit_code() == 3);
  CHECK_THAT(started.err, Contains("there is no /dev/video99; is the camera plugged in?"));
  const Run null = run({"--set", "device=/dev/null"});
  CHECK(null.exit_code() == 3);
  CHECK_THAT(null.err, Contains("/dev/null is no camera"));
}

TEST_CASE("wrong parameters of a camera are found when the graph is checked", "[system][camera]") {
  const auto refused = [](const Words& more, const std::string& text) {
    const Run checked = run(Words{"--check"} + more);
    INFO(checked.err);
    CHECK(checked.exit_code() == 2);
    CHECK_THAT(checked.err, Contains(text));
  };
  refused({"--set", "device=camera:0"}, "\"camera:0\" is no path; write /dev/video0");
  refused({"--set", "encoding=RGB9"}, "did you mean \"RGB8\"?");
  refused(virtual_clock(), "in virtual time nothing is at the other end of \"/dev/video99\"");
}
