// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>

#include "orca/base/executive.hpp"
#include "orca/base/mutex.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"

namespace orca {

/// The pace of a run in virtual time: how fast virtual time passes by the wall clock. It decides when the executive goes on to
/// the next moment and nothing else, so a run does the same at any pace.
///
/// Thread contract: any thread.
class Pace {
 public:
  /// As fast as the machine can.
  static constexpr double kFast = std::numeric_limits<double>::infinity();
  /// The slowest and the fastest pace that is kept by the clock [s of virtual time per s].
  static constexpr double kSlowest = 0.01;
  static constexpr double kFastest = 1000.0;

  /// The pace at one moment. A plain value.
  struct State {
    double factor = kFast;                ///< [s of virtual time per s]; 0: paused; kFast: as fast as it can.
    bool steps = false;                   ///< It lets time pass for a step, and is paused then.
    TimePoint time;                       ///< Virtual time until which the run has come.
    std::optional<TimePoint> finished{};  ///< Virtual time at which finish() was called.
  };

  /// @param factor  0, kFast, or from kSlowest to kFastest.
  explicit Pace(double factor) : factor_(factor) {}

  /// Lets time pass at another pace from now on; 0: not at all.
  /// @errors  invalid_argument.
  Status set(double factor);
  /// Lets a span of virtual time pass, as fast as it can, counted from the time that look() returns. Then it is paused.
  /// @errors  invalid_argument unless the span is positive.
  Status step(Duration span);
  /// Lets time pass as fast as it can, whatever is asked later: the run comes to its end.
  void finish();
  [[nodiscard]] State look() const;

  // For the executive.

  /// Returns how long virtual time must not pass on to its next moment, unless the pace changes; nothing: it may pass at once,
  /// and is taken to have done so.
  /// @param next  not before that of the last call that returned nothing.
  /// @return [s of the steady clock]
  [[nodiscard]] std::optional<TimePoint> hold_before(TimePoint next);
  /// Calls a function whenever the pace has changed; null: none any more. It must not use the pace.
  void on_change(std::function<void()> changed);

 private:
  [[nodiscard]] TimePoint time_at(TimePoint wall) const ORCA_REQUIRES(mutex_);
  void begin_anew(double factor) ORCA_REQUIRES(mutex_);

  mutable Mutex mutex_;
  double factor_ ORCA_GUARDED_BY(mutex_);
  TimePoint since_ ORCA_GUARDED_BY(mutex_);                      // virtual time at which this pace has begun
  std::optional<TimePoint> since_wall_ ORCA_GUARDED_BY(mutex_);  // nothing: not yet
  TimePoint reached_ ORCA_GUARDED_BY(mutex_);                    // the moment at which the executive is
  TimePoint next_ ORCA_GUARDED_BY(mutex_);                       // the one that it waits for
  std::optional<TimePoint> step_end_ ORCA_GUARDED_BY(mutex_);    // while it steps
  std::optional<TimePoint> finished_ ORCA_GUARDED_BY(mutex_);    // when finish() was called
  std::function<void()> changed_ ORCA_GUARDED_BY(mutex_);
};

/// Makes an executive in virtual time that keeps a pace.
/// @param pace  outlives it.
/// @errors  as make_executive(); invalid_argument for the steady clock.
[[nodiscard]] Result<std::unique_ptr<Executive>> make_paced_executive(const ExecutiveOptions& options,
                                                                      Pace& pace);

}  // namespace orca
