// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "orca/hw/link/byte_link.hpp"

namespace orca::hw::link {

class MemoryCable;

struct MemoryOptions {
  std::string name = "memory";
  /// The most bytes that are under way in one direction, at most kMostPending.
  std::size_t capacity = kMostPending;
  /// Whether the ends have descriptors to wait for. Without, they use nothing of the system, for virtual time.
  bool descriptors = false;
};

/// One end of a line between two links of one process.
///
/// What one end writes waits in the line until the other reads it. An end that closes drops what it has not read; what it
/// has written can still be read. The other end is told that it has gone, until it is opened again.
///
/// Thread contract: each end has one strand; the two ends may be in different ones.
class MemoryLink final : public ByteLink {
 public:
  ~MemoryLink() override;

  /// @errors  unavailable if the system gives no descriptor.
  [[nodiscard]] Result<Opening> open() override;
  void close() override;
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Status write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] Status flush() override;
  /// Returns 0: nothing waits outside the line.
  [[nodiscard]] std::size_t pending() const override { return 0; }
  void discard_input() override;
  void discard_output() override {}
  [[nodiscard]] int descriptor() const override;
  [[nodiscard]] std::string name() const override { return name_; }

 private:
  friend std::pair<std::unique_ptr<MemoryLink>, std::unique_ptr<MemoryLink>> make_memory_links(
      const MemoryOptions& options);
  MemoryLink(std::shared_ptr<MemoryCable> cable, std::size_t side, std::string name);

  const std::shared_ptr<MemoryCable> cable_;  // shared: either end may be destroyed first
  const std::size_t side_;                    // 0 or 1
  const std::string name_;
};

/// Makes the two ends of a line, closed.
[[nodiscard]] std::pair<std::unique_ptr<MemoryLink>, std::unique_ptr<MemoryLink>> make_memory_links(
    const MemoryOptions& options = {});

}  // namespace orca::hw::link
