// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "orca/base/descriptor.hpp"
#include "orca/hw/link/stream_link.hpp"

namespace orca::hw::link {

struct ListenOptions {
  /// An IPv4 or IPv6 address of this machine, without brackets. By default only programs of this machine get in.
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;  ///< 0: one that is free; port() tells which.
};

/// The device's side of connections over TCP, for emulators and tests. A driver connects as to a device or a device server.
///
/// It has one client at a time; others wait until that has gone, or until another() lets them in. As long as there is none, read(), write() and flush()
/// give unavailable; the link itself stays open.
///
/// Thread contract: one strand.
class ListenLink final : public StreamLink {
 public:
  explicit ListenLink(ListenOptions options);
  ~ListenLink() override;

  /// Begins to listen; a client need not be there.
  /// @errors  already_exists if the port is taken, invalid_argument for what is no address, not_found for one that this machine does not
  ///          have, failed_precondition for a port that this user may not have; unavailable with the system's reason.
  [[nodiscard]] Result<Opening> open() override;
  void close() override;
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Status write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] Status flush() override;
  void discard_input() override;
  /// Returns the descriptor of the client; without one that of the port, which becomes readable when one comes. It changes when the client is
  /// let in, by the next call of read(), write() or flush().
  [[nodiscard]] int descriptor() const override;
  [[nodiscard]] std::string name() const override;

  /// Returns the port at which it listens. @pre  it is open.
  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// Returns an open link for one more client of the same port at the same time. The port is free again when all of them are closed.
  /// @pre  it is open.
  [[nodiscard]] std::unique_ptr<ListenLink> another() const;

 private:
  Status admit();
  [[nodiscard]] Error refused(int reason) const;

  const ListenOptions options_;
  std::shared_ptr<const Descriptor> listener_;  // that of all links of the port
  std::uint16_t port_;
};

}  // namespace orca::hw::link
