// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control_desk.hpp"
#include "machines/neighbours.hpp"
#include "machines/trading.hpp"
#include "members/conductor.hpp"
#include "members/ledger.hpp"
#include "members/member.hpp"
#include "orca/host/conclusion.hpp"
#include "orca/supervisor/heartbeats.hpp"
#include "starting/company.hpp"
#include "starting/starter.hpp"

namespace orca::supervisor {

/// Brings processes up: all of them at the start of a run, and later those that are started again, or on demand.
///
/// Thread contract: the supervisor's thread.
class Arrivals {
 public:
  /// What it works with. All of it outlives the object.
  struct Place {
    Conductor& conductor;
    Starter& starter;
    Heartbeats& beats;
    Ledger& ledger;
    ControlDesk& control;
    host::Conclusion& conclusion;
    std::optional<Neighbours>& neighbours;
    Trading& trading;
    const graph::Supervision& rules;
    const std::string& log_name;
    std::size_t recorders;  ///< That are to hear of everything from the beginning.
    /// Takes a process that could not even be started, later than at the start of the run.
    std::function<void(Member&, const Error&)> could_not_start;
  };

  explicit Arrivals(Place place) : place_(std::move(place)) {}

  /// Starts processes that do not run, all together. The first ones are those with which the run begins.
  void start(const Members& members);
  /// Goes on with a run that another supervisor has begun: none of the processes that are started is of its first ones.
  void take_over();

  /// Returns when everything had come up; nothing if it has not yet.
  [[nodiscard]] std::optional<TimePoint> up_since() const { return up_since_; }

 private:
  void bring_up(Starter::Begun& begun, bool is_first);
  bool configure_all(const Company& company, const StartOrder& components, bool is_first);
  void wait_for_recorders(const Company& company) const;
  void watch(const Members& members);
  void built(const Members& members);
  void came_up(const Members& members, bool is_first);
  void did_not_come_up(Member& culprit, const Error& error);

  const Place place_;
  bool has_begun_ = false;
  std::optional<TimePoint> up_since_;
};

}  // namespace orca::supervisor
