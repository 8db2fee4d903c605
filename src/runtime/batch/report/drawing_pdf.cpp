// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cairo-pdf.h>
#include <cairo.h>

#include <cstdlib>
#include <memory>
#include <numbers>

#include "drawing.hpp"

namespace orca::batch {
namespace {

constexpr double kLetterSize = 12.0;   // [points]
constexpr double kCircleRadius = 5.0;  // [points] of a circle

cairo_status_t append_bytes(void* file, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(file)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

// Draws parts as an SVG viewer does.
class PdfPage {
 public:
  explicit PdfPage(cairo_t* cairo) : cairo_(cairo) {
    cairo_select_font_face(cairo_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_, kLetterSize);
  }

  void operator()(const Stroke& line) const {
    trace({line.from, line.to});
    stroke(line.colour, 1.0);
  }
  void operator()(const Words& words) const {
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_, words.text.c_str(), &extents);
    const double share = words.anchor == "end" ? 1.0 : words.anchor == "middle" ? 0.5 : 0.0;
    cairo_move_to(cairo_, words.at.x - share * extents.x_advance, words.at.y);
    set_colour(words.colour);
    cairo_show_text(cairo_, words.text.c_str());
  }
  void operator()(const Polyline& line) const {
    trace(line.places);
    stroke(line.colour, line.width, 0.8);
  }
  void operator()(const Walls& walls) const {
    for (const Places& line : walls.lines) trace(line);
    stroke("#444", 1.0);
  }
  void operator()(const Circle& circle) const {
    cairo_new_sub_path(cairo_);
    cairo_arc(cairo_, circle.centre.x, circle.centre.y, kCircleRadius, 0.0, 2.0 * std::numbers::pi);
    stroke(circle.colour, 2.0);
  }
  void operator()(const Bar& bar) const {
    cairo_rectangle(cairo_, bar.corner.x, bar.corner.y, bar.size.x, bar.size.y);
    set_colour(bar.colour);
    cairo_fill(cairo_);
  }

 private:
  void trace(const Places& places) const {
    cairo_new_sub_path(cairo_);
    for (const Vec2& place : places) cairo_line_to(cairo_, place.x, place.y);
  }

  void stroke(const std::string& colour, double width, double opacity = 1.0) const {
    set_colour(colour, opacity);
    cairo_set_line_width(cairo_, width);
    cairo_stroke(cairo_);
  }

  // Takes "#rgb" or "#rrggbb".
  void set_colour(const std::string& colour, double opacity = 1.0) const {
    const std::size_t digits = colour.size() / 3;
    const double most = digits == 1 ? 15.0 : 255.0;
    const auto share = [&](std::size_t i) {
      return static_cast<double>(std::strtol(colour.substr(1 + i * digits, digits).c_str(), nullptr, 16)) /
             most;
    };
    cairo_set_source_rgba(cairo_, share(0), share(1), share(2), opacity);
  }

  cairo_t* const cairo_;
};

}  // namespace

std::string to_pdf(const Drawing& drawing, const std::string& description) {
  std::string file;
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
      cairo_pdf_surface_create_for_stream(append_bytes, &file, drawing.size.x, drawing.size.y),
      cairo_surface_destroy);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");  // not that of now
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_SUBJECT, description.c_str());
  const std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo(cairo_create(surface.get()), cairo_destroy);
  const PdfPage page(cairo.get());
  for (const Part& part : drawing.parts) std::visit(page, part);
  cairo_surface_finish(surface.get());
  const bool is_drawn = cairo_status(cairo.get()) == CAIRO_STATUS_SUCCESS &&
                        cairo_surface_status(surface.get()) == CAIRO_STATUS_SUCCESS;
  return is_drawn ? file : "";
}

}  // namespace orca::batch
