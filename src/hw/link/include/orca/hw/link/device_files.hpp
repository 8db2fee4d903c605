// SPDX-License-Identifier: LGPL-3.0-or-later

/// @file
/// The files in /dev behind which devices are: where they are, who may open them, and who has done so.
///
/// Thread contract: any thread; each function looks at the file system anew.
#pragma once

#include <string>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::hw::link {

/// Returns the path without links; empty: it leads to nothing.
[[nodiscard]] std::string resolved(const std::string& path);

/// Says that another program has the device, and which.
/// @param name  of the link, for messages.
/// @pre  the caller has closed its own descriptor of it.
[[nodiscard]] Error explain_holder(const std::string& path, const std::string& name);

/// Says that this user may not open the device, and who may.
[[nodiscard]] Error explain_permission(const std::string& path, const std::string& name);

/// Returns whether the path is that of a camera by its name, or leads to one: /dev/video0, /dev/v4l/by-id/...
[[nodiscard]] bool is_camera(const std::string& path);

/// Returns the cameras of this machine: by their names in v4l/by-id, and those without such a name by their path. Each once.
/// Further files of one camera, which give no pictures, are left out as far as their names show it.
/// @param folder  of the devices: /dev.
[[nodiscard]] std::vector<std::string> cameras(const std::string& folder = "/dev");

}  // namespace orca::hw::link
