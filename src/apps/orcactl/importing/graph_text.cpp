// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "component_file.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/number.hpp"

namespace orca::orcactl::importing {
namespace {

// A driver by a word in the name of the thesis's library, in small letters.
struct Driver {
  std::string_view word;
  std::string_view type;
};
constexpr std::array kDrivers{
    Driver{"scout", "orca.hw.NomadScout"}, Driver{"xr4000", "orca.hw.Xr4000"},
    Driver{"p2os", "orca.hw.P2os"},        Driver{"pioneer", "orca.hw.P2os"},
    Driver{"peoplebot", "orca.hw.P2os"},   Driver{"sick", "orca.hw.SickLms"},
    Driver{"player", "orca.hw.Player"},
};
// Components of the thesis (11.1) that Orca has by the same name.
constexpr std::array<std::string_view, 11> kComponents{
    "RobotBaseServer", "LaserServer", "Goto",      "SonarAvoid", "LaserAvoid", "MotionCommandFuser",
    "Command",         "Teleop",      "LogServer", "Localizer",  "RandomWalk"};

std::string in_small_letters(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// A name as graphs have it: letters, digits and '_', after a letter.
std::string as_name(std::string text) {
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  const bool begins = !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0;
  return begins ? text : "x" + text;
}

std::string driver_of(const std::string& library) {
  const std::string small = in_small_letters(library);
  const auto known = std::ranges::find_if(
      kDrivers, [&](const Driver& d) { return small.find(d.word) != std::string::npos; });
  return known == kDrivers.end() ? "" : std::string(known->type);
}

std::string type_of(std::string component) {
  if (component.ends_with("Component")) component.resize(component.size() - 9);
  return std::ranges::count(kComponents, component) > 0 ? "orca." + component : "";
}

std::string attribute(std::string_view name, const std::string& value) {
  return value.empty() ? "" : " " + std::string(name) + "=\"" + xml::escaped(value) + "\"";
}

// The number has at most ten digits: more would be those of a conversion.
std::string attribute(std::string_view name, const std::optional<double>& value, std::string_view unit) {
  if (!value) return "";
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%.10g", *value);
  return attribute(name, digits.data() + (unit.empty() ? "" : " " + std::string(unit)));
}

std::string param(const std::string& attributes, std::string_view name) {
  return attributes.empty() ? "" : "    <param" + attribute("name", std::string(name)) + attributes + "/>\n";
}

// Time from one sonar to the next: a Scout's driver has that instead of the time of a round.
std::optional<double> interval_of(const ComponentFile& file, const std::string& driver) {
  const bool has = driver == "orca.hw.NomadScout" && !file.rings.empty();
  if (!has || !file.rings.front().period || file.rings.front().count.value_or(0.0) < 1.0) return {};
  return *file.rings.front().period / *file.rings.front().count;
}

std::string hardware_text(const ComponentFile& file, const std::string& name, const std::string& driver) {
  if (file.library.empty()) return "";
  return "  <hardware" + attribute("name", name) + attribute("type", driver) + ">\n" +
         param(attribute("value", file.robot), "name") +
         param(attribute("value", file.max_speed, "m/s"), "max_speed") +
         param(attribute("value", file.max_turn_rate, "rad/s"), "max_turn_rate") +
         param(attribute("value", interval_of(file, driver), "s"), "sonar_interval") + "  </hardware>\n";
}

std::string ring_text(const Ring& ring) {
  return "    <sonar_ring" + attribute("name", ring.name) + attribute("count", ring.count, "") +
         attribute("first_angle", ring.first_angle, "rad") + attribute("pitch", ring.pitch, "rad") +
         attribute("half_lobe", ring.half_lobe, "rad") + attribute("period", ring.period, "s") +
         attribute("vendor", ring.vendor) + "/>\n";
}

// What the robot's file says, not the graph.
std::string robot_text(const ComponentFile& file) {
  std::string text =
      "  <orca" + attribute("vendor", file.vendor) + attribute("model", file.model) +
      attribute("radius", file.radius, "m") + attribute("bumper_radius", file.bumper_radius, "m") +
      ">\n    <drive" + attribute("type", file.drive) + attribute("max_speed", file.max_speed, "m/s") +
      attribute("max_steer_speed", file.max_turn_rate, "rad/s") +
      attribute("steer_gain", file.steer_gain, "") + attribute("big_turn_angle", file.big_turn_angle, "rad") +
      attribute("big_turn_speed", file.big_turn_speed, "m/s") + "/>\n";
  for (const Ring& ring : file.rings) text += ring_text(ring);
  return text + "  </orca>\n";
}

// In a comment, which may not hold two hyphens.
std::string remark(const std::string& head, std::string text) {
  for (std::size_t at = 0; (at = text.find("--", at)) != std::string::npos;) text.replace(at, 2, "- -");
  return "  <!-- " + head + "\n" + text + "  -->\n";
}

}  // namespace

std::string graph_text(const ComponentFile& file, const std::string& file_name, xml::Diagnostics& out) {
  const std::string hardware = as_name(file.robot.empty() ? "hardware" : file.robot);
  const std::string own = as_name(file.component);
  const bool is_rooted = !file.context.empty() && file.context != "default";
  const std::string component = is_rooted ? as_name(file.context) + "/" + own : own;
  const std::string driver = driver_of(file.library);
  const std::string type = type_of(file.component);
  const xml::Position everywhere{file_name, 0, 0};
  if (type.empty())
    out.warning("I006", everywhere,
                in_quotes(file.component) +
                    " is no component that Orca ships under that name; give it a type of deployer --types");
  if (driver.empty() && !file.library.empty())
    out.warning("I006", everywhere,
                "Orca has no driver in place of " + in_quotes(file.library) +
                    "; give the hardware a type of deployer --types");

  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<graph" + attribute("name", own) +
                     " version=\"1\">\n" + hardware_text(file, hardware, driver) + "  <component" +
                     attribute("name", component) + attribute("type", type) +
                     attribute("hardware", file.library.empty() ? "" : hardware);
  std::string ports;
  std::string hidden;
  for (const Service& service : file.services)
    if (service.is_named)
      ports += "       " + component + "." + service.name + "\n";
    else
      hidden += "    <port" + attribute("name", service.name) + " disabled=\"true\"/>\n";
  text += hidden.empty() ? "/>\n" : ">\n" + hidden + "  </component>\n";
  if (!ports.empty()) text += remark("Ports that connections may name:", ports);
  if (!file.library.empty())
    text += remark("For the robot's file, which the parameter robot of the driver names:", robot_text(file));
  return text + "</graph>\n";
}

}  // namespace orca::orcactl::importing
