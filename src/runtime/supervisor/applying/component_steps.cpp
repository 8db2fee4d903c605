// SPDX-License-Identifier: LGPL-3.0-or-later
#include "applying/component_steps.hpp"

#include <algorithm>
#include <optional>

namespace orca::supervisor {

std::vector<JointStep> arrival_steps(const std::vector<AddComponent>& components) {
  std::vector<JointStep> steps;
  for (const AddComponent& component : components) {
    const auto make = [component]() -> std::optional<ThereAndBack> {
      return ThereAndBack{component, RemoveComponent{component.node.name}};
    };
    steps.push_back({component.node.name, make, [](bool) {}});
  }
  return steps;
}

Status announce(const std::vector<AddComponent>& components, const std::vector<Member*>& all) {
  const auto coming = std::ranges::find(all, Member::Phase::coming_up, &Member::phase);
  if (coming != all.end())
    return fail(Code::unavailable, "process " + (*coming)->name() + " is just coming up; try again later");
  for (const AddComponent& component : components)
    for (Member* const member : all)
      if (member->name() != component.node.process) member->tell(component);
  return ok();
}

void announce_end(const std::string& component, const std::string& process, const std::vector<Member*>& all) {
  for (Member* const member : all)
    if (member->name() != process && member->is_built()) member->tell(RemoveComponent{component});
}

}  // namespace orca::supervisor
