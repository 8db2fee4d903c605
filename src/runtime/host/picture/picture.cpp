// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/picture.hpp"

#include <algorithm>

#include "drawn_picture.hpp"
#include "orca/base/files/own_library.hpp"

namespace orca::host {
namespace {

// Returns the value of an enum by its name's position in a list of the same order.
template <class Enum>
std::optional<Enum> named(std::string_view name, const std::vector<std::string>& names) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Enum>(found - names.begin());
}

}  // namespace

const std::vector<std::string>& view_names() {
  static const std::vector<std::string> names{"world", "robot", "film"};
  return names;
}

const std::vector<std::string>& layer_names() {
  static const std::vector<std::string> names{"walls", "track",  "robot", "sonar",
                                              "laser", "motion", "marks", "places"};
  return names;
}

std::optional<View> view_from(std::string_view name) { return named<View>(name, view_names()); }

std::optional<Layer> layer_from(std::string_view name) { return named<Layer>(name, layer_names()); }

Status write_picture(const Scene& scene, const PictureOptions& options, OutputFile& file) {
  if (!options.file.ends_with(".svg") && !options.file.ends_with(".png"))
    return fail(Code::invalid_argument, "a picture's name ends in .svg or .png", options.file);
  const auto draw = late_function<decltype(orca_draw_picture)>("liborca_picture.so", "orca_draw_picture");
  if (!draw) return draw.error();
  Status drawn;
  (*draw)(scene, options, file, drawn);
  return drawn;
}

}  // namespace orca::host
