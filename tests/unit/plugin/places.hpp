// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "orca/plugin/library.hpp"

namespace orca::test {

/// The build's folders of the shipped plugins, and of those that only these tests load.
inline const std::string kShipped = ORCA_BINARY_DIR "/plugins";
inline const std::string kForTests = ORCA_BINARY_DIR "/tests/unit_plugins";

/// The author's example (templates/component).
inline const std::string kExample = ORCA_BINARY_DIR "/tests/plugins/avoid.so";

inline std::string test_plugin(const std::string& name) { return kForTests + "/" + name + ".so"; }

/// Returns the plugins in a folder, sorted.
inline std::vector<std::string> plugins_in(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".so") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// Loads a plugin, which must succeed.
inline std::unique_ptr<plugin::PluginLibrary> loaded(const std::string& path) {
  auto library = plugin::PluginLibrary::load(path);
  if (!library) FAIL("cannot load: " << library.error().text());
  return std::move(library).value();
}

/// Returns the reason why a plugin does not load.
inline Error refusal(const std::string& path) {
  auto library = plugin::PluginLibrary::load(path);
  if (library) FAIL(path << " was loaded");
  return library.error();
}

}  // namespace orca::test
