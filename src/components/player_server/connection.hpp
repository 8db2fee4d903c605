// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
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

}  // namespace orca::player_server
