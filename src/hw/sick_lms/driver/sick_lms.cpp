// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/geometry/objects/ranges.hpp"
#include "orca/hardware.hpp"
#include "orca/hw/laser_place.hpp"
#include "orca/hw/line_driver.hpp"
#include "orca/hw/line_frames.hpp"
#include "orca/hw/sick_lms/scan.hpp"
#include "orca/hw/sick_lms/timing.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "session.hpp"

namespace {

using orca::Duration;
using orca::Result;
using orca::Status;
using orca::TimePoint;
using namespace orca::hw::sick_lms;
using namespace std::chrono_literals;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr unsigned kFirstRate = 38400;  // at which the laser is looked for
constexpr unsigned kFastestRate = 500000;
constexpr Duration kShortestSilence = 1s;
constexpr Duration kTurn = 100ms;  // between two looks, if input wakes nobody sooner
constexpr Duration kTurnWithoutWaking = 5ms;

// A unit with the measuring mode that has the greatest range in it.
struct Scale {
  const char* name;
  Unit unit;
  std::uint8_t measuring_mode;
  double max_range;  // [m]
};
constexpr Scale kMillimetres{"mm", Unit::millimetre, 6, 32.0};
constexpr Scale kCentimetres{"cm", Unit::centimetre, 0, 80.0};

/// A SICK LMS200 or another laser of the LMS2xx family.
///
/// Its mirror turns 75 times a second. Beams closer than a degree are measured in two or four turns, and a scan is sent when the
/// last one is measured. At 38400 baud about 10 scans of 181 beams come in a second, at 500000 baud all 75.
class SickLms final : public orca::hw::LineDriver {
 public:
  explicit SickLms(orca::hw::HardwareHost& host) : LineDriver(host, "/dev/ttyUSB0", {.baud = kFirstRate}) {}

  std::vector<orca::HardwareFault> prepare() override {
    std::vector<orca::HardwareFault> faults = prepare_line();
    for (orca::HardwareFault& fault : place_.read()) faults.push_back(std::move(fault));
    variant_ = {rounded(*angle_ / kDegree), rounded(100.0 * *resolution_ / kDegree)};
    if (!is_possible(variant_))
      faults.push_back(
          {"resolution", "an LMS has no beams " + shown(*resolution_ / kDegree) + " deg apart over " +
                             shown(*angle_ / kDegree) +
                             " deg; choose 0.5 or 1 deg over 180 deg, or 0.25, 0.5 or 1 deg over 100 deg"});
    if (*rate_ != 0 && !request_rate(static_cast<unsigned>(*rate_)))
      faults.push_back(
          {"rate", request_rate(static_cast<unsigned>(*rate_)).error().message + ", or 0 for the fastest"});
    if (!faults.empty()) return faults;
    scale_ = *unit_ == kCentimetres.name ? kCentimetres : kMillimetres;
    scans_.emplace(scan_period(variant_, expected_rate()));
    add_sensor(*scans_);
    return faults;
  }

  [[nodiscard]] orca::idl::Robot description() const override {
    orca::idl::Robot robot;
    robot.name(*name_);
    robot.vendor("SICK");
    robot.model("LMS200");
    orca::idl::LaserSensor laser;
    laser.name(*name_);
    laser.vendor("SICK");
    laser.model("LMS200");
    laser.port(device());
    laser.type("LaserRangeReadings");
    laser.update_interval(orca::to_seconds(scan_period(variant_, expected_rate())));
    laser.mount(orca::level_frame(place_.place(), place_.height()));
    laser.number(static_cast<std::uint32_t>(beams(variant_)));
    laser.angle_start(place_.sense() * beam_angle(variant_, 0));
    laser.angle_increment(place_.sense() * increment(variant_));
    laser.min_range(0.0);
    laser.max_range(scale_.max_range);
    robot.laser_sensors().push_back(laser);
    return robot;
  }

 protected:
  // The session knows from one connection to the next which rates the laser does not have.
  Status begin(TimePoint now) override {
    if (!session_)
      session_.emplace(line(),
                       Wishes{.variant = variant_,
                              .unit = scale_.unit,
                              .measuring_mode = scale_.measuring_mode,
                              .rate = static_cast<std::uint32_t>(*rate_),
                              .patience = orca::from_seconds(*patience_)},
                       has_rate());
    scanning_ = false;
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
    return turned_ + (line().descriptor() < 0 ? kTurnWithoutWaking : kTurn);
  }

  [[nodiscard]] orca::hw::LineCounts counts() const override {
    return orca::hw::counts_of(session_->statistics());
  }

  // It says nothing unless it scans. A slow line takes a second for a scan.
  [[nodiscard]] Duration longest_silence() const override {
    return scanning_ ? std::max(kShortestSilence, 3 * scan_period(variant_, session_->rate()))
                     : Duration::max();
  }

  Status start() override {
    scanning_ = true;
    heard();  // its silence counts from now
    return session_->send(request_mode(Mode::all_scans));
  }

  void stop() override {
    if (scanning_) (void)session_->send(request_mode(Mode::on_request));
    scanning_ = false;
  }

  void take_leave() override { stop(); }

  Status poll() override {
    turned_ = host().now();
    Status taken;
    Status read = session_->receive(turned_, [&](const Received& received) {
      if (taken.ok()) taken = take(received);
    });
    if (!read.ok()) return read;
    return taken.ok() ? line().flush() : taken;
  }

  Status drive(const orca::hw::DriveSetpoint& /*setpoint*/) override {
    return orca::fail(orca::Code::failed_precondition, "a laser does not move");
  }

 private:
  [[nodiscard]] static unsigned rounded(double number) {
    return number > 0.0 && number < 1e6 ? static_cast<unsigned>(std::lround(number)) : 0;
  }
  [[nodiscard]] static std::string shown(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", number);
    return text;
  }

  // The rate that it has at best, as long as nothing is connected.
  [[nodiscard]] unsigned expected_rate() const {
    return *rate_ != 0 ? static_cast<unsigned>(*rate_) : kFastestRate;
  }

  void meet() {
    const Configuration& configuration = session_->configuration();
    format_ = {.measuring_mode = configuration.measuring_mode().value_or(0),
               .has_real_time_index = (configuration.availability().value_or(0) & 2U) != 0};
    status_ = {};
    const std::string at = has_rate() ? " at " + std::to_string(session_->rate()) + " baud" : "";
    host().write_log(orca::log::Level::info, "connected to " + orca::in_quotes(session_->type()) + at);
    if (!session_->rate_trouble().empty())
      host().write_log(orca::log::Level::warning, session_->rate_trouble());
    turned_ = host().now();
  }

  Status take(const Received& received) {
    const Reply& reply = received.reply;
    note_status(reply.status);
    if (reply.code == ReplyCode::power_on)
      return orca::fail(orca::Code::unavailable, "the laser has restarted: was its power interrupted?");
    if (!scanning_) return orca::ok();  // a scan that was on its way
    if (reply.code == ReplyCode::not_accepted ||
        parse_mode_answer(reply).value_or(ModeAnswer::success) != ModeAnswer::success)
      return orca::fail(orca::Code::failed_precondition, "the laser refuses to send scans");
    if (reply.code != ReplyCode::scan) return orca::ok();
    // A scan whose check word is good and whose content is not fits no setting of ours; the next one may.
    if (!parse_scan(reply, format_, scan_).ok() || scan_.ranges.size() != beams(variant_)) return orca::ok();
    heard(received.stamp);
    publish(received.stamp - mirror_time(variant_));
    return orca::ok();
  }

  // @param stamp  when the first beam was measured.
  void publish(TimePoint stamp) {
    auto object = scans_->loan();
    object->ranges().assign(scan_.ranges.begin(), scan_.ranges.end());
    object->min_range(0.0);
    object->max_range(scale_.max_range);
    object->pose(orca::level_pose(place_.place(), place_.height(), stamp));
    object->stamp(orca::to_time_value(stamp));
    object->angle_start(place_.sense() * beam_angle(variant_, 0));
    object->angle_increment(place_.sense() * increment(variant_));
    // Beams of several turns are not measured in their order.
    const bool in_order = variant_.resolution == 100;
    object->time_increment(in_order ? orca::to_seconds(mirror_time(variant_)) / 360.0 : 0.0);
    orca::set_uncertainty(*object, place_.errors());
    scans_->publish(std::move(object));
  }

  // Reports what has changed in the status byte that ends each telegram.
  void note_status(StatusByte status) {
    if (status.byte == status_.byte) return;
    const bool was_good = is_fine(status_);
    status_ = status;
    if (is_fine(status)) {
      if (!was_good) host().write_log(orca::log::Level::info, "the laser's status is good again");
      return;
    }
    std::string text;
    if (status.is_polluted()) text += "its window is dirty, clean it; ";
    if (status.has_implausible_values()) text += "some of its values are implausible; ";
    if (!status.is_good()) text += "it reports a " + std::string(severity(status)) + "; ";
    host().write_log(orca::log::Level::warning, "the laser: " + text.substr(0, text.size() - 2));
  }

  [[nodiscard]] static bool is_fine(StatusByte status) {
    return status.is_good() && !status.is_polluted() && !status.has_implausible_values();
  }
  [[nodiscard]] static const char* severity(StatusByte status) {
    switch (status.severity()) {
      case 1: return "remark";
      case 2: return "warning";
      case 3: return "error";
      default: return "fatal error";
    }
  }

  orca::Param<std::string> name_{*this, "name", "laser", {.text = "Name of this laser, one word."}};
  orca::Param<double> angle_{
      *this, "angle", 180.0 * kDegree, {.unit = "rad", .text = "Angle that it scans: 100 or 180 deg."}};
  orca::Param<double> resolution_{
      *this,
      "resolution",
      0.5 * kDegree,
      {.unit = "rad", .text = "Angle between two beams: 1 or 0.5 deg, or over 100 deg 0.25 deg."}};
  orca::Param<std::string> unit_{*this,
                                 "unit",
                                 "mm",
                                 {.choices = {"mm", "cm"},
                                  .text = "What it counts: mm up to 32 m, or cm up to 80 m. Another one than "
                                          "it has is written into its memory."}};
  orca::Param<std::int64_t> rate_{
      *this,
      "rate",
      0,
      {.min = 0,
       .text = "Rate of the line in baud: 9600, 19200, 38400, 500000, or 0 for the fastest possible."}};
  orca::Param<double> patience_{*this,
                                "patience",
                                0.0,
                                {.unit = "s",
                                 .min = 0.0,
                                 .max = 600.0,
                                 .text = "For how long a laser is waited for that was just switched on; the "
                                         "deployer gives up after 10 s."}};
  orca::hw::LaserPlace place_{*this, "its middle beam"};

  Variant variant_{};
  Scale scale_ = kMillimetres;
  std::optional<orca::hw::SensorHW<orca::idl::LaserRangeReadings>> scans_;
  std::optional<Session> session_;
  ScanFormat format_{};
  Scan scan_;
  StatusByte status_{};
  bool scanning_ = false;
  TimePoint turned_{};
};

}  // namespace

ORCA_HARDWARE(SickLms, "orca.hw.SickLms")
