// SPDX-License-Identifier: LGPL-3.0-or-later
#include "doorbells.hpp"

#include <algorithm>
#include <utility>

namespace orca::supervisor {
namespace {

std::size_t place_of(const std::string& name, const std::vector<std::string>& names) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

void put(const std::string& name, std::size_t place, std::vector<std::string>& names) {
  if (names.size() <= place) names.resize(place + 1);
  names[place] = name;
}

}  // namespace

Doorbells::Doorbells(const graph::Graph& whole, const std::vector<graph::ProcessNode>& processes,
                     std::optional<Backend> executor, Words words, const RunPage& page)
    : page_(page), words_(std::move(words)) {
  for (const graph::ProcessNode& node : processes)
    if (executor.value_or(node.executor) == Backend::fiber) of_fibers_.insert(node.name);
  for (const graph::ComponentNode& node : whole.components) processes_[node.name] = node.process;
}

void Doorbells::add(const graph::ComponentNode& component, std::size_t place) {
  const MutexLock lock(mutex_);
  processes_[component.name] = component.process;
  put(component.name, place, words_.components);
}

void Doorbells::add_process(const std::string& process, std::size_t place, bool is_of_fibers) {
  const MutexLock lock(mutex_);
  put(process, place, words_.processes);
  is_of_fibers ? (void)of_fibers_.insert(process) : (void)of_fibers_.erase(process);
}

DoorbellWord& Doorbells::of(const std::string& component) const {
  const MutexLock lock(mutex_);
  const std::string& process = processes_.at(component);
  if (of_fibers_.contains(process)) return page_.process_doorbell(place_of(process, words_.processes));
  return page_.doorbell(place_of(component, words_.components));
}

Doorbells::Words Doorbells::words() const {
  const MutexLock lock(mutex_);
  return words_;
}

}  // namespace orca::supervisor
