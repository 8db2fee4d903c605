// SPDX-License-Identifier: LGPL-3.0-or-later
// [driver]
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "orca/geometry/objects/plane.hpp"
#include "orca/hardware.hpp"
#include "orca/hw/framing/byte_reader.hpp"
#include "orca/hw/framing/checksums.hpp"
#include "orca/hw/laser_place.hpp"
#include "orca/hw/line_driver.hpp"
#include "orca/hw/line_frames.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

namespace {

using namespace std::chrono_literals;
using orca::Duration;
using orca::Result;
using orca::Status;
using orca::TimePoint;
using orca::hw::framing::ByteReader;
using orca::hw::framing::Finding;
using Bytes = std::span<const std::uint8_t>;

// A frame of the Owl: A5h, its kind, the length of its content in two bytes, the content, a CRC of all that in two bytes.
constexpr std::uint8_t kStart = 0xA5;
constexpr std::size_t kHead = 4, kCheck = 2, kLongestContent = 256;  // [bytes]
constexpr std::uint8_t kName = 'v', kScan = 's';                     // kinds

Finding look(Bytes bytes) {
  if (bytes[0] != kStart) return {Finding::Kind::nothing, 0};
  if (bytes.size() < kHead) return {Finding::Kind::need_more, 0};
  ByteReader head(bytes.subspan(2));
  const std::size_t content = head.u16();
  if (content > kLongestContent) return {Finding::Kind::nothing, 0};
  const std::size_t whole = kHead + content + kCheck;
  if (bytes.size() < whole) return {Finding::Kind::need_more, 0};
  ByteReader check(bytes.subspan(kHead + content));
  if (check.u16() != orca::hw::framing::crc_ccitt(bytes.first(kHead + content)))
    return {Finding::Kind::bad_checksum, 0};
  return {Finding::Kind::frame, whole};
}

/// An Owl, a made-up laser with 61 beams over half a circle, ten times a second.
class Owl final : public orca::hw::LineDriver {
 public:
  explicit Owl(orca::hw::HardwareHost& host) : LineDriver(host, "/dev/ttyUSB0", {.baud = 115200}) {}

  // Before anything starts: what is wrong with the parameters, and what it offers.
  std::vector<orca::HardwareFault> prepare() override {
    std::vector<orca::HardwareFault> faults = prepare_line();
    for (const orca::HardwareFault& fault : place_.read()) faults.push_back(fault);
    if (faults.empty()) add_sensor(scans_);
    return faults;
  }

  [[nodiscard]] orca::idl::Robot description() const override {
    orca::idl::LaserSensor laser;
    laser.name("owl");
    laser.port(device());
    laser.type("LaserRangeReadings");
    laser.update_interval(0.1);
    laser.mount(orca::level_frame(place_.place(), place_.height()));
    laser.number(kBeams);
    laser.angle_start(first_angle());
    laser.angle_increment(step());
    laser.min_range(kMinRange);
    laser.max_range(kMaxRange);
    orca::idl::Robot robot;
    robot.name("owl");
    robot.laser_sensors().push_back(laser);
    return robot;
  }

 protected:
  // The line is open: ask who is there, again until it answers.
  Status begin(TimePoint now) override {
    named_ = false;
    return ask_name(now);
  }
  Result<bool> advance(TimePoint now) override {
    if (Status read = receive(now); !read.ok()) return read.error();
    if (named_) return true;
    if (now - begun_ > 2s)
      return orca::fail(orca::Code::deadline_exceeded, "nobody answers as an Owl does; is it switched on?");
    if (now - asked_ > 300ms)
      if (Status asked = ask(now, 'V'); !asked.ok()) return asked.error();
    return false;
  }
  [[nodiscard]] TimePoint next_step() const override { return asked_ + 300ms; }

  // Somebody wants scans, or nobody any more.
  Status start() override { return ask(host().now(), 'S'); }
  void stop() override { (void)ask(host().now(), 'Q'); }
  void take_leave() override { stop(); }

  // Called when something has come, and at next_turn().
  Status poll() override { return receive(host().now()); }
  [[nodiscard]] TimePoint next_turn() const override { return looked_ + 100ms; }
  // While it scans. An Owl that nobody uses says nothing.
  [[nodiscard]] Duration longest_silence() const override {
    return scans_wanted() ? Duration(1s) : Duration::max();
  }

  [[nodiscard]] orca::hw::LineCounts counts() const override {
    return orca::hw::counts_of(frames_.statistics());
  }
  Status drive(const orca::hw::DriveSetpoint& /*setpoint*/) override {
    return orca::fail(orca::Code::failed_precondition, "a laser does not move");
  }

 private:
  static constexpr std::uint32_t kBeams = 61;
  static constexpr double kMinRange = 0.05, kMaxRange = 8.0;  // [m]
  [[nodiscard]] double first_angle() const { return -place_.sense() * 0.5 * std::numbers::pi; }
  [[nodiscard]] double step() const { return place_.sense() * std::numbers::pi / (kBeams - 1); }
  [[nodiscard]] bool scans_wanted() const { return state() == orca::hw::HardwareState::active; }

  Status ask_name(TimePoint now) {
    begun_ = now;
    return ask(now, 'V');
  }
  Status ask(TimePoint now, char what) {
    asked_ = now;
    const auto byte = static_cast<std::uint8_t>(what);
    return line().write({&byte, 1});
  }

  Status receive(TimePoint now) {
    looked_ = now;
    return frames_.read(line(), now, [this](const orca::hw::framing::Frame& frame, TimePoint sent) {
      heard(sent);
      const Bytes content = frame.bytes.subspan(kHead, frame.bytes.size() - kHead - kCheck);
      if (frame.bytes[1] == kName) named_ = true;
      if (frame.bytes[1] == kScan && content.size() == 2 * kBeams) publish(content, sent);
    });
  }

  void publish(Bytes content, TimePoint sent) {
    auto scan = scans_.loan();
    scan->ranges().clear();
    for (ByteReader reader(content); reader.remaining() > 0;) {
      const std::uint16_t millimetres = reader.u16();  // 0: nothing is there
      scan->ranges().push_back(millimetres == 0 ? std::numeric_limits<double>::infinity()
                                                : 0.001 * millimetres);
    }
    scan->min_range(kMinRange);
    scan->max_range(kMaxRange);
    scan->pose(orca::level_pose(place_.place(), place_.height(), sent));
    scan->stamp(orca::to_time_value(sent));
    scan->angle_start(first_angle());
    scan->angle_increment(step());
    scans_.publish(std::move(scan));
  }

  orca::hw::LaserPlace place_{*this, "its middle beam"};
  orca::hw::SensorHW<orca::idl::LaserRangeReadings> scans_{100ms};
  orca::hw::LineFrames frames_{{look, kHead + kLongestContent + kCheck}};
  bool named_ = false;
  TimePoint begun_{}, asked_{}, looked_{};
};

}  // namespace

ORCA_HARDWARE(Owl, "my.Owl")
// [/driver]
