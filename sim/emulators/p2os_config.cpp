// SPDX-License-Identifier: LGPL-3.0-or-later
#include "p2os_config.hpp"

#include <chrono>
#include <string>

namespace orca::emulators {
namespace {

constexpr std::uint8_t kType = 0x20;

class Fields {
 public:
  Fields& text(const std::string& value) {
    bytes.insert(bytes.end(), value.begin(), value.end());
    return byte(0);
  }
  Fields& byte(unsigned value) {
    bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
    return *this;
  }
  Fields& word(unsigned value) { return byte(value).byte(value >> 8); }
  Fields& words(std::initializer_list<unsigned> values) {
    for (const unsigned value : values) word(value);
    return *this;
  }
  std::vector<std::uint8_t> bytes{kType};
};

unsigned milliseconds(Duration time) {
  return static_cast<unsigned>(std::chrono::duration_cast<std::chrono::milliseconds>(time).count());
}

unsigned code_of(std::uint32_t baud) {
  constexpr std::uint32_t kRates[] = {9600, 19200, 38400, 57600, 115200};
  unsigned code = 0;
  for (unsigned i = 0; i < 5; ++i)
    if (kRates[i] == baud) code = i;
  return code;
}

}  // namespace

// Of what a robot in the simulator does not have, gains and limits of motor power, it says 0.
std::vector<std::uint8_t> p2os_config(const P2osSettings& settings, unsigned gripper) {
  const bool has_rear = settings.sonars > 8;
  Fields fields;
  fields.text(settings.robot_class).text(settings.subclass).text("ORCA");
  fields.byte(0).words({500, 2200, 300, 2000, 500});  // tops: deg/s, mm/s, deg/s2, mm/s2; PWM
  fields.text(settings.name).byte(milliseconds(settings.cycle)).byte(code_of(settings.baud)).byte(0);
  fields.word(gripper).word(1).byte(has_rear ? 1 : 0);             // gripper, front and rear sonars
  fields.word(110).word(0).word(milliseconds(settings.watchdog));  // low battery 11 V, RevCount
  fields.byte(0).words({0, 0, 0, 0});           // two SIPs; stall value and count; joystick
  fields.words({100, 400, 100, 100, 0, 0, 0});  // turning: deg/s, mm/s, deg/s2 twice; gains
  fields.words({300, 300, 0, 0, 0});            // driving: mm/s2 twice; gains
  fields.byte(settings.front_bumpers)
      .byte(settings.rear_bumpers)
      .byte(0)
      .byte(40)
      .byte(settings.resets_baud ? 2 : 0);
  fields.byte(0).word(0).byte(0).byte(0).word(0).word(0);  // gyro, drift, aux rates, ticks, shutdown
  return fields.text("1.0").bytes;
}

}  // namespace orca::emulators
