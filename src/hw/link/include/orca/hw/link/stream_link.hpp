// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/hw/link/byte_link.hpp"

namespace orca::hw::link {

/// A link through one descriptor of the system, with the bytes that wait to be sent. How the descriptor is opened is added by the
/// classes below.
///
/// Thread contract: one strand.
class StreamLink : public ByteLink {
 public:
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Status write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] Status flush() override;
  [[nodiscard]] std::size_t pending() const override;
  void discard_input() override;
  void discard_output() override { waiting_.clear(); }
  [[nodiscard]] int descriptor() const override { return descriptor_.number(); }

 protected:
  enum class Kind { terminal, socket };

  /// @param gone  says that the other end has gone, and what to do.
  StreamLink(Kind kind, std::string gone) : kind_(kind), gone_(std::move(gone)) {}

  /// Takes over an open descriptor that does not block.
  void attach(Descriptor descriptor);
  /// Closes the descriptor and drops what waits.
  void detach();
  [[nodiscard]] bool is_attached() const { return static_cast<bool>(descriptor_); }

 private:
  [[nodiscard]] bool has_hung_up() const;
  [[nodiscard]] Error gone(int reason) const;
  [[nodiscard]] Error failed(const char* act, int reason) const;
  [[nodiscard]] std::ptrdiff_t send(std::span<const std::uint8_t> bytes) const;

  const Kind kind_;
  const std::string gone_;
  Descriptor descriptor_;
  std::vector<std::uint8_t> waiting_;
};

}  // namespace orca::hw::link
