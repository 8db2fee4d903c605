// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <poll.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "control/control_server.hpp"
#include "control/order_rules.hpp"
#include "members/reply.hpp"
#include "orca/base/result.hpp"
#include "orca/supervisor/access.hpp"
#include "orca/supervisor/control.hpp"
#include "orca/supervisor/control_socket.hpp"
#include "orca/supervisor/moment.hpp"

namespace orca::supervisor {

/// A socket at which others than the owner may ask, and what they may do.
struct SharedSocket {
  std::optional<ControlSocket> socket;  ///< None: nobody else may ask.
  std::vector<Grant> grants;

  /// Opens it if anything is granted.
  /// @errors  as ControlSocket::open_shared().
  [[nodiscard]] static Result<SharedSocket> open(const std::string& system, const std::vector<Grant>& grants);
};

/// The ways by which operators reach a system: one for its owner, and one for others. Only what somebody may ask comes in, and who orders
/// what is kept.
///
/// Thread contract: the supervisor's thread.
class Doors {
 public:
  using Handler = std::function<void(const Ask& ask, const ReplyPtr& reply)>;

  explicit Doors(Handler handler) : handler_(std::move(handler)) {}

  void open(ControlSocket socket);
  void open(SharedSocket others);
  /// From now on nobody can reach the system.
  void close();
  /// Adds what it waits for.
  void add_to(std::vector<pollfd>& all) const;
  /// Takes in what clients ask. Never waits.
  void serve(Moment now);
  /// Makes the files of the sockets again if somebody has removed them.
  /// @return whether that of the owner had been removed; nothing if it is not open.
  /// @errors  of the owner's, as ControlSocket::restore().
  [[nodiscard]] std::optional<Result<bool>> restore();

 private:
  void take(const Ask& ask, const Asker& asker, const ReplyPtr& reply);

  const Handler handler_;
  Audit audit_;
  std::vector<Grant> grants_;
  std::optional<ControlServer> own_;  // the last members: their clients are gone first
  std::optional<ControlServer> shared_;
};

}  // namespace orca::supervisor
