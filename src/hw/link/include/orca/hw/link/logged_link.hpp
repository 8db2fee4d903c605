// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "orca/hw/link/byte_link.hpp"
#include "orca/hw/link/byte_log.hpp"

namespace orca::hw::link {

/// Another link, of which everything that is read and written is noted in a byte log.
///
/// Thread contract: one strand.
class LoggedLink final : public ByteLink {
 public:
  /// @pre  neither is null.
  LoggedLink(std::unique_ptr<ByteLink> link, std::unique_ptr<ByteLog> log);
  ~LoggedLink() override;

  [[nodiscard]] Result<Opening> open() override;
  void close() override;
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Status write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] Status flush() override;
  [[nodiscard]] std::size_t pending() const override { return link_->pending(); }
  void discard_input() override;
  void discard_output() override;
  [[nodiscard]] int descriptor() const override { return link_->descriptor(); }
  bool ring_at_input(std::function<void()> ring) override { return link_->ring_at_input(std::move(ring)); }
  [[nodiscard]] std::string name() const override { return link_->name(); }
  [[nodiscard]] Status set_line(const Line& line) override;
  [[nodiscard]] Status set_dtr(bool raised) override;
  [[nodiscard]] double byte_time() const override { return link_->byte_time(); }

  /// Returns whether the log has neither reached its limit nor lost its disk.
  [[nodiscard]] bool is_logging() const { return log_->is_writing(); }

 private:
  void note_failure(const Error& error);

  const std::unique_ptr<ByteLink> link_;
  const std::unique_ptr<ByteLog> log_;
  bool open_ = false;
  bool gone_ = false;  // and noted, in this session
};

}  // namespace orca::hw::link
