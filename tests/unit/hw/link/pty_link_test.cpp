// SPDX-License-Identifier: GPL-3.0-or-later
// The device's side of a pseudo terminal, as emulators use it.
#include <catch2/catch.hpp>

#include "serial_line.hpp"

using namespace orca;
using namespace orca::test;
using hw::link::PtyLink;
using hw::link::SerialLink;

TEST_CASE("a line in a pseudo terminal has a path that leads to it while it is open", "[hw][link][pty]") {
  const TempFolder folder;
  const std::string path = folder.file("scout");
  PtyLink device(path);
  CHECK(device.name() == "pty:" + path);
  CHECK_FALSE(device.line().has_value());
  for (int round = 0; round < 2; ++round) {
    must_open(device);
    CHECK(std::filesystem::read_symlink(path) == device.device());
    device.close();
    CHECK_FALSE(std::filesystem::exists(std::filesystem::symlink_status(path)));
    CHECK(device.device().empty());
  }
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("a line that awaits its driver tells that there is none yet, and echoes nothing to it",
          "[hw][link][pty]") {
  const TempFolder folder;
  PtyLink device(folder.file("line"));
  must_open(device);
  REQUIRE(device.await_driver().ok());
  CHECK(error_of_reading(device) == Code::unavailable);
  CHECK(error_of_writing(device) == Code::unavailable);
  SerialLink driver(serial_at(folder, folder.file("line")));
  must_open(driver);
  CHECK(read_some(device).empty());
  must_write(device, bytes_of("banner"));
  CHECK(text_of(read_bytes(driver, 6)) == "banner");
  CHECK(read_some(device).empty());
}

TEST_CASE("the path of a line replaces an old link, but no file", "[hw][link][pty]") {
  const TempFolder folder;
  std::filesystem::create_symlink("/dev/pts/99999", folder.file("old"));
  PtyLink device(folder.file("old"));
  must_open(device);
  CHECK(std::filesystem::read_symlink(folder.file("old")) == device.device());

  PtyLink careless(folder.write("notes", "text"));
  const Error refused = error_of_opening(careless);
  CHECK(refused.code == Code::already_exists);
  CHECK(read_text(folder.file("notes")) == "text");
  check_closed(careless);

  PtyLink nowhere(folder.file("no/such/folder"));
  CHECK(error_of_opening(nowhere).code == Code::unavailable);
  check_closed(nowhere);
}

TEST_CASE("a line whose path another one has taken leaves it to that", "[hw][link][pty]") {
  const TempFolder folder;
  PtyLink first(folder.file("line"));
  PtyLink second(folder.file("line"));
  must_open(first);
  must_open(second);
  first.close();
  CHECK(std::filesystem::read_symlink(folder.file("line")) == second.device());
}

TEST_CASE("before a driver has come nothing is echoed, and after it has gone the next one is served",
          "[hw][link][pty]") {
  const TempFolder folder;
  PtyLink device(folder.file("line"));
  must_open(device);
  must_write(device, {0x03, 0x0D, 0x04, 0x11});  // what a terminal would obey or echo
  CHECK(read_some(device).empty());
  SerialLink driver(serial_at(folder, folder.file("line")));
  for (int round = 0; round < 2; ++round) {
    must_open(driver);
    must_write(driver, bytes_of("sync"));
    CHECK(text_of(read_bytes(device, 4)) == "sync");
    driver.close();
    CHECK(error_of_reading(device) == Code::unavailable);
    CHECK(error_of_writing(device) == Code::unavailable);
  }
}
