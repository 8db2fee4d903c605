// SPDX-License-Identifier: GPL-3.0-or-later
#include "wanderers.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "orca/base/random.hpp"

namespace orca::bench {
namespace {

constexpr int kTicksPerScan = 10;
constexpr int kTicksPerSecond = 100;

}  // namespace

Wanderers::Wanderers(const sim::WorldModel& model, const Setting& setting, bool sensing,
                     const sim::Bounds& area)
    : world_(model, {.seed = 1, .realism = setting.realism, .threads = setting.threads}),
      team_(setting.threads),
      sensing_(sensing) {
  sim::RobotModel robot = scout();
  if (!sensing) robot.sonars.clear();
  RandomStream random(3, "bench", "starts");
  for (int tries = 0; robots_.size() < setting.robots; ++tries) {
    if (tries > 100'000) throw std::runtime_error("no room for the robots of the benchmark");
    const Pose2 X_WB{random.uniform(area.low.x, area.high.x), random.uniform(area.low.y, area.high.y),
                     random.uniform(-std::numbers::pi, std::numbers::pi)};
    const auto id = world_.add_robot("robot" + std::to_string(tries), robot, X_WB);
    if (id) robots_.push_back(*id);
  }
  free_.resize(robots_.size());
}

void Wanderers::run_a_second() {
  for (int tick = 0; tick < kTicksPerSecond; ++tick) {
    world_.step();
    if (!sensing_ || tick % kTicksPerScan != 0) continue;
    team_.for_all(robots_.size(), [this](std::size_t i) { free_[i] = is_free(robots_[i]); });
    for (std::size_t i = 0; i < robots_.size(); ++i) steer(robots_[i], free_[i] != 0);
  }
}

bool Wanderers::is_free(sim::RobotId id) const {
  const auto ranges = fan_.cast(world_.caster(), world_.pose(id), static_cast<std::size_t>(id));
  return std::all_of(ranges.begin() + 120, ranges.begin() + 241, [](double range) { return range > 0.6; });
}

void Wanderers::steer(sim::RobotId id, bool free) {
  const Twist2 wanted = free ? Twist2{0.4, 0.0, 0.1} : Twist2{0.0, 0.0, 0.8};
  if (!world_.set_velocity_command(id, wanted.forward, wanted.turn_rate))
    throw std::runtime_error("a command of the benchmark is wrong");
}

Nanoseconds seconds_of(Wanderers& wanderers, int seconds) {
  return time_per_operation(seconds, [&] {
    for (int i = 0; i < seconds; ++i) wanderers.run_a_second();
  });
}

}  // namespace orca::bench
