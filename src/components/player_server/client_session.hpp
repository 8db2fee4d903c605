// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/hw/player/message.hpp"
#include "orca/hw/player/message_reader.hpp"
#include "orca/hw/player/position2d.hpp"
#include "robot_face.hpp"

namespace orca::player_server {

/// The talk between a client of Player and this robot: bytes in, bytes out.
///
/// Data are sent as they arise, or on request in pull mode; of each device the newest takes the place of one that has not been
/// sent. A client that does not read is sent nothing new, and is given up when its answers pile up, too.
///
/// Thread contract: not synchronised.
/// @source  Player 3.1 network protocol and interface definitions.
class ClientSession {
 public:
  /// @param face     of the robot; outlives the session.
  /// @param address  of the server as the client sees it, of which host and robot (TCP port) are used.
  ClientSession(const RobotFace& face, hw::player::Address address);

  /// Takes what the client has sent.
  /// @errors  data_loss if it is no message of Player, unavailable if it does not read its answers: close the connection.
  Status take(std::span<const std::uint8_t> bytes, TimePoint now);

  /// Notes that there is something new of a device. @param stamp  when it was measured [s].
  void offer(const DeviceName& device, double stamp);

  /// Returns the bytes that wait to be sent; the caller takes them from the front.
  [[nodiscard]] std::vector<std::uint8_t>& output() { return output_; }

  /// Returns the velocity that the client wants, and when it said so; nothing if it has none, has switched the motors off, or
  /// does not use the base.
  struct Wish {
    Twist2 velocity;
    TimePoint said;
  };
  [[nodiscard]] const std::optional<Wish>& wish() const { return wish_; }
  /// Returns what is to be said of commands that are dropped, each kind once; empty: nothing.
  [[nodiscard]] std::string take_remark() { return std::exchange(remark_, {}); }
  [[nodiscard]] bool uses(const DeviceName& device) const { return uses_.contains(device); }

 private:
  using Payload = std::span<const std::uint8_t>;

  void obey(const hw::player::Message& message, TimePoint now);
  void command(const hw::player::Message& message, TimePoint now);
  void note_dropped(const hw::player::MessageId& id);
  void answer(const hw::player::Message& message);
  void answer_server(const hw::player::Message& message);
  void answer_device(const hw::player::Message& message);
  bool answer_ranger(const hw::player::Message& message);
  bool switch_motors(Payload payload);
  bool set_odometry(const Result<hw::player::Planar>& wanted);
  void subscribe(const hw::player::Message& message);
  void tell_driver(const hw::player::Message& message);
  void begin_round(const hw::player::Header& request);
  void end_round();
  [[nodiscard]] bool knows(const hw::player::MessageId& id) const;
  [[nodiscard]] bool has(const hw::player::Address& device) const;
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> data_of(const DeviceName& device) const;
  void send_data(const DeviceName& device, double stamp);
  void send(hw::player::Header header, Payload payload = {});
  void accept(const hw::player::Header& request, Payload payload = {});
  void refuse(const hw::player::Header& request);
  [[nodiscard]] hw::player::Planar shown_pose() const;

  const RobotFace& face_;
  const hw::player::Address address_;
  hw::player::MessageReader reader_{hw::player::MessageReader::Side::server};
  std::vector<std::uint8_t> output_;
  std::set<DeviceName> uses_;
  std::map<DeviceName, double> fresh_;  // of each device, when what was not sent yet was measured [s]
  bool pulls_ = false;
  bool asked_ = false;  // for a round that had nothing new yet
  bool motors_on_ = true;
  Pose2 origin_{};  // of the odometry that this client sees
  std::optional<Wish> wish_;
  std::set<std::string> remarks_;  // that were made
  std::string remark_;
};

}  // namespace orca::player_server
