// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "common/command_line.hpp"
#include "exit_code.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/control.hpp"

namespace orca::orcactl {

inline constexpr Duration kForEver = 24h * 365;  ///< [s] As a limit: none.

/// Connects to the system that a call names; if it names none, to the only one that runs.
[[nodiscard]] std::variant<Descriptor, Failure> connect_to(const apps::Call& call);

/// A connection to the supervisor of a running system.
///
/// Thread contract: not synchronised.
class Client {
 public:
  /// Takes a part of an answer.
  using Taker = std::function<void(supervisor::ControlAnswer&)>;

  /// Takes over a connection.
  explicit Client(Descriptor socket) : channel_(std::make_unique<supervisor::Channel>(std::move(socket))) {}

  /// Connects to the system that a call names; if it names none, to the only one that runs. If that does not answer, the user
  /// hears of it, once: see silence_text().
  [[nodiscard]] static std::variant<Client, Failure> connect(const apps::Call& call);

  /// Asks, and passes each part of the answer on until it ends.
  /// @param limit  [s] for each part.
  /// @return the outcome of what was asked.
  /// @errors  unavailable if the system ends meanwhile; deadline_exceeded if the supervisor does not answer.
  Status ask(const supervisor::Ask& ask, const Taker& taker, Duration limit);

  /// Asks for a line to a port. What the supervisor notes to it goes to stderr.
  /// @errors  as ask().
  Result<supervisor::LineAnswer> open_line(const std::string& port, const std::vector<std::string>& options);

 private:
  Result<supervisor::Message> next_message(Duration limit);

  std::unique_ptr<supervisor::Channel> channel_;
  std::uint64_t last_request_ = 0;
  std::function<void()> note_silence_;  // empty: that was done
};

}  // namespace orca::orcactl
