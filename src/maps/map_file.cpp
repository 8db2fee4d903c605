// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/maps/map_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "map_header.hpp"
#include "map_picture.hpp"
#include "orca/base/input_file.hpp"
#include "orca/base/output_file.hpp"
#include "orca/xml/number.hpp"

namespace orca::maps {
namespace {

namespace fs = std::filesystem;

constexpr int kLeastOccupied = 50;            // [%] likelier than not
constexpr int kMostOccupied = 100;            // [%] beyond: not known
constexpr std::size_t kMostText = 64 * 1024;  // [bytes] of a YAML file

Status check_extent(const image::GreyImage& image, double side, const std::string& path) {
  const std::size_t most = std::max(image.width, image.height);
  if (most > kMostAlong)
    return fail(Code::invalid_argument,
                "the map is " + std::to_string(most) + " pixels long, and a map has at most " +
                    std::to_string(kMostAlong) + "; cut it",
                path);
  if (static_cast<double>(most) * side > kMostExtent)
    return fail(Code::invalid_argument,
                std::to_string(most) + " pixels of " + xml::number_text(side) + " m are more than the " +
                    xml::number_text(kMostExtent) +
                    " m that a map may be long; correct the resolution, or cut the map",
                path);
  return ok();
}

constexpr double kHalf = 0.5;  // of darkness: grey 127 is occupied, 128 free, as in worlds of the simulator

Result<idl::OccupancyGrid> map_from(const image::GreyImage& image, const MapHeader& header,
                                    const fs::path& picture, const fs::path& named) {
  if (const Status sound = check_picture(image, header.mode, picture.string()); !sound.ok())
    return sound.error();
  if (const Status sound = check_extent(image, header.resolution, named.string()); !sound.ok())
    return sound.error();
  idl::OccupancyGrid map = map_of(image, header);
  map.name(named.stem().string());
  return map;
}

Result<idl::OccupancyGrid> read_plan(const std::string& path, double resolution) {
  const Result<image::GreyImage> image = image::read_image(path, kMostCells);
  if (!image) return image.error();
  if (!(resolution > 0.0))
    return fail(Code::invalid_argument,
                "a picture has no size of its own; give the resolution, the side of a pixel in metres, or "
                "the YAML file "
                "that belongs to it",
                path);
  if (!is_side(resolution))
    return fail(Code::invalid_argument, "the resolution " + wrong_side(resolution), path);
  MapHeader header;
  header.resolution = resolution;
  header.occupied_from = kHalf;
  header.free_to = kHalf;
  return map_from(*image, header, path, path);
}

Result<idl::OccupancyGrid> read_with_header(const std::string& text, const std::string& path,
                                            double resolution) {
  const Result<MapHeader> header = parse_header(text, path);
  if (!header) return header.error();
  if (resolution != 0.0)
    return fail(Code::invalid_argument, "the file has a resolution of its own; leave the other one out",
                path);
  const fs::path picture = (fs::path(path).parent_path() / header->image).lexically_normal();
  const Result<image::GreyImage> image = image::read_image(picture.string(), kMostCells);
  if (!image)
    return fail(
        image.error().code,
        image.error().message + "; " + path + " names it as its image: put it there, or correct the name",
        picture.string());
  return map_from(*image, *header, picture, path);
}

// A temporary file, which nobody else has, that is gone unless it has got its name.
class Draft {
 public:
  explicit Draft(std::string name) : name_(std::move(name)) {}
  ~Draft() {
    std::error_code ignored;
    if (ours_) fs::remove(draft_, ignored);
  }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  Status write(const std::string& bytes) {
    if (Status claimed = claim(); !claimed.ok()) return claimed;
    OutputFile file("the map");
    if (Status opened = file.open(draft_); !opened.ok()) return opened;
    file.write(bytes);
    return file.close();
  }

  Status keep() {
    std::error_code error;
    fs::rename(draft_, name_, error);
    if (error) return fail(Code::unavailable, "cannot give the map its name: " + error.message(), name_);
    ours_ = false;
    return ok();
  }

 private:
  // Makes a file of a name that is not taken.
  Status claim() {
    constexpr int kTries = 1000;
    for (int i = 0; i < kTries; ++i) {
      draft_ = name_ + ".new" + (i == 0 ? "" : std::to_string(i));
      if (std::FILE* const made = std::fopen(draft_.c_str(), "wxe")) {
        std::fclose(made);
        ours_ = true;
        return ok();
      }
      if (errno != EEXIST) break;
    }
    return fail(Code::unavailable, std::string("cannot write the map: ") + std::strerror(errno), draft_);
  }

  const std::string name_;
  std::string draft_;
  bool ours_ = false;
};

}  // namespace

Result<idl::OccupancyGrid> read_map(const std::string& path, double resolution) {
  const Result<std::string> beginning = read_input_file(path, kMostText + 1);
  if (!beginning)
    return fail(beginning.error().code, "cannot read the map: " + beginning.error().message, path);
  if (beginning->empty())
    return fail(Code::data_loss, "the file is empty; expected a YAML file of ROS, or a PNG or PGM picture",
                path);
  const bool is_picture = image::is_picture(*beginning) || !image::foreign_picture(*beginning).empty();
  if (is_picture || beginning->size() > kMostText) return read_plan(path, resolution);
  return read_with_header(*beginning, path, resolution);
}

std::optional<std::string> doubt_about(const idl::OccupancyGrid& map) {
  std::size_t occupied = 0, free = 0;
  for (const int cell : map.cells()) {
    occupied += cell >= kLeastOccupied && cell <= kMostOccupied ? 1 : 0;
    free += cell < kLeastOccupied ? 1 : 0;
  }
  const std::string what_to_do = "; is it the right picture, and are negate, mode and the thresholds right?";
  if (occupied == 0) return "no cell is occupied, so no robot finds its place by a laser" + what_to_do;
  if (free == 0) return "no cell is free, so no robot finds a way" + what_to_do;
  if (occupied <= free) return std::nullopt;
  return "more cells are occupied (" + std::to_string(occupied) + ") than free (" + std::to_string(free) +
         "); if black and white are exchanged, change negate in its YAML file, or write one if it has none";
}

Result<MapTexts> texts_of(const idl::OccupancyGrid& map, std::string_view picture_name) {
  const std::size_t cells = map.cells().size();
  if (cells == 0 || cells != std::size_t{map.columns()} * map.rows())
    return fail(Code::invalid_argument, "the map has " + std::to_string(map.columns()) + " x " +
                                            std::to_string(map.rows()) + " cells, and values for " +
                                            std::to_string(cells) + "; there is nothing to write");
  const Pose2 corner{map.corner().x(), map.corner().y(), map.corner().orientation()};
  if (!is_side(map.resolution()) || !is_corner(corner))
    return fail(Code::invalid_argument,
                "the map has cells of " + xml::number_text(map.resolution()) + " m and its corner at (" +
                    xml::number_text(corner.x) + " m, " + xml::number_text(corner.y) + " m, " +
                    xml::number_text(corner.yaw) +
                    " rad), which no map that is read may have; ask its server for another");
  if (!is_file_name(picture_name))
    return fail(Code::invalid_argument, "the name holds control characters; choose another one");
  MapHeader header;
  header.image = picture_name;
  header.resolution = map.resolution();
  header.corner = corner;
  const Result<std::string> picture = image::encode_png(picture_of(map));
  if (!picture) return picture.error();
  return MapTexts{*picture, header_text(header)};
}

// The YAML file comes last: whoever sees it finds its picture.
Status write_map(const idl::OccupancyGrid& map, const std::string& name) {
  const std::string stem = name.ends_with(".yaml") ? name.substr(0, name.size() - 5) : name;
  for (const std::string& path : {stem + ".png", stem + ".yaml"})
    if (fs::exists(fs::symlink_status(path)))
      return fail(Code::already_exists, "it is there already; choose another name, or remove it first", path);
  const Result<MapTexts> texts = texts_of(map, fs::path(stem).filename().string() + ".png");
  if (!texts) return texts.error();
  Draft picture(stem + ".png"), header(stem + ".yaml");
  if (Status written = picture.write(texts->picture); !written.ok()) return written;
  if (Status written = header.write(texts->header); !written.ok()) return written;
  if (Status kept = picture.keep(); !kept.ok()) return kept;
  const Status kept = header.keep();
  std::error_code ignored;
  if (!kept.ok()) fs::remove(stem + ".png", ignored);
  return kept;
}

}  // namespace orca::maps
