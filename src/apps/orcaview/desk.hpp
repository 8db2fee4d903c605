// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "access.hpp"
#include "ports.hpp"
#include "system_link.hpp"

namespace orca::view {

class Session;

/// What all sessions share: the connection to the system, its log, the ports at which they look.
///
/// Thread contract: the loop's thread.
class Desk {
 public:
  /// @param connect      as for SystemLink.
  /// @param is_recorded  whether the system is a recording that is played.
  Desk(const boost::asio::any_io_executor& loop, const std::string& system,
       const SystemLink::Connect& connect, bool is_recorded);

  /// Connects to the system.
  void start();
  [[nodiscard]] bool is_recorded() const { return is_recorded_; }
  /// Lets all sessions begin anew, because the time of a recording was set.
  void begin_anew();

  void join(Session& session);
  void leave(Session& session);
  [[nodiscard]] SystemLink& link() { return link_; }
  [[nodiscard]] Ports& ports() { return ports_; }
  /// Begins to follow the system's log for a page, until it leaves or looks away.
  void follow_log(Session& session, std::uint32_t id);
  void leave_log(const Session& session, std::uint32_t id);

 private:
  struct Follower {
    Session* session = nullptr;
    std::uint32_t id = 0;
  };
  void changed(bool is_up);
  void ask_for_log();

  const bool is_recorded_;
  SystemLink link_;
  SystemLink log_link_;  // of its own: what is asked over it has no end
  Ports ports_;
  std::vector<Session*> sessions_;
  std::vector<Follower> followers_;
  bool has_asked_ = false;  // for the log
};

}  // namespace orca::view
