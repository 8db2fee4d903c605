// SPDX-License-Identifier: LGPL-3.0-or-later
#include "component_list.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

namespace orca::host {

void ComponentList::add(std::unique_ptr<ComponentInstance> component) {
  const std::lock_guard lock(mutex_);
  by_name_[component->name()] = component.get();
  all_.push_back(std::move(component));
}

std::unique_ptr<ComponentInstance> ComponentList::take(const std::string& name) {
  const std::lock_guard lock(mutex_);
  by_name_.erase(name);
  const auto place = std::ranges::find(all_, name, [](const auto& component) { return component->name(); });
  std::unique_ptr<ComponentInstance> taken = std::move(*place);
  all_.erase(place);
  return taken;
}

ComponentInstance* ComponentList::find(const std::string& name) const {
  const std::shared_lock lock(mutex_);
  const auto place = by_name_.find(name);
  return place == by_name_.end() ? nullptr : place->second;
}

std::size_t ComponentList::working() const {
  const std::shared_lock lock(mutex_);
  return static_cast<std::size_t>(std::ranges::count(
      all_, ComponentState::work, [](const auto& component) { return component->state(); }));
}

std::vector<RunGlance::Unwell> ComponentList::unwell() const {
  std::vector<RunGlance::Unwell> unwell;
  const std::shared_lock lock(mutex_);
  for (const auto& component : all_) {
    const ComponentState state = component->state();
    if (component->report().ended_badly) {
      unwell.push_back({component->name(), to_string(ComponentState::work_failed)});
    } else if (is_unsettled(state)) {
      unwell.push_back({component->name(), to_string(state)});
    }
  }
  return unwell;
}

}  // namespace orca::host
