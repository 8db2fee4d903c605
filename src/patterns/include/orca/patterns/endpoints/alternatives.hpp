// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/strand.hpp"

namespace orca {

/// A client's port that may have several connections, of which it uses one at a time: its edge can be moved from one server
/// to another while the component runs. The component notices a change of the server no more than it notices that a
/// server was started again.
///
/// Thread contract: allow_moves() before the first connection; move_to() and server() from any thread afterwards.
class MovablePort {
 public:
  virtual ~MovablePort() = default;

  /// Lets the port have any number of connections. It uses the first one until it is moved.
  /// @pre  it is no array and has no connection.
  virtual void allow_moves() = 0;
  [[nodiscard]] virtual bool can_move() const = 0;

  /// Moves the port's edge to one of its servers. The component's strand does it, before it looks at the port again.
  /// @param server  "component.port".
  /// @return false if the port has no connection to it.
  virtual bool move_to(const std::string& server) = 0;
};

/// The servers of a port that uses one at a time, and a move that is still to be made.
///
/// @tparam Server  PushSource or RequestTarget.
/// Thread contract: add() before the component runs; want() from any thread; the rest on the component's strand.
template <class Server>
class Alternatives final : public Intake {
 public:
  /// @param strand  of the client.
  /// @param move    moves the edge; called on the strand.
  Alternatives(Strand& strand, std::function<void(Server&)> move) : strand_(strand), move_(std::move(move)) {
    strand_.add_intake(*this);
  }
  ~Alternatives() override { strand_.remove_intake(*this); }
  Alternatives(const Alternatives&) = delete;
  Alternatives& operator=(const Alternatives&) = delete;

  void add(Server& server) { servers_.push_back(&server); }

  /// Asks for a move to the server of that name.
  /// @return false if there is none.
  bool want(const std::string& path) {
    const auto found = std::ranges::find_if(servers_, [&](Server* server) { return server->path() == path; });
    if (found == servers_.end()) return false;
    wanted_.store(*found, std::memory_order_release);
    strand_.wake();
    return true;
  }

  /// Makes the move that is asked for, if there is one.
  bool take_in() override {
    if (wanted_.load(std::memory_order_relaxed) == nullptr) return false;
    Server* const server = wanted_.exchange(nullptr, std::memory_order_acq_rel);
    if (server != nullptr) move_(*server);
    return server != nullptr;
  }

 private:
  Strand& strand_;
  const std::function<void(Server&)> move_;
  std::vector<Server*> servers_;
  std::atomic<Server*> wanted_{nullptr};
};

}  // namespace orca
