// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/emulators/body.hpp"
#include "orca/emulators/firmware.hpp"
#include "orca/geometry/pose2.hpp"

namespace orca::emulators {

struct PlayerHeader;
class PlayerRobot;

/// Returns where the 16 sonars of a Pioneer 2 are, in the robot frame.
[[nodiscard]] std::vector<Pose2> pioneer_sonars();

/// What a server has, and how it behaves. Devices have the numbers of their interfaces: 2 power, 4 position2d, 5 sonar, 6 laser, 14 bumper.
struct PlayerSettings {
  std::string version = "3.1.1-dev";  ///< In its banner.
  std::string banner{};               ///< What it sends first instead of a banner, if anything.
  std::uint32_t port = 6665;          ///< That it names in addresses.
  std::string base_driver = "p2os";   ///< Of all devices but the laser.
  std::string laser_driver = "sicklms200";
  std::vector<Pose2> sonars = pioneer_sonars();
  unsigned front_bumpers = 5;
  unsigned rear_bumpers = 5;
  double length = 0.44;                 ///< [m]
  double width = 0.38;                  ///< [m]
  Pose2 laser_pose{0.017, 0.008, 0.0};  ///< In the robot frame.
  double laser_height = 0.3;            ///< [m] of its beams.
  double laser_range = 8.0;             ///< [m] what a beam without a return tells.
  double voltage = 12.7;                ///< [V]
  Duration cycle = 100ms;               ///< From data to data, but for the laser.
  Duration scan_period = 25ms;          ///< Least time between two scans.
  Duration accept_time = 50ms;          ///< From the connection to the banner.
  bool shows_rangers =
      false;  ///< The sonars are ranger:0, and the laser is ranger:1, as the simulator Stage shows them.
  std::set<std::uint32_t> missing{};  ///< Devices that it does not have.
  std::set<std::uint32_t> refused{};  ///< Devices whose driver does not start.
  std::set<std::uint32_t> silent{};   ///< Devices whose requests get no answer.
  std::map<std::uint32_t, Duration>
      starting{};  ///< How long devices only queue messages after a client opened them.
};

/// A Player server with one robot, as one of its clients sees it: it lists its devices, lets the client subscribe, answers requests,
/// sends data by itself or when it is asked, and drives the body as it is commanded.
///
/// Each client has its own subscriptions and its own way to get data. All drive the same base, of which the last command counts. A
/// device is closed, and the base stops, when the last client that has it open closes it: until then the base goes on with what a
/// client has commanded that is gone.
///
/// A connection begins when the line says that a host is there, with the banner, and ends when the host has gone: all its devices are
/// closed then. Bytes from a host of which the line has said nothing begin one too. The base has no watchdog: without another
/// command it does for ever what it was told. Its motors turn while they have power and the last command says so. Messages to a device that
/// is not open are dropped, as are commands that are not known or of a wrong size; such requests are refused. Of a stream whose header is
/// nonsense, what has come so far is forgotten.
///
/// No rate of a line is enforced. The configuration of the laser is told, and does not change. In pull mode the newest data of each device
/// wait for the client, or the client for them: a round ends with data.
///
/// Thread contract: not synchronised.
/// @source  Player 3.1 server, TCP protocol in XDR.
class PlayerFirmware final : public Firmware {
 public:
  /// @param body    outlives the object.
  /// @param mirror  of its laser; outlives the object. Null: it has none.
  explicit PlayerFirmware(Body& body, PlayerSettings settings = {}, const Mirror* mirror = nullptr);
  ~PlayerFirmware() override;
  PlayerFirmware(const PlayerFirmware&) = delete;
  PlayerFirmware& operator=(const PlayerFirmware&) = delete;

  void take(std::span<const std::uint8_t> bytes, std::uint32_t baud, TimePoint now) override;
  std::vector<std::uint8_t> advance(TimePoint now) override;
  [[nodiscard]] std::unique_ptr<Firmware> for_another_host() override;
  /// The connection of this client is lost then, as when the server is started anew. Where the odometry begins is forgotten, too.
  void reset(TimePoint now) override;
  void note_host(bool is_there, TimePoint now) override;

  [[nodiscard]] bool has_power() const;
  /// Returns whether this client has the device open.
  [[nodiscard]] bool is_subscribed(std::uint32_t device) const { return open_.contains(device); }
  /// Returns how many connections this client's place has had.
  [[nodiscard]] int connections() const { return connections_; }
  /// Returns how many messages of them were dropped.
  [[nodiscard]] int dropped() const { return dropped_; }

 private:
  using Bytes = std::span<const std::uint8_t>;

  explicit PlayerFirmware(std::shared_ptr<PlayerRobot> robot);
  void connect(TimePoint now);
  void disconnect();
  void greet();
  void obey(Bytes message);
  void ask(std::uint32_t device, const PlayerHeader& header, Bytes payload);
  [[nodiscard]] bool is_starting(std::uint32_t device) const;
  void serve(const PlayerHeader& header, Bytes payload);
  void subscribe(const PlayerHeader& header, Bytes payload);
  void close(std::uint32_t device);
  void list_devices(const PlayerHeader& header);
  void tell_driver(const PlayerHeader& header, Bytes payload);
  void set_data_mode(const PlayerHeader& header, Bytes payload);
  void give_data(const PlayerHeader& header);
  void end_round();
  void publish(std::uint32_t device, Bytes payload);
  void send_data(std::uint32_t device, Bytes payload);
  void answer(const PlayerHeader& header, std::uint32_t type, Bytes payload);
  void send(const PlayerHeader& header, Bytes payload);

  const std::shared_ptr<PlayerRobot> robot_;  // that of all clients
  const PlayerSettings& settings_;            // the robot's
  TimePoint now_{};
  bool has_host_ = false;              // the line says so
  std::optional<TimePoint> greet_at_;  // then the banner is due
  bool connected_ = false;             // the banner was sent
  std::vector<std::uint8_t> heard_;    // of a message whose rest is awaited
  std::vector<std::uint8_t> out_;
  std::set<std::uint32_t> open_;  // devices
  std::map<std::uint32_t, TimePoint> opened_at_;
  std::vector<std::vector<std::uint8_t>> waiting_;  // messages to devices that are starting
  bool pulls_ = false;
  bool asked_ = false;                                        // for a round that had no data yet
  std::map<std::uint32_t, std::vector<std::uint8_t>> queue_;  // in pull mode, by device
  TimePoint next_cycle_{};
  std::uint32_t scans_ = 0;  // of the robot, when the client got one or opened the laser
  int connections_ = 0;
  int dropped_ = 0;
};

}  // namespace orca::emulators
