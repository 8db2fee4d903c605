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
#include "orca/hw/line_session.hpp"
#include "orca/hw/p2os/command.hpp"
#include "orca/hw/p2os/config.hpp"
#include "orca/hw/p2os/packet.hpp"

namespace orca::hw::p2os {

/// A packet of the robot, and when its first byte arrived.
struct Received {
  std::span<const std::uint8_t> body;
  TimePoint stamp;
};

/// The connection to a robot: finds the rate of the line, makes the handshake, asks for the controller's settings, changes to a faster
/// rate, and then passes packets on.
///
/// The handshake is SYNC0, SYNC1, SYNC2, each answered, then OPEN, whereupon the robot begins to send. A controller that is still
/// open from an earlier run sends at once: it is closed first.
///
/// The rate is changed to kFastRate where the robot has a slower one and says that it returns to its own when the connection ends: so
/// every program finds it again. If nothing is heard at the faster rate, both go back, and after two such attempts, or losses soon
/// after a change, the robot's own rate is kept. A robot that is lost is looked for at the rate that it had last, and at its own.
///
/// Thread contract: not synchronised; the container's strand.
/// @source  Pioneer 2 operations manual, "Connecting"; order of rates and times of public drivers.
class Session final : public hw::LineSession {
 public:
  /// The rate [baud] that public drivers change to: their parameters name it for all models.
  static constexpr std::uint32_t kFastRate = 38400;

  /// @param link   outlives the object.
  /// @param rates  [baud] to be tried, in this order; one that the link ignores is enough for a connection.
  /// @param speeds_up  whether a slower rate may be changed to kFastRate.
  Session(link::ByteLink& link, std::vector<std::uint32_t> rates, bool speeds_up = true);

  Status begin(TimePoint now) override;
  /// It also sends packets then.
  Result<bool> advance(TimePoint now) override;
  [[nodiscard]] TimePoint next() const override { return deadline_; }
  [[nodiscard]] LineCounts counts() const override { return counts_of(frames_.statistics()); }

  /// Reads what there is and hands out the packets. @pre  the handshake is done.
  /// @errors  those of the link.
  Status receive(TimePoint now, const std::function<void(const Received&)>& take);

  /// Sends a command.
  /// @errors  those of ByteLink::write().
  Status send(const Packet& packet) { return link_.write(packet.view()); }

  /// Returns what the robot has said of itself. @pre  the handshake is done.
  [[nodiscard]] const Identity& identity() const { return identity_; }
  /// Returns the settings of its controller; nothing: it does not tell them. @pre  the handshake is done.
  [[nodiscard]] const std::optional<Config>& config() const { return config_; }
  /// Returns the rate of the line [baud].
  [[nodiscard]] std::uint32_t rate() const { return rate_; }
  /// Returns why the rate is not kFastRate; empty: it is, or there is no need.
  [[nodiscard]] const std::string& rate_trouble() const { return rate_trouble_; }

 private:
  enum class Step {
    sync0,
    sync1,
    sync2,
    first_packet,
    closing,   // an old connection
    settings,  // are asked for
    faster,    // it is told to change its rate
    fast,      // it is listened to at the new rate
    slower,    // it is told to change back
    slow,      // it is listened to at the old rate
    done
  };

  Status search(TimePoint now);
  Status call(TimePoint now);
  Status say(Step step, TimePoint now);
  Status take(std::span<const std::uint8_t> body, TimePoint now);
  Status greet(std::span<const std::uint8_t> body, TimePoint now);
  Status choose_rate(TimePoint now);
  Result<bool> can_be_fast();
  Status finish(TimePoint now);
  Status change(std::uint32_t baud, Step step, TimePoint now);
  Status set_rate(std::uint32_t baud);
  Status try_again(TimePoint now);
  Status miss(TimePoint now);
  Status lose_at_change(TimePoint now);
  Status call_again(TimePoint now);
  [[nodiscard]] Error nobody() const;

  link::ByteLink& link_;
  const std::vector<std::uint32_t> rates_;
  const bool speeds_up_;
  LineFrames frames_{kProtocol};
  Step step_ = Step::sync0;
  std::vector<std::uint32_t> order_;  // of the rates at which it is called
  std::size_t call_ = 0;              // the present one of these
  int closings_ = 0;                  // of old connections
  int tries_ = 0;                     // to get its settings
  std::uint32_t rate_ = 0;            // of the line
  std::uint32_t last_rate_ = 0;       // at which it worked last
  std::optional<TimePoint> fast_since_;
  int misses_ = 0;  // of the faster rate
  bool is_lost_at_change_ = false;
  std::string rate_trouble_;
  std::optional<Config> config_;
  TimePoint deadline_{};
  bool heard_ = false;  // a packet, at whatever rate
  Identity identity_;
};

}  // namespace orca::hw::p2os
