// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "orca/patterns/push.hpp"

namespace orca {

/// The moment at which objects that come at different times are fused (thesis 7.4).
enum class Fusing {
  all,    ///< When all subjects have new data: for modest differences in timing.
  any,    ///< At every new object, with the latest of the others.
  clock,  ///< At fixed times, with the latest of all.
};

/// A wait for several PushProxies of one component (thesis 7.4, Fig. 7.11). It only waits; the proxies take
/// the objects.
///
/// Every wait throws Interrupted when the component must leave its lap.
/// Thread contract: the component's strand.
class Synchronizer {
 public:
  void add(PushProxyHandle& subject);
  void remove(PushProxyHandle& subject);

  /// Blocks until this subject has new data.
  /// @pre  the subject was added.
  void wait(PushProxyHandle& subject);
  /// Does the same, but waits at most `limit`.
  /// @return whether the subject has new data.
  bool wait(PushProxyHandle& subject, Duration limit);

  /// Blocks until any subject has new data, and returns it; if there are several, the one that was added
  /// first.
  /// @pre  at least one subject was added, for this and all that follow.
  PushProxyHandle& wait();
  /// Does the same, but waits at most `limit`; null when the time has passed.
  PushProxyHandle* wait(Duration limit);

  /// Blocks until all subjects have new data.
  void wait_all();
  /// Does the same, but waits at most `limit`.
  /// @return whether all have new data.
  bool wait_all(Duration limit);

  /// Blocks until the policy says that it is time to fuse.
  /// @param period  of the clock [s]. The clock starts at the first call; missed ticks are skipped.
  void wait_to_fuse(Fusing policy, Duration period = Duration{0});

 private:
  [[nodiscard]] Strand& strand() const;
  [[nodiscard]] TimePoint deadline_in(Duration limit) const;
  [[nodiscard]] bool all_new() const;
  [[nodiscard]] PushProxyHandle* first_new() const;
  PushProxyHandle* wait_any_until(TimePoint deadline);
  void wait_for_tick(Duration period);

  std::vector<PushProxyHandle*> subjects_;
  TimePoint last_tick_{};
};

}  // namespace orca
