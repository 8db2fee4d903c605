// SPDX-License-Identifier: LGPL-3.0-or-later
#include <numbers>

#include "part_readers.hpp"

namespace orca::robot_file {

double Camera::focal_length() const {
  return 0.5 * static_cast<double>(width) / portable::tan(0.5 * field_of_view);
}

void read_camera(const xml::Attributes& e, Devices& model) {
  Camera camera;
  set(camera.name, e.name("name"));
  set(camera.link, e.text("link"));
  set(camera.width, e.integer("width"));
  set(camera.height, e.integer("height"));
  set(camera.field_of_view, e.number("field_of_view"));
  set(camera.period, e.duration("period"));
  if (camera.field_of_view >= std::numbers::pi)
    e.error_at("field_of_view", codes::kContradiction,
               "a camera with a pinhole sees less than 180 deg of its surroundings");
  if (camera.period > Duration{0}) check_period(e, camera.period);
  camera.label = read_label(e);
  if (name_is_free(e, camera.name, model)) model.cameras.push_back(std::move(camera));
}

}  // namespace orca::robot_file
