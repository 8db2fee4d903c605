// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"

namespace orca::deployer {

/// The description that a plugin gives of itself.
struct PluginDescription {
  std::string file;
  std::uint32_t abi_version = 0;
  std::string orca_version;  ///< Version of the Orca that it was built with.
  std::string build_id;      ///< Of the plugin, as the linker wrote it; empty: none.
  std::vector<Contract> types;
};

/// Loads a plugin and describes it. Its types are constructed only for that.
/// @param type  the only type to describe; empty: all.
[[nodiscard]] Result<PluginDescription> describe_plugin(const std::string& path,
                                                        const std::string& type = "");

/// Returns whether a word names a plugin file rather than a type: it has a '/', ends with ".so", or is a file here.
[[nodiscard]] bool names_plugin_file(const std::string& word);

/// Returns the text that `--describe` prints: the types with their ports and parameters.
[[nodiscard]] std::string text(const PluginDescription& plugin);
/// Returns the same for programs:
/// {file, abi_version, orca_version, build_id, types: [{type, kind, ports, parameters, ...}]}.
[[nodiscard]] std::string json(const PluginDescription& plugin);

}  // namespace orca::deployer
