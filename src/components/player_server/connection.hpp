// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "client_session.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "robot_face.hpp"

namespace orca::player_server {

/// A client that is connected. Nothing of it waits.
///
/// Thread contract: not synchronised.
class Connection {
 public:
  Connection(Descriptor socket, const RobotFace& face, std::string peer);

  /// Reads what has come, and sends what waits.
  /// @errors  unavailable if the client has gone; those of ClientSession::take(). Then drop the connection.
  Status exchange(TimePoint now);
  [[nodiscard]] ClientSession& session() { return session_; }
  /// Returns the client's address, for people.
  [[nodiscard]] const std::string& peer() const { return peer_; }

 private:
  Status send();

  Descriptor socket_;
  const std::string peer_;
  ClientSession session_;
};

/// A TCP port at which clients arrive.
///
/// Thread contract: not synchronised.
class Listener {
 public:
  /// @param address  IPv4 address of this machine, or 0.0.0.0 for all of its own.
  /// @param port     0: any; port() returns it.
  /// @errors  already_exists if another program has the port, unavailable with any other reason, and what to do.
  Status open(const std::string& address, std::uint16_t port);
  void close() { socket_.reset(); }
  [[nodiscard]] bool is_open() const { return static_cast<bool>(socket_); }
  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// Returns the next client that has arrived; null: none.
  [[nodiscard]] std::unique_ptr<Connection> accept(const RobotFace& face);

 private:
  Descriptor socket_;
  std::uint16_t port_ = 0;
};

}  // namespace orca::player_server
