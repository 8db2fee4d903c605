// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include <string>

#include "orca/emulators/p2os_firmware.hpp"
#include "orca/hw/p2os/packet.hpp"
#include "robot_line.hpp"

namespace orca::emulators::test {

inline constexpr const char* kSync0 = "FA FB 03 00 00 00";  // and PULSE
inline constexpr const char* kSync1 = "FA FB 03 01 00 01";  // and OPEN
inline constexpr const char* kSync2 = "FA FB 03 02 00 02";  // and CLOSE
inline constexpr const char* kEnable = "FA FB 06 04 3B 01 00 05 3B";
inline constexpr const char* kAhead = "FA FB 06 0B 3B C8 00 D3 3B";  // VEL 200
inline constexpr const char* kStop = "FA FB 03 1D 00 1D";

/// A Pioneer and its host.
struct PioneerLine : RobotLine<P2osFirmware, P2osSettings, 9600> {
  using RobotLine::RobotLine;
  std::string answer(const std::string& bytes) { return RobotLine::answer(bytes, 50ms); }
  void open() {
    for (const char* const step : {kSync0, kSync1, kSync2, kSync1}) (void)answer(step);
    say(kEnable);
  }
  /// Keeps its watchdog fed while time passes.
  void pass_alive(Duration time) {
    for (Duration done{0}; done < time; done += 500ms) {
      say(kSync0);
      (void)pass(500ms);
    }
  }
  /// Returns the next information packet.
  Bytes information() {
    Bytes packet;
    hw::framing::Scanner scanner(hw::p2os::kProtocol);
    for (int step = 0; packet.empty() && step < 1000; ++step)
      scanner.feed(pass(1ms), [&](const hw::framing::Frame& frame) {
        if ((frame.bytes[3] & 0xF0) == 0x30) packet.assign(frame.bytes.begin(), frame.bytes.end());
      });
    REQUIRE(packet.size() >= 30);
    return packet;
  }
};

/// The same, when the host has opened it.
struct OpenPioneer : PioneerLine {
  OpenPioneer() { open(); }
};

}  // namespace orca::emulators::test
