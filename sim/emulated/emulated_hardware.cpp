// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <string>
#include <vector>

#include "device_kinds.hpp"
#include "device_line.hpp"
#include "objects.hpp"
#include "orca/hardware.hpp"
#include "simulated_robot.hpp"
#include "world_body.hpp"

namespace {

using namespace orca::sim;
using namespace std::chrono_literals;
using orca::Status;
using orca::TimePoint;

constexpr orca::Duration kTurn = 2ms;  // of the lines: at 38400 baud 8 bytes
constexpr orca::Duration kLeaveTime = 500ms;

/// A robot in the simulated world whose devices are at the other ends of lines, where real drivers find them. Here it has nothing but
/// its true pose.
class EmulatedHardware final : public SimulatedRobot {
 public:
  using SimulatedRobot::SimulatedRobot;

 private:
  std::vector<orca::HardwareFault> declare() override {
    body_.emplace(robot(), WorldBody::Motors{
                               .wheels = [this](const orca::Twist2& v) { (void)command({.velocity = v}); },
                               .gripper = [this](const GripperOrder& order) { (void)move_gripper(order); }});
    add_sensor(truth_);
    const auto wishes = read_devices(*lines_text_);
    if (!wishes) return {{"lines", wishes.error().message}};
    lines_.clear();
    kinds_.clear();
    for (const DeviceWish& wish : *wishes) {
      kinds_.push_back(wish.kind);
      auto firmware = make_firmware(wish, *body_);
      if (!firmware) return {{"lines", firmware.error().message}};
      lines_.push_back(std::make_unique<DeviceLine>(wish.place, std::move(*firmware)));
    }
    return {};
  }

  Status open() override {
    if (Status world = SimulatedRobot::open(); !world.ok()) return world;
    for (const auto& line : lines_) {
      Status opened =
          host().executive().is_virtual() ? line->open_in_memory([this] { hear(); }) : line->open();
      if (!opened.ok()) return opened;
    }
    for (std::size_t i = 0; i < lines_.size(); ++i)
      host().write_log(orca::log::Level::info, kinds_[i] + ": " + lines_[i]->where());
    is_open_ = true;
    return orca::ok();
  }

  // Drivers are closed at the same time: what they say last still reaches the devices, which stop their motors.
  void close() override {
    const std::unique_ptr<orca::Event> pause = host().executive().make_event();
    const TimePoint end = host().now() + kLeaveTime;
    while (is_open_ && host().now() < end && turn()) pause->wait_until(host().now() + kTurn);
    for (const auto& line : lines_) line->close();
    is_open_ = false;
  }

  Status poll() override {
    (void)turn();
    return orca::ok();
  }

  // A driver has said something, in virtual time: the devices hear it at once.
  void hear() {
    turned_ = TimePoint{};
    wake();
  }

  // Returns whether any driver has its line open.
  bool turn() {
    const TimePoint now = host().now();
    if (now >= next_tick()) go_on();
    bool has_driver = false;
    for (const auto& line : lines_) has_driver = line->exchange(now) || has_driver;
    turned_ = now;
    return has_driver;
  }

  [[nodiscard]] TimePoint next_poll() const override { return std::min(next_tick(), turned_ + kTurn); }

  Status drive(const orca::hw::DriveSetpoint&) override { return orca::ok(); }

  void sense(const SharedWorld::Inbox& inbox) override {
    body_->sense(inbox);
    if (state() != orca::hw::HardwareState::active) return;
    for (const SharedWorld::Inbox::Truth& pose : inbox.truth) {
      auto object = truth_.loan();
      fill(*object, pose);
      truth_.publish(std::move(object));
    }
  }

  void miss(const SharedWorld::Inbox& inbox) override { body_->sense(inbox); }

  orca::Param<std::string> lines_text_{
      *this,
      "lines",
      "",
      {.text = "Its devices, e.g. \"p2os pioneer\": the kind of each (with "
               "a model: p2os:p3dx) and the name of its "
               "line, which is emulated:NAME to the driver, or listen:PORT, which "
               "is emulated:tcp:PORT to it."}};

  orca::hw::SensorHW<orca::idl::RobotPose> truth_{kTruthPeriod, orca::hw::Source::truth};
  std::optional<WorldBody> body_;
  std::vector<std::unique_ptr<DeviceLine>> lines_;
  std::vector<std::string> kinds_;  // of the devices on them
  bool is_open_ = false;
  TimePoint turned_{};
};

}  // namespace

ORCA_HARDWARE(EmulatedHardware, "orca.hw.Emulated")
