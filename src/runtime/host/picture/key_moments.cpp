// SPDX-License-Identifier: LGPL-3.0-or-later
#include "key_moments.hpp"

#include <algorithm>
#include <cmath>

namespace orca {
namespace {

constexpr std::size_t kLeast = 6;
constexpr std::size_t kMost = 12;

// The moment nearest to that time.
const Scene::Moment& at(const Scene::Robot& robot, TimePoint time) {
  return *std::ranges::min_element(robot.moments, {}, [time](const Scene::Moment& moment) {
    return moment.time < time ? time - moment.time : moment.time - time;
  });
}

bool is_near(const Scene::Robot& robot, const Scene::Mark& mark) {
  const Scene::Moment& moment = at(robot, mark.time);
  return std::hypot(moment.position.x - mark.position.x, moment.position.y - mark.position.y) <
         std::max(1.0, 2.0 * robot.radius_m);
}

// Marks do not say whose they are: those near enough are taken for the robot's own.
void add_marks(const Scene::Robot& robot, const std::vector<Scene::Mark>& marks, const std::string& verb,
               std::vector<KeyMoment>& found) {
  for (const Scene::Mark& mark : marks)
    if (is_near(robot, mark)) found.push_back({&robot, &at(robot, mark.time), verb + mark.label});
}

void fill_up(const Scene::Robot& robot, std::vector<KeyMoment>& found) {
  const TimePoint first = robot.moments.front().time;
  const Duration length = robot.moments.back().time - first;
  for (std::size_t i = 1; i < kLeast - 1 && found.size() < kLeast; ++i) {
    const Scene::Moment& between =
        at(robot, first + length * static_cast<int>(i) / static_cast<int>(kLeast - 1));
    if (std::ranges::none_of(found, [&](const KeyMoment& key) { return key.moment == &between; }))
      found.push_back({&robot, &between, ""});
  }
}

std::vector<KeyMoment> thinned(const std::vector<KeyMoment>& all) {
  if (all.size() <= kMost) return all;
  std::vector<KeyMoment> kept;
  for (std::size_t i = 0; i < kMost; ++i) kept.push_back(all[i * (all.size() - 1) / (kMost - 1)]);
  return kept;
}

std::vector<KeyMoment> moments_of(const Scene::Robot& robot, const Scene& scene) {
  std::vector<KeyMoment> found{{&robot, &robot.moments.front(), "start"}};
  if (robot.moments.size() > 1) found.push_back({&robot, &robot.moments.back(), "end"});
  add_marks(robot, scene.arrivals, "at ", found);
  add_marks(robot, scene.contacts, "contact of ", found);
  fill_up(robot, found);
  std::ranges::stable_sort(found, {}, [](const KeyMoment& key) { return key.moment->time; });
  return thinned(found);
}

}  // namespace

std::vector<KeyMoment> key_moments(const Scene& scene) {
  std::vector<KeyMoment> all;
  for (const Scene::Robot& robot : scene.robots) {
    if (robot.moments.empty()) continue;
    const std::vector<KeyMoment> found = moments_of(robot, scene);
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

}  // namespace orca
