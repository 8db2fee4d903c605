// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "orca/base/time.hpp"

namespace orca::dds::of_team {

/// The systems that are heard on a topic.
///
/// Thread contract: one thread.
class Senders {
 public:
  /// A system that is heard.
  struct Sender {
    std::string
        name;  ///< Its own, or if another one with the same name is heard, too, with a number behind it.
    /// The time to be added to its instants [s], so that they are by the clock of this machine: at most as much too late as the shortest
    /// way of an object takes.
    Duration shift{};
  };

  /// Notes an object.
  /// @param sent  when, by the clock of the sender.
  /// @return nothing if more systems speak than there may be.
  [[nodiscard]] std::optional<Sender> note(const std::string& name, std::uint64_t run, TimePoint sent,
                                           TimePoint came);

 private:
  // The shortest times from a sender's clock at the start to this one's at the end. Two windows of time, of which the older one is
  // forgotten: the clocks drift.
  struct Known {
    std::string name;
    Duration shortest = Duration::max();
    Duration shortest_before = Duration::max();
    TimePoint window{};  // begin of the present one
    TimePoint heard{};
  };

  void forget_silent(TimePoint now);
  [[nodiscard]] bool is_taken(const std::string& name) const;

  std::map<std::pair<std::string, std::uint64_t>, Known> known_;  // by name and run
};

}  // namespace orca::dds::of_team
