// SPDX-License-Identifier: GPL-3.0-or-later
// Time of one simulated second: physics at 100 Hz, 16 sonars and 361 laser beams at 10 Hz for each robot. The
// factor over real time is one second divided by this time.
#include <optional>
#include <string>

#include "benchmarks.hpp"
#include "comparison.hpp"
#include "processors.hpp"
#include "sim_scenes.hpp"
#include "wanderers.hpp"

namespace orca::bench {
namespace {

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
