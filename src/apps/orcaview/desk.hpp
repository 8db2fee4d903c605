// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "access.hpp"
#include "ports.hpp"
#include "system_link.hpp"

namespace orca::view {

class Page;

/// What all pages share: the connection to the system, its log, the ports at which they look.
///
/// Thread contract: the loop's thread.
class Desk {
 public:
  Desk(const boost::asio::any_io_executor& loop, const std::string& system);

  /// Connects to the system.
  void start();

  void join(Page& page);
  void leave(Page& page);
  [[nodiscard]] std::size_t pages() const { return pages_.size(); }

  [[nodiscard]] SystemLink& link() { return link_; }
  [[nodiscard]] Ports& ports() { return ports_; }
  /// Begins to follow the system's log for a page, until it leaves or looks away.
  void follow_log(Page& page, std::uint64_t id);
  void leave_log(const Page& page, std::uint64_t id);

  /// Returns the message with which a page is greeted.
  [[nodiscard]] std::string greeting(Role role) const;

 private:
  struct Follower {
    Page* page = nullptr;
    std::uint64_t id = 0;
  };
  void changed(bool is_up);
  void ask_for_log();

  SystemLink link_;
  SystemLink log_link_;  // of its own: what is asked over it has no end
  Ports ports_;
  std::vector<Page*> pages_;
  std::vector<Follower> followers_;
  bool has_asked_ = false;  // for the log
};

}  // namespace orca::view
