// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/goals/mission_proxy.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/component/held_motors.hpp"
#include "orca/idl/time.hpp"
#include "outbox.hpp"

namespace orca::go {
namespace {

constexpr Duration kRoomLimit = std::chrono::seconds(5);          // for Goto to take a point
constexpr Duration kGrace = std::chrono::seconds(2);              // for Goto to say that the time is up
constexpr Duration kLookAfter = std::chrono::seconds(1);          // whether the motors are held
constexpr Duration kRetryAfter = std::chrono::milliseconds(200);  // for receivers that come up

}  // namespace

struct MissionProxy::Drive {
  Trip trip;
  Outbox outbox;
  std::uint64_t mission;
  double time_limit;  // [s]
  TimePoint limit;    // for Goto to reach it
  HeldTime held{};
  std::vector<std::string> told{};    // the behaviours of which the fuser knows
  bool by_route = false;              // The via points are those of a route.
  std::optional<TimePoint> ask_at{};  // when the route is asked for again
};

MissionProxy::MissionProxy(Component& owner, ComponentHost& host)
    : host_(host),
      goto_(owner, "goto", {.text = "Receiver of the coordinates: a Goto."}),
      clients_(owner, "clients", {.text = "Receiver of the list of behaviours: a fuser."}),
      check_(owner, "check",
             {.text = "Asked once, before the start, whether the list of behaviours is right: a fuser.",
              .optional = true}),
      places_(owner, "places",
              {.text = "Asked where the places are that goals name: a PlaceServer.", .optional = true}),
      arrived_(owner, "arrived", {.text = "Reports that a goal is reached.", .manual = true, .depth = 16}),
      failed_(owner, "failed",
              {.text = "Reports that a goal is given up, and why.",
               .optional = true,
               .manual = true,
               .depth = 16}),
      path_(owner, "path",
            {.text = "The way that is left to Goto. Used where its process can be started again.",
             .optional = true,
             .manual = true,
             .depth = 16}),
      given_up_(owner, "GoalFailedPush",
                {.text = "Goals that failed without a word of Goto: not taken, or not answered."}),
      routes_(owner),
      behaviours_(owner, "behaviours", {"goto", "avoid"},
                  {.text = "Behaviours that the fuser uses on the way."}),
      reach_radius_(owner, "reach_radius", 0.2,
                    {.unit = "m", .min = 0.01, .text = "Distance at which a goal counts as reached."}),
      via_radius_(owner, "via_radius", 0.3,
                  {.unit = "m", .min = 0.01, .text = "Distance at which a via point counts as passed."}),
      reach_angle_(
          owner, "reach_angle", 0.1,
          {.unit = "rad", .min = 0.01, .text = "Accepted deviation from the direction at the goal."}) {}

MissionProxy::~MissionProxy() = default;

Status MissionProxy::configure() {
  results_.add(arrived_);
  results_.add(failed_);
  results_.add(path_);
  results_.add(routes_.doors());
  return check_behaviours();
}

// A list with a wrong name would be refused on the way. Where nobody answers yet, as to an object that is to take another one's
// place, that has to do.
Status MissionProxy::check_behaviours() {
  if (!check_.connected() || checked_ == *behaviours_) return ok();
  auto list = check_.loan();
  list->clients() = *behaviours_;
  const auto checked = check_.query(std::move(list));
  if (checked) {
    checked_ = *behaviours_;
    return ok();
  }
  if (checked.error().code == Code::not_found) return behaviours_.refuse(checked.error());
  host_.write_log(log::Level::debug,
                  "cannot ask yet whether its behaviours are there: " + checked.error().message);
  return ok();
}

Status MissionProxy::look_up(Trip& trip) {
  const Status found = find_places(trip);
  if (found.ok() || found.error().code == Code::invalid_argument) return found;
  host_.write_log(log::Level::debug, found.error().message + "; it is asked again on the way");
  return ok();
}

Status MissionProxy::find_places(Trip& trip) {
  for (Place& via : trip.via)
    if (Status found = find_place(via); !found.ok()) return found;
  return find_place(trip.goal);
}

// Completes a place that is given by its name.
Status MissionProxy::find_place(Place& place) {
  if (place.name.empty()) return ok();
  if (!places_.connected())
    return fail(Code::invalid_argument,
                in_quotes(place.name) +
                    " is the name of a place, and nobody says where it is: connect the "
                    "port \"places\" to a PlaceServer, or give coordinates, as in "
                    "\"kitchen: 5 4.5\"");
  auto question = places_.loan();
  question->about() = place.name;
  const auto answer = places_.query(std::move(question));
  if (!answer && answer.error().code == Code::not_found)
    return fail(Code::invalid_argument, answer.error().message);
  if (!answer)
    return fail(answer.error().code,
                "cannot ask where " + in_quotes(place.name) + " is: " + answer.error().message);
  const auto& point = (*answer)->coordinate().point();
  place = {point.x(), point.y(), point.z(), std::move(place.door), {}};
  return ok();
}

const Trip& MissionProxy::trip() const { return drive_->trip; }

std::optional<MissionProxy::Ending> MissionProxy::begin(const Trip& trip, double time_limit) {
  const std::uint64_t mission = host_.begin_mission();
  drive_ = std::make_unique<Drive>(
      Drive{trip, Outbox(trip.via.size() + 1), mission, time_limit, host_.now() + from_seconds(time_limit)});
  arrived_.subscribe();
  failed_.subscribe();
  drive_->by_route = routes_.connected() && trip.via.empty();
  if (goto_.server_restarts() || drive_->by_route)
    path_.subscribe();  // in another process: it may forget the route
  if (drive_->by_route) routes_.begin();
  if (const Status found = find_places(drive_->trip);
      !found.ok() && found.error().code == Code::invalid_argument)
    return end(give_up(idl::GOAL_REFUSED, "refused: " + found.error().text()));
  if (drive_->by_route) (void)lay_route();
  const Status sent = send_due(time_limit);
  if (sent.ok() || may_come_back()) return std::nullopt;
  return end(give_up(idl::GOAL_REFUSED, "refused: " + sent.error().text()));
}

std::optional<MissionProxy::Ending> MissionProxy::wait(Duration longest) {
  if (drive_->told != *behaviours_) drive_->outbox.list_changed();
  drive_->limit += drive_->held.since_last(host_.now(), host_.kept_alarms());
  const Duration left = last_moment() - host_.now();
  if (const PushSubject* const port = next_result(std::min({left, longest, kLookAfter}))) {
    if (const std::optional<Ending> ending = take_result(*port)) return end(*ending);
  } else if (host_.now() >= last_moment()) {
    char text[32];
    std::snprintf(text, sizeof text, "%g s", drive_->time_limit);
    return end(give_up(idl::GOAL_UNANSWERED, std::string("unanswered: no arrival within ") + text));
  } else if (is_due()) {
    send_again();
  }
  follow_route();
  return std::nullopt;
}

void MissionProxy::cancel(const std::string& reason) {
  if (drive_ != nullptr) end(give_up(idl::GOAL_UNANSWERED, "cancelled: " + reason));
}

void MissionProxy::stop() {
  drive_.reset();
  if (const Status sent = send_clients({}); !sent.ok())
    host_.write_log(log::Level::debug, sent.error().text());
}

// Ends the drive: the robot stands.
MissionProxy::Ending MissionProxy::end(const Ending& ending) {
  drive_.reset();
  arrived_.unsubscribe();
  failed_.unsubscribe();
  path_.unsubscribe();
  routes_.end();
  if (const Status sent = send_clients({}); !sent.ok())
    host_.write_log(log::Level::warning, "the robot may drive on: " + sent.error().text());
  host_.end_mission();
  return ending;
}

// Reports that the goal has failed, because Goto has not.
MissionProxy::Ending MissionProxy::give_up(idl::GoalFailure kind, const std::string& reason) {
  host_.write_log(log::Level::warning, "goal \"" + drive_->trip.name + "\" was not reached; " + reason);
  auto failed = given_up_.loan();
  failed->name() = drive_->trip.name;
  failed->kind(kind);
  failed->reason() = reason;
  failed->stamp(to_time_value(host_.now()));
  given_up_.push(std::move(failed));
  return {false, drive_->mission, reason};
}

// Returns whether Goto or the fuser is in a process that may be started again.
bool MissionProxy::may_come_back() const {
  return goto_.server_restarts().has_value() || clients_.server_restarts().has_value();
}

// A Goto that says why gives up first.
TimePoint MissionProxy::last_moment() const {
  return drive_->limit + (failed_.connected() ? kGrace : Duration{0});
}

// Sends what Goto and the fuser need and do not have.
// @param time_limit  [s] for Goto to reach the goal.
Status MissionProxy::send_due(double time_limit) {
  if (Status found = find_places(drive_->trip); !found.ok()) return found;
  const Trip& trip = drive_->trip;
  Outbox& outbox = drive_->outbox;
  outbox.note_restarts(goto_.server_restarts(), clients_.server_restarts());
  while (const std::optional<std::size_t> next = outbox.next_point()) {
    const bool via = *next < trip.via.size();
    const Place& place = via ? trip.via[*next] : trip.goal;
    const Demands demands{via ? *via_radius_ : *reach_radius_, *reach_angle_, time_limit, via};
    if (Status sent = goto_.send_wait_max(point_of(trip, place, demands), kRoomLimit); !sent.ok())
      return sent;
    outbox.point_sent();
    outbox.note_restarts(goto_.server_restarts(), clients_.server_restarts());
  }
  if (!outbox.list_is_due()) return ok();
  if (Status sent = send_clients(*behaviours_); !sent.ok()) return sent;
  drive_->told = *behaviours_;
  outbox.list_sent();
  return ok();
}

Status MissionProxy::send_clients(const std::vector<std::string>& names) {
  auto list = clients_.loan();
  list->clients() = names;
  return clients_.send(std::move(list));
}

bool MissionProxy::is_due() const {
  const Outbox& outbox = drive_->outbox;
  return !outbox.is_empty() || outbox.is_outdated(goto_.server_restarts(), clients_.server_restarts());
}

void MissionProxy::send_again() {
  const double left = to_seconds(drive_->limit - host_.now());
  const bool has_changed = !drive_->told.empty() && drive_->told != *behaviours_;
  const Status sent = send_due(std::max(left, 0.1));
  if (sent.ok() && has_changed) {
    host_.write_log(log::Level::info, "the robot now drives by " + listed(*behaviours_));
  } else if (sent.ok()) {
    host_.write_log(log::Level::info,
                    "Goto or the fuser was started again, and has been sent what it needs for \"" +
                        drive_->trip.name + "\": " + std::to_string(drive_->outbox.points_left()) + " of " +
                        std::to_string(drive_->trip.via.size() + 1) + " points are left");
  } else {
    host_.write_log(log::Level::debug, "cannot send again yet: " + sent.error().text());
  }
}

// Waits for a result, or until something is to be sent again; then it returns null, as it does after that time.
PushSubject* MissionProxy::next_result(Duration longest) {
  const bool is_idle = drive_->outbox.is_empty() && !drive_->ask_at;
  return results_.wait(is_idle ? longest : std::min(longest, kRetryAfter), [this] {
    return drive_->outbox.is_outdated(goto_.server_restarts(), clients_.server_restarts());
  });
}

// Returns the result; nothing if that is still open. Objects of other missions are late: their goals have been given up.
std::optional<MissionProxy::Ending> MissionProxy::take_result(const PushSubject& port) {
  if (&port == &arrived_) {
    if (is_ours(*arrived_.get_update())) return Ending{true, drive_->mission, {}};
  } else if (&port == &failed_) {
    const auto failed = failed_.get_update();
    if (!is_ours(*failed) || find_other_way(*failed)) return std::nullopt;
    host_.write_log(log::Level::warning,
                    "goal \"" + drive_->trip.name + "\" was not reached; " + failed->reason());
    return Ending{false, drive_->mission, failed->reason()};
  } else if (&port == &routes_.doors()) {
    (void)routes_.doors().get_update();
    if (drive_->by_route) drive_->ask_at = host_.now();
  } else if (const auto path = path_.get_update(); is_ours(*path)) {
    note_way(*path);
  }
  return std::nullopt;
}

// Lays the trip along the cheapest route, as far as there is an answer now.
// @return whether its points must be sent.
bool MissionProxy::lay_route() {
  constexpr Duration kAgain = std::chrono::milliseconds(500);
  drive_->ask_at.reset();
  const Result<bool> laid = routes_.lay(drive_->trip);
  if (!laid) {
    const bool later = laid.error().code != Code::not_found;
    if (later) drive_->ask_at = host_.now() + kAgain;
    host_.write_log(later ? log::Level::debug : log::Level::warning,
                    "no route to \"" + drive_->trip.name + "\": " + laid.error().message);
    return false;
  }
  if (*laid) drive_->outbox.lay_out(drive_->trip.via.size() + 1);
  return *laid;
}

// Asks for the route again if a door has been found shut or open. Points that are on their way to Goto come first.
void MissionProxy::follow_route() {
  if (!drive_->ask_at || host_.now() < *drive_->ask_at || !drive_->outbox.is_empty()) return;
  const bool is_first = drive_->trip.via.empty();
  if (!lay_route()) return;
  if (!is_first)
    host_.write_log(log::Level::info, "another way to \"" + drive_->trip.name + "\": " + routes_.text());
  const Status sent = send_due(std::max(to_seconds(drive_->limit - host_.now()), 0.1));
  if (!sent.ok()) host_.write_log(log::Level::warning, sent.error().text());
}

// Goes on by another way after a leg was blocked, as another mission: Goto has given up the one before.
// @return whether there is one.
bool MissionProxy::find_other_way(const idl::GoalFailed& failed) {
  if (!drive_->by_route || failed.kind() != idl::GOAL_BLOCKED) return false;
  const Status reported = routes_.report_blocked(drive_->trip, drive_->outbox.points_left());
  if (!reported.ok() || !lay_route()) return false;
  host_.write_log(log::Level::info, "another way to \"" + drive_->trip.name + "\" after it was " +
                                        failed.reason() + ": " + routes_.text());
  host_.end_mission();
  drive_->mission = host_.begin_mission();
  return send_due(std::max(to_seconds(drive_->limit - host_.now()), 0.1)).ok() || may_come_back();
}

bool MissionProxy::is_ours(const idl::OrcaObject& result) const {
  return result.mission() == drive_->mission;
}

// Learns from the way that is left to Goto which points the robot has passed. One that ends at a via point was pushed before
// Goto had the whole route; to a charger it ends elsewhere than at the goal.
void MissionProxy::note_way(const idl::Path& path) {
  if (path.poses().empty()) return;
  const auto& last = path.poses().back().position();
  const auto is_last = [&](const Place& via) { return last.x() == via.x && last.y() == via.y; };
  if (std::ranges::none_of(drive_->trip.via, is_last)) drive_->outbox.note_left(path.poses().size() - 1);
}

}  // namespace orca::go
