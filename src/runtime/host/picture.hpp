// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"
#include "orca/hw/scene.hpp"

namespace orca {

/// Draws a scene into a file, as SVG or PNG by the file's ending; a metre is as long across as up.
///
/// @errors  invalid_argument for another ending or an empty scene; unavailable if the file cannot be written.
Status write_picture(const Scene& scene, const std::string& path);

}  // namespace orca
