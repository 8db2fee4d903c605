// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "goal_list.hpp"
#include "orca/base/live_line.hpp"
#include "orca/base/text.hpp"
#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"
#include "orca/patterns/synchronizer.hpp"
#include "outbox.hpp"
#include "prompt.hpp"

namespace {

using orca::command::Agenda;
using orca::command::Outbox;
using orca::command::Route;

constexpr orca::Duration kRoomLimit = std::chrono::seconds(5);          // for Goto to take a point
constexpr orca::Duration kGrace = std::chrono::seconds(2);              // for Goto to say that the time is up
constexpr orca::Duration kRetryAfter = std::chrono::milliseconds(200);  // for receivers that come up
constexpr orca::Duration kRest = std::chrono::seconds(1);  // in rounds, after a goal that was not reached

// A goal that the robot is on its way to.
struct Drive {
  Route route;
  Outbox outbox;
  std::uint64_t mission;
  orca::TimePoint limit;  // for Goto to reach it
};

/// A component that sends the robot to one goal after the other, taken from a parameter, a file or a prompt
/// (thesis 11.1). For each goal it begins a mission, subscribes to its results, sends the coordinates to Goto
/// and the list of behaviours to the fuser, and waits. After the result it unsubscribes and clears the list.
/// If Goto or the fuser is in another process that is started again meanwhile, it gets what it needs once more.
/// While the robot drives, other goals may be set. When there are no more goals it is done, or has failed if one was not reached.
class Command final : public orca::Component {
 public:
  explicit Command(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    stay_active(true);
    results_.add(arrived_);
    results_.add(failed_);
    results_.add(path_);
    std::vector<Route> routes;
    for (const std::string& text : *goals_)
      if (const orca::Status added = add(text, routes); !added.ok()) return goals_.refuse(added.error());
    if (!goals_file_->empty())
      if (const orca::Status read = read_file(routes); !read.ok()) return goals_file_.refuse(read.error());
    listed_ = *goals_;
    asks_ = listed_.empty() && goals_file_->empty();
    agenda_.set(std::move(routes));
    return check_behaviours();
  }

  // Asks the fuser whether it knows the behaviours, because a list with a wrong name would be refused on the way.
  orca::Status check_behaviours() {
    if (!check_.connected()) return orca::ok();
    auto list = check_.loan();
    list->clients() = *behaviours_;
    const auto checked = check_.query(std::move(list));
    if (checked) return orca::ok();
    if (checked.error().code == orca::Code::not_found) return behaviours_.refuse(checked.error());
    return orca::fail(checked.error().code,
                      "cannot ask whether its behaviours are there: " + checked.error().message +
                          "; let it come up after the fuser, with start_after");
  }

  // A lap begins a goal, or waits for something to happen to it. While it waits, orders and objects that are sent are taken.
  orca::Outcome work() override {
    if (drive_) {
      await();
      return orca::again();
    }
    while (agenda_.next(rounds()) == nullptr) {
      if (!asks_) return conclude();
      if (!ask()) return conclude();
    }
    if (std::exchange(rests_, false)) sleep(kRest);
    begin(*agenda_.next(rounds()));
    return orca::again();
  }

  [[nodiscard]] std::size_t rounds() const { return static_cast<std::size_t>(*rounds_); }

  orca::Outcome conclude() {
    if (emptied_) wait_until([] { return false; }, std::chrono::hours(1));  // an order ends the lap
    if (emptied_) return orca::again();
    if (missed_ == 0) return orca::done();
    return orca::failed("not reached: " + orca::listed(unreached_) + " (" + std::to_string(missed_) + " of " +
                        std::to_string(tried_) + " goals)");
  }

  // Sends the robot to a goal.
  void begin(const Route& route) {
    agenda_.begin();
    ++tried_;
    const std::uint64_t mission = begin_mission();
    drive_.emplace(
        Drive{route, Outbox(route.via.size() + 1), mission, now() + orca::from_seconds(*goal_timeout_)});
    arrived_.subscribe();
    failed_.subscribe();
    if (goto_.server_restarts()) path_.subscribe();  // in another process: it may forget the route
    const orca::Status sent = send_due(*drive_, *goal_timeout_);
    if (sent.ok() || may_come_back()) return;
    give_up(route, orca::idl::GOAL_REFUSED, "refused: " + sent.error().text());
    end(false);
  }

  // Waits until something has happened to the goal, and ends the drive if that was its result.
  void await() {
    const orca::TimePoint end_of_wait = drive_->limit + grace();
    if (const orca::PushSubject* const port = next_result(drive_->outbox, end_of_wait)) {
      if (const auto reached = take_result(*port, *drive_)) end(*reached);
    } else if (now() < end_of_wait) {
      send_again(*drive_, orca::to_seconds(drive_->limit - now()));
    } else {
      char text[32];
      std::snprintf(text, sizeof text, "%g s", *goal_timeout_);
      give_up(drive_->route, orca::idl::GOAL_UNANSWERED,
              std::string("unanswered: no arrival within ") + text);
      end(false);
    }
  }

  // Ends the drive: the robot stands.
  void end(bool reached) {
    if (!reached) {
      ++missed_;
      rests_ = *rounds_ != 1;
      if (std::ranges::find(unreached_, drive_->route.name) == unreached_.end())
        unreached_.push_back(drive_->route.name);
    }
    drive_.reset();
    arrived_.unsubscribe();
    failed_.unsubscribe();
    path_.unsubscribe();
    if (const orca::Status sent = send_clients({}); !sent.ok())
      log_warning("the robot may drive on: " + sent.error().text());
    end_mission();
  }

  // Returns whether Goto or the fuser is in a process that may be started again.
  [[nodiscard]] bool may_come_back() const {
    return goto_.server_restarts().has_value() || clients_.server_restarts().has_value();
  }

  // Sends what Goto and the fuser need and do not have.
  // @param time_limit  [s] for Goto to reach the goal.
  orca::Status send_due(Drive& drive, double time_limit) {
    const Route& route = drive.route;
    Outbox& outbox = drive.outbox;
    outbox.note_restarts(goto_.server_restarts(), clients_.server_restarts());
    while (const std::optional<std::size_t> next = outbox.next_point()) {
      const bool via = *next < route.via.size();
      const orca::command::Place& place = via ? route.via[*next] : route.goal;
      const orca::command::Demands demands{via ? *via_radius_ : *reach_radius_, *reach_angle_, time_limit,
                                           via};
      if (orca::Status sent = goto_.send_wait_max(point_of(route, place, demands), kRoomLimit); !sent.ok())
        return sent;
      outbox.point_sent();
      outbox.note_restarts(goto_.server_restarts(), clients_.server_restarts());
    }
    if (!outbox.list_is_due()) return orca::ok();
    if (orca::Status sent = send_clients(*behaviours_); !sent.ok()) return sent;
    outbox.list_sent();
    return orca::ok();
  }

  // Returns whether the goal was reached; nothing if that is still open. Objects of other missions are late: their
  // goals have been given up.
  std::optional<bool> take_result(const orca::PushSubject& port, Drive& drive) {
    if (&port == &arrived_) {
      if (is_of(*arrived_.get_update(), drive.mission)) return true;
    } else if (&port == &failed_) {
      const auto failed = failed_.get_update();
      if (!is_of(*failed, drive.mission)) return std::nullopt;
      log_failure(drive.route, failed->reason());
      return false;
    } else if (const auto path = path_.get_update(); is_of(*path, drive.mission)) {
      note_way(drive.outbox, drive.route, *path);
    }
    return std::nullopt;
  }

  // Waits for a result, or until something is to be sent again; then it returns null, as it does at `end`.
  orca::PushSubject* next_result(const Outbox& outbox, orca::TimePoint end) {
    const orca::Duration left = end - now();
    return results_.wait(outbox.is_empty() ? left : std::min(left, kRetryAfter), [&] {
      return outbox.is_outdated(goto_.server_restarts(), clients_.server_restarts());
    });
  }

  // Learns from the way that is left to Goto which points the robot has passed. A way that does not lead to the
  // goal was pushed before Goto had the whole route.
  static void note_way(Outbox& outbox, const Route& route, const orca::idl::Path& path) {
    if (path.poses().empty()) return;
    const auto& last = path.poses().back().position();
    if (last.x() == route.goal.x && last.y() == route.goal.y) outbox.note_left(path.poses().size() - 1);
  }

  void send_again(Drive& drive, double time_left) {
    const orca::Status sent = send_due(drive, std::max(time_left, 0.1));
    if (sent.ok()) {
      log_info("Goto or the fuser was started again, and has been sent what it needs for \"" +
               drive.route.name + "\": " + std::to_string(drive.outbox.points_left()) + " of " +
               std::to_string(drive.route.via.size() + 1) + " points are left");
    } else {
      log_debug("cannot send again yet: " + sent.error().text());
    }
  }

  static bool is_of(const orca::idl::OrcaObject& result, std::uint64_t mission) {
    return result.mission() == mission;
  }

  void log_failure(const Route& route, const std::string& reason) const {
    log_warning("goal \"" + route.name + "\" was not reached; " + reason);
  }

  // A Goto that says why gives up first.
  [[nodiscard]] orca::Duration grace() const { return failed_.connected() ? kGrace : orca::Duration{0}; }

  // Reports that the goal has failed, because Goto has not.
  void give_up(const Route& route, orca::idl::GoalFailure kind, const std::string& reason) {
    log_failure(route, reason);
    auto failed = given_up_.loan();
    failed->name() = route.name;
    failed->kind(kind);
    failed->reason() = reason;
    failed->stamp(orca::to_time_value(now()));
    given_up_.push(std::move(failed));
  }

  // Another list takes the place of the one that is driven; the goal on the way is given up.
  orca::Status params_changed() override {
    if (*goals_ == listed_) return orca::ok();
    std::vector<Route> routes;
    for (const std::string& text : *goals_)
      if (const orca::Status added = add(text, routes); !added.ok()) return added;
    if (drive_) {
      give_up(drive_->route, orca::idl::GOAL_UNANSWERED, "cancelled: there are other goals");
      end(false);
    }
    rests_ = false;
    listed_ = *goals_;
    emptied_ = routes.empty() && !asks_;
    agenda_.set(std::move(routes));
    return orca::ok();
  }

  void stop() override {
    drive_.reset();
    if (const orca::Status sent = send_clients({}); !sent.ok()) log_debug(sent.error().text());
  }

  // A goal that the robot is on its way to is driven to again.
  void save_state(orca::StateWriter& state) const override {
    const std::size_t on_the_way = drive_ ? 1 : 0;
    state.write(tried_ - on_the_way, unreached_, missed_, agenda_.begun() - on_the_way, listed_, emptied_);
  }

  orca::Status load_state(orca::StateReader& state) override {
    if (state.tag().version == 1) {
      if (orca::Status read = state.read(tried_, unreached_); !read.ok()) return read;
      missed_ = unreached_.size();
      agenda_.go_on_after(tried_);
      return orca::ok();
    }
    std::size_t begun = 0;
    std::vector<std::string> listed;
    bool emptied = false;
    if (orca::Status read = state.read(tried_, unreached_, missed_, begun, listed, emptied); !read.ok())
      return read;
    if (listed != listed_) return orca::ok();  // that was another list
    agenda_.go_on_after(begun);
    emptied_ = emptied;
    asks_ = asks_ && !emptied;
    return orca::ok();
  }

  [[nodiscard]] std::uint32_t state_version() const override { return 2; }
  [[nodiscard]] std::vector<orca::StateTag> accepted_states() const override { return {{"orca.Command", 1}}; }

  orca::Status send_clients(const std::vector<std::string>& names) {
    auto list = clients_.loan();
    list->clients() = names;
    return clients_.send(std::move(list));
  }

  // Asks the user for one goal; false when there will be no more. Typed letters stay when the lap is given up for an order.
  bool ask() {
    const orca::LiveLine::Pause room;  // the user sees what he types
    if (!prompt_.show()) return false;
    while (!prompt_.read()) sleep(std::chrono::milliseconds(50));
    const std::string line = prompt_.take_line();
    if (line.empty()) return false;
    std::vector<Route> routes;
    if (const orca::Status added = add(line, routes); !added.ok()) log_error(added.error().text());
    agenda_.set(std::move(routes));
    return true;
  }

  orca::Status read_file(std::vector<Route>& routes) {
    const auto lines = orca::command::read_goal_file(*goals_file_);
    if (!lines) return lines.error();
    for (const orca::command::GoalLine& line : *lines)
      if (const orca::Status added = add(line.text, routes); !added.ok())
        return orca::fail(added.error().code, added.error().message, line.place);
    return orca::ok();
  }

  orca::Status add(const std::string& text, std::vector<Route>& routes) {
    orca::Result<Route> route = orca::command::parse_route(text);
    if (!route) return route.error();
    for (orca::command::Place& via : route->via)
      if (orca::Status found = find_place(via); !found.ok()) return found;
    if (orca::Status found = find_place(route->goal); !found.ok()) return found;
    routes.push_back(std::move(route).value());
    return orca::ok();
  }

  // Completes a place that is given by its name.
  orca::Status find_place(orca::command::Place& place) {
    if (place.name.empty()) return orca::ok();
    if (!places_.connected())
      return orca::fail(orca::Code::invalid_argument,
                        orca::in_quotes(place.name) +
                            " is the name of a place, and nobody says where it is: connect the port "
                            "\"places\" to a PlaceServer, or give coordinates, as in \"kitchen: 5 4.5\"");
    auto question = places_.loan();
    question->about() = place.name;
    const auto answer = places_.query(std::move(question));
    if (!answer && answer.error().code == orca::Code::not_found)
      return orca::fail(orca::Code::invalid_argument, answer.error().message);
    if (!answer)
      return orca::fail(answer.error().code, "cannot ask where " + orca::in_quotes(place.name) +
                                                 " is: " + answer.error().message +
                                                 "; let it come up after the PlaceServer, with start_after");
    const auto& point = (*answer)->coordinate().point();
    place.x = point.x();
    place.y = point.y();
    place.z = point.z();
    return orca::ok();
  }

  orca::SendProxy<orca::idl::GoalPoint> goto_{
      *this, "goto", {.text = "Receiver of the coordinates: a Goto."}};
  orca::SendProxy<orca::idl::ClientList> clients_{
      *this, "clients", {.text = "Receiver of the list of behaviours: a fuser."}};
  orca::QueryProxy<orca::idl::ClientList, orca::idl::ClientList> check_{
      *this,
      "check",
      {.text = "Asked once, before the start, whether the list of behaviours is right: a fuser.",
       .optional = true}};
  orca::QueryProxy<orca::idl::Ask, orca::idl::GoalPoint> places_{
      *this,
      "places",
      {.text = "Asked where the places are that goals name: a PlaceServer.", .optional = true}};
  orca::PushProxy<orca::idl::Arrived> arrived_{
      *this, "arrived", {.text = "Reports that a goal is reached.", .manual = true, .depth = 16}};

  orca::PushProxy<orca::idl::GoalFailed> failed_{
      *this,
      "failed",
      {.text = "Reports that a goal is given up, and why.", .optional = true, .manual = true, .depth = 16}};
  orca::PushProxy<orca::idl::Path> path_{
      *this,
      "path",
      {.text = "The way that is left to Goto. Used where its process can be started again.",
       .optional = true,
       .manual = true,
       .depth = 16}};
  orca::PushServer<orca::idl::GoalFailed> given_up_{
      *this,
      "GoalFailedPush",
      {.text = "Goals that failed without a word of Goto: not taken, or not answered."}};

  orca::Param<std::vector<std::string>> goals_{
      *this,
      "goals",
      {},
      {.text = "Goals, each \"name: x y > door x y degrees width > x y\" in metres: any via points, then the "
               "goal; or \"hall > kitchen\": places by name. Other goals take the place of all."}};
  orca::Param<std::string> goals_file_{
      *this,
      "goals_file",
      "",
      {.file = true, .fixed = true, .text = "File of goals, one per line; # starts a comment line."}};
  orca::Param<std::int64_t> rounds_{
      *this,
      "rounds",
      1,
      {.min = 0,
       .max = 1e6,
       .text = "How often the goals are driven to, one after the other; 0: without end."}};
  orca::Param<std::vector<std::string>> behaviours_{
      *this, "behaviours", {"goto", "avoid"}, {.text = "Behaviours that the fuser uses on the way."}};
  orca::Param<double> reach_radius_{
      *this,
      "reach_radius",
      0.2,
      {.unit = "m", .min = 0.01, .text = "Distance at which a goal counts as reached."}};
  orca::Param<double> via_radius_{
      *this,
      "via_radius",
      0.3,
      {.unit = "m", .min = 0.01, .text = "Distance at which a via point counts as passed."}};
  orca::Param<double> reach_angle_{
      *this,
      "reach_angle",
      0.1,
      {.unit = "rad", .min = 0.01, .text = "Accepted deviation from the direction at the goal."}};
  orca::Param<double> goal_timeout_{
      *this,
      "goal_timeout",
      300.0,
      {.unit = "s", .min = 1.0, .text = "Longest time for one goal; after it the goal has failed."}};

  orca::Synchronizer results_;
  Agenda agenda_;
  std::vector<std::string> listed_;  // the parameter goals, as it was taken
  bool asks_ = false;                // Whether goals come from the prompt.
  bool emptied_ = false;             // Whether all goals were taken away while it runs.
  orca::command::Prompt prompt_;
  std::optional<Drive> drive_;
  bool rests_ = false;  // Whether the goal before was not reached, and others are driven to in rounds.
  std::size_t tried_ = 0;
  std::size_t missed_ = 0;
  std::vector<std::string> unreached_;  // each once
};

}  // namespace

ORCA_COMPONENT(Command, "orca.Command")
ORCA_ALLOW_IN_VIRTUAL_TIME("poll", "with a timeout of zero: it asks for input and never waits for it")
