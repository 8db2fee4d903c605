// SPDX-License-Identifier: LGPL-3.0-or-later
#include "encounters.hpp"

namespace orca::sim {
namespace {

constexpr double kApart = Scene::kNear + 0.05;  // [m]

}  // namespace

Scene::Encounter& Encounters::present(const std::string& person, TimePoint time) {
  const auto [at, is_new] = present_.try_emplace(person, all_.size());
  if (is_new) all_.push_back({time, person, Scene::kNear});
  return all_[at->second];
}

void Encounters::look(const Person& person, const Now& now) {
  const double gap = distance(now.outline, person.position) - person.radius;
  if (gap > kApart) present_.erase(person.name);
  if (gap >= Scene::kNear) return;
  Scene::Encounter& encounter = present(person.name, now.time);
  if (encounter.touched || gap >= encounter.gap_m) return;
  encounter.gap_m = gap;
  encounter.robot_speed = now.speed;
  encounter.person_speed = person.speed;
}

void Encounters::touch(const ContactEvent& contact, TimePoint time) {
  Scene::Encounter& encounter = present(contact.other, time);
  if (encounter.touched) return;
  encounter.touched = true;
  encounter.gap_m = 0.0;
  encounter.robot_speed = contact.speed;
  encounter.person_speed = *contact.person_speed;
}

}  // namespace orca::sim
