// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/line_frames.hpp"
#include "orca/hw/line_session.hpp"
#include "orca/hw/nomad_scout/state.hpp"

namespace orca::hw::nomad_scout {

/// An answer of the robot that holds its state.
struct Answer {
  Type type = Type::get_state;  ///< Type of the command that it answers.
  State state;
  TimePoint stamp{};  ///< When its first byte arrived.
};

/// The connection to a Scout: finds the rate of the line, and then sends one command after the other, each when the one before it
/// was answered or has waited too long.
///
/// There is no handshake: a robot that answers with its state is connected. What a line sends back to us (local echo) is
/// ignored.
///
/// Thread contract: not synchronised; the container's strand.
/// @source  Nomadic Technologies, Nomad host protocol.
class ScoutSession final : public LineSession {
 public:
  using Take = std::function<void(const Answer&)>;

  /// @param link   outlives the object.
  /// @param rates  [baud] to be tried, in this order.
  ScoutSession(link::ByteLink& link, const std::vector<std::uint32_t>& rates)
      : link_(link), search_(link, rates) {}

  Status begin(TimePoint now) override;
  /// @errors  those of LineSession; data_loss if it is another robot.
  Result<bool> advance(TimePoint now) override;
  /// Returns when the command that waits for its answer has waited too long; kForever if none waits.
  [[nodiscard]] TimePoint next() const override { return asked_ ? deadline_ : kForever; }
  [[nodiscard]] LineCounts counts() const override { return counts_of(frames_.statistics()); }

  /// Returns what the robot answered first. @pre  it has been found.
  [[nodiscard]] const Answer& first() const { return *first_; }

  /// Reads what there is and hands out the answers. @pre  the robot has been found.
  /// @errors  unavailable if the robot refuses a command again and again; those of the link.
  Status receive(TimePoint now, const Take& take);

  /// Returns whether a command may be sent: the last one was answered, or had waited too long when receive() was called.
  [[nodiscard]] bool is_free() const { return !asked_; }
  /// Sends a command, whose answer is awaited. One that was asked before is not awaited any more, but its answer is taken if
  /// it comes.
  /// @errors  those of ByteLink::write().
  Status ask(const Packet& packet, TimePoint now);
  /// Sends a command whose answer is of no interest.
  Status tell(const Packet& packet) { return link_.write(packet.view()); }

  /// Returns the rate of the line [baud].
  [[nodiscard]] std::uint32_t rate() const { return search_.rate(); }

 private:
  Status read(TimePoint now, const Take& take);
  Status take_frame(const framing::Frame& frame, TimePoint stamp, const Take& take);
  Status take_refusal();
  Status call(TimePoint now);
  [[nodiscard]] Error nobody() const;

  link::ByteLink& link_;
  RateSearch search_;
  LineFrames frames_{kProtocol};
  bool heard_ = false;  // a packet, at whatever rate
  std::optional<Answer> first_;
  std::optional<Type> asked_{};  // awaits its answer
  TimePoint deadline_{};
  int refusals_ = 0;  // NAKs one after the other
};

}  // namespace orca::hw::nomad_scout
