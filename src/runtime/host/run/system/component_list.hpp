// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <shared_mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "orca/host/run_view.hpp"
#include "run/component/component_instance.hpp"

namespace orca::host {

/// The components of one graph in this process, which may come and go.
///
/// Thread contract: find(), working() and unwell() from any thread, the rest from one. A component is alive until the thread that
/// has taken it out destroys it, so others that look at it must know that it stays.
class ComponentList {
 public:
  using All = std::vector<std::unique_ptr<ComponentInstance>>;

  void add(std::unique_ptr<ComponentInstance> component);
  /// Takes a component out. @pre  it is there.
  [[nodiscard]] std::unique_ptr<ComponentInstance> take(const std::string& name);

  /// Returns a component; null if there is none of that name.
  [[nodiscard]] ComponentInstance* find(const std::string& name) const;
  /// Returns how many are at work.
  [[nodiscard]] std::size_t working() const;
  /// Returns those that do not work as they should, or not yet.
  [[nodiscard]] std::vector<RunGlance::Unwell> unwell() const;
  /// Returns all, in the order in which they have come.
  [[nodiscard]] const All& all() const { return all_; }

 private:
  mutable std::shared_mutex mutex_;
  All all_;                                                      // changed with mutex_ held
  std::unordered_map<std::string, ComponentInstance*> by_name_;  // the same
};

}  // namespace orca::host
