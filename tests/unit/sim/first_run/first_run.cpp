// SPDX-License-Identifier: GPL-3.0-or-later
// The example of docs/simulation.md; to be run in the source tree's top folder.
// [program]
#include <algorithm>
#include <iostream>

#include "orca/sim/robot_file.hpp"
#include "orca/sim/world.hpp"
#include "orca/sim/world_file.hpp"

int main() {
  using namespace orca::sim;
  orca::xml::Diagnostics errors;
  const auto office = read_world("sim/worlds/office.xml", {}, errors);
  const auto scout = read_robot("sim/robots/nomad_scout.urdf", errors);
  if (!office || !scout) {
    std::cerr << errors.text();
    return 2;
  }
  World world(*office, {.seed = 1, .realism = Realism::nominal});
  const auto dewey = world.add_robot("dewey", *scout, office->place("start")->pose);
  if (!dewey || !world.set_velocity_command(*dewey, 0.3, 0.0)) return 1;  // 0.3 m/s, straight on

  for (int tick = 0; tick < 100; ++tick) {
    world.step();                                  // 10 ms
    if (const auto& scan = world.sonar(*dewey)) {  // only in the tick that completes a round of the ring
      const auto nearest = std::ranges::min_element(scan->readings, {}, &SonarReading::range);
      std::cout << "nearest echo " << nearest->range << " m\n";
    }
  }
}
// [/program]
