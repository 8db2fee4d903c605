// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "orca/base/descriptor.hpp"
#include "orca/hw/link/byte_link.hpp"

namespace orca::test {

/// A device in the network, on loopback, that serves one connection at a time. It has a small buffer, so that it is soon
/// full. open() is under way until somebody has connected.
class TcpDevice final : public hw::link::ByteLink {
 public:
  /// @param family  AF_INET or AF_INET6.
  explicit TcpDevice(int family);

  [[nodiscard]] std::uint16_t port() const { return port_; }

  [[nodiscard]] Result<hw::link::Opening> open() override;
  void close() override;
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Status write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] Status flush() override { return ok(); }
  [[nodiscard]] std::size_t pending() const override { return 0; }
  void discard_input() override {}
  void discard_output() override {}
  [[nodiscard]] int descriptor() const override { return peer_.number(); }
  [[nodiscard]] std::string name() const override { return "the device on port " + std::to_string(port_); }

 private:
  Descriptor listener_;
  Descriptor peer_;
  std::uint16_t port_ = 0;
};

}  // namespace orca::test
