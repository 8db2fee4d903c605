// SPDX-License-Identifier: LGPL-3.0-or-later
#include "world_surroundings.hpp"

#include "orca/idl/time.hpp"
#include "world_objects.hpp"

namespace orca::sim {

void WorldSurroundings::fill_plan(idl::WorldPlan& plan) {
  world_->at(host_.now(), [&](const World& world) { fill(plan, world.model()); });
}

void WorldSurroundings::fill_scene(idl::WorldScene& scene) {
  const TimePoint now = host_.now();
  world_->at(now, [&](const World& world) { fill(scene, world); });
  scene.stamp(to_time_value(now));
  scene.events().clear();
  for (const SharedWorld::Event& event : world_->events()) {
    const Vec2 place = event.place.value_or(Vec2{std::nan(""), std::nan("")});
    idl::WorldEvent& object = scene.events().emplace_back();
    object.text(event.text);
    object.x(place.x);
    object.y(place.y);
    object.stamp(to_time_value(event.time));
  }
}

Result<std::string> WorldSurroundings::change(const idl::WorldChange& change) {
  const TimePoint now = host_.now();
  Result<std::string> changed = world_->at(now, [&](World& world) { return carry_out(change, world); });
  if (changed) world_->note(*changed, now);
  return changed;
}

}  // namespace orca::sim
