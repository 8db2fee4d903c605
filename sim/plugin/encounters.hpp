// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orca/hw/scene.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/shape.hpp"

namespace orca::sim {

// The encounters of one robot with people: each begins when the two are nearer than Scene::kNear, and ends when they are well
// apart again.
class Encounters {
 public:
  // The robot after a tick.
  struct Now {
    TimePoint time;
    Shape outline;       // In the world.
    double speed = 0.0;  // [m/s]
  };

  // Looks how near a person is now.
  void look(const Person& person, const Now& now);
  // Notes that they touched in this tick. @pre  the contact is one with a person.
  void touch(const ContactEvent& contact, TimePoint time);

  [[nodiscard]] const std::vector<Scene::Encounter>& all() const { return all_; }

 private:
  Scene::Encounter& present(const std::string& person, TimePoint time);

  std::vector<Scene::Encounter> all_;
  std::map<std::string, std::size_t> present_;  // By the person's name.
};

}  // namespace orca::sim
