// SPDX-License-Identifier: LGPL-3.0-or-later
#include "key_moments.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace orca::host {
namespace {

constexpr std::size_t kLeast = 6;
constexpr std::size_t kMost = 12;

bool is_near(const Scene::Robot& robot, const Scene::Mark& mark) {
  const Scene::Moment& moment = moment_at(robot, mark.time);
  return std::hypot(moment.pose.x - mark.position.x, moment.pose.y - mark.position.y) <
         std::max(1.0, 2.0 * robot.radius_m);
}

// Marks that do not name their robot count as a robot's own if they are near.
bool is_own(const Scene::Robot& robot, const Scene::Mark& mark) {
  return mark.robot.empty() ? is_near(robot, mark) : mark.robot == robot.name;
}

// Adds the marks of a robot.
void add_marks(const Scene::Robot& robot, const std::vector<Scene::Mark>& marks, const std::string& verb,
               std::vector<KeyMoment>& found) {
  for (const Scene::Mark& mark : marks)
    if (is_own(robot, mark)) found.push_back({&robot, &moment_at(robot, mark.time), verb + mark.label});
}

// Joins moments at the same time, so that a moment with two reasons is shown once.
std::vector<KeyMoment> joined(std::vector<KeyMoment> found) {
  std::ranges::stable_sort(found, {}, [](const KeyMoment& key) { return key.moment->time; });
  std::vector<KeyMoment> keys;
  for (KeyMoment& key : found) {
    if (keys.empty() || keys.back().moment != key.moment)
      keys.push_back(std::move(key));
    else
      keys.back().why += ", " + key.why;
  }
  return keys;
}

// Returns the middle of the two neighbours that are farthest apart in time; nothing if there is none.
std::optional<KeyMoment> middle_of_the_longest_gap(const Scene::Robot& robot,
                                                   const std::vector<KeyMoment>& keys) {
  const Scene::Moment* best = nullptr;
  Duration longest{};
  for (std::size_t i = 1; i < keys.size(); ++i) {
    const Scene::Moment& from = *keys[i - 1].moment;
    const Duration gap = keys[i].moment->time - from.time;
    const Scene::Moment& middle = moment_at(robot, from.time + gap / 2);
    if (gap <= longest || &middle == &from || &middle == keys[i].moment) continue;
    longest = gap;
    best = &middle;
  }
  return best == nullptr ? std::nullopt : std::optional(KeyMoment{&robot, best, ""});
}

std::vector<KeyMoment> thinned(const std::vector<KeyMoment>& all) {
  if (all.size() <= kMost) return all;
  std::vector<KeyMoment> kept;
  for (std::size_t i = 0; i < kMost; ++i) kept.push_back(all[i * (all.size() - 1) / (kMost - 1)]);
  return kept;
}

std::vector<KeyMoment> moments_of(const Scene::Robot& robot, const Scene& scene) {
  std::vector<KeyMoment> found{{&robot, &robot.moments.front(), "start"}};
  add_marks(robot, scene.arrivals, "at ", found);
  add_marks(robot, scene.contacts, "contact of ", found);
  if (robot.moments.size() > 1) found.push_back({&robot, &robot.moments.back(), "end"});
  std::vector<KeyMoment> keys = joined(std::move(found));
  while (keys.size() < kLeast) {
    const auto between = middle_of_the_longest_gap(robot, keys);
    if (!between) break;
    keys.push_back(*between);
    std::ranges::stable_sort(keys, {}, [](const KeyMoment& key) { return key.moment->time; });
  }
  return thinned(keys);
}

}  // namespace

const Scene::Moment& moment_at(const Scene::Robot& robot, TimePoint time) {
  return *std::ranges::min_element(robot.moments, {}, [time](const Scene::Moment& moment) {
    return moment.time < time ? time - moment.time : moment.time - time;
  });
}

std::vector<KeyMoment> key_moments(const Scene& scene) {
  std::vector<KeyMoment> all;
  for (const Scene::Robot& robot : scene.robots) {
    if (robot.moments.empty()) continue;
    const std::vector<KeyMoment> found = moments_of(robot, scene);
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

}  // namespace orca::host
