// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "orca/base/strand.hpp"
#include "orca/patterns/endpoints/cores.hpp"
#include "orca/patterns/endpoints/published.hpp"

namespace orca {

/// The counters of the laps of one component that take time in virtual time, from its start until now. A plain value.
struct ComputingCounters {
  std::uint64_t laps = 0;      ///< Laps that have begun.
  Duration time{0};            ///< [s] that they took together, by the run's clock.
  Duration waited{0};          ///< [s] for which they waited for a core before that.
  std::uint64_t overruns = 0;  ///< Laps that were computing still when the next one was due already.
};

/// The time that a component's laps compute, where the graph says that they take some. It serves virtual time, in which code
/// itself takes none.
///
/// The code of a lap runs at one instant, so it sees what there was at the beginning. Objects that it gives out wait until its
/// computing is over, and so does the end of a lap that gives out nothing. Objects that arrive meanwhile wait in their queues.
///
/// Thread contract: counters() from any thread; the rest from the component's strand.
class Computing {
 public:
  explicit Computing(Strand& strand) : strand_(strand) {}

  /// Lets the laps compute on these cores, with those of other components. @thread  before the component runs.
  /// @param cores  outlive this object.
  void share(Cores& cores) { cores_ = &cores; }

  /// Begins a lap that computes for this long [s]; 0 s: it takes no time, and is not counted.
  void begin(Duration time);
  /// Lets the time pass that the present lap still has to compute. To be called before it gives anything out, and at its end.
  /// @return false if the strand must end before that, so that nobody will hear what the lap computes.
  bool finish() { return owed_ == Duration{0} || spend(); }
  /// Forgets the lap, which was given up before it had given out anything.
  void give_up() { owed_ = Duration{0}; }
  /// Counts that the next lap was due before the present one had computed.
  void note_overrun() { ++overruns_; }

  [[nodiscard]] ComputingCounters counters() const {
    return {laps_, Duration(time_), Duration(waited_), overruns_};
  }

 private:
  bool spend();

  Strand& strand_;
  Cores* cores_ = nullptr;  // null: each lap has one of its own
  Duration owed_{0};
  Published<std::uint64_t> laps_;
  Published<Duration::rep> time_;
  Published<Duration::rep> waited_;
  Published<std::uint64_t> overruns_;
};

}  // namespace orca
