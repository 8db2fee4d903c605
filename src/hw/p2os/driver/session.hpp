// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/line_frames.hpp"
#include "orca/hw/link/byte_link.hpp"
#include "orca/hw/p2os/command.hpp"
#include "orca/hw/p2os/sync.hpp"

namespace orca::hw::p2os {

/// A packet of the robot, and when its first byte arrived.
struct Received {
  std::span<const std::uint8_t> body;
  TimePoint stamp;
};

/// The connection to a robot: finds the rate of the line, makes the handshake, and then passes packets on.
///
/// The handshake is SYNC0, SYNC1, SYNC2, each answered, then OPEN, whereupon the robot begins to send. A controller that is still
/// open from an earlier run sends at once: it is closed first.
///
/// Thread contract: not synchronised; the container's strand.
/// @source  Pioneer 2 operations manual, "Connecting"; order of rates and times of public drivers.
class Session {
 public:
  /// @param link   outlives the object.
  /// @param rates  [baud] to be tried, in this order; one that the link ignores is enough for a connection.
  Session(link::ByteLink& link, std::vector<std::uint32_t> rates);

  /// Begins anew with the first rate. @pre  the link is open.
  Status begin(TimePoint now);

  /// Goes on with the handshake.
  /// @return whether it is done: the robot is known, and has sent its first packet.
  /// @errors  not_found if nothing answers at any rate, with what to do; those of the link.
  Result<bool> advance(TimePoint now);
  /// Returns when advance() has something to do, even if nothing comes.
  [[nodiscard]] TimePoint next() const { return deadline_; }

  /// Reads what there is and hands out the packets. @pre  the handshake is done.
  /// @errors  those of the link.
  Status receive(TimePoint now, const std::function<void(const Received&)>& take);

  /// Sends a command.
  /// @errors  those of ByteLink::write().
  Status send(const Packet& packet) { return link_.write(packet.view()); }

  /// Returns what the robot has said of itself. @pre  the handshake is done.
  [[nodiscard]] const Identity& identity() const { return identity_; }
  /// Returns the rate of the line [baud].
  [[nodiscard]] std::uint32_t rate() const { return rates_[rate_]; }
  [[nodiscard]] const framing::Statistics& statistics() const { return frames_.statistics(); }

 private:
  enum class Step { sync0, sync1, sync2, first_packet, closing, done };

  Status say(Step step, TimePoint now);
  Status take(std::span<const std::uint8_t> body, TimePoint now);
  Status greet(std::span<const std::uint8_t> body, TimePoint now);
  Result<bool> try_again(TimePoint now);
  [[nodiscard]] Error nobody() const;

  link::ByteLink& link_;
  const std::vector<std::uint32_t> rates_;
  LineFrames frames_{kProtocol};
  Step step_ = Step::sync0;
  std::size_t rate_ = 0;
  int tries_ = 0;  // at this rate
  TimePoint deadline_{};
  bool heard_ = false;  // a packet, at whatever rate
  Identity identity_;
};

}  // namespace orca::hw::p2os
