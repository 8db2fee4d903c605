// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"

namespace orca::sim::detail {

struct MeshPlace {
  std::string path;
  bool instead = false;  // Whether it is another format of the mesh, which lies beside it.
};

// Finds the file that the filename of a <mesh> names (robot_file::find_named_file). For a file whose format is not read (COLLADA,
// glTF, PLY) it finds an STL or OBJ file of the same name beside it.
// @errors  not_found with the folders that were searched; invalid_argument for a format that is not read.
[[nodiscard]] Result<MeshPlace> find_mesh(const std::string& name, const std::string& robot_file,
                                          const std::string& packages);

}  // namespace orca::sim::detail
