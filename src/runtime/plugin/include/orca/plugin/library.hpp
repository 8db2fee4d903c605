// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/component/manifest.hpp"

namespace orca {

/// A plugin in memory, from load() until the object is destroyed. Whatever was made from its types must be
/// gone by then.
///
/// Thread contract: one thread.
class PluginLibrary {
 public:
  /// Loads a plugin and checks its manifest.
  ///
  /// @errors  not_found if there is no such file; invalid_argument, with what is wrong and what to do, for a
  /// file that
  ///          cannot be loaded, that is not an Orca plugin, or that was built for another ABI version.
  static Result<std::unique_ptr<PluginLibrary>> load(const std::string& path);

  ~PluginLibrary();
  PluginLibrary(const PluginLibrary&) = delete;
  PluginLibrary& operator=(const PluginLibrary&) = delete;

  /// The absolute path that it was loaded from.
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] const Manifest& manifest() const { return *manifest_; }
  [[nodiscard]] std::vector<const TypeEntry*> types() const;
  /// Null if the plugin holds no such type.
  [[nodiscard]] const TypeEntry* find(PluginKind kind, std::string_view type) const;

 private:
  PluginLibrary(std::string path, void* handle, const Manifest* manifest);

  std::string path_;
  void* handle_;
  const Manifest* manifest_;
};

/// Whether any part of the file is still mapped into this process, be it that the file itself has been
/// removed or exchanged meanwhile: the proof after unloading.
[[nodiscard]] bool is_mapped(const std::string& path);

}  // namespace orca
