// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "members/member.hpp"
#include "orca/base/result.hpp"
#include "orca/host/stop_signal.hpp"
#include "orca/supervisor/moment.hpp"

namespace orca::supervisor {

/// What a process may take to end if somebody waits for it.
inline constexpr EndLimits kHurry{1900ms, 500ms};

/// The end of all processes of a run: each is ordered to end, and hurried or ended by force if that takes too long for those
/// who wait for it.
///
/// Thread contract: the supervisor's thread.
class TakingDown {
 public:
  /// @param members  all; outlives the object, as `stop` does.
  /// @param stop     a request means that somebody waits.
  TakingDown(const Members& members, const host::StopSignal& stop) : members_(members), stop_(stop) {}

  /// Orders all to end.
  void begin(Moment now);
  /// Hurries those that still run if somebody has begun to wait. Call it again and again.
  /// @return whether none runs any more.
  [[nodiscard]] bool is_done(Moment now);

 private:
  void limit(Moment now, const EndLimits& limits) const;

  const Members& members_;
  const host::StopSignal& stop_;
  bool hurries_ = false;
};

}  // namespace orca::supervisor
