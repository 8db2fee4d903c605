// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cairo.h>

#include <set>
#include <string>
#include <vector>

#include "colours.hpp"
#include "orca/host/picture.hpp"

namespace orca::host {

/// The strip below a picture: what each colour means, and a bar of a round length as the scale.
class Legend {
 public:
  /// @param width  [pixels] of the picture.
  /// @param scale  [pixels/m] of the parts of the world that it shows.
  Legend(const Scene& scene, const std::set<Layer>& hidden, double width, double scale);

  [[nodiscard]] double height() const;  ///< [pixels]
  /// Draws the strip with its upper edge at `top` [pixels].
  void draw(cairo_t* cairo, double top) const;

 private:
  struct Entry {
    std::string text;
    Colour colour;
    double left;  // [pixels]
    double top;   // [pixels] below the upper edge of the strip
  };
  void add(const std::string& text, const Colour& colour);
  void add_robots(const Scene& scene);
  void add_layers(const Scene& scene, const std::set<Layer>& hidden);
  static void draw_entry(cairo_t* cairo, const Entry& entry, double top);
  void draw_bar(cairo_t* cairo, double top) const;

  std::vector<Entry> entries_;
  double width_;
  double scale_;
  double next_left_;  // [pixels] Place of the next entry.
  double next_top_ = 0.0;
};

}  // namespace orca::host
