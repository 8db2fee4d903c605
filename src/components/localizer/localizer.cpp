// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "last_place.hpp"
#include "orca/component.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"
#include "orca/navigation/map_localizer.hpp"
#include "orca/planning/floor.hpp"
#include "reckoning.hpp"
#include "senses.hpp"

namespace {

using orca::Pose2;
using orca::idl::LaserRangeReadings;
using orca::idl::Localization;
using orca::idl::OccupancyGrid;
using orca::idl::Odometry;
using orca::idl::RobotPose;
using orca::idl::SonarRangeReadings;
using orca::nav::Known;
using orca::nav::PlaceBelief;
using orca::nav::PoseSpread;
using orca::nav::Reckoned;

orca::idl::LocalizationState state_of(Known known) {
  switch (known) {
    case Known::unknown: return orca::idl::LOCALIZATION_UNKNOWN;
    case Known::ambiguous: return orca::idl::LOCALIZATION_AMBIGUOUS;
    case Known::localized: return orca::idl::LOCALIZATION_LOCALIZED;
    case Known::lost: break;
  }
  return orca::idl::LOCALIZATION_LOST;
}

orca::idl::Pose2D pose_of(const Pose2& pose) {
  orca::idl::Pose2D result;
  result.x(pose.x);
  result.y(pose.y);
  result.orientation(pose.yaw);
  return result;
}

// Returns a place seen from another frame, in which the one that it is given in has the pose X_AB.
orca::idl::Pose2D seen_in(const Pose2& X_AB, const PoseSpread& spread) {
  orca::idl::Pose2D X_BC = pose_of(spread.mean);
  X_BC.covariance(spread.covariance);
  return orca::compose(pose_of(X_AB), X_BC);
}

// Returns where somebody says that the robot is; not better than a person knows it.
PoseSpread said_by(const RobotPose& pose, const Pose2& X_WM) {
  constexpr double kPlace = 0.3;  // [m]
  constexpr double kTurn = 0.2;   // [rad]
  const auto X_MR = seen_in(inverse(X_WM), {orca::plane_pose(pose), pose.covariance()});
  PoseSpread spread{orca::plane_pose(X_MR), X_MR.covariance()};
  spread.covariance[0] += kPlace * kPlace;
  spread.covariance[4] += kPlace * kPlace;
  spread.covariance[8] += kTurn * kTurn;
  return spread;
}

/// The belief that a localizer leaves for the next one.
struct Memory {
  std::vector<PlaceBelief> places;
  bool was_known = false;
  std::optional<Reckoned> reckoned;
  std::vector<orca::nav::SurfaceOffset> offsets;
  double yaw = 0.0;  // of the frame of the places in the world

  auto state() { return std::tie(places, was_known, reckoned, offsets, yaw); }
};

// Doubts all places: some time has passed, in which somebody may have moved the robot.
void doubt(Memory& memory) {
  memory.was_known = false;
  for (PlaceBelief& place : memory.places) {
    place.believed = false;
    place.quick = place.slow = -1.0;
    for (const std::size_t i : {0U, 4U, 8U}) place.where.covariance[i] += 0.04;
  }
}

/// A localizer with a map (thesis 11.1, Localizer): it finds where the robot is in it by lasers and sonars, and follows it. See README.md.
class Localizer final : public orca::Component {
 public:
  explicit Localizer(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    lap_on("odometry");
    if (!map_.connected() && !maps_.connected())
      return orca::fail(
          orca::Code::failed_precondition,
          "it has no map: connect its port \"map\" to the OccupancyGridQuery of a MapServer, or its "
          "port \"maps\" to the OccupancyGridPush of who makes one");
    if (laser_.sources().empty() && sonar_.sources().empty())
      return orca::fail(orca::Code::failed_precondition,
                        "it senses nothing: connect its port \"laser\" or \"sonar\"");
    orca::nav::LocalizerOptions options;
    options.searches = *searches_;
    localizer_.emplace(nullptr, random("particles"), options);
    if (orca::Status kept = open_last(); !kept.ok()) return kept;
    return start_place_->empty() ? orca::ok() : find_start();
  }

  // A robot that cannot remember where it was finds it as one that has never been there.
  orca::Status open_last() {
    if (keeps_pose_->empty()) return orca::ok();
    if (keeps_pose_->find('/') != std::string::npos || keeps_pose_->front() == '.')
      return keeps_pose_.refuse(
          "it is a name, not a path; expected a name without \"/\" that does not begin "
          "with a dot, such as \"pioneer\"");
    if (orca::Status opened = last_.open(*keeps_pose_); !opened.ok())
      log_warning("what was kept of where the robot was is not used: " + opened.error().text());
    if (!start_place_->empty()) last_.forget();
    return orca::ok();
  }

  // Asks where the place is at which the robot starts.
  orca::Status find_start() {
    if (!places_.connected())
      return start_place_.refuse(orca::fail(orca::Code::failed_precondition,
                                            "nobody says where that place is: connect the port \"places\" to "
                                            "a PlaceServer"));
    auto question = places_.loan();
    question->about() = *start_place_;
    const auto answer = places_.query(std::move(question));
    if (!answer && answer.error().code == orca::Code::not_found) return start_place_.refuse(answer.error());
    if (!answer)
      return orca::fail(answer.error().code,
                        "cannot ask where its start_place is: " + answer.error().message +
                            "; let it come up after the PlaceServer, with start_after");
    const orca::idl::GoalPoint& place = **answer;
    start_.emplace();
    start_->x(place.coordinate().point().x());
    start_->y(place.coordinate().point().y());
    start_->orientation(place.orientation().orientation().yaw());
    return orca::ok();
  }

  // It may begin again on the way, with another client.
  orca::Status start() override {
    senses_.clear();
    for (const auto& source : laser_.sources()) source.subscribe();
    for (const auto& source : sonar_.sources()) source.subscribe();
    return orca::ok();
  }

  void stop() override {
    laser_.unsubscribe_all();
    sonar_.unsubscribe_all();
    if (question_) map_.query_forget(*std::exchange(question_, std::nullopt));
    warn_unless(last_.close(floor_));
  }

  void warn_unless(const orca::Status& kept) {
    if (!kept.ok()) log_warning("it is not kept where the robot is: " + kept.error().text());
  }

  orca::Outcome work() override {
    const auto odometry = odometry_.get_update();
    if (!senders_.accepts(*odometry)) return orca::again();
    learn_map();
    follow(*odometry);
    listen();
    sense();
    report(*odometry);
    return orca::again();
  }

  // Asks for the map until somebody answers, and takes over each that comes.
  void learn_map() {
    while (maps_.new_data_arrived()) take_map(*maps_.get_update());
    if (question_) {
      take_answer();
    } else if (!has_map_ && map_.connected() && (!asked_ || now() - *asked_ >= kAskAgain)) {
      asked_ = now();
      if (const auto id = map_.query_request(map_.loan())) question_ = *id;
    }
    if (!floor_.has_changed()) return;
    has_map_ = true;
    last_.change_map();
    localizer_->change_map(floor_.map());
  }

  void take_answer() {
    const auto answer = map_.query_receive(*question_);
    if (!answer) return;
    question_.reset();
    if (*answer) return take_map(***answer);
    log_warning("it has no map: " + answer->error().message);
  }

  void take_map(const OccupancyGrid& grid) {
    if (const orca::Status taken = floor_.take(grid); !taken.ok()) log_warning(taken.error().message);
  }

  // Goes on with the odometry; a place that was taken over is where the robot was at an older one.
  void follow(const Odometry& odometry) {
    const bool goes_on = reckoning_.take(odometry);
    const Reckoned now = *reckoning_.latest();
    if (!goes_on) begin_anew(now, odometry.origin());
    senses_.move(orca::to_time_point(odometry.stamp()), now.X_OR);
    if (start_) localizer_->place(said_by(*std::exchange(start_, std::nullopt), floor_.X_WM()), now);
    if (has_map_ && last_.waits()) doubt_last(now);
  }

  // The robot may still be where it was in the last run: the next scan says whether it is.
  void doubt_last(const Reckoned& now) {
    if (const auto where = last_.take(floor_))
      localizer_->suggest(*where, now);
    else
      log_info("what was kept of where the robot was is not used: " + where.error().message);
  }

  void begin_anew(const Reckoned& now, const std::string& base) {
    senses_.clear();
    localizer_->reckon_anew(now);
    log_warning("the odometry of \"" + base +
                "\" goes on from another place, so it is doubted where the robot is");
  }

  void listen() {
    for (const auto& source : laser_.sources()) {
      if (!source.new_data_arrived()) continue;
      if (const auto scan = source.take_latest(); senders_.accepts(*scan))
        senses_.add_scan(source.path(), scan);
    }
    for (const auto& source : sonar_.sources()) {
      if (!source.new_data_arrived()) continue;
      if (const auto round = source.take_latest(); senders_.accepts(*round))
        senses_.add_round(source.path(), *round);
    }
  }

  void sense() {
    const Reckoned now = *reckoning_.latest();
    while (const auto taken = senses_.take_scan(*range_)) {
      const double time = orca::to_seconds(taken->stamp.time_since_epoch());
      if (time < localizer_->time() && localizer_->time() <= now.time) continue;
      localizer_->move({time, taken->X_OR, now.covariance});
      localizer_->see(taken->scan);
    }
    const bool hears = senses_.has_echoes() && localizer_->is_time_for(orca::nav::MapLocalizer::kSonars, now);
    if (hears || now.time - localizer_->time() > kSilence || now.time < localizer_->time())
      localizer_->move(now);
    if (hears) localizer_->hear(senses_.take_echoes(now.X_OR));
  }

  void report(const Odometry& odometry) {
    const Reckoned reckoned = *reckoning_.latest();
    const Known known = localizer_->known(reckoned);
    note(known);
    auto pose = poses_.loan();
    const Pose2 X_WM = floor_.X_WM();
    if (const auto where = localizer_->where(reckoned)) {
      const auto X_WR = seen_in(X_WM, *where);
      pose->x(X_WR.x());
      pose->y(X_WR.y());
      pose->orientation(X_WR.orientation());
      pose->covariance(X_WR.covariance());
    }
    if (known == Known::localized)
      warn_unless(last_.keep(floor_, *localizer_->where(reckoned), now()));
    else
      pose->covariance(orca::anywhere());
    pose->translational_velocity(odometry.translational_velocity());
    pose->sideways_velocity(odometry.sideways_velocity());
    pose->steering_velocity(odometry.steering_velocity());
    pose->stamp(odometry.stamp());
    poses_.push(std::move(pose));
    auto state = states_.loan();
    state->state(state_of(known));
    const std::vector<PlaceBelief> places = localizer_->places(reckoned);
    state->share(places.empty() ? 0.0 : std::max(0.0, places.front().quick));
    for (const PlaceBelief& place : places) state->places().push_back(seen_in(X_WM, place.where));
    state->stamp(odometry.stamp());
    states_.push(std::move(state));
  }

  void note(Known known) {
    if (known == std::exchange(known_, known)) return;
    if (known == Known::localized) {
      log_info("it is known where the robot is");
      clear_alarm(kLost, "it is known again where the robot is");
    }
    if (known == Known::ambiguous) log_info("the robot may be at one of several places");
    if (known == Known::lost)
      raise_alarm(
          kLost, orca::idl::ALARM_CRITICAL,
          "it is not known any more where the robot is: what it senses is not what the map shows there, "
          "or it senses nothing; it stands until it is found, or somebody sends where it is to "
          "RobotPoseSend");
  }

  // Somebody says where the robot is.
  orca::Status on_pose(const orca::ObjectPtr<RobotPose>& pose) {
    if (orca::Status valid = orca::check_reading(*pose); !valid.ok()) return valid;
    if (orca::is_anywhere(pose->covariance()))
      return orca::fail(orca::Code::invalid_argument,
                        "its covariance says that nobody knows where the robot is");
    if (!reckoning_.latest())
      return orca::fail(
          orca::Code::failed_precondition,
          "no odometry has come that says anything valid; send the pose again when the base works");
    last_.forget();
    localizer_->place(said_by(*pose, floor_.X_WM()), *reckoning_.latest());
    log_info("the robot is where \"" + pose->origin() + "\" says");
    return orca::ok();
  }

  void save_state(orca::StateWriter& state) const override {
    Memory memory{{}, localizer_->was_known(), reckoning_.latest(), localizer_->offsets(), floor_.X_WM().yaw};
    if (memory.reckoned) memory.places = localizer_->places(*memory.reckoned);
    state.write(memory, reckoning_);
  }

  orca::Status load_state(orca::StateReader& state) override {
    Memory memory;
    orca::Status read = state.read(memory, reckoning_);
    start_.reset();
    if (!read.ok() || !memory.reckoned) return read;
    const bool is_fresh =
        std::fabs(orca::to_seconds(now().time_since_epoch()) - memory.reckoned->time) < kFresh;
    if (!is_fresh) doubt(memory);
    last_.forget();
    reckoning_.resume(*memory.reckoned);
    floor_.expect(memory.yaw);
    localizer_->resume(memory.places, memory.was_known, *reckoning_.latest(), memory.offsets);
    return read;
  }

  static constexpr const char* kLost = "LOST";
  static constexpr double kSilence = 1.0;  // [s]
  static constexpr double kFresh = 1.0;    // [s]
  static constexpr orca::Duration kAskAgain = std::chrono::seconds(2);

  orca::SenderWatch senders_{host()};
  orca::localizer::Reckoning reckoning_;
  orca::planning::Floor floor_;
  orca::localizer::LastPlace last_;
  orca::localizer::Senses senses_;
  std::optional<orca::nav::MapLocalizer> localizer_;
  std::optional<RobotPose> start_;  // as somebody has said, until the first odometry
  Known known_ = Known::unknown;    // as was said last
  bool has_map_ = false;
  std::optional<orca::TimePoint> asked_;
  std::optional<orca::QueryId> question_;
  orca::SendServer<RobotPose> where_{
      *this,
      "RobotPoseSend",
      &Localizer::on_pose,
      {.text = "Where the robot is now, in the frame of the world, from somebody who knows it."}};
  orca::PushProxy<Odometry> odometry_{*this, "odometry", {.text = "Odometry of the base."}};
  orca::PushProxyArray<LaserRangeReadings> laser_{
      *this, "laser", {.text = "Scans of lasers, any number.", .optional = true}};
  orca::PushProxyArray<SonarRangeReadings> sonar_{
      *this, "sonar", {.text = "Rounds of sonar rings, any number.", .optional = true}};
  orca::QueryProxy<orca::idl::Ask, OccupancyGrid> map_{
      *this, "map", {.text = "Asked for the map until it is there: a MapServer.", .optional = true}};
  orca::PushProxy<OccupancyGrid> maps_{
      *this,
      "maps",
      {.text = "Maps, or parts of the map, that take the place of what is there.", .optional = true}};
  orca::QueryProxy<orca::idl::Ask, orca::idl::GoalPoint> places_{
      *this,
      "places",
      {.text = "Asked once, before the start, where the place is at which the robot starts: a PlaceServer.",
       .optional = true}};
  orca::PushServer<RobotPose> poses_{*this,
                                     "RobotPosePush",
                                     {.text = "Pose of the robot in the frame of the world, once per lap. "
                                              "Its covariance is that of anywhere unless the "
                                              "robot is localized."}};
  orca::PushServer<Localization> states_{
      *this, "LocalizationPush", {.text = "How well it is known where the robot is, once per lap."}};
  orca::Param<std::string> start_place_{*this,
                                        "start_place",
                                        "",
                                        {.fixed = true,
                                         .text = "Place at which the robot starts, by its name; empty: it is "
                                                 "found, which needs a laser, or said."}};
  orca::Param<bool> searches_{
      *this,
      "searches",
      true,
      {.fixed = true,
       .text = "Whether it searches the whole map while it does not know where the robot is; otherwise "
               "somebody must say it."}};
  orca::Param<std::string> keeps_pose_{
      *this,
      "keeps_pose",
      "",
      {.fixed = true,
       .text = "Name under which the last pose is kept from one run to the next, to be checked by the first "
               "scan: NAME.pose in ~/.local/state/orca/kept; empty: it is not kept."}};
  orca::Param<double> range_{
      *this,
      "map_range",
      20.0,
      {.unit = "m", .min = 1.0, .max = 100.0, .text = "Echoes that are farther away do not count."}};
};

}  // namespace

ORCA_COMPONENT(Localizer, "orca.Localizer")
