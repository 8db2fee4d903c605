// SPDX-License-Identifier: GPL-3.0-or-later
// What a person reads whose serial line cannot be opened.
#include <catch2/catch.hpp>

#include <sys/stat.h>

#include <cerrno>

#include "serial_line.hpp"
#include "serial_trouble.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::link::SerialLink;
using hw::link::SerialPlaces;

TEST_CASE("a device that is not there: the adapters that are plugged in are listed", "[hw][link][serial]") {
  const TempFolder folder;
  SerialLink link(serial_at(folder, folder.file("ttyUSB7")));
  const Error none = error_of_opening(link);
  CHECK(none.code == Code::not_found);
  CHECK(none.where == "serial:" + folder.file("ttyUSB7"));
  CHECK_THAT(none.message, Contains("there is no " + folder.file("ttyUSB7")) &&
                               Contains("no serial adapter is plugged in"));
  FakeAdapter base(folder, "usb-Orca_Scout_0001");
  FakeAdapter laser(folder, "usb-Orca_Laser_0002");
  base.plug_in();
  laser.plug_in();
  CHECK_THAT(error_of_opening(link).message, Contains(laser.id_path() + ", " + base.id_path()));
}

TEST_CASE("a file, a folder or a device that is no terminal is refused before it is used",
          "[hw][link][serial]") {
  const TempFolder folder;
  SerialLink file(serial_at(folder, folder.write("notes", "text")));
  CHECK(error_of_opening(file).code == Code::invalid_argument);
  CHECK_THAT(error_of_opening(file).message, Contains("is a file, not a serial device"));
  CHECK(read_text(folder.file("notes")) == "text");
  SerialLink whole(serial_at(folder, folder.path().string()));
  CHECK_THAT(error_of_opening(whole).message, Contains("is a folder, not a serial device"));
  SerialLink null(serial_at(folder, "/dev/null"));
  CHECK(error_of_opening(null).code == Code::invalid_argument);
  CHECK_THAT(error_of_opening(null).message, Contains("/dev/null is no serial device"));
}

TEST_CASE("a device that this user may not open: the group that may, and the command to join it",
          "[hw][link][serial]") {
  const TempFolder folder;
  const std::string file = folder.write("ttyS9", "");
  REQUIRE(chmod(file.c_str(), 0660) == 0);
  const SerialPlaces places(folder.file("serial"));
  const Error refused = hw::link::explain_refusal(file, EACCES, places, "serial:ttyS9");
  CHECK(refused.code == Code::failed_precondition);
  CHECK_THAT(refused.message, Contains("may not open " + file) && Contains("sudo usermod -aG ") &&
                                  Contains("log out and in again"));
  REQUIRE(chmod(file.c_str(), 0600) == 0);
  CHECK_THAT(hw::link::explain_refusal(file, EACCES, places, "serial:ttyS9").message,
             Contains("no group may"));
}

TEST_CASE("a port whose holder cannot be seen: the command that shows it", "[hw][link][serial]") {
  const TempFolder folder;
  const SerialPlaces places(folder.file("serial"));
  const Error busy = hw::link::explain_refusal(folder.write("it's free", ""), EBUSY, places, "serial");
  CHECK(busy.code == Code::unavailable);
  CHECK_THAT(busy.message, Contains("sudo fuser '") && Contains("it'\\''s free'"));
}

TEST_CASE("a device file without a port behind it is no reason to wait", "[hw][link][serial]") {
  const SerialPlaces places("/nowhere");
  for (const int reason : {ENXIO, ENODEV, EIO}) {
    const Error absent = hw::link::explain_refusal("/dev/ttyS31", reason, places, "serial:/dev/ttyS31");
    CHECK(absent.code == Code::not_found);
    CHECK_THAT(absent.message, Contains("/dev/ttyS31 exists, but no serial port is behind it"));
  }
  CHECK_THAT(hw::link::explain_refusal("/dev/ttyS31", ELOOP, places, "x").message,
             Contains("Too many levels"));
}
