// SPDX-License-Identifier: LGPL-3.0-or-later
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "goal_list.hpp"
#include "orca/base/input_file.hpp"
#include "orca/base/live_line.hpp"
#include "orca/base/text.hpp"
#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"
#include "orca/patterns/synchronizer.hpp"
#include "outbox.hpp"

namespace {

using orca::command::Outbox;
using orca::command::Route;

constexpr std::size_t kMaxBytes = 1'000'000;                            // of a file of goals
constexpr orca::Duration kRoomLimit = std::chrono::seconds(5);          // for Goto to take a point
constexpr orca::Duration kGrace = std::chrono::seconds(2);              // for Goto to say that the time is up
constexpr orca::Duration kRetryAfter = std::chrono::milliseconds(200);  // for receivers that come up

/// A component that sends the robot to one goal after the other, taken from a parameter, a file or a prompt
/// (thesis 11.1). For each goal it begins a mission, subscribes to its results, sends the coordinates to Goto
/// and the list of behaviours to the fuser, and waits. After the result it unsubscribes and clears the list.
/// If Goto or the fuser is in another process that is started again meanwhile, it gets what it needs once more.
/// When there are no more goals it is done, or has failed if one was not reached.
class Command final : public orca::Component {
 public:
  explicit Command(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    stay_active(true);
    results_.add(arrived_);
    results_.add(failed_);
    results_.add(path_);
    for (const std::string& text : *goals_)
      if (const orca::Status added = add(text); !added.ok()) return goals_.refuse(added.error());
    if (!goals_file_->empty())
      if (const orca::Status read = read_file(); !read.ok()) return goals_file_.refuse(read.error());
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

  orca::Outcome work() override {
    const std::optional<Route> route = next();
    if (!route) return conclude();
    const std::uint64_t mission = begin_mission();
    drive(*route, mission);
    if (const orca::Status sent = send_clients({}); !sent.ok())
      log_warning("the robot may drive on: " + sent.error().text());
    end_mission();
    return orca::again();
  }

  orca::Outcome conclude() const {
    if (unreached_.empty()) return orca::done();
    return orca::failed("not reached: " + orca::listed(unreached_) + " (" +
                        std::to_string(unreached_.size()) + " of " + std::to_string(tried_) + " goals)");
  }

  void drive(const Route& route, std::uint64_t mission) {
    ++tried_;
    arrived_.subscribe();
    failed_.subscribe();
    if (goto_.server_restarts()) path_.subscribe();  // in another process: it may forget the route
    Outbox outbox(route.via.size() + 1);
    const orca::Status sent = send_due(outbox, route, *goal_timeout_);
    const bool refused = !sent.ok() && !may_come_back();
    if (refused) give_up(route, orca::idl::GOAL_REFUSED, "refused: " + sent.error().text());
    if (refused || !wait_for_result(outbox, route, mission)) unreached_.push_back(route.name);
    arrived_.unsubscribe();
    failed_.unsubscribe();
    path_.unsubscribe();
  }

  // Returns whether Goto or the fuser is in a process that may be started again.
  [[nodiscard]] bool may_come_back() const {
    return goto_.server_restarts().has_value() || clients_.server_restarts().has_value();
  }

  // Sends what Goto and the fuser need and do not have.
  // @param time_limit  [s] for Goto to reach the goal.
  orca::Status send_due(Outbox& outbox, const Route& route, double time_limit) {
    outbox.note_restarts(goto_.server_restarts(), clients_.server_restarts());
    while (const std::optional<std::size_t> next = outbox.next_point()) {
      const bool via = *next < route.via.size();
      const orca::command::Place& place = via ? route.via[*next] : route.goal;
      if (orca::Status sent = send_point(route, place, via, time_limit); !sent.ok()) return sent;
      outbox.point_sent();
      outbox.note_restarts(goto_.server_restarts(), clients_.server_restarts());
    }
    if (!outbox.list_is_due()) return orca::ok();
    if (orca::Status sent = send_clients(*behaviours_); !sent.ok()) return sent;
    outbox.list_sent();
    return orca::ok();
  }

  // Returns whether the goal was reached.
  bool wait_for_result(Outbox& outbox, const Route& route, std::uint64_t mission) {
    const orca::TimePoint limit = now() + orca::from_seconds(*goal_timeout_);
    const orca::TimePoint end = limit + grace();
    for (;;) {
      if (const orca::PushSubject* const port = next_result(outbox, end)) {
        if (const auto reached = take_result(*port, outbox, route, mission)) return *reached;
      } else if (now() < end) {
        send_again(outbox, route, orca::to_seconds(limit - now()));
      } else {
        break;
      }
    }
    char text[32];
    std::snprintf(text, sizeof text, "%g s", *goal_timeout_);
    give_up(route, orca::idl::GOAL_UNANSWERED, std::string("unanswered: no arrival within ") + text);
    return false;
  }

  // Returns whether the goal was reached; nothing if that is still open. Objects of other missions are late: their
  // goals have been given up.
  std::optional<bool> take_result(const orca::PushSubject& port, Outbox& outbox, const Route& route,
                                  std::uint64_t mission) {
    if (&port == &arrived_) {
      if (is_of(*arrived_.get_update(), mission)) return true;
    } else if (&port == &failed_) {
      const auto failed = failed_.get_update();
      if (!is_of(*failed, mission)) return std::nullopt;
      log_failure(route, failed->reason());
      return false;
    } else if (const auto path = path_.get_update(); is_of(*path, mission)) {
      note_way(outbox, route, *path);
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

  void send_again(Outbox& outbox, const Route& route, double time_left) {
    const orca::Status sent = send_due(outbox, route, std::max(time_left, 0.1));
    if (sent.ok()) {
      log_info("Goto or the fuser was started again, and has been sent what it needs for \"" + route.name +
               "\": " + std::to_string(outbox.points_left()) + " of " + std::to_string(route.via.size() + 1) +
               " points are left");
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

  void stop() override {
    if (const orca::Status sent = send_clients({}); !sent.ok()) log_debug(sent.error().text());
  }

  // Between two laps no goal is under way: one at which the robot was driven when the process was lost is driven to again.
  void save_state(orca::StateWriter& state) const override { state.write(tried_, unreached_); }

  orca::Status load_state(orca::StateReader& state) override {
    if (orca::Status read = state.read(tried_, unreached_); !read.ok()) return read;
    for (std::size_t i = 0; i < tried_ && !waiting_.empty(); ++i) waiting_.pop_front();
    return orca::ok();
  }

  orca::Status send_point(const Route& route, const orca::command::Place& place, bool via,
                          double time_limit) {
    orca::Loan<orca::idl::GoalPoint> point = point_at(place);
    point->name() = route.name;
    point->coordinate().point().x(place.x);
    point->coordinate().point().y(place.y);
    point->coordinate().point().z(place.z);
    point->via(via);
    point->reach_radius().distance(via ? *via_radius_ : *reach_radius_);
    point->use_orientation(!via && route.use_orientation);
    if (!place.door) point->orientation().orientation().yaw(route.orientation);
    point->reach_angle(*reach_angle_);
    point->time_limit(time_limit);
    return goto_.send_wait_max(std::move(point), kRoomLimit);
  }

  // Returns a GoalPoint, or a Door, which is one too. Who sends a robot through a door says that it is passable.
  static orca::Loan<orca::idl::GoalPoint> point_at(const orca::command::Place& place) {
    if (!place.door) return orca::make_object<orca::idl::GoalPoint>();
    auto door = orca::make_object<orca::idl::Door>();
    door->orientation().orientation().yaw(place.door->direction);
    door->door_width().distance(place.door->width);
    door->passable(true);
    return door;
  }

  orca::Status send_clients(const std::vector<std::string>& names) {
    auto list = clients_.loan();
    list->clients() = names;
    return clients_.send(std::move(list));
  }

  std::optional<Route> next() {
    while (waiting_.empty() && asks())
      if (!ask()) return std::nullopt;
    if (waiting_.empty()) return std::nullopt;
    Route route = std::move(waiting_.front());
    waiting_.pop_front();
    return route;
  }

  // Returns whether to ask the user: there are goals from nowhere else.
  [[nodiscard]] bool asks() const { return goals_->empty() && goals_file_->empty(); }

  // Asks the user for one goal; false when there will be no more.
  bool ask() {
    constexpr std::string_view kPrompt = "goal (name: x y > x y, empty line to end)? ";
    const orca::LiveLine::Pause room;  // the user sees what he types
    if (write(STDERR_FILENO, kPrompt.data(), kPrompt.size()) < 0) return false;
    std::string line;
    if (!read_line(line) || line.empty()) return false;
    if (const orca::Status added = add(line); !added.ok()) log_error(added.error().text());
    return true;
  }

  // Reads a line from stdin without blocking the strand in the system, so that the component can be stopped
  // meanwhile.
  bool read_line(std::string& line) {
    for (;;) {
      pollfd input{STDIN_FILENO, POLLIN, 0};
      if (poll(&input, 1, 0) == 0) {
        sleep(std::chrono::milliseconds(50));
        continue;
      }
      char c = 0;
      if (read(STDIN_FILENO, &c, 1) != 1) return !line.empty();
      if (c == '\n') return true;
      line += c;
    }
  }

  orca::Status read_file() {
    const orca::Result<std::string> text = orca::read_input_file(*goals_file_, kMaxBytes);
    if (!text)
      return orca::fail(text.error().code, "cannot read the file of goals: " + text.error().message,
                        *goals_file_);
    if (text->size() == kMaxBytes)
      return orca::fail(orca::Code::invalid_argument,
                        "the file of goals has more than 1 MB, which is the limit", *goals_file_);
    std::istringstream file(*text);
    int number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      if (line.find_first_not_of(" \t\r") == std::string::npos || line.front() == '#') continue;
      const orca::Status added = add(line);
      if (!added.ok())
        return orca::fail(added.error().code, added.error().message,
                          *goals_file_ + ":" + std::to_string(number) + ":1");
    }
    return orca::ok();
  }

  orca::Status add(const std::string& text) {
    orca::Result<Route> route = orca::command::parse_route(text);
    if (!route) return route.error();
    for (orca::command::Place& via : route->via)
      if (orca::Status found = find_place(via); !found.ok()) return found;
    if (orca::Status found = find_place(route->goal); !found.ok()) return found;
    waiting_.push_back(std::move(route).value());
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
      {.fixed = true,
       .text = "Goals, each \"name: x y > door x y degrees width > x y\" in metres: any via points, then the "
               "goal; or \"hall > kitchen\": places by name."}};
  orca::Param<std::string> goals_file_{
      *this,
      "goals_file",
      "",
      {.file = true, .fixed = true, .text = "File of goals, one per line; # starts a comment line."}};
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
  std::deque<Route> waiting_;
  std::size_t tried_ = 0;
  std::vector<std::string> unreached_;
};

}  // namespace

ORCA_COMPONENT(Command, "orca.Command")
ORCA_ALLOW_IN_VIRTUAL_TIME("poll", "with a timeout of zero: it asks for input and never waits for it")
