// SPDX-License-Identifier: GPL-3.0-or-later
// What a loop that commands a base feels of a device that stalls, compared with the same loop beside one that works.
#include <fcntl.h>
#include <termios.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <memory>
#include <thread>

#include "benchmarks.hpp"
#include "comparison.hpp"
#include "on_executive.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/base/strand.hpp"
#include "orca/hardware.hpp"
#include "orca/hw/link/pty_link.hpp"
#include "orca/hw/link/serial_link.hpp"

namespace orca::bench {
namespace {

using namespace std::chrono_literals;

constexpr Duration kLap = 10ms;
constexpr Duration kSayAgain = 50ms;

class BenchHost final : public hw::HardwareHost {
 public:
  explicit BenchHost(Executive& executive) : executive_(executive) {}
  void declare_param(ParamDeclaration) override {}
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] TimePoint now() const override { return executive_.now(); }
  [[nodiscard]] RandomStream random(std::string_view stream) const override { return {1, name_, stream}; }
  void write_log(log::Level, std::string_view) const override {}
  void report(const idl::Contact&) override {}
  [[nodiscard]] std::uint64_t run_seed() const override { return 1; }
  void state_changed(hw::HardwareState) override {}
  void held(const std::optional<std::string>&) override {}
  void pausing() override {}
  [[nodiscard]] Executive& executive() override { return executive_; }

 private:
  Executive& executive_;
  const std::string name_ = "base";
};

// A base on a serial line: it reads what comes, and says what the wheels shall do, again and again.
class SerialBase final : public hw::HardwareContainer {
 public:
  SerialBase(hw::HardwareHost& host, const std::string& device)
      : HardwareContainer(host), link_({.device = device, .line = {.baud = 9600}}) {
    set_motion(wheels_);
  }
  std::vector<HardwareFault> prepare() override { return {}; }
  [[nodiscard]] idl::Robot description() const override { return {}; }

 protected:
  Status open() override {
    const Result<hw::link::Opening> opened = link_.open();
    return opened ? ok() : Status(opened.error());
  }
  void close() override { link_.close(); }
  [[nodiscard]] bool recovers() const override { return true; }
  [[nodiscard]] int descriptor() const override { return link_.descriptor(); }
  Status poll() override {
    std::array<std::uint8_t, 256> bytes{};
    Result<std::size_t> count = link_.read(bytes);
    for (; count && *count > 0; count = link_.read(bytes)) heard();
    if (!count) return count.error();
    return host().now() < said_ + kSayAgain ? ok() : say();
  }
  [[nodiscard]] TimePoint next_poll() const override { return said_ + kSayAgain; }
  Status drive(const hw::DriveSetpoint&) override { return say(); }

 private:
  Status say() {
    said_ = host().now();
    const std::array<std::uint8_t, 9> command{0xFA, 0xFB, 6, 11, 0x3B, 100, 0, 111, 0x3B};
    return link_.write(command);
  }

  hw::link::SerialLink link_;
  hw::MotionHW wheels_{{.max_speed = 1.0, .max_turn_rate = 2.0}, 200ms};
  TimePoint said_{};
};

// The device: it sends ten packets a second and reads what it is told; or it stalls: it sends without a pause, and its line takes
// nothing.
class Device {
 public:
  explicit Device(bool stalls) : stalls_(stalls) {
    if (!line_.open()) std::abort();
    terminal_ = Descriptor(::open(line_.device().c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (stalls && tcflow(terminal_.number(), TCOOFF) != 0) std::abort();
    thread_ = std::thread([this] { run(); });
  }
  ~Device() {
    ends_ = true;
    thread_.join();
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  [[nodiscard]] const std::string& path() const { return line_.device(); }

 private:
  void run() {
    std::array<std::uint8_t, 50> bytes{};
    while (!ends_) {
      (void)line_.write(bytes);
      (void)line_.read(bytes);
      std::this_thread::sleep_for(stalls_ ? 10ms : 100ms);
    }
  }

  const bool stalls_;
  hw::link::PtyLink line_;
  Descriptor terminal_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

// A component that tells a base every 10 ms what to do.
class Loop {
 public:
  Loop(Executive& executive, bool stalls)
      : device_(stalls), host_(executive), base_(host_, device_.path()), pause_(executive.make_event()) {
    base_.run();
    base_.acquire();
  }
  ~Loop() {
    base_.shut_down();
    (void)base_.join_until(host_.now() + 10s);
  }

  /// Waits for a lap's time and commands the base. Returns what both have taken.
  Nanoseconds lap() {
    const TimePoint begin = host_.now();
    pause_->wait_until(begin + kLap);
    idl::MotionCommand command;
    command.speed(0.1);
    (void)base_.command(command);
    return static_cast<Nanoseconds>((host_.now() - begin).count());
  }

 private:
  Device device_;
  BenchHost host_;
  SerialBase base_;
  std::unique_ptr<Event> pause_;
};

}  // namespace

void register_stalling_device() {
  add_row({"100 Hz loop beside a device that stalls", "beside one that works", p99_ratio_at_most(1.05)}, 2000,
          [](auto& state, Row& row) {
            run_on(kThreads, [&](Executive& executive) {
              Loop beside_stalling(executive, true);
              Loop beside_working(executive, false);
              alternate(
                  state, row, 1, [&](int) { return beside_stalling.lap(); },
                  [&](int) { return beside_working.lap(); });
            });
          });
}

}  // namespace orca::bench
