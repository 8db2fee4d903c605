// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"

namespace orca::hw::link {

/// A client that has connected.
struct TcpClient {
  Descriptor socket;  ///< It does not block, and sends each write at once.
  std::string peer;   ///< The client's address and port, for people.
};

/// A TCP port of this machine at which clients arrive. A few of them wait in the system until accept() takes them. TcpLink makes a
/// ByteLink of a client.
///
/// Thread contract: not synchronised.
class TcpListener {
 public:
  /// Starts to listen; an earlier port is given up.
  /// @param address  an IPv4 address of this machine: 127.0.0.1 for clients on this machine, 0.0.0.0 for all.
  /// @param port     0: any that is free; port() returns which.
  /// @errors  already_exists: another program has the port; failed_precondition: this user may not listen there; not_found: this
  ///          machine does not have the address; invalid_argument: it is no IPv4 address; unavailable with any other reason. The
  ///          text says what to do.
  Status open(const std::string& address, std::uint16_t port);
  /// Stops listening. Clients that were accepted stay connected.
  void close() { socket_.reset(); }
  [[nodiscard]] bool is_open() const { return static_cast<bool>(socket_); }
  /// Returns the port of the last open(); 0: there was none.
  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// Returns the place in the form that make_link() reads: tcp:127.0.0.1:6665.
  [[nodiscard]] std::string name() const;

  /// Takes the client that has waited longest; nothing: none waits.
  [[nodiscard]] std::optional<TcpClient> accept();

 private:
  Descriptor socket_;
  std::string address_;
  std::uint16_t port_ = 0;
};

}  // namespace orca::hw::link
