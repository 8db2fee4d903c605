// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "foxglove/robot_descriptions.hpp"
#include "orca/base/result.hpp"

namespace orca::view {

/// Size of the largest file that a viewer gets [bytes].
inline constexpr std::size_t kLargestAsset = std::size_t{16} << 20;

/// Returns the content of a file that a viewer may have: a robot's file, a mesh or a picture, by the ending of its name. A link counts by
/// the name of the file to which it leads.
/// @errors  failed_precondition: another kind of file; not_found: no such file, or it cannot be read; unavailable: too large.
[[nodiscard]] Result<std::string> read_asset(const std::string& path);

/// The files that viewers may fetch: the robots' files that a graph names, and the meshes and textures that those name.
/// What a viewer asks for is compared with these names, and never taken for a path.
///
/// Thread contract: not synchronised.
class Assets {
 public:
  Assets() = default;
  explicit Assets(const std::vector<RobotFile>& robots);

  /// Returns the content of a file.
  /// @param uri  as a robot's file writes it, such as "package://pioneer/base.stl"; or the path of any of the files, as it is
  ///             or with "file://" before it.
  /// @errors  not_found if no robot's file names it; else as read_asset().
  [[nodiscard]] Result<std::string> read(const std::string& uri) const;

 private:
  void add(const std::string& path);

  std::map<std::string, std::string> paths_;  // by URI
};

/// Returns the answer to a viewer that has asked for a file: the bytes, or why there are none.
[[nodiscard]] std::string asset_response(std::uint32_t request, const Result<std::string>& content);

}  // namespace orca::view
