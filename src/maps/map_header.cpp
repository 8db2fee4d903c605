// SPDX-License-Identifier: LGPL-3.0-or-later
#include "map_header.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/maps/map_file.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"

namespace orca::maps {
namespace {

const std::vector<std::string> kKeys{"image",           "mode",       "resolution", "origin", "negate",
                                     "occupied_thresh", "free_thresh"};

// A fault of the file, as an exception within this file only: yaml-cpp throws, too.
struct Fault {
  YAML::Mark mark;
  std::string text;
};

constexpr double kMostYaw = 6.2832;  // [rad] a turn; more is degrees

// The values of the keys. Each is there and valid, or that is a Fault.
class Values {
 public:
  explicit Values(const YAML::Node& root) : root_(root) {
    if (!root.IsMap())
      throw Fault{root.Mark(), "this is no map: expected lines such as \"resolution: 0.05\""};
    std::set<std::string> seen;
    for (const auto& entry : root) check_key(entry.first, seen);
  }

  [[nodiscard]] std::string text(const std::string& key) const {
    const YAML::Node value = root_[key];
    if (!value.IsDefined()) throw Fault{root_.Mark(), missing(key)};
    if (!value.IsScalar() || value.Scalar().empty())
      throw Fault{value.Mark(), key + " must be one word or number"};
    return value.Scalar();
  }

  [[nodiscard]] std::string text_or(const std::string& key, const std::string& otherwise) const {
    return root_[key].IsDefined() ? text(key) : otherwise;
  }

  [[nodiscard]] double number(const std::string& key) const {
    const std::string found = text(key);
    const Result<double> value = xml::parse_number(found);
    if (!value) throw Fault{root_[key].Mark(), key + ": " + value.error().message};
    return *value;
  }

  [[nodiscard]] double number_within(const std::string& key, double least, double most) const {
    const double value = number(key);
    if (!(value >= least && value <= most))
      refuse(key, "is " + xml::number_text(value) + "; it must be from " + xml::number_text(least) + " to " +
                      xml::number_text(most));
    return value;
  }

  [[nodiscard]] Pose2 pose(const std::string& key) const {
    const YAML::Node list = root_[key];
    if (!list.IsDefined()) throw Fault{root_.Mark(), missing(key)};
    if (!list.IsSequence() || list.size() != 3)
      throw Fault{list.Mark(), key + " must be three numbers, [x, y, yaw] in metres and radians"};
    std::array<double, 3> found{};
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Result<double> value = xml::parse_number(list[i].IsScalar() ? list[i].Scalar() : "");
      if (!value) throw Fault{list[i].Mark(), key + ": " + value.error().message};
      found[i] = *value;
    }
    if (std::fabs(found[2]) > kMostYaw)
      throw Fault{list[2].Mark(), key + ": the yaw is " + xml::number_text(found[2]) +
                                      "; it is in radians, where 1.5708 is a right angle"};
    return {found[0], found[1], wrapped(found[2])};
  }

  [[noreturn]] void refuse(const std::string& key, const std::string& why) const {
    throw Fault{root_[key].Mark(), key + " " + why};
  }

 private:
  // A key of another program is left alone; one that is nearly one of ours is a mistake.
  static void check_key(const YAML::Node& key, std::set<std::string>& seen) {
    const std::string name = key.IsScalar() ? key.Scalar() : "";
    const bool is_known = std::ranges::find(kKeys, name) != kKeys.end();
    if (is_known && !seen.insert(name).second)
      throw Fault{key.Mark(), name + " is given twice; leave one of them out"};
    if (is_known) return;
    if (const auto nearest = xml::nearest_name(name, kKeys))
      throw Fault{key.Mark(), "unknown key " + in_quotes(name) + xml::did_you_mean(nearest)};
  }

  static std::string missing(const std::string& key) {
    const std::string wanted = key == "resolution" ? ", the side of a pixel in metres" : "";
    return key + wanted +
           " is missing; a map of ROS has image, resolution, origin, negate, occupied_thresh and " +
           "free_thresh";
  }

  const YAML::Node root_;
};

bool yes_or_no(const Values& values, const std::string& key) {
  const std::string found = values.text(key);
  if (found == "1" || found == "true" || found == "True") return true;
  if (found != "0" && found != "false" && found != "False")
    values.refuse(key, "is " + in_quotes(found) + "; it must be 0 or 1");
  return false;
}

MapMode mode_of(const Values& values) {
  const std::string found = values.text_or("mode", "trinary");
  if (found == "scale") return MapMode::scale;
  if (found == "raw") return MapMode::raw;
  if (found != "trinary")
    values.refuse("mode", "is " + in_quotes(found) + "; it must be trinary, scale or raw");
  return MapMode::trinary;
}

MapHeader header_of(const Values& values) {
  MapHeader header;
  header.image = values.text("image");
  if (!is_file_name(header.image))
    values.refuse("image", "holds control characters, which no file's name has");
  header.resolution = values.number("resolution");
  if (!is_side(header.resolution)) values.refuse("resolution", wrong_side(header.resolution));
  header.corner = values.pose("origin");
  if (!is_corner(header.corner))
    values.refuse("origin", "is farther away than " + xml::number_text(kMostDistance) +
                                " m along x or y; choose a frame whose origin is near the building");
  header.negate = yes_or_no(values, "negate");
  header.occupied_from = values.number_within("occupied_thresh", 0.0, 1.0);
  header.free_to = values.number_within("free_thresh", 0.0, 1.0);
  if (header.free_to >= header.occupied_from)
    values.refuse("free_thresh",
                  "must be less than occupied_thresh: dark pixels are occupied, light ones free");
  header.mode = mode_of(values);
  if (header.mode == MapMode::raw && header.negate)
    values.refuse("negate", "is not possible with mode: raw, whose numbers are the cells; leave it at 0");
  return header;
}

std::string fixed(double value) {
  std::array<char, 400> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  return {text.data(), end.ptr};
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

}  // namespace

bool is_side(double resolution) { return resolution >= kLeastSide && resolution <= kMostSide; }

std::string wrong_side(double resolution) {
  return "is " + xml::number_text(resolution) + "; it is the side of a pixel in metres and must be from " +
         xml::number_text(kLeastSide) + " to " + xml::number_text(kMostSide) + ", such as 0.05";
}

bool is_corner(const Pose2& corner) {
  return std::isfinite(corner.yaw) && std::fabs(corner.x) <= kMostDistance &&
         std::fabs(corner.y) <= kMostDistance;
}

bool is_file_name(std::string_view name) {
  constexpr unsigned char kDelete = 0x7F;
  return std::ranges::none_of(name, [](unsigned char c) { return c < ' ' || c == kDelete; });
}

Result<MapHeader> parse_header(std::string_view text, const std::string& path) {
  const auto refused = [&](const YAML::Mark& mark, const std::string& why) {
    const std::string line = mark.is_null() ? "" : ":" + std::to_string(mark.line + 1);
    return fail(Code::invalid_argument, why, path + line);
  };
  try {
    return header_of(Values(YAML::Load(std::string(text))));
  } catch (const Fault& fault) {
    return refused(fault.mark, fault.text);
  } catch (const YAML::Exception& error) {
    return refused(error.mark,
                   "this is no YAML (" + error.msg + "); expected lines such as \"resolution: 0.05\"");
  }
}

std::string header_text(const MapHeader& header) {
  constexpr std::array kModes{"trinary", "scale", "raw"};
  const Pose2& corner = header.corner;
  return "image: " + quoted(header.image) + "\nmode: " + kModes.at(static_cast<std::size_t>(header.mode)) +
         "\nresolution: " + fixed(header.resolution) + "\norigin: [" + fixed(corner.x) + ", " +
         fixed(corner.y) + ", " + fixed(corner.yaw) + "]\nnegate: " + (header.negate ? "1" : "0") +
         "\noccupied_thresh: " + fixed(header.occupied_from) + "\nfree_thresh: " + fixed(header.free_to) +
         "\n";
}

}  // namespace orca::maps
