// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/hardware.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/idl/time_shift.hpp"
#include "orca/recording/objects/recorded_run.hpp"

namespace {

using namespace orca;
using namespace orca::hw;
using recording::RecordedObject;
using recording::RecordedRun;

constexpr Duration kMaxCommandAge = 200ms;
constexpr Duration kUsualPeriod = 100ms;  // of what was recorded once only

/// A sensor whose readings are those of a port in a recording.
class RecordedSensor final : public SensorEndpoint {
 public:
  using SensorEndpoint::SensorEndpoint;
  void publish(ObjectLoan reading) { publish_loan(std::move(reading)); }
};

/// The sensors of a robot as they were recorded: each reading comes again when it came then, counted from the beginning of the
/// recording, which is when somebody uses the robot first, with its stamps moved by as much. Commands to the base are taken and change nothing. Poses of the robot (RobotPose)
/// are served by TruthLocalizer; the description of the robot is the first one in the recording, with lasers as their scans say. What is wrong in a log,
/// such as damaged lines and stamps that run backwards, is a warning when the graph is checked, and does not end the replay.
///
/// Components of today see what those of then saw, so in virtual time they do the same each time.
class LogReplay final : public HardwareContainer {
 public:
  explicit LogReplay(HardwareHost& host) : HardwareContainer(host) {}

  std::vector<HardwareFault> prepare() override {
    if (ports_->empty()) return {};
    if (recording_->empty())
      return {{.param = "recording", .text = "it names no file; record one with deployer --record run.mcap"}};
    Result<std::unique_ptr<RecordedRun>> opened = RecordedRun::open(*recording_);
    if (!opened) return {{.param = "recording", .text = opened.error().message}};
    run_ = *std::move(opened);
    std::vector<HardwareFault> faults;
    for (const std::string& port : *ports_) declare(port, faults);
    if (!faults.empty()) return faults;
    if (const Status read = load(); !read.ok())
      faults.push_back({.param = "recording", .text = read.error().message});
    for (const auto& [port, sensor] : sensors_)
      if (std::ranges::find(readings_, sensor.get(), &Reading::sensor) == readings_.end())
        faults.push_back({.param = "ports",
                          .text = "there is nothing of " + in_quotes(port) + " in the recording",
                          .only_warns = true});
    for (const std::string& flaw : run_->flaws())
      faults.push_back(
          {.param = "recording", .text = in_quotes(*recording_) + ": " + flaw, .only_warns = true});
    run_.reset();  // everything that is needed of it is here
    describe_lasers();
    motion_ = std::make_unique<MotionHW>(limits(), kMaxCommandAge);
    set_motion(*motion_);
    return faults;
  }

  [[nodiscard]] idl::Robot description() const override { return robot_; }

 protected:
  // The recording begins when somebody uses the robot for the first time, so that nothing of it is missed.
  Status start() override {
    if (std::exchange(has_begun_, true)) return ok();
    shift_ = host().now() - begin_;
    char times[96];
    std::snprintf(times, sizeof times, "the recording begins at %.6f s of its clock, %.6f s of this one",
                  to_seconds(begin_), to_seconds(host().now()));
    host().write_log(log::Level::info, times);
    return ok();
  }

  Status poll() override {
    if (!has_begun_) return ok();
    while (next_ < readings_.size() && readings_[next_].passed + shift_ <= host().now())
      publish(readings_[next_++]);
    if (next_ == readings_.size() && !std::exchange(is_over_, true))
      host().write_log(log::Level::info, "the recording is over");
    return ok();
  }

  [[nodiscard]] TimePoint next_poll() const override {
    return has_begun_ && next_ < readings_.size() ? readings_[next_].passed + shift_ : kForever;
  }

  Status drive(const DriveSetpoint& /*setpoint*/) override { return ok(); }

 private:
  struct Reading {
    RecordedSensor* sensor;
    ObjectRef object;
    TimePoint passed;
  };

  void declare(const std::string& port, std::vector<HardwareFault>& faults) {
    const Result<std::string> row = recording::find_row(run_->rows(), run_->others(), port);
    if (!row) {
      std::vector<std::string> words{row.error().message};
      std::ranges::copy(run_->flaws(), std::back_inserter(words));  // lines that are damaged may be why
      return faults.push_back({.param = "ports", .text = joined(words, "; ")});
    }
    if (sensors_.contains(*row))
      return faults.push_back({.param = "ports", .text = in_quotes(*row) + " is named twice"});
    const auto& [type_name, count] = *run_->rows().at(*row).types.begin();
    const ObjectType& type = *find_object_type(type_name);
    const Source source = &type == &object_type<idl::RobotPose>() ? Source::truth : Source::sensor;
    const bool is_first =
        std::ranges::none_of(sensors_, [&](const auto& entry) { return &entry.second->type() == &type; });
    sensors_[*row] =
        std::make_unique<RecordedSensor>(type, period_of(count), source, is_first ? "" : device_of(*row));
    add_sensor(*sensors_[*row]);
  }

  // Returns the component of a port, or a topic as a name: "front_scan" of "/front/scan".
  static std::string device_of(const std::string& row) {
    if (!row.starts_with('/')) return row.substr(0, row.find('.'));
    std::string name = row.substr(1);
    std::ranges::replace(name, '/', '_');
    return name;
  }

  // Returns the mean time between two of them, in whole milliseconds.
  [[nodiscard]] Duration period_of(std::uint64_t count) const {
    if (count < 2 || run_->length() <= Duration{0}) return kUsualPeriod;
    const Duration mean = run_->length() / static_cast<Duration::rep>(count - 1);
    return std::max<Duration>(1ms, std::chrono::round<std::chrono::milliseconds>(mean));
  }

  Status load() {
    begin_ = run_->begin();
    bool has_robot = false;
    std::set<std::string> rows;
    for (const auto& [name, row] : run_->rows())
      if (sensors_.contains(name) || row.types.contains(std::string(object_type<idl::Robot>().name)))
        rows.insert(name);
    return run_->take_objects(rows, [&](const RecordedObject& one) {
      if (const auto sensor = sensors_.find(std::string(one.row)); sensor != sensors_.end())
        readings_.push_back({sensor->second.get(), one.object, one.passed});
      if (const auto robot = object_cast<idl::Robot>(one.object); robot && !std::exchange(has_robot, true))
        robot_ = *robot;
    });
  }

  // A laser that the description leaves out, because it was another device's, is what its scans say of it.
  void describe_lasers() {
    if (!robot_.laser_sensors().empty()) return;
    for (const auto& [port, sensor] : sensors_) {
      const auto first = std::ranges::find(readings_, sensor.get(), &Reading::sensor);
      if (first == readings_.end()) continue;
      if (const auto scan = object_cast<idl::LaserRangeReadings>(first->object))
        robot_.laser_sensors().push_back(laser_of(*scan, *sensor, port));
    }
  }

  static idl::LaserSensor laser_of(const idl::LaserRangeReadings& scan, const SensorEndpoint& sensor,
                                   const std::string& port) {
    idl::LaserSensor laser;
    laser.name(sensor.device().empty() ? "laser" : sensor.device());
    laser.port(port);
    laser.type(std::string(sensor.type().name));
    laser.update_interval(to_seconds(sensor.period()));
    laser.mount().position(scan.pose().position());
    laser.mount().rotation(scan.pose().rotation());
    laser.number(static_cast<std::uint32_t>(scan.ranges().size()));
    laser.angle_start(scan.angle_start());
    laser.angle_increment(scan.angle_increment());
    laser.min_range(scan.min_range());
    laser.max_range(scan.max_range());
    return laser;
  }

  [[nodiscard]] DriveLimits limits() const {
    DriveLimits limits{.max_speed = *max_speed_, .max_turn_rate = *max_turn_rate_};
    if (robot_.drives().empty()) return limits;
    const idl::Drive& drive = robot_.drives().front();
    return {drive.max_speed(),      drive.max_steer_speed(), drive.steer_gain(),
            drive.big_turn_angle(), drive.big_turn_speed(),  drive.type()};
  }

  void publish(const Reading& reading) {
    if (state() != HardwareState::active) return;  // nobody wants it, and nobody did then
    ObjectLoan object = copy_value(reading.object);
    shift_times(object, shift_);
    reading.sensor->publish(std::move(object));
  }

  Param<std::string> recording_{
      *this,
      "recording",
      "",
      {.fixed = true,
       .text = "The recording: an MCAP file of deployer --record or orcactl "
               "record, a bag of ROS 2 (MCAP or SQLite, its file or its folder), or "
               "a CARMEN log, packed by gzip or not"}};
  Param<std::vector<std::string>> ports_{
      *this,
      "ports",
      {},
      {.fixed = true,
       .text = "Ports of the recording whose objects come again: "
               "base.OdometryPush; laser.LaserRangeReadingsPush; of a bag "
               "its topics: /odom; /scan. In a bag such a port means the only "
               "topic of its type"}};
  Param<double> max_speed_{*this,
                           "max_speed",
                           1.0,
                           {.unit = "m/s",
                            .min = 0.0,
                            .fixed = true,
                            .text = "Limit of the base, if the recording has no description of the robot"}};
  Param<double> max_turn_rate_{
      *this, "max_turn_rate", 1.0, {.unit = "rad/s", .min = 0.0, .fixed = true, .text = "Likewise"}};
  std::unique_ptr<RecordedRun> run_;                                // until everything is read
  std::map<std::string, std::unique_ptr<RecordedSensor>> sensors_;  // by port
  std::unique_ptr<MotionHW> motion_;
  std::vector<Reading> readings_;  // in the order in which they passed
  idl::Robot robot_;
  TimePoint begin_{};  // of the recording
  Duration shift_{0};  // from its times to those of this run
  std::size_t next_ = 0;
  bool has_begun_ = false;
  bool is_over_ = false;
};

}  // namespace

ORCA_HARDWARE(LogReplay, "orca.hw.Log")
