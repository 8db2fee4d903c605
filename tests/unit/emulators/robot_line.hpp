// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hex_bytes.hpp"
#include "orca/emulators/body.hpp"
#include "orca/emulators/firmware.hpp"
#include "orca/geometry/arc.hpp"

namespace orca::emulators::test {

/// A body that senses what the test says, and rolls as it is told.
struct ScriptedBody final : Body {
  void drive(const Twist2& velocity) override { told = velocity; }
  [[nodiscard]] Pose2 odometry() const override { return pose; }
  [[nodiscard]] Twist2 velocity() const override { return measured.value_or(told); }
  [[nodiscard]] std::optional<double> sonar(int number) const override {
    const auto found = ranges.find(number);
    return found == ranges.end() ? std::nullopt : std::optional<double>(found->second);
  }
  [[nodiscard]] std::uint16_t bumpers() const override { return pressed; }
  [[nodiscard]] bool is_stalled() const override { return stalled; }
  [[nodiscard]] std::uint8_t cliffs() const override { return no_floor; }
  [[nodiscard]] bool is_lifted() const override { return lifted; }
  [[nodiscard]] std::optional<bool> is_charged() const override { return charged; }
  void move_gripper(GripperMove move) override { gripper_moves.push_back(move); }
  [[nodiscard]] std::optional<GripperLook> gripper() const override { return look; }

  Twist2 told;
  std::optional<Twist2> measured;
  Pose2 pose;
  std::map<int, double> ranges;
  std::optional<bool> charged;
  std::uint16_t pressed = 0;
  std::uint8_t no_floor = 0;
  bool stalled = false;
  bool lifted = false;
  std::vector<GripperMove> gripper_moves;
  std::optional<GripperLook> look;
};

/// A robot's controller and its host, which hears everything that it sends.
/// @tparam kBaud  [baud] at which the host speaks, if it is not told otherwise.
template <class Device, class Settings, std::uint32_t kBaud>
struct RobotLine {
  using Bytes = hw::test::Bytes;

  explicit RobotLine(const Settings& settings = {}) : firmware(body, settings) {
    (void)firmware.advance(now);
  }
  void say(const std::string& bytes, std::uint32_t baud = kBaud) {
    firmware.take(hw::test::hex(bytes), baud, now);
  }
  /// Lets time pass in steps of 1 ms, in which the body moves, and returns what was sent.
  Bytes pass(Duration time) {
    Bytes sent;
    for (const TimePoint end = now + time; now < end;) {
      now += 1ms;
      body.pose = along_arc(body.pose, body.told * 0.001);
      const Bytes part = firmware.advance(now);
      sent.insert(sent.end(), part.begin(), part.end());
    }
    return sent;
  }
  /// Returns as text what comes within `time`.
  std::string answer(const std::string& bytes, Duration time) {
    say(bytes);
    return hw::test::text_of(pass(time));
  }

  ScriptedBody body;
  Device firmware;
  TimePoint now{10s};
};

}  // namespace orca::emulators::test
