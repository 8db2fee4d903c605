// SPDX-License-Identifier: GPL-3.0-or-later
// Time of one simulated second: physics at 100 Hz, 16 sonars and 361 laser beams at 10 Hz for each robot. The
// factor over real time is one second divided by this time.
#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks.hpp"
#include "comparison.hpp"
#include "orca/base/random.hpp"
#include "orca/base/team.hpp"
#include "orca/sim/world.hpp"
#include "processors.hpp"
#include "sim_scenes.hpp"

namespace orca::bench {
namespace {

constexpr int kTicksPerScan = 10;
constexpr int kTicksPerSecond = 100;

struct Setting {
  std::size_t robots = 1;
  sim::Realism realism = sim::Realism::nominal;
  unsigned threads = 1;  // Threads that compute sensor readings.
};

/// Robots that wander about a world. They drive ahead while there is room, and otherwise turn on the spot.
/// Without sensors they stand still.
class Wanderers {
 public:
  Wanderers(const sim::WorldModel& model, const Setting& setting, bool sensing)
      : world_(model, {.seed = 1, .realism = setting.realism, .threads = setting.threads}),
        team_(setting.threads),
        sensing_(sensing) {
    sim::RobotModel robot = scout();
    if (!sensing) robot.sonars.clear();
    RandomStream random(3, "bench", "starts");
    const sim::Bounds bounds = model.bounds();
    for (int tries = 0; robots_.size() < setting.robots; ++tries) {
      if (tries > 100'000) throw std::runtime_error("no room for the robots of the benchmark");
      const Pose2 X_WB{random.uniform(bounds.low.x, bounds.high.x),
                       random.uniform(bounds.low.y, bounds.high.y),
                       random.uniform(-std::numbers::pi, std::numbers::pi)};
      const auto id = world_.add_robot("robot" + std::to_string(tries), robot, X_WB);
      if (id) robots_.push_back(*id);
    }
    free_.resize(robots_.size());
  }

  void run_a_second() {
    for (int tick = 0; tick < kTicksPerSecond; ++tick) {
      world_.step();
      if (!sensing_ || tick % kTicksPerScan != 0) continue;
      team_.for_all(robots_.size(), [this](std::size_t i) { free_[i] = is_free(robots_[i]); });
      for (std::size_t i = 0; i < robots_.size(); ++i) steer(robots_[i], free_[i] != 0);
    }
  }

 private:
  [[nodiscard]] bool is_free(sim::RobotId id) const {
    const auto ranges = fan_.cast(world_.caster(), world_.pose(id), static_cast<std::size_t>(id));
    return std::all_of(ranges.begin() + 120, ranges.begin() + 241, [](double range) { return range > 0.6; });
  }
  void steer(sim::RobotId id, bool free) {
    const Twist2 wanted = free ? Twist2{0.4, 0.0, 0.1} : Twist2{0.0, 0.0, 0.8};
    if (!world_.set_velocity_command(id, wanted.forward, wanted.turn_rate))
      throw std::runtime_error("a command of the benchmark is wrong");
  }

  sim::World world_;
  Team team_;
  bool sensing_;
  Fan fan_;
  std::vector<sim::RobotId> robots_;
  std::vector<char> free_;  // Per robot: whether there is room ahead.
};

Nanoseconds seconds_of(Wanderers& wanderers, int seconds) {
  return time_per_operation(seconds, [&] {
    for (int i = 0; i < seconds; ++i) wanderers.run_a_second();
  });
}

void add(const std::string& name, const sim::WorldModel& model, const Setting& setting,
         double times_real_time) {
  const int seconds = setting.robots > 1 ? 1 : 20;
  const int samples = setting.robots > 1 ? 20 : 50;
  add_row(
      {"a simulated second, " + name, "at rest and without sensors", median_at_most(1e9 / times_real_time)},
      samples, [=](auto& state, Row& row) {
        std::optional<AllProcessors> all;
        if (setting.threads > 1) all.emplace();
        Wanderers seeing(model, setting, true);
        Wanderers resting(model, setting, false);
        alternate(
            state, row, seconds, [&](int n) { return seconds_of(seeing, n); },
            [&](int n) { return seconds_of(resting, n); });
      });
}

}  // namespace

void register_sim_world() {
  add("one Scout among 200 boxes", two_hundred_boxes(), {}, 400.0);
  const std::optional<sim::WorldModel> map = cave();
  if (!map) return;
  add("one Scout in the cave", *map, {}, 400.0);
  add("100 Scouts in the cave", *map, {.robots = 100}, 5.0);
  add("100 Scouts that do not hear each other", *map, {.robots = 100, .realism = sim::Realism::ideal}, 5.0);
  const auto threads = static_cast<unsigned>(at_start().count());
  if (threads > 1)
    add("100 Scouts in the cave on " + std::to_string(threads) + " threads", *map,
        {.robots = 100, .threads = threads}, 5.0);
}

}  // namespace orca::bench
