// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "orca/patterns/push.hpp"

namespace orca {

/// The moment at which objects that come at different times are fused (thesis 7.4).
enum class Fusing {
  all,     ///< When all subjects have new data: for modest differences in timing.
  any,     ///< At every new object, with the latest of the others.
  clock,   ///< At fixed times, with the latest of all.
  stamps,  ///< When the oldest objects that wait at all subjects were sensed at one moment.
};

/// A wait for several PushProxies and port arrays of one component (thesis 7.4, Fig. 7.11). It only waits; the
/// component takes the objects from its ports.
///
/// A port array counts as the servers that it is subscribed to at the moment: one that the component subscribes
/// to later is waited for from then on, and one that it leaves no longer. An array that is subscribed to nobody
/// has nothing new, and neither has a port that is not connected.
///
/// Every wait throws Interrupted when the component must leave its lap.
/// Thread contract: the component's strand.
class Synchronizer {
 public:
  void add(PushSubject& subject);
  void remove(PushSubject& subject);

  /// Blocks until this subject has new data; an array, from any server.
  /// @pre  the subject was added.
  void wait(PushSubject& subject);
  /// Does the same, but waits at most `limit`.
  /// @return whether the subject has new data.
  bool wait(PushSubject& subject, Duration limit);

  /// Blocks until any subject has new data, and returns it; if there are several, the one that was added
  /// first.
  /// @pre  at least one subject was added, for this and all that follow.
  PushSubject& wait();
  /// Does the same, but waits at most `limit`; null when the time has passed.
  PushSubject* wait(Duration limit);
  /// Does the same, but waits only as long as `unless` is false; null when it is true, or the time has passed. It is
  /// evaluated whenever something arrives, and when a server's process is replaced.
  PushSubject* wait(Duration limit, const std::function<bool()>& unless);

  /// Blocks until all subjects have new data; arrays, from every server that they are subscribed to.
  void wait_all();
  /// Does the same, but waits at most `limit`.
  /// @return whether all have new data.
  bool wait_all(Duration limit);
  /// Does the same, but waits only as long as `unless` is false. It is evaluated whenever something arrives.
  bool wait_all(Duration limit, const std::function<bool()>& unless);

  /// Blocks until the oldest objects that wait at the subjects belong to one moment: their stamps differ by at
  /// most `within`. An object's stamp says when it was sensed; one without a stamp counts from its creation_time.
  /// The component then takes these objects with get_update() or take().
  ///
  /// Objects that are too old to match anything that comes are dropped and counted as EdgeCounters::unmatched.
  /// The earliest of the sets that match counts. If the fastest subject sends every `p`, `within` = `p` / 2 makes
  /// it the closest as well.
  /// @pre  the stamps of one server do not go back in time. Each edge has room for the objects that must wait for
  ///       others: an edge that keeps only the latest loses them.
  void wait_matching(Duration within);
  /// Does the same, but waits at most `limit`.
  /// @return whether the objects belong to one moment.
  bool wait_matching(Duration within, Duration limit);

  /// Blocks until the policy says that it is time to fuse.
  /// @param time  [s] period of the clock, or largest difference of the stamps. The clock starts at the first
  ///              call; missed ticks are skipped.
  void wait_to_fuse(Fusing policy, Duration time = Duration{0});

 private:
  using Endpoints = std::vector<PushClientEndpoint*>;

  [[nodiscard]] const Endpoints& endpoints();
  [[nodiscard]] Strand& strand() const;
  [[nodiscard]] TimePoint deadline_in(Duration limit) const;
  [[nodiscard]] PushSubject* first_new() const;
  PushSubject* wait_any_until(TimePoint deadline);
  bool wait_matching_until(Duration within, TimePoint deadline);
  void wait_for_tick(Duration period);

  std::vector<PushSubject*> subjects_;
  Endpoints endpoints_;  // of the subjects; kept for its memory
  TimePoint last_tick_{};
};

}  // namespace orca
