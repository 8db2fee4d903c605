// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/output_file.hpp"
#include "orca/base/result.hpp"
#include "orca/hw/scene.hpp"

namespace orca::host {

/// The viewpoint from which a run is shown.
enum class View {
  world,  ///< The whole world at the end of the run, with the robots' tracks.
  robot,  ///< The surroundings of the first robot at the end of the run; ahead is up.
  film,  ///< The surroundings of each robot at its key moments: start, arrivals, contacts, end, some between.
};

/// The parts of a picture that can be left out.
enum class Layer { walls, track, robot, sonar, laser, motion, marks, places };

/// Return the view or the layer that people call by this name; nothing if there is none.
[[nodiscard]] std::optional<View> view_from(std::string_view name);
[[nodiscard]] std::optional<Layer> layer_from(std::string_view name);
[[nodiscard]] const std::vector<std::string>& view_names();
[[nodiscard]] const std::vector<std::string>& layer_names();

/// The options of a picture of a run.
struct PictureOptions {
  std::string file;  ///< Ends in .svg or .png; empty: no picture.
  View view = View::world;
  std::set<Layer> hidden;
};

/// Draws a scene into an open file, as SVG or PNG by the ending of its name in the options, with the same scale
/// across as up. Each robot has a colour of its own. Sonar readings are yellow, lasers blue. A red arrow shows
/// how far the robot would drive in a second, and a red arc how far it would turn. A strip below explains the
/// colours and shows the scale.
///
/// @errors  invalid_argument for another ending or an empty scene; unavailable if it cannot be drawn. Whether it
///          could be written is returned by close() of the file.
Status write_picture(const Scene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace orca::host
