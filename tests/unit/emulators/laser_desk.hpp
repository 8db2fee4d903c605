// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hex_bytes.hpp"
#include "orca/emulators/sick_lms_firmware.hpp"

namespace orca::emulators::test {

using hw::test::Bytes;
using hw::test::hex;
using hw::test::text_of;

/// A mirror that turns when the test says so.
struct StillMirror final : Mirror {
  [[nodiscard]] std::optional<MirrorTurn> last_turn() const override {
    if (ranges.empty()) return std::nullopt;
    return MirrorTurn{{}, first_angle, step, ranges};
  }
  double first_angle = 0.0;  // [rad]
  double step = 1.0;         // [rad]
  std::vector<double> ranges;
};

/// A laser on a line of its own whose time the test makes pass, a millisecond at a time.
struct LaserDesk {
  explicit LaserDesk(SickLmsSettings settings = {}) : laser(mirror, std::move(settings)) {}

  /// Lets time pass and returns what the laser has sent meanwhile.
  Bytes pass(Duration time) {
    Bytes sent;
    for (const TimePoint end = now + time; now < end;) {
      now += 1ms;
      for (const std::uint8_t byte : laser.advance(now)) sent.push_back(byte);
    }
    return sent;
  }
  /// Sends bytes at the host's rate and returns, as text, what comes back within a second.
  std::string ask(const std::string& request, Duration time = 1s) {
    laser.take(hex(request), baud, now);
    return text_of(pass(time));
  }
  /// Lets the laser power up and drops what it says of that.
  void power_up() { (void)pass(1500ms); }

  StillMirror mirror;
  SickLmsFirmware laser;
  TimePoint now{1s};
  std::uint32_t baud = 9600;
};

/// A laser that has powered up.
struct ReadyDesk : LaserDesk {
  explicit ReadyDesk(SickLmsSettings settings = {}) : LaserDesk(std::move(settings)) { power_up(); }
};

}  // namespace orca::emulators::test
