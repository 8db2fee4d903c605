// SPDX-License-Identifier: LGPL-3.0-or-later
#include "drawn_picture.hpp"

#include <cairo-svg.h>
#include <cairo.h>

#include <memory>

#include "views.hpp"

namespace orca::host {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;

cairo_status_t append(void* file, const unsigned char* data, unsigned int length) {
  static_cast<OutputFile*>(file)->write({reinterpret_cast<const char*>(data), length});
  return CAIRO_STATUS_SUCCESS;
}

Surface make_surface(const std::string& path, double width, double height, OutputFile& file) {
  cairo_surface_t* const surface =
      path.ends_with(".svg")
          ? cairo_svg_surface_create_for_stream(append, &file, width, height)
          : cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width), static_cast<int>(height));
  return {surface, cairo_surface_destroy};
}

Status finish(cairo_surface_t* surface, const std::string& path, OutputFile& file) {
  cairo_status_t status = cairo_surface_status(surface);
  if (status == CAIRO_STATUS_SUCCESS && path.ends_with(".png"))
    status = cairo_surface_write_to_png_stream(surface, append, &file);
  cairo_surface_finish(surface);
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface);
  if (status == CAIRO_STATUS_SUCCESS) return ok();
  return fail(Code::unavailable, std::string("cannot draw the picture: ") + cairo_status_to_string(status),
              path);
}

Status draw(const Drawing& drawing, const std::string& path, OutputFile& file) {
  const Surface surface = make_surface(path, drawing.width, drawing.height, file);
  cairo_t* const cairo = cairo_create(surface.get());
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_paint(cairo);
  drawing.draw(cairo);
  cairo_destroy(cairo);
  return finish(surface.get(), path, file);
}

Result<Drawing> drawing_of(const Scene& scene, const PictureOptions& options) {
  switch (options.view) {
    case View::robot: return robot_view(scene, options.hidden);
    case View::film: return film(scene, options.hidden);
    default: return world_view(scene, options.hidden);
  }
}

}  // namespace

extern "C" [[gnu::visibility("default")]] void orca_draw_picture(const Scene& scene,
                                                                 const PictureOptions& options,
                                                                 OutputFile& file, Status& drawn) {
  const Result<Drawing> drawing = drawing_of(scene, options);
  drawn = drawing ? draw(*drawing, options.file, file)
                  : fail(drawing.error().code, drawing.error().message, options.file);
}

}  // namespace orca::host
