// SPDX-License-Identifier: GPL-3.0-or-later
#include "foxglove/assets.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "temp_folder.hpp"

using namespace orca::view;
using orca::Code;

namespace {

namespace fs = std::filesystem;

// A robot's file with meshes in a package and beside it, and with names that lead elsewhere.
class Robot {
 public:
  Robot() {
    write("pioneer/meshes/base.stl", "solid base");
    write("pioneer/urdf/wheel.OBJ", "v 0 0 0");
    write("pioneer/urdf/skin.png", "picture");
    write("pioneer/urdf/secret.txt", "secret");
    write("pioneer/urdf/other.stl", "a mesh that nobody names");
    fs::create_symlink(path("pioneer/urdf/secret.txt"), path("pioneer/urdf/link.stl"));
    fs::create_directory(path("pioneer/urdf/folder.stl"));
    write("pioneer/urdf/robot.urdf", R"(<?xml version="1.0"?><robot name="r">
      <material name="m"><texture filename="skin.png"/></material>
      <link name="base">
        <visual><geometry><mesh filename="package://pioneer/meshes/base.stl"/></geometry></visual>
        <visual><geometry><mesh filename="wheel.OBJ"/></geometry></visual>
        <visual><geometry><mesh filename="secret.txt"/></geometry></visual>
        <visual><geometry><mesh filename="link.stl"/></geometry></visual>
        <visual><geometry><mesh filename="folder.stl"/></geometry></visual>
        <visual><geometry><mesh filename="missing.stl"/></geometry></visual>
        <visual><geometry><mesh filename="/dev/zero"/></geometry></visual>
        <visual><geometry><mesh filename="http://elsewhere/base.stl"/></geometry></visual>
      </link></robot>)");
  }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_.file(name); }
  [[nodiscard]] Assets assets() const {
    const std::string robot = path("pioneer/urdf/robot.urdf");
    return Assets({{"pioneer", robot, "", read_asset(robot).value()}});
  }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(path(name)).parent_path());
    std::ofstream(path(name)) << text;
  }

 private:
  orca::test::TempFolder folder_;
};

}  // namespace

TEST_CASE(
    "a robot's file, its meshes and its textures are assets, as the file writes them and by their paths",
    "[view][foxglove]") {
  const Robot robot;
  const Assets assets = robot.assets();
  CHECK(assets.read("package://pioneer/meshes/base.stl").value() == "solid base");
  CHECK(assets.read("file://" + robot.path("pioneer/meshes/base.stl")).value() == "solid base");
  CHECK(assets.read("wheel.OBJ").value() == "v 0 0 0");
  CHECK(assets.read("file://" + robot.path("pioneer/urdf/wheel.OBJ")).value() == "v 0 0 0");
  CHECK(assets.read("skin.png").value() == "picture");
  CHECK(assets.read(robot.path("pioneer/urdf/robot.urdf")).value().starts_with("<?xml"));
}

TEST_CASE("no other file is an asset, however it is written", "[view][foxglove]") {
  const Robot robot;
  const Assets assets = robot.assets();
  for (const std::string& uri :
       {std::string("package://pioneer/urdf/other.stl"), std::string("package://pioneer/../../etc/passwd"),
        std::string("package://pioneer/meshes/../meshes/base.stl"), std::string("other.stl"),
        std::string("/etc/passwd"), std::string("file:///etc/passwd"),
        std::string("http://elsewhere/base.stl"), std::string(), robot.path("pioneer/urdf/other.stl"),
        std::string("package://pioneer/meshes/base.stl\0", 34)}) {
    INFO(uri);
    const auto content = assets.read(uri);
    REQUIRE_FALSE(content);
    CHECK(content.error().code == Code::not_found);
  }
}

TEST_CASE("what a robot's file names is no asset if it is no mesh or picture", "[view][foxglove]") {
  const Robot robot;
  const Assets assets = robot.assets();
  CHECK(assets.read("secret.txt").error().code == Code::failed_precondition);
  CHECK(assets.read("link.stl").error().code == Code::failed_precondition);  // it leads to the text
  CHECK(assets.read("/dev/zero").error().code == Code::failed_precondition);
  CHECK(assets.read("folder.stl").error().code == Code::not_found);
  CHECK(assets.read("missing.stl").error().code == Code::not_found);
  robot.write("pioneer/urdf/wheel.OBJ", "");
  fs::resize_file(robot.path("pioneer/urdf/wheel.OBJ"), kLargestAsset + 1);
  CHECK(assets.read("wheel.OBJ").error().code == Code::unavailable);
}

TEST_CASE("the answer to a viewer has the bytes, or the error", "[view][foxglove]") {
  CHECK(asset_response(0x0102, std::string("mesh")) == std::string("\4\2\1\0\0\0\0\0\0\0mesh", 14));
  const std::string refused = asset_response(7, orca::fail(Code::not_found, "none"));
  CHECK(refused.substr(0, 6) == std::string("\4\7\0\0\0\1", 6));
  CHECK(static_cast<std::size_t>(refused[6]) == refused.size() - 10);
  CHECK_THAT(refused.substr(10), Catch::Contains("none"));
}
