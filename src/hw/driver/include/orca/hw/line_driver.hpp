// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "orca/component/param.hpp"
#include "orca/hw/container.hpp"
#include "orca/hw/line_session.hpp"
#include "orca/hw/link/byte_link.hpp"

namespace orca::hw {

/// A driver of a device at the end of one line (thesis 10.2). It opens the line that the parameter `device` names, keeps a log of
/// its bytes if `byte_log` names a file, and opens it again when the device has failed and may have come back. A driver adds
/// a session, which knows what is said over the line.
///
/// Thread contract: as HardwareContainer. What is protected runs on the container's strand.
class LineDriver : public HardwareContainer {
 protected:
  /// @param usual  the line where such a device is often found: the default of `device`.
  /// @param first  how bytes go over a serial line at first; begin() may set another rate.
  LineDriver(HardwareHost& host, const std::string& usual, const link::Line& first = {});

  /// Makes the line, closed. To be called first in prepare().
  /// @return what is wrong with the parameters.
  [[nodiscard]] std::vector<HardwareFault> prepare_line();
  /// Returns the line. From the first begin() on it is always the same object.
  /// @pre  prepare_line() has found no fault.
  [[nodiscard]] link::ByteLink& line() const { return *line_; }
  /// Returns the line as the graph names it.
  [[nodiscard]] const std::string& device() const { return *device_; }
  /// Returns whether the line has a rate, as a serial one has.
  [[nodiscard]] bool has_rate() const { return line_->byte_time() > 0.0; }

  /// Returns the session, which is made the first time. Called each time when the line has been opened.
  virtual LineSession& session() = 0;
  /// Takes note of the device, which the session has found.
  /// @errors  of the device, if it is of no use.
  virtual Status meet() { return ok(); }
  /// Writes to the log that the device is connected. @param rate  of the line [baud], which is told if it has one.
  void log_connected(const std::string& device, std::uint32_t rate = 0) const;
  void warn(const std::string& text) const { host().write_log(log::Level::warning, text); }
  [[nodiscard]] LineCounts counts() const override {
    return session_ != nullptr ? session_->counts() : LineCounts{};
  }

  /// Returns when the session has something to do, even if nothing comes, as long as it does not know the device.
  [[nodiscard]] virtual TimePoint next_step() const { return session_->next(); }
  /// Returns when poll() has something to do, even if nothing comes.
  [[nodiscard]] virtual TimePoint next_turn() const = 0;
  /// Says the last thing before the line is closed; also after a fault, when the line may still work.
  virtual void take_leave() {}

 private:
  Status open() final;
  Result<bool> probe() final;
  void close() final;
  [[nodiscard]] bool recovers() const final { return true; }
  [[nodiscard]] int descriptor() const final { return line_->descriptor(); }
  [[nodiscard]] TimePoint next_poll() const final;
  // A line that wakes nobody, such as a replay, is looked at in each turn, and next_poll() sees to it that there are turns.
  [[nodiscard]] bool hears_input() const final { return true; }
  Status make_line();

  Param<std::string> device_;
  Param<std::string> byte_log_{*this,
                               "byte_log",
                               "",
                               {.text = "File for all bytes that go over the line, with their times; "
                                        "device=\"replay:FILE\" plays it back."}};
  const link::Line first_;
  std::unique_ptr<link::ByteLink> line_;
  LineSession* session_ = nullptr;
  bool is_made_ = false;  // for the clock of the run
  bool is_open_ = false;
  bool rings_ = false;  // at input, where it has no descriptor
};

}  // namespace orca::hw
