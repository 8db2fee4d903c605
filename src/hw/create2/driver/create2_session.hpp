// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/create2/command.hpp"
#include "orca/hw/create2/sensors.hpp"
#include "orca/hw/line_frames.hpp"
#include "orca/hw/line_session.hpp"

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
class Create2Session final : public LineSession {
 public:
  /// A function that takes the readings of a frame, and when its first byte arrived.
  using Take = std::function<void(const Sensors&, TimePoint stamp)>;

  /// @param link   outlives the object.
  /// @param rates  [baud] to be tried, in this order.
  Create2Session(link::ByteLink& link, const std::vector<std::uint32_t>& rates)
      : link_(link), search_(link, rates) {}

  /// Wheels that turn stop with it.
  Status begin(TimePoint now) override;
  Result<bool> advance(TimePoint now) override;
  [[nodiscard]] TimePoint next() const override { return deadline_; }
  [[nodiscard]] LineCounts counts() const override { return counts_of(frames_.statistics()); }

  /// Reads what there is and hands out the frames. @pre  the robot has been found.
  /// @errors  those of the link.
  Status receive(TimePoint now, const Take& take);
  /// Sends a command.
  /// @errors  those of ByteLink::write().
  Status send(const Command& command) { return link_.write(command.view()); }

  /// Returns the rate of the line [baud].
  [[nodiscard]] std::uint32_t rate() const { return search_.rate(); }

 private:
  Status call(TimePoint now);
  [[nodiscard]] Error nobody() const;

  link::ByteLink& link_;
  RateSearch search_;
  LineFrames frames_{kProtocol};
  TimePoint deadline_{};
  int good_frames_ = 0;  // since the robot was called
  bool found_ = false;
  int mode_offset_ = 0;  // of the modes that it reports
};

}  // namespace orca::hw::create2
