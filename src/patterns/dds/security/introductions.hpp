// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <fastdds/rtps/common/Locator.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <set>
#include <span>
#include <vector>

#include "orca/base/mutex.hpp"

namespace orca::dds {

/// The order in which Fast DDS 2.9.1 gets what belongs to introductions of participants: one packet after the other, and the first
/// message of a handshake after the announcement of its sender. It drops a message of a handshake that comes while it is busy with
/// the sender on another thread, or before it knows the sender; and it repeats one after a second only.
///
/// Thread contract: any thread.
class Introductions {
 public:
  using Receiver = eprosima::fastdds::rtps::TransportReceiverInterface;
  using Locator = eprosima::fastrtps::rtps::Locator_t;

  /// Passes a packet on to its receiver, at once or when its sender has been announced.
  void pass(std::span<const std::uint8_t> packet, Receiver& receiver, const Locator& here,
            const Locator& sender);

 private:
  using Clock = std::chrono::steady_clock;
  using Prefix = std::array<std::uint8_t, 12>;  // of the GUIDs of a participant

  struct Packet {
    std::vector<std::uint8_t> bytes;
    Receiver* receiver;  // lives until no transport receives any more
    Locator here;
    Locator sender;
    Clock::time_point came;
  };

  void keep(Packet packet) ORCA_REQUIRES(mutex_);
  void pass_kept(const Prefix& sender) ORCA_REQUIRES(mutex_);

  Mutex mutex_;
  std::set<Prefix> announced_ ORCA_GUARDED_BY(mutex_);
  std::vector<Packet> kept_ ORCA_GUARDED_BY(mutex_);
};

}  // namespace orca::dds
