// SPDX-License-Identifier: LGPL-3.0-or-later
#include "map_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace orca::maps {
namespace {

using image::GreyImage;

constexpr std::uint8_t kFree = 0;
constexpr std::uint8_t kOccupied = 100;
constexpr std::uint8_t kUnknown = 255;
constexpr int kOccupiedPercent = 65;  // as ROS's map_saver: occupied_thresh and free_thresh
constexpr int kFreePercent = 19;
constexpr std::uint8_t kGreyFree = 254;
constexpr std::uint8_t kGreyUnknown = 205;

std::string size_text(const GreyImage& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height);
}

// Returns how much pixels differ on the mean that stand so far apart in the file.
double unlikeness(const GreyImage& image, std::size_t apart, std::size_t from_end) {
  std::size_t sum = 0;
  const std::size_t count = image.grey.size() - from_end;
  for (std::size_t i = 0; i < count; ++i)
    sum += static_cast<std::size_t>(std::abs(int{image.grey[i]} - int{image.grey[i + apart]}));
  return static_cast<double>(sum) / static_cast<double>(count);
}

// In a picture what lies one above the other is alike. If pixels one height apart in the file are much more alike than those one width
// apart, the width is really the height. A long picture is not judged: there most pixels one height apart lie in the same row, and the
// walls of a corridor make them alike. Less than kMuch times as long as wide, at least half of them lie in different rows.
bool is_transposed(const GreyImage& image) {
  constexpr std::size_t kTooSmall = 16;  // [pixels] to say anything
  constexpr std::size_t kMuch = 2;
  const auto [least, most] = std::minmax(image.width, image.height);
  if (image.width == image.height || least < kTooSmall || most >= kMuch * least) return false;
  return static_cast<double>(kMuch) * unlikeness(image, image.height, most) <
         unlikeness(image, image.width, most);
}

// Between black and white a map has one grey, that of what is not known; in drawn plans edges are soft. A photograph has all greys.
bool is_photograph(const GreyImage& image) {
  constexpr std::size_t kDark = 90;  // 0.65 and 0.196 of darkness
  constexpr std::size_t kLight = 205;
  constexpr double kMost = 0.2;  // of all pixels
  std::array<std::size_t, 256> counts{};
  for (const std::uint8_t grey : image.grey) ++counts[grey];
  std::size_t between = 0, one = 0;
  for (std::size_t grey = kDark; grey <= kLight; ++grey) {
    between += counts[grey];
    one = std::max(one, counts[grey]);
  }
  return static_cast<double>(between - one) > kMost * static_cast<double>(image.grey.size());
}

// Per cent of what is neither occupied nor free.
std::uint8_t between(double darkness, const MapHeader& header) {
  const double share = (darkness - header.free_to) / (header.occupied_from - header.free_to);
  return static_cast<std::uint8_t>(std::lround(1.0 + 98.0 * share));
}

std::array<std::uint8_t, 256> cells_of_greys(const MapHeader& header) {
  std::array<std::uint8_t, 256> cells{};
  for (int grey = 0; grey < 256; ++grey) {
    const double darkness = (header.negate ? grey : 255 - grey) / 255.0;
    std::uint8_t& cell = cells.at(static_cast<std::size_t>(grey));
    if (header.mode == MapMode::raw)
      cell = grey <= kOccupied ? static_cast<std::uint8_t>(grey) : kUnknown;
    else if (darkness > header.occupied_from)
      cell = kOccupied;
    else if (darkness < header.free_to)
      cell = kFree;
    else
      cell = header.mode == MapMode::scale ? between(darkness, header) : kUnknown;
  }
  return cells;
}

}  // namespace

Status check_picture(const GreyImage& image, MapMode mode, const std::string& path) {
  const auto refused = [&](const std::string& why) { return fail(Code::invalid_argument, why, path); };
  if (image.deep)
    return refused(
        "the picture has 16 bits a pixel, and a map has 8; convert it, for instance with \"convert OLD "
        "-depth 8 NEW\"");
  if (image.coloured)
    return refused(
        "the picture has colours, and a map is grey; decide what they mean, and paint what is occupied "
        "black, what is "
        "free white and what is not known in grey 205");
  if (is_transposed(image))
    return refused("width and height seem to be exchanged in the head of the picture, which says " +
                   size_text(image) + "; correct it to " + std::to_string(image.height) + " x " +
                   std::to_string(image.width));
  if (mode == MapMode::trinary && is_photograph(image))
    return refused(
        "more than a fifth of the picture are greys that are neither occupied nor free, as in a photograph; "
        "draw a "
        "plan in black and white, or say mode: scale in a YAML file if greys are probabilities");
  return ok();
}

idl::OccupancyGrid map_of(const GreyImage& image, const MapHeader& header) {
  const std::array<std::uint8_t, 256> cells = cells_of_greys(header);
  idl::OccupancyGrid map;
  map.corner().x(header.corner.x);
  map.corner().y(header.corner.y);
  map.corner().orientation(header.corner.yaw);
  map.resolution(header.resolution);
  map.columns(static_cast<std::uint32_t>(image.width));
  map.rows(static_cast<std::uint32_t>(image.height));
  map.cells().reserve(image.grey.size());
  for (std::size_t row = image.height; row-- > 0;)
    for (std::size_t i = row * image.width; i < (row + 1) * image.width; ++i)
      map.cells().push_back(image.opaque.empty() || image.opaque[i] == 255 ? cells[image.grey[i]] : kUnknown);
  return map;
}

GreyImage picture_of(const idl::OccupancyGrid& map) {
  GreyImage image{map.columns(), map.rows(), {}};
  image.grey.reserve(map.cells().size());
  for (std::size_t row = image.height; row-- > 0;)
    for (std::size_t i = row * image.width; i < (row + 1) * image.width; ++i) {
      const int cell = map.cells()[i];
      const bool occupied = cell >= kOccupiedPercent && cell <= kOccupied;
      image.grey.push_back(occupied ? 0 : cell <= kFreePercent ? kGreyFree : kGreyUnknown);
    }
  return image;
}

}  // namespace orca::maps
