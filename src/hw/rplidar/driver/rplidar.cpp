// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/geometry/objects/plane.hpp"
#include "orca/geometry/objects/ranges.hpp"
#include "orca/hardware.hpp"
#include "orca/hw/laser_place.hpp"
#include "orca/hw/line_driver.hpp"
#include "orca/hw/rplidar/turns.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "rplidar_session.hpp"

namespace {

using orca::Duration;
using orca::Result;
using orca::Status;
using orca::TimePoint;
using namespace orca::hw::rplidar;
using namespace std::chrono_literals;

constexpr Duration kUsualTurn = 181'818'182ns;  // 5.5 in a second
constexpr Duration kLongestWait = 3s;           // for a whole turn, while points come
constexpr Duration kLook = 100ms;               // between two looks, if input wakes nobody sooner
constexpr Duration kLookWithoutWaking = 5ms;
constexpr double kMinRange = 0.15;  // [m]
constexpr int kBlindTurns = 50;     // without any echo, until that is said

/// A SLAMTEC RPLIDAR A1: a laser whose head turns all around, about 5.5 times a second.
///
/// Its motor turns as long as somebody uses it. It is switched by the adapter's line DTR, which other links than a serial port do not
/// have: there the motor turns as the adapter lets it.
///
/// A scan is a turn. It begins behind and goes clockwise as the head does, so the angles of its beams, counter-clockwise, decrease; upside down they increase.
class Rplidar final : public orca::hw::LineDriver {
 public:
  explicit Rplidar(orca::hw::HardwareHost& host) : LineDriver(host, "/dev/ttyUSB0", {.baud = kBaud}) {}

  std::vector<orca::HardwareFault> prepare() override {
    std::vector<orca::HardwareFault> faults = prepare_line();
    for (orca::HardwareFault& fault : place_.read()) faults.push_back(std::move(fault));
    if (!faults.empty()) return faults;
    turns_.emplace(static_cast<std::size_t>(*beams_));
    scans_.emplace(kUsualTurn);
    add_sensor(*scans_);
    return faults;
  }

  [[nodiscard]] orca::idl::Robot description() const override {
    orca::idl::Robot robot;
    robot.name(*name_);
    robot.vendor("SLAMTEC");
    robot.model("RPLIDAR A1");
    orca::idl::LaserSensor laser;
    laser.name(*name_);
    laser.vendor("SLAMTEC");
    laser.model("RPLIDAR A1");
    laser.port(device());
    laser.type("LaserRangeReadings");
    laser.update_interval(orca::to_seconds(kUsualTurn));
    laser.mount(orca::level_frame(place_.place(), place_.height()));
    laser.number(static_cast<std::uint32_t>(*beams_));
    laser.angle_start(place_.sense() * std::numbers::pi);
    laser.angle_increment(increment());
    laser.min_range(kMinRange);
    laser.max_range(*max_range_);
    robot.laser_sensors().push_back(laser);
    return robot;
  }

 protected:
  Status begin(TimePoint now) override {
    session_.emplace(line(), mode());
    noted_.reset();
    return session_->begin(now);
  }

  Result<bool> advance(TimePoint now) override {
    Result<bool> done = session_->advance(now);
    if (done && *done) meet();
    return done;
  }

  [[nodiscard]] TimePoint next_step() const override {
    return line().descriptor() < 0 ? host().now() : session_->next();
  }
  [[nodiscard]] TimePoint next_turn() const override {
    const Duration look = line().descriptor() < 0 ? kLookWithoutWaking : kLook;
    return std::min(looked_ + look, session_->next());
  }

  [[nodiscard]] orca::hw::LineCounts counts() const override { return session_->counts(); }

  // It says nothing unless it scans.
  [[nodiscard]] Duration longest_silence() const override {
    return session_->scans() ? Duration(1s) : Duration::max();
  }

  Status start() override {
    turns_->restart();
    blind_turns_ = 0;
    scanned_ = false;
    return session_->scan(host().now());
  }

  void stop() override { session_->rest(); }
  void take_leave() override { session_->rest(); }

  Status poll() override {
    looked_ = host().now();
    Status read =
        session_->receive(looked_, [&](const Point& point, TimePoint stamp) { take(point, stamp); });
    if (!read.ok()) return read;
    if (!session_->scans()) return line().flush();
    note_beginning();
    if (looked_ - turned_ > kLongestWait) return no_turn();
    return line().flush();
  }

  Status drive(const orca::hw::DriveSetpoint& /*setpoint*/) override {
    return orca::fail(orca::Code::failed_precondition, "a laser does not move");
  }

 private:
  [[nodiscard]] ScanMode mode() const {
    if (*mode_ == "express") return ScanMode::express;
    return *mode_ == "standard" ? ScanMode::standard : ScanMode::automatic;
  }
  [[nodiscard]] double increment() const {
    return -place_.sense() * 2.0 * std::numbers::pi / static_cast<double>(*beams_);
  }

  void meet() {
    const DeviceInfo& info = session_->info();
    char firmware[16];
    std::snprintf(firmware, sizeof firmware, "%d.%02d", info.firmware_major, info.firmware_minor);
    host().write_log(orca::log::Level::info, "connected to an RPLIDAR, model " + std::to_string(info.model) +
                                                 ", firmware " + firmware + ", serial number " +
                                                 info.serial_text());
    if (session_->health().state != Health::State::good)
      host().write_log(orca::log::Level::warning, "the laser reports that it may fail soon (number " +
                                                      std::to_string(session_->health().error) + ")");
    looked_ = host().now();
  }

  void note_beginning() {
    if (std::exchange(scanned_, true)) return;
    turned_ = looked_;
    if (noted_ == session_->is_express()) return;
    noted_ = session_->is_express();
    host().write_log(orca::log::Level::info, *noted_ ? "it sends express scans" : "it sends standard scans");
  }

  [[nodiscard]] Status no_turn() const {
    return orca::fail(
        orca::Code::deadline_exceeded,
        "the laser sends points, but no whole turn for 3 s: does its head turn evenly, and is its "
        "cable good? " +
            std::to_string(turns_->incomplete()) + " turns had gaps");
  }

  void take(const Point& point, TimePoint stamp) {
    heard(session_->sent());
    const Turn* const turn = turns_->add(point, stamp);
    if (turn == nullptr) return;
    turned_ = looked_;
    publish(*turn);
  }

  void publish(const Turn& turn) {
    auto object = scans_->loan();
    object->ranges().assign(turn.ranges.begin(), turn.ranges.end());
    for (double& range : object->ranges())
      if (range >= *max_range_) range = std::numeric_limits<double>::infinity();
    note_sight(object->ranges());
    object->min_range(kMinRange);
    object->max_range(*max_range_);
    object->pose(orca::level_pose(place_.place(), place_.height(), turn.stamp));
    object->stamp(orca::to_time_value(turn.stamp));
    object->angle_start(place_.sense() * std::numbers::pi);
    object->angle_increment(increment());
    object->time_increment(orca::to_seconds(turn.period) / static_cast<double>(*beams_));
    orca::set_uncertainty(*object, place_.errors());
    scans_->publish(std::move(object));
  }

  // A laser that sees nothing for long may have something over its head; or it stands in the open.
  template <class Ranges>
  void note_sight(const Ranges& ranges) {
    const bool sees = std::ranges::any_of(ranges, [](double range) { return std::isfinite(range); });
    blind_turns_ = sees ? 0 : blind_turns_ + 1;
    if (blind_turns_ == kBlindTurns)
      host().write_log(
          orca::log::Level::warning,
          "the laser has seen nothing for 50 turns: is something over its head, is it in the sun, "
          "or is there nothing within its range?");
  }

  orca::Param<std::string> name_{*this, "name", "laser", {.text = "Name of this laser, one word."}};
  orca::Param<std::string> mode_{
      *this,
      "mode",
      "auto",
      {.choices = {"auto", "standard", "express"},
       .text = "Which scans it is asked for: express ones have twice as many points; "
               "auto: those if its firmware knows them."}};
  orca::Param<std::int64_t> beams_{
      *this, "beams", 360, {.min = 36, .max = 1440, .text = "Beams of a scan, at equal angles all around."}};
  orca::Param<double> max_range_{
      *this,
      "max_range",
      12.0,
      {.unit = "m",
       .min = 1.0,
       .max = 16.0,
       .text = "What is farther away is nothing: 12 m for an A1M8, 6 m for older ones."}};
  orca::hw::LaserPlace place_{*this, "its angle 0"};

  std::optional<orca::hw::SensorHW<orca::idl::LaserRangeReadings>> scans_;
  std::optional<TurnCollector> turns_;
  std::optional<RplidarSession> session_;
  bool scanned_ = false;       // points have come since start()
  std::optional<bool> noted_;  // whether express scans were said to come
  int blind_turns_ = 0;
  TimePoint looked_{};
  TimePoint turned_{};  // when a turn ended
};

}  // namespace

ORCA_HARDWARE(Rplidar, "orca.hw.Rplidar")
