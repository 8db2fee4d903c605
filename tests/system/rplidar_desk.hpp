// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "bad_line.hpp"
#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "orca/emulators/rplidar_firmware.hpp"
#include "record_table.hpp"
#include "temp_folder.hpp"

namespace orca::test {

using emulators::RplidarFirmware;
using emulators::RplidarSettings;

/// An RPLIDAR on a desk, whose line a test can spoil.
using BadRplidar = BadLine<RplidarFirmware>;
using Laser = DeviceOnDesk<BadRplidar, MirrorOnDesk>;

inline constexpr double kDegree = std::numbers::pi / 180.0;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline RplidarSettings at_once() {
  RplidarSettings settings;
  settings.boot = 0s;
  settings.spin_up = 100ms;
  return settings;
}

/// A range of its own for each degree to the left of straight ahead, and no echo between 40 and 60 degrees.
inline std::vector<double> ranges_of_place() {
  std::vector<double> ranges;
  for (int i = 0; i < 360; ++i) ranges.push_back(i >= 40 && i <= 60 ? kInfinity : 1.0 + 0.025 * i);
  return ranges;
}

inline void show_place(Laser& laser) {
  laser.with([](BadRplidar&, MirrorOnDesk& mirror) { mirror.show(0.0, kDegree, ranges_of_place()); });
}

inline Words listen(const std::string& device, const Words& more = {}) {
  return Words{system_graph("rplidar.xml"), "--set", "device=" + device} + more;
}

inline Words recorded(const TempFolder& folder, const Words& more = {}) {
  return Words{"--record", folder.file("scans.csv") + "=laser.LaserRangeReadingsPush"} + more;
}

inline std::vector<RecordTable::Row> scans_in(const TempFolder& folder) {
  return RecordTable(folder.file("scans.csv")).rows("laser.LaserRangeReadingsPush");
}

/// Checks that each beam of the scan shows what the mirror shows at most so many beams beside its direction.
inline void check_ranges(const RecordTable::Row& scan, double step, int beside = 1) {
  const std::vector<double> shown = ranges_of_place();
  const std::vector<double> got = numbers(scan, "ranges");
  REQUIRE(got.size() == 360);
  CHECK(number(scan, "angle_start") == Approx(std::numbers::pi));
  CHECK(number(scan, "angle_increment") == Approx(-kDegree));
  for (int i = 0; i < 360; ++i) {
    const int left = (540 - i) % 360;  // [deg] of the beam, counter-clockwise
    double nearest = kInfinity;
    double farthest = 0.0;
    for (int off = -beside; off <= beside; ++off) {
      const double range = shown[static_cast<std::size_t>((left + off + 360) % 360)];
      nearest = std::min(nearest, range);
      farthest = std::max(farthest, range);
    }
    const double range = got[static_cast<std::size_t>(i)];
    CAPTURE(i, left, range);
    CHECK(range >= nearest - 0.51 * step);
    CHECK(range <= farthest + 0.51 * step);
  }
}

inline bool sends(Laser& laser) {
  return laser.with([](BadRplidar& firmware, MirrorOnDesk&) { return firmware.device().sends_scans(); });
}

inline int turns_sent(Laser& laser) {
  return laser.with([](BadRplidar& firmware, MirrorOnDesk&) { return firmware.device().turns(); });
}

inline std::vector<int> requests_to(Laser& laser) {
  return laser.with([](BadRplidar& firmware, MirrorOnDesk&) { return firmware.device().requests(); });
}

inline bool was_asked(Laser& laser, int request) {
  const std::vector<int> requests = requests_to(laser);
  return std::ranges::find(requests, request) != requests.end();
}

}  // namespace orca::test
