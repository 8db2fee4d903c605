// SPDX-License-Identifier: LGPL-3.0-or-later

/// @file
/// Ports that speak to the systems of a team: what a port pushes reaches the ports of all others that hear the same name, if their type
/// is the same.
///
/// It is a part of liborca_dds.so, which a process opens when one of its ports is in a team (open_team_topics()), and never closes.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "orca/base/result.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"

namespace orca {

/// A system as a part of a team.
struct TeamOptions {
  std::string team;
  std::string system;     ///< Name of this one.
  std::uint64_t run = 0;  ///< The same in all processes of a run, and in no other run.
  std::uint32_t domain = 0;
  std::string address{};  ///< The network interface's; empty: all of them.
};

/// This process's part in a team. Objects arrive with the name of their system as origin, and with their instants by this machine's
/// clock. Others are not trusted: what is no object of the port's type is dropped, and reported once for each of them.
///
/// Thread contract: connect() before the components run. It outlives the ports.
class TeamTopics {
 public:
  virtual ~TeamTopics() = default;
  /// Lets a PushServer offer what it pushes, while somebody hears it, or a PushProxy hear what others offer. The port keeps its end.
  /// @param offer   the name that all systems use.
  /// @param policy  of the queue where objects arrive.
  /// @errors  invalid_argument if the port is none of Push; unavailable if DDS refuses.
  virtual Status connect(Endpoint& port, const std::string& offer, const QueuePolicy& policy) = 0;
};

/// Opens the library, if this process has not done so yet, and takes part.
/// @errors  unavailable if there is no such library, or if DDS does not start.
[[nodiscard]] Result<std::unique_ptr<TeamTopics>> open_team_topics(const TeamOptions& options);

/// The result of the library's function.
using MadeTeamTopics = std::optional<Result<std::unique_ptr<TeamTopics>>>;
/// The library exports it as orca_make_team_topics.
using MakeTeamTopics = void(const TeamOptions& options, MadeTeamTopics& made);

}  // namespace orca
