// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cstdio>

#include "drawing.hpp"
#include "orca/xml/document.hpp"

namespace orca::batch {
namespace {

using xml::escaped;

std::string in_pixels(double value, const char* format = "%.1f") {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// Returns the element of a part.
struct Element {
  std::string operator()(const Stroke& line) const {
    return "<line x1=\"" + in_pixels(line.from.x) + "\" y1=\"" + in_pixels(line.from.y) + "\" x2=\"" +
           in_pixels(line.to.x) + "\" y2=\"" + in_pixels(line.to.y) + "\" stroke=\"" + line.colour + "\"/>\n";
  }
  std::string operator()(const Words& words) const {
    return "<text x=\"" + in_pixels(words.at.x) + "\" y=\"" + in_pixels(words.at.y) + "\" text-anchor=\"" +
           words.anchor + "\" fill=\"" + words.colour + "\">" + escaped(words.text) + "</text>\n";
  }
  std::string operator()(const Polyline& line) const {
    std::string text = "<polyline fill=\"none\" stroke=\"" + line.colour + "\" stroke-width=\"" +
                       in_pixels(line.width) + "\" stroke-opacity=\"0.8\" points=\"";
    for (const Vec2& place : line.places) text += in_pixels(place.x) + "," + in_pixels(place.y) + " ";
    return text + "\"/>\n";
  }
  std::string operator()(const Walls& walls) const {
    std::string path = "<path fill=\"none\" stroke=\"#444\" d=\"";
    for (const Places& line : walls.lines)
      for (const Vec2& place : line)
        path += (&place == &line.front() ? "M" : "L") + in_pixels(place.x) + " " + in_pixels(place.y);
    return path + "\"/>\n";
  }
  std::string operator()(const Circle& circle) const {
    return "<circle cx=\"" + in_pixels(circle.centre.x) + "\" cy=\"" + in_pixels(circle.centre.y) +
           "\" r=\"5\" fill=\"none\" stroke=\"" + circle.colour + "\" stroke-width=\"2\"/>\n";
  }
  std::string operator()(const Bar& bar) const {
    return "<rect x=\"" + in_pixels(bar.corner.x) + "\" y=\"" + in_pixels(bar.corner.y, "%.0f") +
           "\" width=\"" + in_pixels(bar.size.x, "%.0f") + "\" height=\"" + in_pixels(bar.size.y, "%.0f") +
           "\" fill=\"" + bar.colour + "\"/>\n";
  }
};

}  // namespace

std::string to_svg(const Drawing& drawing, const std::string& description) {
  const std::string width = in_pixels(drawing.size.x, "%.0f");
  const std::string height = in_pixels(drawing.size.y, "%.0f");
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height +
                     "\" viewBox=\"0 0 " + width + " " + height +
                     "\" font-size=\"12\" font-family=\"sans-serif\">\n";
  if (!description.empty()) text += "<desc>" + escaped(description) + "</desc>\n";
  for (const Part& part : drawing.parts) text += std::visit(Element{}, part);
  return text + "</svg>\n";
}

}  // namespace orca::batch
