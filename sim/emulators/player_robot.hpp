// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/emulators/body.hpp"
#include "orca/emulators/player_firmware.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca::emulators {

/// Of a device, as clients name it.
struct PlayerAddress {
  std::uint32_t interface = 0;
  std::uint32_t index = 0;
  friend bool operator==(const PlayerAddress&, const PlayerAddress&) = default;
};

/// The devices behind an emulated Player server, as its drivers see them: what they answer, tell and do. Interfaces, types and subtypes have
/// the numbers of the protocol. A device is named by the interface that it has at most servers, even if this one shows it as a ranger.
///
/// Thread contract: not synchronised.
class PlayerRobot {
 public:
  using Bytes = std::vector<std::uint8_t>;

  /// @param body, mirror  outlive the object; without a mirror it has no laser.
  PlayerRobot(Body& body, const Mirror* mirror, PlayerSettings settings);

  [[nodiscard]] const PlayerSettings& settings() const { return settings_; }
  [[nodiscard]] std::vector<std::uint32_t> devices() const;
  [[nodiscard]] PlayerAddress address_of(std::uint32_t device) const;
  /// Returns the device with an address; nothing if it has none.
  [[nodiscard]] std::optional<std::uint32_t> device_at(const PlayerAddress& address) const;
  /// Returns whether a device knows a message.
  [[nodiscard]] bool knows(std::uint32_t device, std::uint32_t type, std::uint32_t subtype) const;

  /// Carries out a request. @return the answer's payload; nothing if it is not known, or has another size than it must.
  [[nodiscard]] std::optional<Bytes> request(std::uint32_t device, std::uint32_t subtype,
                                             std::span<const std::uint8_t> payload);
  /// Carries out a command to the base. @return whether it was one.
  bool command(std::uint32_t subtype, std::span<const std::uint8_t> payload);
  /// One more client has a device open.
  void open(std::uint32_t device) { ++users_[device]; }
  /// One client less has it open. The driver of a base that nobody has open stops it, and takes its power.
  void close(std::uint32_t device);
  /// The odometry begins where the robot is.
  void define(const Pose2& pose);

  /// Returns what a device other than the laser tells now.
  [[nodiscard]] Bytes data(std::uint32_t device) const;
  /// The laser makes a scan of what its mirror has shown since the last one, if it is time.
  void look(TimePoint now);
  /// Returns how many scans it has made.
  [[nodiscard]] std::uint32_t scans() const { return scans_; }
  /// Returns its last scan. @pre  it has made one.
  [[nodiscard]] const Bytes& scan() const { return scan_; }

  [[nodiscard]] bool has_power() const { return power_; }

 private:
  [[nodiscard]] std::optional<MirrorTurn> last_turn() const;
  [[nodiscard]] std::optional<Bytes> request_of_base(std::uint32_t subtype,
                                                     std::span<const std::uint8_t> payload);
  [[nodiscard]] Bytes sonar_geometry() const;
  [[nodiscard]] Bytes laser_geometry() const;
  [[nodiscard]] Bytes laser_configuration() const;
  [[nodiscard]] Bytes ranger_geometry(std::uint32_t device) const;
  [[nodiscard]] Bytes ranger_configuration(std::uint32_t device) const;
  [[nodiscard]] Bytes laser_scan(const MirrorTurn& turn, const std::vector<double>& ranges) const;
  [[nodiscard]] Bytes state() const;
  [[nodiscard]] Bytes sonar_ranges() const;
  [[nodiscard]] Bytes pressed() const;
  [[nodiscard]] Bytes battery() const;
  void drive();
  void rest();

  Body& body_;
  const Mirror* const mirror_;
  const PlayerSettings settings_;
  std::map<std::uint32_t, int> users_;  // by device
  bool power_ = false;
  bool may_turn_ = true;  // the wheels, as the last command says
  Twist2 wanted_{};
  Pose2 defined_{};     // what the pose is
  Pose2 defined_at_{};  // where the body's odometry says this
  TimePoint next_scan_{};
  std::optional<TimePoint> scanned_{};  // the turn that was told last
  std::uint32_t scans_ = 0;
  Bytes scan_;
};

}  // namespace orca::emulators
