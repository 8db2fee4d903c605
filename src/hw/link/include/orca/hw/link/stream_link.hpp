// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/hw/link/byte_link.hpp"

namespace orca::hw::link {

/// The bytes through one descriptor of a link, with those that wait to be sent.
///
/// Thread contract: not synchronised.
class Stream {
 public:
  enum class Kind { terminal, socket };

  /// @param owner  the link, for messages. It outlives the stream.
  /// @param gone   says that the other end has gone, and what to do.
  Stream(const ByteLink& owner, Kind kind, std::string gone)
      : owner_(owner), kind_(kind), gone_(std::move(gone)) {}

  /// Takes over an open descriptor that does not block.
  void attach(Descriptor descriptor);
  /// Closes the descriptor and drops what waits.
  void detach();

  [[nodiscard]] int descriptor() const { return descriptor_.number(); }
  [[nodiscard]] bool is_attached() const { return static_cast<bool>(descriptor_); }
  [[nodiscard]] std::size_t pending() const { return waiting_.size(); }
  void discard_output() { waiting_.clear(); }

  // As those of ByteLink.
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into);
  [[nodiscard]] Status write(std::span<const std::uint8_t> bytes);
  [[nodiscard]] Status flush();

  /// Reads and drops what is there.
  void drain();

 private:
  [[nodiscard]] bool has_hung_up() const;
  [[nodiscard]] Error gone(int reason) const;
  [[nodiscard]] Error failed(const char* act, int reason) const;
  [[nodiscard]] std::ptrdiff_t send(std::span<const std::uint8_t> bytes) const;

  const ByteLink& owner_;
  const Kind kind_;
  const std::string gone_;
  Descriptor descriptor_;
  std::vector<std::uint8_t> waiting_;
};

}  // namespace orca::hw::link
