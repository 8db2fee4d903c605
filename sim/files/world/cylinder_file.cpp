// SPDX-License-Identifier: LGPL-3.0-or-later
#include "cylinder_file.hpp"

#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <vector>

#include "codes.hpp"
#include "files/formats/gzip_file.hpp"
#include "orca/base/text.hpp"
#include "orca/robot_file/values.hpp"
#include "orca/xml/number.hpp"

namespace orca::sim::detail {

using namespace robot_file::values;

namespace {

constexpr std::string_view kColumns = "world,x,y";
constexpr double kRadius = 0.075;       // [m]
constexpr double kHeight = 2.5;         // [m]
constexpr std::size_t kMost = 100'000;  // cylinders of one world

// Returns the places of BARN's task: from the free strip before the field to the open space behind it.
std::vector<Place> places() {
  const double ahead = 0.5 * std::numbers::pi;
  return {{"start", {-2.25, 3.0, ahead}}, {"goal", {-2.25, 13.0, ahead}}};
}

class CylinderFile {
 public:
  CylinderFile(const std::string& path, std::optional<std::uint64_t> number, xml::Diagnostics& diagnostics)
      : path_(path), number_(number), diagnostics_(diagnostics) {
    world_.name = std::filesystem::path(path).filename().string();
    world_.name = world_.name.substr(0, world_.name.find('.'));
    world_.places = places();
  }

  std::optional<WorldModel> read(std::string_view text) {
    int line = 0;
    for (std::size_t start = 0; start <= text.size();) {
      const std::size_t end = std::min(text.find('\n', start), text.size());
      const std::string_view content = xml::trimmed(text.substr(start, end - start));
      start = end + 1;
      if (++line == 1) {
        if (content != kColumns)
          return refuse(1, 1, "the first line is not " + in_quotes(kColumns) + ", the names of the columns");
      } else if (!content.empty()) {
        row(content, line);
      }
    }
    check_number();
    return std::move(world_);
  }

 private:
  void error(int line, int column, const std::string& message, const char* code = world_codes::kBadRow) {
    diagnostics_.error(code, {path_, line, column}, message);
  }

  std::nullopt_t refuse(int line, int column, const std::string& message) {
    error(line, column, message);
    return std::nullopt;
  }

  void row(std::string_view content, int line) {
    const auto fields = xml::split(content, ",");
    if (fields.size() != 3)
      return error(
          line, 1,
          "the row has " + std::to_string(fields.size()) + " fields, expected 3: " + std::string(kColumns));
    const auto column = [&](std::string_view field) {
      return 1 + static_cast<int>(field.data() - content.data());
    };
    const Result<std::int64_t> world = xml::parse_integer(fields[0]);
    if (!world || *world < 0)
      return error(line, column(fields[0]), "world: " + in_quotes(fields[0]) + " is not a world's number");
    const auto x = coordinate("x", fields[1], line, column(fields[1]));
    const auto y = coordinate("y", fields[2], line, column(fields[2]));
    if (x && y) add(static_cast<std::uint64_t>(*world), {{*x, *y}, kRadius}, line);
  }

  std::optional<double> coordinate(const char* name, std::string_view field, int line, int column) {
    const Result<double> value = xml::parse_number(field);
    if (!value) return refuse(line, column, std::string(name) + ": " + value.error().message);
    if (std::fabs(*value) <= kFarthest) return *value;
    return refuse(line, column, std::string(name) + ": " + in_quotes(field) + " is farther than 100 km");
  }

  void add(std::uint64_t world, const Circle& cylinder, int line) {
    worlds_.insert(worlds_.end(), world);  // they are sorted as a rule
    if (world != number_) return;
    for (const Place& place : world_.places)
      if (contains(cylinder, place.pose.position()))
        error(line, 1, "the cylinder stands on the place \"" + place.name + "\"; no robot can get there",
              world_codes::kPlaceInObstacle);
    if (world_.obstacles.size() == kMost)
      error(line, 1,
            "world " + std::to_string(world) + " has more than 100000 cylinders; at most these are read",
            world_codes::kTooMany);
    if (world_.obstacles.size() <= kMost) world_.obstacles.push_back({"cylinder", cylinder, kHeight});
  }

  void check_number() {
    if (number_ && worlds_.contains(*number_)) return;
    if (worlds_.empty()) return error(0, 0, "the file holds no world, only the names of its columns");
    const std::string held = "the file holds " + std::to_string(worlds_.size()) + " worlds, numbered from " +
                             std::to_string(*worlds_.begin()) + " to " + std::to_string(*worlds_.rbegin());
    if (!number_)
      return error(0, 0, held + "; choose one: \"" + path_ + "#" + std::to_string(*worlds_.begin()) + "\"",
                   world_codes::kNumber);
    const auto after = worlds_.lower_bound(*number_);
    const std::uint64_t nearest = after == worlds_.end() ? *worlds_.rbegin() : *after;
    error(0, 0,
          "there is no world " + std::to_string(*number_) + "; " + held + "; did you mean " +
              std::to_string(nearest) + "?",
          world_codes::kNumber);
  }

  std::string path_;
  std::optional<std::uint64_t> number_;
  xml::Diagnostics& diagnostics_;
  WorldModel world_;
  std::set<std::uint64_t> worlds_;
};

}  // namespace

std::optional<WorldModel> read_cylinder_world(const std::string& path, std::optional<std::uint64_t> number,
                                              xml::Diagnostics& diagnostics) {
  const Result<std::string> text = read_maybe_packed(path);
  if (text) return CylinderFile(path, number, diagnostics).read(*text);
  diagnostics.error(world_codes::kUnreadable, {path, 0, 0}, text.error().message);
  return std::nullopt;
}

}  // namespace orca::sim::detail
