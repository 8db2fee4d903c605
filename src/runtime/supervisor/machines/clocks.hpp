// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/idl/machines.hpp"

namespace orca::supervisor {

/// How the clocks of the other machines of a system differ from that of this one, measured by the states that all repeat, as NTP
/// does: a state says when it was made, which state of mine came last, and how long ago. So each state that comes gives an offset
/// and a round trip, and the true offset is at most half the round trip away, however unequal the two ways are. What was measured
/// with the shortest round trip counts, for at most a minute; its error grows meanwhile, since no two clocks run equally fast.
///
/// A clock that certainly differs by more than kTolerated is reported, and corrected until it certainly does not. A smaller
/// difference is left alone, because a time service (NTP, PTP) knows better than a measurement of one minute.
///
/// Thread contract: not synchronised. It has no clock.
class Clocks {
 public:
  static constexpr Duration kTolerated = 20ms;

  /// What is known of the clock of a machine.
  struct Offset {
    Duration ahead{0};  ///< By how much it is ahead of this machine's [s].
    Duration error{0};  ///< The truth is at most so far away [s], if clocks drift apart by at most 100 ppm.
    Duration round_trip{0};  ///< Of the measurement [s].
  };
  /// A clock that differs, or does not any more.
  struct News {
    std::string machine;
    bool differs = false;
    std::string text;  ///< For people; names the machine.
  };

  /// @param here  name of this machine.
  /// @param run   number of its run.
  Clocks(std::string here, std::uint64_t run) : here_(std::move(here)), run_(run) {}

  /// Takes a state that is believed (Gathering::hear()). Its times may be anything.
  /// @param now  by the clock of this machine.
  void hear(const idl::MachineState& state, TimePoint now);
  /// Writes the times that the others need.
  /// @param now  by the clock of this machine.
  void fill(idl::MachineState& state, TimePoint now) const;

  /// Returns what is known of the clock of a machine; nothing: it has not been measured within a minute.
  [[nodiscard]] std::optional<Offset> offset(const std::string& machine, TimePoint now) const;
  /// Returns by how much the clock of a machine is ahead, as far as it is corrected [s]. It changes only when it must: instants
  /// that are corrected by it keep their order.
  [[nodiscard]] Duration correction(const std::string& machine) const;
  /// Returns what has happened since the last call.
  [[nodiscard]] std::vector<News> take_news() { return std::exchange(news_, {}); }

 private:
  struct Sample {
    Duration ahead;
    Duration round_trip;
    TimePoint begun;  // when the state of this machine was made, by its own clock

    [[nodiscard]] Duration error(TimePoint now) const;
  };
  struct Peer {
    std::uint64_t run = 0;
    TimePoint said{};              // when its latest state was made, by its own clock
    TimePoint heard{};             // when that came, by this machine's
    std::deque<Sample> samples{};  // old ones first; each has a smaller error than the one after it
    bool differs = false;
    Duration correction{0};
  };

  static std::optional<Sample> measure(const idl::MachineState& state, const idl::MachineRun& heard,
                                       TimePoint now);
  static void keep(Peer& peer, const Sample& sample, TimePoint now);
  void judge(const std::string& machine, Peer& peer, TimePoint now);

  const std::string here_;
  const std::uint64_t run_;
  std::map<std::string, Peer> peers_;
  std::vector<News> news_;
};

}  // namespace orca::supervisor
