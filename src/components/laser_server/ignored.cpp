// SPDX-License-Identifier: LGPL-3.0-or-later
#include "ignored.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

namespace orca::laser {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kRounding = 1e-9;  // [rad]
constexpr double kTurn = 2.0 * std::numbers::pi;

// Reads so many numbers and nothing else.
bool read_numbers(std::istringstream& text, double* numbers, int count) {
  text.imbue(std::locale::classic());
  for (int i = 0; i < count; ++i)
    if (!(text >> numbers[i])) return false;
  std::string rest;
  return !(text >> rest);
}

bool is_between(double number, double one, double other) {
  return number >= std::min(one, other) && number <= std::max(one, other);
}

}  // namespace

Result<Ignored> Ignored::parse(const std::vector<std::string>& texts) {
  Ignored ignored;
  for (const std::string& text : texts) {
    const Result<Part> part = parse_part(text);
    if (!part) return part.error();
    ignored.parts_.push_back(*part);
  }
  return ignored;
}

Result<Ignored::Part> Ignored::parse_part(std::string_view text) {
  std::istringstream words{std::string(text)};
  std::string word;
  words >> word;
  Part part;
  if (word == "outline" && read_numbers(words, part.numbers, 0)) return part;
  part.kind = word == "sector" ? Part::Kind::sector : Part::Kind::box;
  const bool is_sector = part.kind == Part::Kind::sector;
  if ((is_sector || word == "box") && read_numbers(words, part.numbers, is_sector ? 2 : 4)) {
    if (is_sector) part.numbers[0] *= kDegree;
    if (is_sector) part.numbers[1] *= kDegree;
    return part;
  }
  return fail(
      Code::invalid_argument,
      "cannot read \"" + std::string(text) +
          "\"; expected \"sector FROM TO\" in degrees, \"box X1 Y1 X2 Y2\" in metres, or \"outline\"");
}

std::size_t Ignored::leave_out(idl::LaserRangeReadings& scan, const RobotOutline& robot) const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < scan.ranges().size(); ++i) {
    if (std::isnan(scan.ranges()[i])) continue;
    if (std::ranges::none_of(parts_, [&](const Part& part) { return holds(part, scan, i, robot); })) continue;
    scan.ranges()[i] = std::numeric_limits<double>::quiet_NaN();
    ++count;
  }
  return count;
}

bool Ignored::holds(const Part& part, const idl::LaserRangeReadings& scan, std::size_t beam,
                    const RobotOutline& robot) {
  if (part.kind == Part::Kind::sector) {
    const double angle = scan.angle_start() + scan.angle_increment() * static_cast<double>(beam);
    const double width = part.numbers[1] - part.numbers[0];
    const double off = std::remainder(angle - part.numbers[0] - 0.5 * width, kTurn);
    return std::abs(off) <= 0.5 * width + kRounding;
  }
  if (!(scan.ranges()[beam] < scan.max_range())) return false;
  const Vec2 end = end_of_beam(scan, beam);
  if (part.kind == Part::Kind::outline) return robot.holds(end);
  return is_between(end.x, part.numbers[0], part.numbers[2]) &&
         is_between(end.y, part.numbers[1], part.numbers[3]);
}

}  // namespace orca::laser
