// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"

namespace orca::robot_file {

/// Returns the path of the file that a `filename` in a robot's file names: a path, beside the robot's file or from `/`; file://PATH; or
/// package://PACKAGE/PATH and model://PACKAGE/PATH. A package is looked for in the folder `packages`, if it is given, and
/// otherwise in the folders above the robot's file: a folder of its name, or one with the package.xml of that name.
/// Only in a package is it certain that the file exists.
/// @errors  not_found with the folders that were searched; invalid_argument for another scheme.
/// @thread  any; it reads the folders.
[[nodiscard]] Result<std::string> find_named_file(const std::string& name, const std::string& robot_file,
                                                  const std::string& packages);

}  // namespace orca::robot_file
