// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "orca/base/steady_clock.hpp"
#include "orca/hw/link/byte_link.hpp"

namespace orca::hw::link {

class MemoryCable;

struct MemoryOptions {
  /// The two ends of a line. A driver waits for its device and sets the rate.
  enum class End { driver, device };

  std::string name;  ///< Of the line; both ends of this process with one name belong together.
  End end = End::driver;
  Line line{};           ///< Rate that the driver has set until set_line().
  Duration patience{0};  ///< Time that a driver's open() waits for the device's end [s]; 0: it needs none.
  NowFunction now = steady_now;  ///< The clock of `patience`.
};

/// One end of a line between two links of one process, which uses nothing of the system and so works in virtual time.
///
/// What one end writes waits in the line until the other reads it. An end that closes drops what it has not read; what it
/// has written can still be read. The other end is told that it has gone, until it is opened again.
///
/// Thread contract: each end has one strand; the two ends may be in different ones.
class MemoryLink final : public ByteLink {
 public:
  explicit MemoryLink(MemoryOptions options);
  ~MemoryLink() override;

  /// @errors  already_exists if another link has this end open; not_found if no device came in time.
  [[nodiscard]] Result<Opening> open() override;
  void close() override;
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Status write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] Status flush() override;
  /// Returns 0: nothing waits outside the line.
  [[nodiscard]] std::size_t pending() const override { return 0; }
  void discard_input() override;
  void discard_output() override {}
  [[nodiscard]] int descriptor() const override { return -1; }
  bool ring_at_input(std::function<void()> ring) override;
  [[nodiscard]] std::string name() const override { return "memory:" + options_.name; }
  [[nodiscard]] Status set_line(const Line& line) override;
  /// Returns the time that one byte takes at the driver's rate [s]. The line itself takes no time.
  [[nodiscard]] double byte_time() const override;

  /// Returns the line as the driver has set it; nothing: no driver has opened it.
  [[nodiscard]] std::optional<Line> line() const;

 private:
  [[nodiscard]] bool goes_on_waiting();

  const MemoryOptions options_;
  const std::shared_ptr<MemoryCable> cable_;  // shared: either end may be destroyed first
  const std::size_t side_;                    // 0 or 1
  Line set_;                                  // by the driver
  std::optional<TimePoint> waits_since_;
  bool is_open_ = false;
};

}  // namespace orca::hw::link
