// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/emulators/body.hpp"
#include "orca/emulators/firmware.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/hw/link/faulty_link.hpp"

namespace orca::test {

/// A robot in an empty plain, whose wheels do at once what they are told.
class PlainBody final : public emulators::Body {
 public:
  void go_on(Duration time, TimePoint /*now*/) { pose_ = along_arc(pose_, velocity_ * to_seconds(time)); }
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
  DeskLine(const char* name) : device(name) {}
  DeskLine(std::string path) : device(std::move(path)) {}
  DeskLine(std::string path, hw::link::FaultPlan plan) : device(std::move(path)), faults(std::move(plan)) {}
  std::string device;  ///< Its path, or in virtual time its name in memory.
  /// What goes wrong on it, as the device sees it: `in` is what the host sends, `out` what the device sends.
  /// A line that has some does not work again when the host has closed it.
  std::optional<hw::link::FaultPlan> faults{};
};

/// A scanning laser's mirror in a place that stays as it is until the test changes it.
class MirrorOnDesk final : public emulators::Mirror {
 public:
  void go_on(Duration /*time*/, TimePoint now) {
    stamp_ = now;
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

/// A device on a desk: its line, and its firmware in its surroundings.
/// @tparam Body  has go_on(Duration, TimePoint) beside what the firmware wants of it.
///
/// Thread contract: one strand.
template <class Firmware, class Body>
class Desk {
 public:
  /// @param link  its side of the line, closed.
  /// @param plan  what goes wrong on it; nothing: nothing does.
  /// @param more  what the firmware's constructor takes behind the body.
  template <class... More>
  Desk(std::unique_ptr<hw::link::ByteLink> link, std::optional<hw::link::FaultPlan> plan, More&&... more)
      : link_(std::move(link)), firmware_(body_, std::forward<More>(more)...) {
    if (!plan) return;
    auto faulty = std::make_unique<hw::link::FaultyLink>(std::move(link_), *plan);
    faulty_ = faulty.get();
    link_ = std::move(faulty);
  }

  void open() { REQUIRE(link_->open()); }
  void close() { link_->close(); }
  [[nodiscard]] bool has_faults() const { return faulty_ != nullptr; }
  /// Nothing that it sends or is sent arrives any more.
  void fall_silent(bool silent) { silent_ = silent; }
  /// What the host sends comes back to it as well.
  void echo(bool echoes) { echoes_ = echoes; }
  /// Looks at firmware and body, or changes them.
  template <class Look>
  auto with(Look look) {
    return look(firmware_, body_);
  }
  /// Returns how often a fault has happened on the line.
  [[nodiscard]] std::uint64_t faults(hw::link::Fault fault) const {
    return faulty_ == nullptr ? 0 : faulty_->count(fault);
  }

  /// Returns the time of its firmware, which goes on when the clock of go_on() begins anew.
  [[nodiscard]] TimePoint now() const { return now_; }

  /// Lets time pass until `clock`. @param baud  rate that the host has set; 0: the line has none.
  void go_on(TimePoint clock, std::uint32_t baud) {
    if (clock < clock_) ahead_ = now_ - clock;
    clock_ = clock;
    const TimePoint now = clock + ahead_;
    body_.go_on(now_ == TimePoint{} ? Duration{0} : now - now_, now);
    now_ = now;
    std::array<std::uint8_t, 256> bytes{};
    const auto count = link_->read(bytes);
    firmware_.note_host(static_cast<bool>(count), now);
    if (count && *count > 0 && !silent_) {
      if (echoes_) (void)link_->write({bytes.data(), *count});
      firmware_.take({bytes.data(), *count}, baud, now);
    }
    const std::vector<std::uint8_t> sent = firmware_.advance(now);
    if (!sent.empty() && !silent_) (void)link_->write(sent);
    (void)link_->flush();
  }

 private:
  hw::link::FaultyLink* faulty_ = nullptr;  // link_, if there are faults
  std::unique_ptr<hw::link::ByteLink> link_;
  Body body_;
  Firmware firmware_;
  TimePoint clock_{};  // at the last step
  TimePoint now_{};    // likewise, of the firmware
  Duration ahead_{0};  // the firmware is of the clock
  std::atomic<bool> silent_{false};
  std::atomic<bool> echoes_{false};
};

}  // namespace orca::test
