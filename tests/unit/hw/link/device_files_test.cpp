// SPDX-License-Identifier: GPL-3.0-or-later
// The files of devices: which are cameras, and who has them.
#include <catch2/catch.hpp>

#include <fstream>

#include "orca/hw/link/device_files.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
namespace fs = std::filesystem;

TEST_CASE("the cameras of a machine are listed once, by their lasting name if they have one",
          "[hw][link][camera]") {
  const TempFolder folder;
  const fs::path dev(folder.path());
  for (const char* name : {"video0", "video1", "video2", "ttyUSB0", "null"}) std::ofstream(dev / name) << "";
  CHECK(hw::link::cameras(folder.file("nothing")).empty());
  CHECK(hw::link::cameras(dev.string()) ==
        std::vector<std::string>{folder.file("video0"), folder.file("video1"), folder.file("video2")});
  fs::create_directories(dev / "v4l/by-id");
  fs::create_symlink("../../video0", dev / "v4l/by-id/usb-Maker_Eye-video-index0");
  fs::create_symlink("../../video1", dev / "v4l/by-id/usb-Maker_Eye-video-index1");  // gives no pictures
  CHECK(hw::link::cameras(dev.string()) ==
        std::vector<std::string>{folder.file("v4l/by-id/usb-Maker_Eye-video-index0"), folder.file("video2")});
}

TEST_CASE("a camera is known by its file's name, and a link by where it leads", "[hw][link][camera]") {
  const TempFolder folder;
  std::ofstream(folder.file("video3")) << "";
  std::ofstream(folder.file("ttyUSB0")) << "";
  fs::create_symlink("video3", folder.file("eye"));
  fs::create_symlink("ttyUSB0", folder.file("video9"));
  CHECK(hw::link::is_camera(folder.file("video3")));
  CHECK(hw::link::is_camera(folder.file("eye")));
  CHECK(hw::link::is_camera(folder.file("video7")));  // not there, but meant
  CHECK_FALSE(hw::link::is_camera(folder.file("video9")));
  CHECK_FALSE(hw::link::is_camera(folder.file("ttyUSB0")));
}

TEST_CASE("nobody is said to hold a device that is not there", "[hw][link]") {
  const TempFolder folder;
  CHECK_THAT(hw::link::explain_holder(folder.file("ttyUSB9"), "serial").message,
             Contains("another program, which only root can see"));
}
