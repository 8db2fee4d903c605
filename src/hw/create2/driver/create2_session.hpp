// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/create2/command.hpp"
#include "orca/hw/create2/sensors.hpp"
#include "orca/hw/create2/stream.hpp"
#include "orca/hw/line_frames.hpp"
#include "orca/hw/link/byte_link.hpp"

namespace orca::hw::create2 {

/// The connection to a Create 2: finds the rate of the line, opens the robot's interface in passive mode, and takes the frames of
/// a stream that it asks for.
///
/// A slow line carries fewer packets: without the charge of the battery. Of firmware that reports its mode plus 1, as some Roombas 600
/// have, the true mode is handed out.
///
/// Thread contract: not synchronised; the container's strand.
/// @source  "iRobot Create 2 Open Interface (OI) Specification based on the iRobot Roomba 600", 2016; libcreate, its workaround for
///          the reported mode.
class Create2Session {
 public:
  /// A function that takes the readings of a frame, and when its first byte arrived.
  using Take = std::function<void(const Sensors&, TimePoint stamp)>;

  /// @param link   outlives the object.
  /// @param rates  [baud] to be tried, in this order; one that the link ignores is enough for a connection.
  Create2Session(link::ByteLink& link, std::vector<std::uint32_t> rates);

  /// Begins anew with the first rate. Wheels that turn stop with it. @pre  the link is open.
  Status begin(TimePoint now);
  /// Goes on with the search for the robot.
  /// @return whether its stream has begun.
  /// @errors  not_found if nothing comes at any rate, with what to do; those of the link.
  Result<bool> advance(TimePoint now);
  /// Returns when advance() has something to do, even if nothing comes.
  [[nodiscard]] TimePoint next() const { return deadline_; }

  /// Reads what there is and hands out the frames. @pre  the robot has been found.
  /// @errors  those of the link.
  Status receive(TimePoint now, const Take& take);
  /// Sends a command.
  /// @errors  those of ByteLink::write().
  Status send(const Command& command) { return link_.write(command.view()); }

  /// Returns the rate of the line [baud].
  [[nodiscard]] std::uint32_t rate() const { return rates_[rate_]; }
  [[nodiscard]] const framing::Statistics& statistics() const { return frames_.statistics(); }

 private:
  Status call(TimePoint now);
  Status try_again(TimePoint now);
  [[nodiscard]] Error nobody() const;

  link::ByteLink& link_;
  const std::vector<std::uint32_t> rates_;
  LineFrames frames_{kProtocol};
  std::size_t rate_ = 0;
  int tries_ = 0;  // at this rate
  TimePoint deadline_{};
  int good_frames_ = 0;  // since the robot was called
  bool found_ = false;
  int mode_offset_ = 0;  // of the modes that it reports
};

}  // namespace orca::hw::create2
