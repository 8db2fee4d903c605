// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/measures.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "motion.hpp"
#include "orca/batch/statistics/summary.hpp"
#include "orca/hw/scene.hpp"

namespace orca::batch {
namespace {

using Steps = std::span<const Scene::Step>;

constexpr Duration kEndOfRun = std::chrono::seconds(20);
constexpr double kStands = 0.05;    // [m/s] A robot that is slower stands.
constexpr double kSmallArea = 1.0;  // [m] diagonal of its box
constexpr std::size_t kManyReversals = 10;

// The score of the BARN Challenge (X. Xiao et al., "Autonomous Ground Navigation in Highly Constrained Spaces", IEEE Robotics &
// Automation Magazine 29(4), 2022): the clock starts when the robot has moved so far, and the best time is that of the
// reference at this speed.
constexpr double kHasMoved = 0.1;   // [m]
constexpr double kBestSpeed = 2.0;  // [m/s]

// The needs of measures: without them a run has none.
constexpr const char* kReference = "a world with a reference";
constexpr const char* kPeople = "a world with people";
constexpr const char* kLocalizer = "a localizer that says how sure it is";
constexpr const char* kKidnapping = "a robot with one that is carried off";
constexpr const char* kContact = "a contact";
constexpr const char* kGoals = "goals of the experiment";
constexpr const char* kRobot = "a simulated robot";
constexpr const char* kMotion = "a simulated robot that moves";

constexpr double kAll = 1.0;  // [1]

constexpr std::array kMeasures{
    Measure{"claimed", "", "Goals that components said were reached.", &Measures::claimed, kGoals},
    Measure{"claimed_wrongly", "", "Those that they said while the robot was not there.",
            &Measures::claimed_wrongly, kGoals},
    Measure{"not_claimed", "", "Goals that robots reached and no component said so.", &Measures::not_claimed,
            kGoals},
    Measure{"way", "m", "True way of all robots.", &Measures::way, kRobot},
    Measure{"way_ratio", "", "The way divided by the world's reference; 1 is best.", &Measures::way_ratio,
            kReference},
    Measure{"spl", "", "Success weighted by path length: 1 / way_ratio, at most 1, and 0 without success.",
            &Measures::spl, kReference, kAll},
    Measure{"barn_score", "", "Score of the BARN benchmark: of the reference at 2 m/s, 0.5 at best.",
            &Measures::barn_score, kReference, 0.5},
    Measure{"clearance", "m", "Smallest distance to anything that a robot could touch, at most 2 m.",
            &Measures::clearance, kRobot},
    Measure{"clearance_p5", "m", "Distance that was kept in 95 % of the time.", &Measures::clearance_p5,
            kRobot},
    Measure{"clearance_mean", "m", "Mean distance along the way: the area under it, divided by the way.",
            &Measures::clearance_mean, kMotion},
    Measure{"curvature", "1/m", "Mean absolute curvature: all turns, to either side, divided by the way.",
            &Measures::curvature, kMotion},
    Measure{"jerk", "m/s3", "Root of the mean square of the forward jerk, of speeds over half a second.",
            &Measures::jerk, kRobot},
    Measure{"reversals", "1/m", "Changes between turning left and right, per metre.", &Measures::reversals,
            kMotion},
    Measure{"impact_speed", "m/s", "Speed at the first contact.", &Measures::impact_speed, kContact},
    Measure{"people_touched", "", "Touches between a robot and a person.", &Measures::people_touched,
            kPeople},
    Measure{"people_run_into", "", "Those in which the robot moved, by more than 0.05 m/s.",
            &Measures::people_run_into, kPeople},
    Measure{"near_misses", "", "Times that a robot came nearer than 0.3 m to a person and touched nobody.",
            &Measures::near_misses, kPeople},
    Measure{"noticed", "", "Share of kidnappings that its localizer noticed within 3 s or 1 m.",
            &Measures::noticed, kKidnapping, kAll},
    Measure{"found_again", "", "Share of kidnappings after which it was right within 15 s or 8 m.",
            &Measures::found_again, kKidnapping, kAll},
    Measure{"sure_but_wrong", "", "Share of the time in which it was sure and more than 0.5 m off.",
            &Measures::sure_but_wrong, kLocalizer, kAll},
    Measure{"ambiguous", "", "Share of the time in which it said that there are several places.",
            &Measures::ambiguous, kLocalizer, kAll},
    Measure{"recoveries", "", "Times that a planner found no way on and recovered.", &Measures::recoveries,
            kRobot}};

constexpr std::array<std::pair<Failure, const char*>, 8> kFailures{{{Failure::none, ""},
                                                                    {Failure::crash, "crash"},
                                                                    {Failure::contact, "contact"},
                                                                    {Failure::lost, "lost"},
                                                                    {Failure::overload, "overload"},
                                                                    {Failure::trap, "trap"},
                                                                    {Failure::oscillation, "oscillation"},
                                                                    {Failure::time_out, "time_out"}}};

std::vector<Steps> motions_of(const Scene& scene) {
  std::vector<Steps> motions;
  for (const Scene::Robot& robot : scene.robots)
    if (!robot.motion.empty()) motions.emplace_back(robot.motion);
  return motions;
}

double barn_score(const std::vector<Steps>& motions, const RunEnd& end) {
  if (!end.succeeded) return 0.0;
  TimePoint start = end.end;
  for (const Steps& steps : motions) start = std::min(start, time_of_way(steps, kHasMoved).value_or(end.end));
  const double best = *end.reference / kBestSpeed;
  return best / std::clamp(to_seconds(end.end - start), 2.0 * best, 8.0 * best);
}

// Counts the encounters with people. In a world without people there is nothing to count.
void count_people(const Scene& scene, Measures& measures) {
  if (scene.people == 0) return;
  measures.people_touched = measures.people_run_into = measures.near_misses = 0.0;
  for (const Scene::Robot& robot : scene.robots)
    for (const Scene::Encounter& encounter : robot.encounters) {
      if (encounter.touched) ++*measures.people_touched;
      if (encounter.touched && encounter.robot_speed > kStands) ++*measures.people_run_into;
      if (!encounter.touched) ++*measures.near_misses;
    }
}

void compare_with_reference(const std::vector<Steps>& motions, const RunEnd& end, Measures& measures) {
  measures.way_ratio = *measures.way / *end.reference;
  measures.spl = end.succeeded ? std::min(1.0, *end.reference / std::max(*measures.way, 1e-9)) : 0.0;
  measures.barn_score = barn_score(motions, end);
}

}  // namespace

const char* name_of(Failure failure) {
  return std::ranges::find(kFailures, failure, &std::pair<Failure, const char*>::first)->second;
}

std::optional<Failure> failure_of(std::string_view name) {
  for (const auto& [failure, its_name] : kFailures)
    if (name == its_name) return failure;
  return std::nullopt;
}

std::span<const Measure> all_measures() { return kMeasures; }

Measures measure(const Scene& scene, const RunEnd& end) {
  const std::vector<Steps> motions = motions_of(scene);
  if (motions.empty()) return {};
  Measures measures;
  std::vector<double> clearances;
  std::vector<double> jerks;
  std::size_t reversals = 0;
  double way = 0.0;
  double turned = 0.0;
  double area = 0.0;
  for (const Steps& steps : motions) {
    way += way_of(steps);
    const std::vector<Stretch> stretches = stretches_of(steps);
    reversals += reversals_in(stretches);
    turned += turn_of(steps);
    area += area_under_clearance(steps);
    for (const Scene::Step& step : steps) clearances.push_back(step.clearance_m);
    if (!stretches.empty()) add_jerks(stretches, to_seconds(steps[kStretch].time - steps[0].time), jerks);
  }
  measures.way = way;
  measures.clearance = std::ranges::min(clearances);
  measures.clearance_p5 = quantile(clearances, 0.05).value();
  if (!jerks.empty()) measures.jerk = root_mean_square(jerks);
  if (way > kHasMoved) {
    measures.reversals = static_cast<double>(reversals) / way;
    measures.curvature = turned / way;
    measures.clearance_mean = area / way;
  }
  if (end.first_contact)
    for (const Steps& steps : motions)
      measures.impact_speed =
          std::max(measures.impact_speed.value_or(0.0), speed_before(steps, *end.first_contact));
  count_people(scene, measures);
  if (end.reference) compare_with_reference(motions, end, measures);
  return measures;
}

Failure failure_in(const Scene& scene, const RunEnd& end) {
  if (end.first_contact) return Failure::contact;
  if (end.succeeded) return Failure::none;
  if (end.lost) return Failure::lost;
  if (end.overload) return Failure::overload;
  bool turned = false;
  for (const Steps& steps : motions_of(scene)) {
    const Steps last = since(steps, end.end - kEndOfRun);
    if (extent_of(last) > kSmallArea) return Failure::time_out;
    turned = turned || reversals_in(stretches_of(last)) >= kManyReversals;
  }
  if (motions_of(scene).empty()) return Failure::none;
  return turned ? Failure::oscillation : Failure::trap;
}

}  // namespace orca::batch
