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

#include "orca/hardware.hpp"
#include "orca/hw/laser_driver.hpp"
#include "orca/hw/rplidar/turns.hpp"
#include "rplidar_session.hpp"

namespace {

using namespace orca;
using namespace orca::hw;
using namespace orca::hw::rplidar;

constexpr Duration kUsualTurn = 181'818'182ns;  // 5.5 in a second
constexpr Duration kLongestWait = 3s;           // for a whole turn, while points come
constexpr double kMinRange = 0.15;              // [m]
constexpr int kBlindTurns = 50;                 // without any echo, until that is said

/// A SLAMTEC RPLIDAR A1: a laser whose head turns all around, about 5.5 times a second.
///
/// Its motor turns as long as somebody uses it. It is switched by the adapter's line DTR, which other links than a serial port do not
/// have: there the motor turns as the adapter lets it.
///
/// A scan is a turn. It begins behind and goes clockwise as the head does, so the angles of its beams, counter-clockwise, decrease; upside down they increase.
class Rplidar final : public LaserDriver {
 public:
  explicit Rplidar(HardwareHost& host)
      : LaserDriver(host, {.baud = kBaud},
                    {.vendor = "SLAMTEC", .model = "RPLIDAR A1", .direction = "its angle 0"}) {}

 protected:
  [[nodiscard]] Scans scans() const override {
    return {.beams = static_cast<std::size_t>(*beams_),
            .first_angle = std::numbers::pi,
            .increment = -2.0 * std::numbers::pi / static_cast<double>(*beams_),
            .min_range = kMinRange,
            .max_range = *max_range_,
            .period = kUsualTurn};
  }

  LineSession& session() override {
    if (!session_) session_.emplace(line(), mode());
    return *session_;
  }

  Status meet() override {
    const DeviceInfo& info = session_->info();
    char firmware[16];
    std::snprintf(firmware, sizeof firmware, "%d.%02d", info.firmware_major, info.firmware_minor);
    log_connected("an RPLIDAR, model " + std::to_string(info.model) + ", firmware " + firmware +
                  ", serial number " + info.serial_text());
    if (session_->health().state != Health::State::good)
      warn("the laser reports that it may fail soon (number " + std::to_string(session_->health().error) +
           ")");
    noted_.reset();
    return ok();
  }

  // It says nothing unless it scans.
  [[nodiscard]] Duration longest_silence() const override {
    return session_->scans() ? Duration(1s) : Duration::max();
  }

  Status start() override {
    if (!turns_) turns_.emplace(static_cast<std::size_t>(*beams_));
    turns_->restart();
    blind_turns_ = 0;
    scanned_ = false;
    return session_->scan(host().now());
  }

  void stop() override { session_->rest(); }
  void take_leave() override { session_->rest(); }

  Status look(TimePoint now) override {
    Status read =
        session_->receive(now, [&](const Point& point, TimePoint stamp) { take(point, stamp, now); });
    if (!read.ok() || !session_->scans()) return read;
    note_beginning(now);
    return now - turned_ > kLongestWait ? no_turn() : ok();
  }

 private:
  [[nodiscard]] ScanMode mode() const {
    if (*mode_ == "express") return ScanMode::express;
    return *mode_ == "standard" ? ScanMode::standard : ScanMode::automatic;
  }

  void note_beginning(TimePoint now) {
    if (std::exchange(scanned_, true)) return;
    turned_ = now;
    if (noted_ == session_->is_express()) return;
    noted_ = session_->is_express();
    host().write_log(log::Level::info, *noted_ ? "it sends express scans" : "it sends standard scans");
  }

  [[nodiscard]] Status no_turn() const {
    return fail(Code::deadline_exceeded,
                "the laser sends points, but no whole turn for 3 s: does its head turn evenly, and is its "
                "cable good? " +
                    std::to_string(turns_->incomplete()) + " turns had gaps");
  }

  void take(const Point& point, TimePoint stamp, TimePoint now) {
    heard(session_->sent());
    const Turn* const turn = turns_->add(point, stamp);
    if (turn == nullptr) return;
    turned_ = now;
    std::vector<double> ranges = turn->ranges;
    for (double& range : ranges)
      if (range >= *max_range_) range = std::numeric_limits<double>::infinity();
    note_sight(ranges);
    publish(ranges, turn->stamp, to_seconds(turn->period) / static_cast<double>(*beams_));
  }

  // A laser that sees nothing for long may have something over its head; or it stands in the open.
  void note_sight(const std::vector<double>& ranges) {
    const bool sees = std::ranges::any_of(ranges, [](double range) { return std::isfinite(range); });
    blind_turns_ = sees ? 0 : blind_turns_ + 1;
    if (blind_turns_ == kBlindTurns)
      warn(
          "the laser has seen nothing for 50 turns: is something over its head, is it in the sun, "
          "or is there nothing within its range?");
  }

  Param<std::string> mode_{*this,
                           "mode",
                           "auto",
                           {.choices = {"auto", "standard", "express"},
                            .text = "Which scans it is asked for: express ones have twice as many points; "
                                    "auto: those if its firmware knows them."}};
  Param<std::int64_t> beams_{
      *this, "beams", 360, {.min = 36, .max = 1440, .text = "Beams of a scan, at equal angles all around."}};
  Param<double> max_range_{
      *this,
      "max_range",
      12.0,
      {.unit = "m",
       .min = 1.0,
       .max = 16.0,
       .text = "What is farther away is nothing: 12 m for an A1M8, 6 m for older ones."}};

  std::optional<TurnCollector> turns_;
  std::optional<RplidarSession> session_;
  bool scanned_ = false;       // points have come since start()
  std::optional<bool> noted_;  // whether express scans were said to come
  int blind_turns_ = 0;
  TimePoint turned_{};  // when a turn ended
};

}  // namespace

ORCA_HARDWARE(Rplidar, "orca.hw.Rplidar")
