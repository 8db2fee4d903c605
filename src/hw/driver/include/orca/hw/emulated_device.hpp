// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "orca/component/param.hpp"
#include "orca/hw/container.hpp"
#include "orca/hw/link/memory_link.hpp"

namespace orca::hw {

/// An emulation of a device, for a driver of the same graph in virtual time. The parameter `lines` has what it is and the name of its
/// line, "owl bench"; the driver's `device` is then emulated:bench.
///
/// Thread contract: as HardwareContainer. What is protected runs on the container's strand.
class EmulatedDevice : public HardwareContainer {
 public:
  std::vector<HardwareFault> prepare() final;
  [[nodiscard]] idl::Robot description() const final { return {}; }

 protected:
  using Bytes = std::vector<std::uint8_t>;

  /// @param period  from one speak() to the next, above 0 [s].
  EmulatedDevice(HardwareHost& host, Duration period) : HardwareContainer(host), period_(period) {}

  /// Returns the answer to what the driver has written, which arrives at once; empty: none.
  /// @param bytes  in pieces of any size.
  virtual Bytes hear(std::span<const std::uint8_t> /*bytes*/) { return {}; }
  /// Returns the bytes that the device sends by itself, once per period while a driver has the line open; empty: none.
  virtual Bytes speak() { return {}; }

 private:
  Status open() final;
  void close() final { line_->close(); }
  Status poll() final;
  [[nodiscard]] TimePoint next_poll() const final { return due_; }
  [[nodiscard]] bool hears_input() const final { return true; }
  Status drive(const DriveSetpoint& /*setpoint*/) final { return ok(); }
  void send(const Bytes& bytes);

  Param<std::string> lines_{
      *this,
      "lines",
      "",
      {.text = "What it is, and the name of its line: \"owl bench\" is emulated:bench to a driver."}};
  const Duration period_;
  std::unique_ptr<link::MemoryLink> line_;
  TimePoint due_{};
};

}  // namespace orca::hw
