// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "deployer.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/emulators/body.hpp"
#include "orca/emulators/firmware.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/hw/link/faulty_link.hpp"
#include "orca/hw/link/pty_link.hpp"

namespace orca::test {

/// A robot in an empty plain, whose wheels do at once what they are told.
class PlainBody final : public emulators::Body {
 public:
  void go_on(Duration time) { pose_ = along_arc(pose_, velocity_ * to_seconds(time)); }
  void drive(const Twist2& velocity) override { velocity_ = velocity; }
  [[nodiscard]] Pose2 odometry() const override { return pose_; }
  [[nodiscard]] Twist2 velocity() const override { return velocity_; }
  [[nodiscard]] std::optional<double> sonar(int) const override { return range_; }
  [[nodiscard]] std::uint16_t bumpers() const override { return bumpers_; }
  [[nodiscard]] std::uint8_t cliffs() const override { return cliffs_; }
  [[nodiscard]] bool is_lifted() const override { return lifted_; }

  /// Puts something around it, at a distance [m] from each sonar; nothing: takes it away.
  void surround(std::optional<double> range) { range_ = range; }
  /// Presses these bumpers, a bit each, and no others.
  void touch(std::uint16_t bumpers) { bumpers_ = bumpers; }
  /// Takes the floor away at these places, a bit each, and at no others.
  void drop(std::uint8_t cliffs) { cliffs_ = cliffs; }
  /// Lifts it up, or puts it down.
  void lift(bool lifted) { lifted_ = lifted; }

 private:
  Pose2 pose_;
  Twist2 velocity_;
  std::optional<double> range_;
  std::uint16_t bumpers_ = 0;
  std::uint8_t cliffs_ = 0;
  bool lifted_ = false;
};

/// The line of a device on a desk.
struct DeskLine {
  DeskLine(std::string path) : device(std::move(path)) {}
  DeskLine(std::string path, hw::link::FaultPlan plan) : device(std::move(path)), faults(std::move(plan)) {}
  std::string device;  ///< Its path.
  /// What goes wrong on it, as the device sees it: `in` is what the host sends, `out` what the device sends.
  /// A line that has some does not work again when the host has closed it.
  std::optional<hw::link::FaultPlan> faults{};
};

/// A scanning laser's mirror in a place that stays as it is until the test changes it.
class MirrorOnDesk final : public emulators::Mirror {
 public:
  void go_on(Duration /*time*/) {
    stamp_ = steady_now();
    ++turns_;
  }
  [[nodiscard]] std::optional<emulators::MirrorTurn> last_turn() const override {
    if (turns_ == 0) return std::nullopt;
    return emulators::MirrorTurn{stamp_, first_angle_, step_, ranges_};
  }
  /// @param first_angle, step  [rad], @param ranges  [m], infinite: no return.
  void show(double first_angle, double step, std::vector<double> ranges) {
    first_angle_ = first_angle;
    step_ = step;
    ranges_ = std::move(ranges);
  }

 private:
  double first_angle_ = 0.0;
  double step_ = 1.0;
  std::vector<double> ranges_;
  TimePoint stamp_{};
  int turns_ = 0;
};

/// A device on a desk: its line, a pseudo terminal, is there, and its firmware runs, as long as this lives.
/// @tparam Body  has go_on(Duration) beside what the firmware wants of it.
///
/// Thread contract: one thread.
template <class Firmware, class Body>
class DeviceOnDesk {
 public:
  /// @param more  what the firmware's constructor takes behind the body.
  template <class... More>
  explicit DeviceOnDesk(const DeskLine& line, More&&... more)
      : DeviceOnDesk(std::make_unique<hw::link::PtyLink>(line.device), line.faults,
                     std::forward<More>(more)...) {}

  ~DeviceOnDesk() {
    ends_ = true;
    thread_.join();
  }
  DeviceOnDesk(const DeviceOnDesk&) = delete;
  DeviceOnDesk& operator=(const DeviceOnDesk&) = delete;

  /// Looks at firmware and body, or changes them, between two of their steps.
  template <class Look>
  auto with(Look look) {
    const std::lock_guard lock(mutex_);
    return look(firmware_, body_);
  }
  /// Pulls the plug out, and puts it in again.
  void unplug() {
    const std::lock_guard lock(mutex_);
    link_->close();
  }
  void plug_in() {
    const std::lock_guard lock(mutex_);
    open();
  }
  /// Nothing that it sends or is sent arrives any more.
  void fall_silent(bool silent) { silent_ = silent; }
  /// What the host sends comes back to it as well.
  void echo(bool echoes) { echoes_ = echoes; }
  /// Returns how often a fault has happened on the line.
  [[nodiscard]] std::uint64_t faults(hw::link::Fault fault) const {
    return faulty_ == nullptr ? 0 : faulty_->count(fault);
  }

 private:
  // A line without faults has no FaultyLink around it, which would not outlive the driver's first leave.
  template <class... More>
  DeviceOnDesk(std::unique_ptr<hw::link::PtyLink> pty, std::optional<hw::link::FaultPlan> plan,
               More&&... more)
      : pty_(*pty), link_(std::move(pty)), firmware_(body_, std::forward<More>(more)...) {
    if (plan) {
      plan->now = steady_now;
      auto faulty = std::make_unique<hw::link::FaultyLink>(std::move(link_), *plan);
      faulty_ = faulty.get();
      link_ = std::move(faulty);
    }
    open();
    thread_ = std::thread([this] { run(); });
  }

  void open() {
    REQUIRE(link_->open());
    if (faulty_ == nullptr) REQUIRE(pty_.await_driver().ok());
  }

  void run() {
    for (TimePoint last = steady_now(); !ends_; std::this_thread::sleep_for(1ms)) {
      const std::lock_guard lock(mutex_);
      const TimePoint now = steady_now();
      body_.go_on(now - last);
      last = now;
      exchange(now);
    }
  }
  void exchange(TimePoint now) {
    std::array<std::uint8_t, 256> bytes{};
    const auto count = link_->read(bytes);
    firmware_.note_host(static_cast<bool>(count), now);
    if (count && *count > 0 && !silent_) {
      if (echoes_) (void)link_->write({bytes.data(), *count});
      firmware_.take({bytes.data(), *count}, pty_.line() ? pty_.line()->baud : 0, now);
    }
    const std::vector<std::uint8_t> sent = firmware_.advance(now);
    if (!sent.empty() && !silent_) (void)link_->write(sent);
    (void)link_->flush();
  }

  hw::link::PtyLink& pty_;                  // inside link_
  hw::link::FaultyLink* faulty_ = nullptr;  // likewise, if there are faults
  std::unique_ptr<hw::link::ByteLink> link_;
  Body body_;
  Firmware firmware_;
  std::mutex mutex_;
  std::atomic<bool> silent_{false};
  std::atomic<bool> echoes_{false};
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

/// Returns whether the condition comes true within 20 s.
inline bool eventually(const std::function<bool()>& condition) {
  const TimePoint end = steady_now() + 20s * static_cast<int>(kSlowdown);
  while (!condition()) {
    if (steady_now() > end) return false;
    std::this_thread::sleep_for(5ms);
  }
  return true;
}

}  // namespace orca::test
