// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

namespace orca {

/// The counters of one Push edge, from its start until now. A plain value.
struct EdgeCounters {
  std::uint64_t delivered = 0;  ///< Objects put into the queue.
  std::uint64_t dropped = 0;    ///< Objects lost, for any of the reasons that follow.

  std::uint64_t dropped_oldest = 0;   ///< They made room for a newer one.
  std::uint64_t dropped_newest = 0;   ///< They found the queue full.
  std::uint64_t dropped_blocked = 0;  ///< Their publisher waited for room in vain, or had waited before.
  std::uint64_t dropped_by_link = 0;  ///< The link between two processes had no room for them.
  std::uint64_t unmatched = 0;        ///< No object of the same moment came to the other ports.
  std::uint64_t left_behind = 0;      ///< They were still in the queue at unsubscribe().
  std::uint64_t over_limit = 0;       ///< Dropped while subscribed, beyond the number that the edge may drop.
  std::uint64_t waits = 0;            ///< Times that the publisher had to wait for room.
  std::uint64_t missed_deadlines = 0;  ///< Deadlines that passed without an object.
  std::uint32_t queued = 0;            ///< Objects in the queue now.
  std::uint32_t high_water = 0;        ///< Largest number that was ever in the queue.
};

/// The counters of one Send or Query server, or of one Send edge, from its start until now. A plain value.
struct IntakeCounters {
  std::uint64_t accepted = 0;
  std::uint64_t refused = 0;  ///< Not accepted, for any of the reasons that follow.
  std::uint64_t failed = 0;   ///< Accepted, but the handler returned an error or threw.

  std::uint64_t refused_full = 0;
  std::uint64_t refused_closed = 0;
  std::uint64_t withdrawn = 0;   ///< The sender stopped waiting for room.
  std::uint64_t waits = 0;       ///< Times that a sender had to wait for room.
  std::uint32_t queued = 0;      ///< Waiting to be handled now.
  std::uint32_t high_water = 0;  ///< Largest number that ever waited; summed over several edges.

  IntakeCounters& operator+=(const IntakeCounters& other) {
    accepted += other.accepted;
    refused += other.refused;
    failed += other.failed;
    refused_full += other.refused_full;
    refused_closed += other.refused_closed;
    withdrawn += other.withdrawn;
    waits += other.waits;
    queued += other.queued;
    high_water += other.high_water;
    return *this;
  }
};

/// The counters of one SendProxy or QueryProxy, from its start until now. A plain value.
struct RequestCounters {
  std::uint64_t sent = 0;       ///< Objects or questions that left.
  std::uint64_t answered = 0;   ///< Accepted by the server, or answered without an error.
  std::uint64_t failed = 0;     ///< Refused, or answered by an error.
  std::uint64_t timed_out = 0;  ///< Abandoned at the caller's time limit.
};

}  // namespace orca
