// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "wire.hpp"

// after wire.hpp, which includes what Boost.Asio lacks
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "orca/base/result.hpp"
#include "orca/supervisor/control.hpp"

namespace orca::view {

/// The connection to the supervisor of one system. If the system ends, it waits until one of the name runs again.
///
/// Thread contract: the loop's thread.
class SystemLink {
 public:
  /// Takes a part of an answer.
  using Taker = std::function<void(supervisor::ControlAnswer)>;
  using Done = std::function<void(const Status& outcome)>;

  using Connect = std::function<Result<Descriptor>()>;

  /// @param connect  returns a new connection to the supervisor.
  /// @param changed  is called when the system is there, and when it is gone.
  SystemLink(const boost::asio::any_io_executor& loop, std::string system, Connect connect,
             std::function<void(bool)> changed);
  ~SystemLink();
  SystemLink(const SystemLink&) = delete;
  SystemLink& operator=(const SystemLink&) = delete;

  /// Connects, again and again until it succeeds.
  void start();

  /// Asks. The supervisor cuts off whoever asks 200 times in a second, so the rest of 150 waits for the next second, but for an
  /// emergency stop. `done` is called once, at the end of the answer; with unavailable if the system ends before.
  void ask(supervisor::Ask ask, Taker take, Done done);

  [[nodiscard]] bool is_up() const { return wire_ != nullptr; }
  [[nodiscard]] const std::string& system() const { return system_; }

 private:
  struct Question {
    Taker take;
    Done done;
  };
  void send(std::uint64_t request, supervisor::Ask ask);
  void send_waiting();
  void take(supervisor::Message message);
  void lose(const Error& why);
  void try_later();

  const boost::asio::any_io_executor loop_;
  const std::string system_;
  const Connect connect_;
  const std::function<void(bool)> changed_;
  boost::asio::steady_timer retry_;
  std::shared_ptr<Wire> wire_;  // null: there is no system
  std::uint64_t last_request_ = 0;
  std::map<std::uint64_t, Question> open_;
  std::deque<std::pair<std::uint64_t, supervisor::Ask>> waiting_;  // for the next second
  boost::asio::steady_timer second_;                               // that has begun with the first question
  int asked_ = 0;                                                  // in it
};

}  // namespace orca::view
