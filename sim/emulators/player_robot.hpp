// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/emulators/body.hpp"
#include "orca/emulators/player_firmware.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca::emulators {

/// The devices behind an emulated Player server, as its drivers see them: what they answer, tell and do. Interfaces, types and subtypes have
/// the numbers of the protocol.
///
/// Thread contract: not synchronised.
class PlayerRobot {
 public:
  using Bytes = std::vector<std::uint8_t>;

  /// @param body, mirror, settings  outlive the object; without a mirror it has no laser.
  PlayerRobot(Body& body, const Mirror* mirror, const PlayerSettings& settings);

  [[nodiscard]] std::vector<std::uint32_t> interfaces() const;
  /// Returns whether a device knows a message.
  [[nodiscard]] static bool knows(std::uint32_t interface, std::uint32_t type, std::uint32_t subtype);

  /// Carries out a request. @return the answer's payload; nothing if it is not known, or has another size than it must.
  [[nodiscard]] std::optional<Bytes> request(std::uint32_t interface, std::uint32_t subtype,
                                             std::span<const std::uint8_t> payload);
  /// Carries out a command to the base. @return whether it was one.
  bool command(std::uint32_t subtype, std::span<const std::uint8_t> payload);
  /// The base stands from now on, without power.
  void rest();
  /// The odometry begins where the robot is.
  void define(const Pose2& pose);

  /// Returns what a device other than the laser tells now.
  [[nodiscard]] Bytes data(std::uint32_t interface) const;
  /// Returns the laser's scan if there is a new one.
  [[nodiscard]] std::optional<Bytes> scan(TimePoint now);

  [[nodiscard]] bool has_power() const { return power_; }

 private:
  [[nodiscard]] std::optional<Bytes> request_of_base(std::uint32_t subtype,
                                                     std::span<const std::uint8_t> payload);
  [[nodiscard]] Bytes sonar_geometry() const;
  [[nodiscard]] Bytes laser_geometry() const;
  [[nodiscard]] Bytes laser_configuration() const;
  [[nodiscard]] Bytes state() const;
  [[nodiscard]] Bytes sonar_ranges() const;
  [[nodiscard]] Bytes pressed() const;
  [[nodiscard]] Bytes battery() const;
  void drive();

  Body& body_;
  const Mirror* const mirror_;
  const PlayerSettings& settings_;
  bool power_ = false;
  bool may_turn_ = true;  // the wheels, as the last command says
  Twist2 wanted_{};
  Pose2 defined_{};     // what the pose is
  Pose2 defined_at_{};  // where the body's odometry says this
  TimePoint next_scan_{};
  std::optional<TimePoint> scanned_{};  // the turn that was told last
  std::uint32_t scans_ = 0;
};

}  // namespace orca::emulators
