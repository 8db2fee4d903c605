// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Devices on a desk in virtual time, and the system that drives them, in the process of the test: what takes seconds beside a real
/// line takes milliseconds, and is the same each time.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "deployer.hpp"
#include "desk.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/link/memory_link.hpp"
#include "orca/hw/seat.hpp"
#include "orca/idl/motion.hpp"

namespace orca::test {

/// What runs beside a system in its time: devices, step by step, and the script of a test.
///
/// Thread contract: only during run_virtual(), from the script, except step() and now().
class Bench {
 public:
  /// A function that lets a device go on until now. @return whether the device is still there.
  using Device = std::function<bool(TimePoint now)>;

  /// Adds a device that goes on from now on, each millisecond.
  void add(Device device) { devices_.push_back(std::move(device)); }

  /// Lets time pass.
  void sleep(Duration time);
  /// Lets time pass until the condition holds, at most `limit`. @return whether it does.
  bool until(const std::function<bool()>& condition, Duration limit = std::chrono::seconds(20));
  /// The same for a text in the log. @return whether it is there.
  bool until_log(const std::string& text, Duration limit = std::chrono::seconds(20));
  [[nodiscard]] std::string log() const;

  /// Send a command from the component `test_operator`, whose ports `motion` and `velocity` the graph may connect.
  /// @return what SendProxy::send() returns.
  Status send(const idl::MotionCommand& command);
  Status send(const idl::HolonomicVelocity& command);
  /// Returns the place of the graph's hardware, as its server and the process see it. @pre  there is a server.
  [[nodiscard]] hw::HardwareSeat& seat();

  /// Returns the time of the run.
  [[nodiscard]] TimePoint now() const;

 private:
  friend class BenchRun;
  static void stop();
  void step();
  Status in_operator(std::function<Status()> job);
  std::vector<Device> devices_;
};

/// The bench of this process.
[[nodiscard]] Bench& bench();

/// Runs a graph as `deployer --clock virtual` with these words does, beside the devices of the bench.
/// @param script  is called at the start of the run and may wait; the run ends when it returns. Empty: none.
/// @return with what the deployer would have written, in the same words: results in `out`, the log in `err`, without times.
/// @thread  the main thread, outside other calls of it.
Run run_virtual(const Words& words, const std::function<void()>& script = {});

/// A device on a desk in virtual time. Its line is in memory: the driver's device is "memory:NAME".
template <class Firmware, class Body>
class VirtualDevice {
 public:
  /// @param more  what the firmware's constructor takes behind the body.
  template <class... More>
  explicit VirtualDevice(const DeskLine& line, More&&... more)
      : VirtualDevice(std::make_unique<hw::link::MemoryLink>(hw::link::MemoryOptions{
                          .name = line.device, .end = hw::link::MemoryOptions::End::device}),
                      line.faults, std::forward<More>(more)...) {}
  VirtualDevice(const VirtualDevice&) = delete;
  VirtualDevice& operator=(const VirtualDevice&) = delete;

  template <class Look>
  auto with(Look look) {
    return desk_->with(look);
  }
  /// Returns the time of its firmware.
  [[nodiscard]] TimePoint now() const { return desk_->now(); }
  /// Pulls the plug out, and puts it in again.
  void unplug() { desk_->close(); }
  void plug_in() { desk_->open(); }
  /// As those of Desk.
  void fall_silent(bool silent) { desk_->fall_silent(silent); }
  void echo(bool echoes) { desk_->echo(echoes); }
  [[nodiscard]] std::uint64_t faults(hw::link::Fault fault) const { return desk_->faults(fault); }

 private:
  template <class... More>
  VirtualDevice(std::unique_ptr<hw::link::MemoryLink> link, std::optional<hw::link::FaultPlan> plan,
                More&&... more)
      : link_(link.get()) {
    if (plan) plan->now = [] { return bench().now(); };
    desk_ =
        std::make_shared<Desk<Firmware, Body>>(std::move(link), std::move(plan), std::forward<More>(more)...);
    desk_->open();
    bench().add([desk = std::weak_ptr(desk_), line = link_](TimePoint now) {
      const auto here = desk.lock();
      if (here) here->go_on(now, line->line() ? line->line()->baud : 0);
      return here != nullptr;
    });
  }

  hw::link::MemoryLink* link_;  // inside desk_
  std::shared_ptr<Desk<Firmware, Body>> desk_;
};

}  // namespace orca::test
