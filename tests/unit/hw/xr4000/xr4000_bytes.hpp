// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "hex_bytes.hpp"
#include "orca/hw/xr4000/frame.hpp"

/// Frames of the protocol of docs/hardware/xr4000.md, written out by hand.
namespace orca::hw::test {

inline const std::string kXrHello = "58 52 01 00 01 01 64 D1";
inline const std::string kXrHelloAnswer = "58 52 03 00 81 00 01 78 D2 A7";
inline const std::string kXrGetState = "58 52 00 00 02 DE EC";
// Ready, 123456 ms, integrator -500, 1250, 785, speeds -100, 300, -50.
inline const std::string kXrStateAnswer =
    "58 52 1E 00 82 00 00 40 E2 01 00 0C FE FF FF E2 04 00 00 11 03 00 00 9C FF FF FF 2C 01 00 00 CE FF FF "
    "FF 23 6F";
// Velocity mode: x -100 mm/s, y 300 mm/s, both with 500 mm/s^2; rotation 250 mrad/s with 2000 mrad/s^2.
inline const std::string kXrSetAxes =
    "58 52 1B 00 03 04 9C FF FF FF F4 01 00 00 04 2C 01 00 00 F4 01 00 00 04 FA 00 00 00 D0 07 00 00 80 7D";
inline const std::string kXrResetMotionTimer = "58 52 00 00 04 18 8C";
inline const std::string kXrSetTimer = "58 52 04 00 05 F4 01 00 00 D3 71";  // 500 ms
inline const std::string kXrSetIntegrator =                                 // 1000, -2000, 1571
    "58 52 0C 00 06 E8 03 00 00 30 F8 FF FF 23 06 00 00 87 ED";
inline const std::string kXrGetSonar = "58 52 00 00 07 7B BC";
inline const std::string kXrGetInfrared = "58 52 00 00 08 94 4D";
inline const std::string kXrGetBumper = "58 52 00 00 09 B5 5D";
inline const std::string kXrGetBattery = "58 52 00 00 0A D6 6D";
// 508 mm, each 25 mm more than the one before; nothing from the last.
inline const std::string kXrSonarAnswer =
    "58 52 61 00 87 00 FC 01 15 02 2E 02 47 02 60 02 79 02 92 02 AB 02 C4 02 DD 02 F6 02 0F 03 28 03 41 03 "
    "5A 03 "
    "73 03 8C 03 A5 03 BE 03 D7 03 F0 03 09 04 22 04 3B 04 54 04 6D 04 86 04 9F 04 B8 04 D1 04 EA 04 03 05 "
    "1C 05 "
    "35 05 4E 05 67 05 80 05 99 05 B2 05 CB 05 E4 05 FD 05 16 06 2F 06 48 06 61 06 7A 06 FF FF 11 EA";
// 0, 1, 2 ... 47.
inline const std::string kXrInfraredAnswer =
    "58 52 61 00 88 00 00 00 01 00 02 00 03 00 04 00 05 00 06 00 07 00 08 00 09 00 0A 00 0B 00 0C 00 0D 00 "
    "0E 00 "
    "0F 00 10 00 11 00 12 00 13 00 14 00 15 00 16 00 17 00 18 00 19 00 1A 00 1B 00 1C 00 1D 00 1E 00 1F 00 "
    "20 00 "
    "21 00 22 00 23 00 24 00 25 00 26 00 27 00 28 00 29 00 2A 00 2B 00 2C 00 2D 00 2E 00 2F 00 D9 5A";
// Switch 3 of set 0 is touched low, switch 7 of set 5 high.
inline const std::string kXrBumperAnswer =
    "58 52 3D 00 89 00 00 00 00 01 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 "
    "00 00 "
    "00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 02 64 AD";
inline const std::string kXrBatteryAnswer =
    "58 52 09 00 8A 00 E0 01 E1 01 00 00 FF FF 4F 5D";  // 480 481 0 65535

/// A frame and what it says.
struct HeldXrMessage {
  explicit HeldXrMessage(const std::string& frame) : bytes(hex(frame)), message(xr4000::message_of(bytes)) {}
  HeldXrMessage(const HeldXrMessage&) = delete;
  HeldXrMessage& operator=(const HeldXrMessage&) = delete;
  const Bytes bytes;
  const xr4000::Message message;
};

}  // namespace orca::hw::test
