// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orca/component.hpp"
#include "orca/goals/route_proxy.hpp"
#include "orca/goals/trip.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"
#include "orca/patterns/synchronizer.hpp"

namespace orca::go {

/// The side of whoever wants a robot to be somewhere, in one component (thesis 11.1). For each trip it begins a mission, subscribes
/// to its results, sends the points to who drives (a Goto, a planner, a Porter) and the list of behaviours to the fuser, and says what
/// became of it. Then the robot stands, and the mission is over. A trip without via points is laid along a route, if there is a
/// RouteServer, and laid again when a door on it is found shut or a leg of it is blocked. If a receiver is in another process that is started again
/// meanwhile, it gets what it needs once more.
///
/// A member of the component: it declares the ports and parameters that all such components have.
///
/// Thread contract: as the component that it belongs to.
class MissionProxy {
 public:
  /// The result of a mission.
  struct Ending {
    bool reached = false;
    std::uint64_t mission = 0;  ///< Its id.
    std::string
        reason;  ///< Why it is not, for people: "blocked: ..."; the words before the colon are one of a few.
  };

  MissionProxy(Component& owner, ComponentHost& host);
  ~MissionProxy();
  MissionProxy(const MissionProxy&) = delete;
  MissionProxy& operator=(const MissionProxy&) = delete;

  /// Connects its parts. @pre  called once, from the component's configure().
  /// @errors  the fuser does not know the behaviours.
  [[nodiscard]] Status configure();
  /// Asks the fuser about the behaviours, unless it knew the same ones before; for params_changed().
  /// @errors  the fuser does not know them.
  [[nodiscard]] Status check_behaviours();
  /// Completes the places of a trip that are given by their names, as far as there is an answer now.
  /// @errors  invalid_argument: nobody is there to say where they are, or there is no such place.
  [[nodiscard]] Status look_up(Trip& trip);

  /// Sends the robot on a trip.
  /// @param time_limit [s]  for the way to the goal.
  /// @return its ending, if nobody takes the goal.
  /// @pre  not active()
  [[nodiscard]] std::optional<Ending> begin(const Trip& trip, double time_limit);
  /// Returns whether a trip has begun and has not ended.
  [[nodiscard]] bool active() const { return drive_ != nullptr; }
  /// Returns the trip. @pre  active()
  [[nodiscard]] const Trip& trip() const;
  /// Waits until something has happened to the trip, at most for `longest`.
  /// @return its ending, if that was it.
  /// @pre  active()
  [[nodiscard]] std::optional<Ending> wait(Duration longest);
  /// Gives up the trip, if there is one: the robot stands.
  /// @param reason  for people, after "cancelled: ".
  void cancel(const std::string& reason);
  /// Forgets the trip, if there is one: the component stops.
  void stop();

 private:
  struct Drive;

  Status find_places(Trip& trip);
  Status find_place(Place& place);
  Status send_due(double time_limit);
  Status send_clients(const std::vector<std::string>& names);
  [[nodiscard]] bool is_due() const;
  void send_again();
  bool lay_route();
  void follow_route();
  bool find_other_way(const idl::GoalFailed& failed);
  PushSubject* next_result(Duration longest);
  std::optional<Ending> take_result(const PushSubject& port);
  void note_way(const idl::Path& path);
  Ending give_up(idl::GoalFailure kind, const std::string& reason);
  Ending end(const Ending& ending);
  [[nodiscard]] bool may_come_back() const;
  [[nodiscard]] TimePoint last_moment() const;
  [[nodiscard]] bool is_ours(const idl::OrcaObject& result) const;

  ComponentHost& host_;

  SendProxy<idl::GoalPoint> goto_;
  SendProxy<idl::ClientList> clients_;
  QueryProxy<idl::ClientList, idl::ClientList> check_;
  QueryProxy<idl::Ask, idl::GoalPoint> places_;
  PushProxy<idl::Arrived> arrived_;
  PushProxy<idl::GoalFailed> failed_;
  PushProxy<idl::Path> path_;
  PushServer<idl::GoalFailed> given_up_;
  RouteProxy routes_;

  Param<std::vector<std::string>> behaviours_;
  Param<double> reach_radius_;
  Param<double> via_radius_;
  Param<double> reach_angle_;

  std::vector<std::string> checked_;  // behaviours that the fuser knows
  Synchronizer results_;
  std::unique_ptr<Drive> drive_;
};

}  // namespace orca::go
