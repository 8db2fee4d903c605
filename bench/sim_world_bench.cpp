// SPDX-License-Identifier: GPL-3.0-or-later
// What a second of simulated time costs: physics at 100 Hz, 16 sonars and 361 laser beams at 10 Hz for each
// robot. A second divided by that is how many times faster than real time it runs.
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks.hpp"
#include "comparison.hpp"
#include "orca/base/random.hpp"
#include "orca/sim/world.hpp"
#include "sim_scenes.hpp"

namespace orca::bench {
namespace {

constexpr int kTicksPerScan = 10;
constexpr int kTicksPerSecond = 100;

/// Robots that wander about a world: ahead while there is room, else turning on the spot. Without sensors
/// they stand still.
class Wanderers {
 public:
  Wanderers(const sim::WorldModel& model, std::size_t count, bool sensing, sim::Realism realism)
      : world_(model, {.seed = 1, .realism = realism}), sensing_(sensing) {
    sim::RobotModel robot = scout();
    if (!sensing) robot.sonars.clear();
    RandomStream random(3, "bench", "starts");
    const sim::Bounds bounds = model.bounds();
    for (int tries = 0; robots_.size() < count; ++tries) {
      if (tries > 100'000) throw std::runtime_error("no room for the robots of the benchmark");
      const sim::Pose2 X_WB{random.uniform(bounds.low.x, bounds.high.x),
                            random.uniform(bounds.low.y, bounds.high.y),
                            random.uniform(-std::numbers::pi, std::numbers::pi)};
      const auto id = world_.add_robot("robot" + std::to_string(tries), robot, X_WB);
      if (id) robots_.push_back(*id);
    }
  }

  void run_a_second() {
    for (int tick = 0; tick < kTicksPerSecond; ++tick) {
      world_.step();
      if (!sensing_ || tick % kTicksPerScan != 0) continue;
      for (const sim::RobotId id : robots_) steer(id);
    }
  }

 private:
  void steer(sim::RobotId id) {
    bool free = true;
    const auto& ranges = fan_.cast(world_.caster(), world_.pose(id), static_cast<std::size_t>(id));
    for (std::size_t k = 120; k <= 240; ++k) free = free && ranges[k] > 0.6;
    const sim::Velocity wanted = free ? sim::Velocity{0.4, 0.1} : sim::Velocity{0.0, 0.8};
    if (!world_.set_velocity_command(id, wanted.forward, wanted.turn))
      throw std::runtime_error("a command of the benchmark is wrong");
  }

  sim::World world_;
  bool sensing_;
  Fan fan_;
  std::vector<sim::RobotId> robots_;
};

Nanoseconds seconds_of(Wanderers& wanderers, int seconds) {
  return time_per_operation(seconds, [&] {
    for (int i = 0; i < seconds; ++i) wanderers.run_a_second();
  });
}

void add(const std::string& name, const sim::WorldModel& model, std::size_t robots, double times_real_time,
         sim::Realism realism = sim::Realism::nominal) {
  const int seconds = robots > 1 ? 1 : 20;
  const int samples = robots > 1 ? 20 : 50;
  add_row(
      {"a simulated second, " + name, "at rest and without sensors", median_at_most(1e9 / times_real_time)},
      samples, [=](auto& state, Row& row) {
        Wanderers seeing(model, robots, true, realism);
        Wanderers resting(model, robots, false, realism);
        alternate(
            state, row, seconds, [&](int n) { return seconds_of(seeing, n); },
            [&](int n) { return seconds_of(resting, n); });
      });
}

}  // namespace

void register_sim_world() {
  add("one Scout among 200 boxes", two_hundred_boxes(), 1, 400.0);
  const std::optional<sim::WorldModel> map = cave();
  if (!map) return;
  add("one Scout in the cave", *map, 1, 400.0);
  add("100 Scouts in the cave", *map, 100, 5.0);
  add("100 Scouts that do not hear each other", *map, 100, 5.0, sim::Realism::ideal);
}

}  // namespace orca::bench
