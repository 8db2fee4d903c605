// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/line_frames.hpp"
#include "orca/hw/line_session.hpp"
#include "orca/hw/rplidar/receiver.hpp"
#include "orca/hw/rplidar/request.hpp"

namespace orca::hw::rplidar {

/// Which scans are asked for.
enum class ScanMode {
  automatic,  ///< Express scans if the scanner knows them.
  standard,   ///< A point is a node: half as many, with the strength of the echo.
  express,    ///< Points in capsules.
};

/// The connection to an RPLIDAR: stops what is being sent, asks who is there, resets a scanner that reports an error, once, and
/// asks for a scan, during which it passes points on.
///
/// The motor turns from scan() to rest(): the line DTR of its adapter stops it. The scanner sends no point before the motor turns
/// evenly, so a scan without points for kSpinTime is one whose motor does not turn.
///
/// Thread contract: not synchronised; the container's strand.
/// @source  SLAMTEC, "RPLIDAR Interface Protocol and Application Notes", for the A1 and A2; DTR: the vendor's SDK.
class RplidarSession final : public LineSession {
 public:
  /// A function that takes a point, and when it was measured.
  using Take = std::function<void(const Point&, TimePoint stamp)>;

  static constexpr Duration kSpinTime = 6s;

  /// @param link  outlives the object.
  RplidarSession(link::ByteLink& link, ScanMode mode);

  /// The motor stands from then on.
  Status begin(TimePoint now) override;
  /// @errors  those of LineSession; failed_precondition if the scanner reports an error after a reset, too, or does not know the
  ///          wished mode, each with what to do.
  Result<bool> advance(TimePoint now) override;
  /// Asks for a scan. Points come when the motor turns evenly. @pre  advance() has returned true.
  Status scan(TimePoint now);
  /// Ends the scan and stops the motor, as far as the line still works.
  void rest();
  /// Reads what there is, hands out the points, and goes on with the request for a scan.
  /// @errors  deadline_exceeded if no scan or no point comes, with what to do; those of the link.
  Status receive(TimePoint now, const Take& take);
  /// Also when receive() has something to do.
  [[nodiscard]] TimePoint next() const override { return deadline_; }

  [[nodiscard]] const DeviceInfo& info() const { return info_; }
  [[nodiscard]] const Health& health() const { return health_; }
  /// Returns whether points come, or came last, in capsules.
  [[nodiscard]] bool is_express() const { return express_; }
  /// Returns whether points have come since scan().
  [[nodiscard]] bool scans() const { return step_ == Step::flow; }
  /// Returns when the first byte left the scanner of what brought the last points. @pre  points have come.
  [[nodiscard]] TimePoint sent() const { return sent_; }
  [[nodiscard]] LineCounts counts() const override;

 private:
  enum class Step { quiet, info, health, boot, rates, done, hush, scan, spin, flow };

  Status say(Step step, TimePoint now);
  Status say_again(TimePoint now);
  Status request(Step step);
  [[nodiscard]] static Duration patience(Step step);
  Status send(Request request);
  Status read(TimePoint now, const Take& take);
  void hear(const Event& event, TimePoint now, const Take& take);
  void hear_point(const Point& point, TimePoint now, const Take& take);
  Status take_answer(TimePoint now);
  Status take_health(TimePoint now);
  Status choose(TimePoint now);
  Status go_on(TimePoint now);
  Status give_up(TimePoint now);
  Status refuse_express(TimePoint now);
  [[nodiscard]] Duration age_of_point() const;
  [[nodiscard]] Error nobody() const;

  link::ByteLink& link_;
  const ScanMode mode_;
  Receiver receiver_;
  LineCounts before_;  // of the scans before the present one
  Step step_ = Step::quiet;
  int tries_ = 0;  // of this step
  TimePoint deadline_{};
  bool was_reset_ = false;
  bool answered_ = false;  // the present step
  bool has_rates_ = false;
  bool express_ = false;
  std::uint64_t heard_bytes_ = 0;  // since begin()
  Arrivals arrivals_;
  TimePoint sent_{};
  DeviceInfo info_;
  Health health_;
  SampleRates rates_;
  int place_in_capsule_ = 0;  // of the next point
};

}  // namespace orca::hw::rplidar
