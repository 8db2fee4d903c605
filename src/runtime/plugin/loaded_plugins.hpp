// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "orca/plugin/loaded_plugins.hpp"

namespace orca::plugin {

/// A registration of the plugin that contains an address. plugin_at() knows the plugin during this object's
/// lifetime. Beyond 256 plugins the rest stays unknown.
///
/// Thread contract: one thread makes and destroys.
class LoadedPlugin {
 public:
  LoadedPlugin(const std::string& path, const void* address);
  ~LoadedPlugin();
  LoadedPlugin(const LoadedPlugin&) = delete;
  LoadedPlugin& operator=(const LoadedPlugin&) = delete;

  /// Returns its extent in memory.
  [[nodiscard]] std::uintptr_t start() const { return start_; }
  [[nodiscard]] std::uintptr_t end() const { return end_; }

 private:
  std::uintptr_t start_ = 0;
  std::uintptr_t end_ = 0;
  int place_ = -1;
};

}  // namespace orca::plugin
