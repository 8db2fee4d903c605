// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of the simulator's pages hold its own numbers, and the elements and attributes that it reads.
#include <catch2/catch.hpp>
#include <fstream>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

#include "approval.hpp"
#include "files/world/world_rules.hpp"
#include "orca/robot_file/rules.hpp"
#include "orca/sim/realism.hpp"
#include "shipped.hpp"

using namespace orca::sim;
using namespace orca::sim::test;

namespace {

using Lines = std::vector<std::string>;

// Returns the rows of a page's table that begins with `heading`, without the heading and the line below it.
Lines rows_below(const std::string& heading, const std::string& name) {
  std::ifstream page(ORCA_SOURCE_DIR "/docs/" + name);
  std::string line;
  while (std::getline(page, line) && line != heading) {
  }
  std::getline(page, line);
  REQUIRE(line.starts_with("|---"));
  Lines rows;
  while (std::getline(page, line) && line.starts_with("|")) rows.push_back(line);
  return rows;
}

std::string number(double value, const std::string& unit) {
  std::ostringstream text;
  text << std::setprecision(4) << value;
  return unit.empty() ? text.str() : text.str() + " " + unit;
}

std::string percent(double value) { return number(100.0 * value, "%"); }
std::string millimetres(double value) { return number(1000.0 * value, "mm"); }
std::string degrees(double value) { return number(value * 180.0 / std::numbers::pi, "deg"); }
std::string yes_or_no(bool value) { return value ? "yes" : "no"; }

// The page's names for the members of ErrorLevels, in their order.
const Lines kErrors = {"wheel diameters: bound of their ratio, less 1",
                       "wheel diameters: bound of their mean's relative error",
                       "track: bound of its relative error",
                       "slip of a wheel per root of a metre, standard deviation",
                       "slip of a wheel per root of a radian of turn, in addition",
                       "slip that all wheels have in common, per root of a metre",
                       "lag and dead time of the drive, times those of the file",
                       "sonar: standard deviation, relative to the range",
                       "sonar: readings that are arbitrary",
                       "sonar: transducers that are silent, unless `dead_sonars` says more",
                       "sonar: critical angle of smooth surfaces",
                       "sonar: crosstalk",
                       "laser: bound of the bias of a run",
                       "laser: standard deviation",
                       "laser: incidence beyond which nothing returns",
                       "laser: weakest echo, as a share of that of a surface of 10 % at `max_range`",
                       "laser: mixed pixels",
                       "infrared: standard deviation per squared range",
                       "readings in the steps of the device"};

// The numbers of one level, as the page writes them, then the estimates that all levels share. The names must cover
// ErrorLevels: with a member more or less this does not compile.
Lines numbers_of(Realism realism) {
  const auto [wheel_mismatch, wheel_size, track_error, slip, turn_slip, common_slip, delay_scale, sonar_noise,
              sonar_outliers, sonar_dead, critical_angle, sonar_crosstalk, laser_bias, laser_sigma,
              laser_drop_angle, laser_threshold, mixed_pixels, infrared_noise, quantised, slip_length,
              common_length, slip_angle, sonar_edges, sonar_threshold, sonar_in_line, laser_spot,
              contact_friction, wheel_grip, motor_force] = error_levels(realism);
  return {percent(wheel_mismatch),   percent(wheel_size),      percent(track_error),
          millimetres(slip),         millimetres(turn_slip),   millimetres(common_slip),
          number(delay_scale, ""),   percent(sonar_noise),     percent(sonar_outliers),
          percent(sonar_dead),       degrees(critical_angle),  yes_or_no(sonar_crosstalk),
          millimetres(laser_bias),   millimetres(laser_sigma), degrees(laser_drop_angle),
          percent(laser_threshold),  yes_or_no(mixed_pixels),  number(infrared_noise, "/m"),
          yes_or_no(quantised),      number(slip_length, "m"), number(common_length, "m"),
          number(slip_angle, "rad"), number(sonar_edges, ""),  number(sonar_threshold, ""),
          degrees(sonar_in_line),    number(laser_spot, ""),   number(contact_friction, ""),
          number(wheel_grip, ""),    number(motor_force, "")};
}

Lines column_of(Realism realism) {
  const Lines all = numbers_of(realism);
  return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kErrors.size())};
}

std::string drive_kind(DriveKind kind) {
  switch (kind) {
    case DriveKind::differential: return "differential";
    case DriveKind::synchro: return "synchro";
    case DriveKind::holonomic: return "holonomic";
  }
  return "unknown";
}

std::string plan_of(const Shape& footprint) {
  if (const auto* const circle = std::get_if<Circle>(&footprint))
    return "circle, radius " + number(circle->radius, "m");
  const Bounds plan = bounds_of(footprint);
  return "polygon, " + number(plan.high.x - plan.low.x, "") + " x " + number(plan.high.y - plan.low.y, "m");
}

std::string row_of(const std::string& name) {
  const RobotModel robot = shipped(name);
  return "| `" + name + "` | " + drive_kind(robot.drive.kind) + " | " + number(robot.drive.max_speed, "m/s") +
         " | " + degrees(robot.drive.max_turn_rate) + "/s | " + plan_of(robot.footprint) + " |";
}

// Attribute names by element. An element that depends on where it stands is called "`door` in a `wall`".
using Table = std::map<std::string, std::set<std::string>>;

// Returns cell `number` of a row, counted from 0.
std::string cell(const std::string& row, std::size_t number) {
  std::size_t begin = 2;
  while (number-- > 0) begin = row.find(" | ", begin) + 3;
  return row.substr(begin, row.find(" |", begin) - begin);
}

// Returns the first words of the pieces between commas: "fill (0 to 0.5), rounds" gives "fill" and "rounds".
std::set<std::string> names_in(const std::string& list) {
  std::set<std::string> names;
  std::istringstream pieces(list);
  for (std::string piece; std::getline(pieces, piece, ',');) {
    std::string name;
    if (std::istringstream(piece) >> name) names.insert(name);
  }
  return names;
}

// Reads a table of elements; a remark in brackets after an element's name is skipped.
Table table_of(const std::string& heading, const std::string& page, std::size_t attributes = 1) {
  Table table;
  for (const std::string& row : rows_below(heading, page)) {
    const std::string element = cell(row, 0);
    table[element.substr(0, element.find(" ("))] = names_in(cell(row, attributes));
  }
  return table;
}

std::string quoted(std::string_view element) { return "`" + std::string(element) + "`"; }

std::set<std::string> attributes_of(const orca::xml::ElementRule& rule) {
  const std::vector<std::string> names = rule.attribute_names();
  return {names.begin(), names.end()};
}

// Returns the elements that the rules allow below `root`, two levels deep, in the notation of the pages.
Table rules_below(const orca::xml::ElementRule& root) {
  Table table{{quoted(root.name), attributes_of(root)}};
  for (const auto* const element : root.children) {
    table[quoted(element->name)] = attributes_of(*element);
    for (const auto* const part : element->children)
      table[quoted(part->name) + " in a " + quoted(element->name)] = attributes_of(*part);
  }
  return table;
}

}  // namespace

TEST_CASE("docs/realism.md has the numbers behind each level of realism", "[sim][docs]") {
  const Lines ideal = column_of(Realism::ideal);
  const Lines nominal = column_of(Realism::nominal);
  const Lines harsh = column_of(Realism::harsh);
  const Lines recorded = column_of(Realism::recorded);
  Lines expected;
  for (std::size_t i = 0; i < kErrors.size(); ++i)
    expected.push_back("| " + kErrors[i] + " | " + ideal[i] + " | " + nominal[i] + " | " + harsh[i] + " | " +
                       recorded[i] + " |");
  CHECK(rows_below("| error | ideal | nominal | harsh | recorded |", "realism.md") == expected);
}

TEST_CASE("docs/realism.md says of each error where its values come from", "[sim][docs]") {
  Lines named;
  for (const std::string& row : rows_below("| error | nominal | harsh | recorded |", "realism.md")) {
    named.push_back(cell(row, 0));
    for (const std::size_t level : {1U, 2U, 3U}) {
      CAPTURE(row);
      CHECK(cell(row, level).size() > 0);
    }
  }
  CHECK(named == kErrors);
}

TEST_CASE("docs/halved-and-doubled.md has the estimates that all levels share", "[sim][docs]") {
  Lines shown;
  for (const std::string& row : rows_below("| name | estimate | what it is |", "halved-and-doubled.md"))
    shown.push_back(cell(row, 1));
  for (const Realism level : {Realism::ideal, Realism::nominal, Realism::harsh, Realism::recorded}) {
    const Lines all = numbers_of(level);
    CHECK(Lines(all.begin() + static_cast<std::ptrdiff_t>(kErrors.size()), all.end()) == shown);
  }
}

TEST_CASE("docs/simulation.md has every shipped robot with its drive, speeds and plan",
          "[sim][robots][docs]") {
  Lines expected;
  for (const auto& file : orca::test::files_in(kRobots, ".urdf"))
    expected.push_back(row_of(file.stem().string()));
  CHECK(rows_below("| file | drive | speed | turn rate | plan |", "simulation.md") == expected);
}

TEST_CASE("docs/world-files.md has every element of a world file with its attributes", "[sim][docs]") {
  const Table kinds =
      table_of("| kind | what is drawn | attributes with their defaults |", "world-files.md", 2);
  std::set<std::string> expected_kinds;
  for (const std::string_view kind : detail::kGenerateRule.attribute("kind")->value.choices)
    expected_kinds.insert(quoted(kind));
  Table page = table_of("| element | attributes | meaning |", "world-files.md");
  std::set<std::string> kinds_on_page;
  for (const auto& [kind, attributes] : kinds) {
    kinds_on_page.insert(kind);
    page["`generate`"].insert(attributes.begin(), attributes.end());
  }
  CHECK(kinds_on_page == expected_kinds);
  CHECK(page == rules_below(detail::kWorldRule));
}

TEST_CASE("docs/robot-files.md has every element in <orca> with its attributes", "[sim][robots][docs]") {
  CHECK(table_of("| element | attributes |", "robot-files.md") == rules_below(orca::robot_file::kOrcaRule));
}
