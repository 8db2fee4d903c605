// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/hw/scene.hpp"

namespace orca::host {

/// From where a run is shown.
enum class View {
  world,  ///< The whole world as it was in the end, with the robots' ways.
  robot,  ///< Around the first robot as it was in the end; ahead is up.
  film,   ///< Around each robot at its key moments: start, arrivals, contacts, end, and some between.
};

/// What can be left out of a picture.
enum class Layer { walls, track, robot, sonar, laser, motion, marks };

/// Their names, as people write them.
[[nodiscard]] std::optional<View> view_from(std::string_view name);
[[nodiscard]] std::optional<Layer> layer_from(std::string_view name);
[[nodiscard]] const std::vector<std::string>& view_names();
[[nodiscard]] const std::vector<std::string>& layer_names();

struct PictureOptions {
  std::string file;  ///< Ends in .svg or .png; empty: no picture.
  View view = View::world;
  std::set<Layer> hidden;
};

/// Draws a scene into a file, as SVG or PNG by the file's ending; a metre is as long across as up. Sonar
/// readings are yellow, lasers blue; a red arrow shows how far the robot would come in a second, a red arc
/// how far it would turn.
///
/// @errors  invalid_argument for another ending or an empty scene; unavailable if the file cannot be written.
Status write_picture(const Scene& scene, const PictureOptions& options);

}  // namespace orca::host
