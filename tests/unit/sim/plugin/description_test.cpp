// SPDX-License-Identifier: GPL-3.0-or-later
// Each field of the descriptions of the shipped robots, beside their robot files, read here a second time, and
// beside appendix A of the thesis.
#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <regex>
#include <set>
#include <sstream>

#include "objects.hpp"
#include "orca/sim/robot_file.hpp"

using namespace orca;
using namespace orca::sim;

namespace {

using Fields = std::map<std::string, std::string>;

std::string text_of(double number) {
  std::ostringstream text;
  text.precision(9);
  text << (std::abs(number) < 1e-12 ? 0.0 : number);
  return text.str();
}

// Collects the fields of an object as "path" -> "value", without those that the framework sets.
class Flattener final : public FieldVisitor {
 public:
  Flattener(std::string prefix, Fields& fields) : prefix_(std::move(prefix)), fields_(fields) {}

  void field(const FieldInfo& info, const Value& value) override {
    if (!info.header)
      std::visit([&](const auto& of) { add(prefix_ + std::string(info.name), of); }, value.of);
  }

 private:
  void add(const std::string& path, std::string* text) { fields_[path] = *text; }
  void add(const std::string& path, idl::TimeValue* time) { fields_[path] = std::to_string(time->ns()); }
  void add(const std::string& path, const EnumValue& value) {
    fields_[path] = std::string(value.names[value.get(value.place)]);
  }
  void add(const std::string& path, const StructValue& part) {
    Flattener inner(path + ".", fields_);
    part.fields(part.object, inner);
  }
  void add(const std::string& path, const ListValue& list) {
    for (std::size_t k = 0; k < list.size(list.list); ++k) {
      const Value element = list.at(list.list, k);
      std::visit([&](const auto& of) { add(path + "." + std::to_string(k), of); }, element.of);
    }
  }
  template <class Number>
  void add(const std::string& path, Number* number) {
    fields_[path] = text_of(static_cast<double>(*number));
  }

  std::string prefix_;
  Fields& fields_;
};

// A robot file as a text with elements and attributes, in the simplest way that could work.
class PlainFile {
 public:
  explicit PlainFile(const std::string& robot) {
    std::ifstream file(std::string(ORCA_SOURCE_DIR) + "/sim/robots/" + robot + ".urdf");
    std::ostringstream all;
    all << file.rdbuf();
    text_ = std::regex_replace(all.str(), std::regex("<!--[^]*?-->"), "");
  }

  [[nodiscard]] bool has(const std::string& element) const { return !attributes(element).empty(); }
  [[nodiscard]] std::string get(const std::string& element, const std::string& name,
                                const std::string& otherwise = "") const {
    const std::string all = attributes(element);
    std::smatch found;
    return std::regex_search(all, found, std::regex("\\s" + name + "=\"([^\"]*)\"")) ? found[1].str()
                                                                                     : otherwise;
  }
  // Returns a number in SI units; of a list, its first one.
  [[nodiscard]] std::string si(const std::string& element, const std::string& name,
                               const std::string& otherwise = "0") const {
    static const std::map<std::string, double> kUnits{{"", 1.0},
                                                      {"m", 1.0},
                                                      {"mm", 1e-3},
                                                      {"s", 1.0},
                                                      {"ms", 1e-3},
                                                      {"m/s", 1.0},
                                                      {"mm/s", 1e-3},
                                                      {"m/s2", 1.0},
                                                      {"deg", std::numbers::pi / 180},
                                                      {"deg/s", std::numbers::pi / 180}};
    std::istringstream words(get(element, name, otherwise));
    double number = 0.0;
    words >> number;
    std::string unit;
    for (std::string word; words >> word;) unit = word;
    return text_of(number * kUnits.at(unit));
  }
  // Returns the names of all elements of a kind.
  [[nodiscard]] std::vector<std::string> names(const std::string& element) const {
    std::vector<std::string> all;
    const std::regex wanted("<" + element + " name=\"([^\"]*)\"");
    for (std::sregex_iterator found(text_.begin(), text_.end(), wanted), end; found != end; ++found)
      all.push_back((*found)[1]);
    return all;
  }
  // Returns the place of a fixed joint, "x y z".
  [[nodiscard]] std::string origin(const std::string& joint) const {
    std::smatch found;
    const std::regex wanted("<joint name=\"" + joint + "\"[^]*?xyz=\"([^\"]*)\"");
    return std::regex_search(text_, found, wanted) ? found[1].str() : "";
  }

 private:
  [[nodiscard]] std::string attributes(const std::string& element) const {
    std::smatch found;
    return std::regex_search(text_, found, std::regex("<" + element + "(\\s[^>]*)>")) ? found[1].str() : "";
  }

  std::string text_;
};

// What all devices have, under `path`.
Fields device(const PlainFile& file, const std::string& path, const std::string& element,
              const std::string& name) {
  return {{path + "name", name},
          {path + "vendor", file.get(element, "vendor")},
          {path + "model", file.get(element, "model")},
          {path + "port", file.get(element, "port")},
          {path + "library", "sim.so"},
          {path + "driver", "orca.hw.Sim"}};
}

Fields sensor(const PlainFile& file, const std::string& path, const std::string& element,
              const std::string& name, const std::string& type) {
  Fields fields = device(file, path, element, name);
  fields[path + "type"] = type;
  fields[path + "update_interval"] = file.si(element, "period");
  return fields;
}

Fields drive(const PlainFile& file) {
  const std::string path = "drives.0.";
  Fields fields = device(file, path, "drive", "drive");
  const std::map<std::string, std::string> kinds{
      {"differential", "DIFFERENTIAL"}, {"synchro", "SYNCHRO"}, {"holonomic", "HOLONOMIC"}};
  fields[path + "type"] = kinds.at(file.get("drive", "type"));
  fields[path + "max_speed"] = file.si("drive", "max_speed");
  fields[path + "max_steer_speed"] = file.si("drive", "max_steer_speed");
  fields[path + "steer_gain"] = file.si("drive", "steer_gain");
  fields[path + "speed_change"] = file.si("drive", "max_acceleration");
  fields[path + "big_turn_angle"] = file.si("drive", "big_turn_angle");
  fields[path + "big_turn_speed"] = file.si("drive", "big_turn_speed");
  return fields;
}

Fields sonar_ring(const PlainFile& file) {
  const std::string path = "sonar_rings.0.", ring = "sonar_ring";
  Fields fields = sensor(file, path, ring, file.get(ring, "name"), "SonarRangeReadings");
  const bool uneven = !file.get(ring, "angles").empty();
  fields[path + "number"] = file.get(ring, "count");
  fields[path + "dphi"] = file.si(ring, "pitch");
  fields[path + "angle_sonar0"] = uneven ? file.si(ring, "angles") : file.si(ring, "first_angle");
  fields[path + "radius"] = uneven ? "0" : file.si("orca", "radius");
  fields[path + "half_lobe"] = file.si(ring, "half_lobe");
  fields[path + "scale_factor"] = file.si(ring, "quantum");
  fields[path + "offset"] = file.si(ring, "offset");
  fields[path + "min_range"] = file.si(ring, "min_range");
  fields[path + "max_range"] = file.si(ring, "max_range");
  return fields;
}

Fields laser(const PlainFile& file, std::size_t index, const std::string& name) {
  const std::string path = "laser_sensors." + std::to_string(index) + ".";
  const std::string element = "laser name=\"" + name + "\"";
  Fields fields = sensor(file, path, element, name, "LaserRangeReadings");
  std::istringstream place(file.origin(name + "_joint"));
  for (const char* axis : {"x", "y", "z"}) {
    double number = -1.0;
    place >> number;
    fields[path + "mount.position." + axis] = text_of(number);
  }
  for (const char* angle : {"roll", "pitch", "yaw"}) fields[path + "mount.rotation." + angle] = "0";
  fields[path + "number"] = file.get(element, "count");
  fields[path + "angle_start"] = file.si(element, "first_angle");
  fields[path + "angle_increment"] = file.si(element, "pitch");
  fields[path + "min_range"] = file.si(element, "min_range");
  fields[path + "max_range"] = file.si(element, "max_range");
  return fields;
}

// Returns what the description of a robot must be, by its file.
Fields expected(const PlainFile& file) {
  Fields all{{"name", "Dewey"},
             {"vendor", file.get("orca", "vendor")},
             {"model", file.get("orca", "model")},
             {"library", "sim.so"},
             {"radius", file.si("orca", "radius")},
             {"bumper_radius", file.si("orca", "bumper_radius", file.get("orca", "radius"))}};
  all.merge(drive(file));
  if (file.has("sonar_ring")) all.merge(sonar_ring(file));
  const std::vector<std::string> lasers = file.names("laser");
  for (std::size_t i = 0; i < lasers.size(); ++i) all.merge(laser(file, i, lasers[i]));
  if (file.has("turret")) all.merge(device(file, "actuators.0.", "turret", file.get("turret", "joint")));
  if (file.has("gripper")) all.merge(device(file, "actuators.0.", "gripper", file.get("gripper", "link")));
  int k = 0;
  const auto add = [&](const std::string& element, const std::string& name, const std::string& type) {
    if (file.has(element))
      all.merge(sensor(file, "sensors." + std::to_string(k++) + ".", element, name, type));
  };
  add("infrared_ring", file.get("infrared_ring", "name"), "InfraredRangeReadings");
  add("bumper_ring", file.get("bumper_ring", "name"), "BumperReadings");
  add("odometry", "odometry", "Odometry");
  add("turret", file.get("turret", "joint"), "TurretAngle");
  add("gripper", file.get("gripper", "link"), "GripperState");
  return all;
}

Fields description_of(const std::string& robot) {
  xml::Diagnostics diagnostics;
  const auto model = read_robot(std::string(ORCA_SOURCE_DIR) + "/sim/robots/" + robot + ".urdf", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(model);
  idl::Robot description = describe(*model, "Dewey");
  Fields fields;
  Flattener flattener("", fields);
  object_type<idl::Robot>().fields(&description, flattener);
  return fields;
}

// A field of a device that no source tells.
struct Unknown {
  std::string robot;
  std::string device;
  std::string field;
  std::string why;
};

const std::string kPartOfTheBase = "a part of the base, to which no source gives a name of its own";
const std::string kMakerUnnamed = "the thesis and the protocols do not say who made it";
const std::string kNoCertainOne = "any camera with these figures will do";
const std::string kModelUnnamed = "the thesis names its maker, Polaroid, and not what the maker calls it";
const std::string kNeverBuilt = "a device of Orca's own, which exists in the simulation only";

const std::vector<Unknown> kUnknown{
    {"nomad_scout", "drive", "model", kPartOfTheBase},
    {"nomad_scout", "bumper", "model", kPartOfTheBase},
    {"nomad_scout", "odometry", "model", kPartOfTheBase},
    {"nomad_scout", "sonar", "model", kModelUnnamed},

    {"nomad_200", "drive", "model", kPartOfTheBase},
    {"nomad_200", "turret_joint", "model", kPartOfTheBase},
    {"nomad_200", "bumper", "model", kPartOfTheBase},
    {"nomad_200", "odometry", "model", kPartOfTheBase},
    {"nomad_200", "sonar", "vendor", kMakerUnnamed},
    {"nomad_200", "sonar", "model", kMakerUnnamed},
    {"nomad_200", "infrared", "vendor", kMakerUnnamed},
    {"nomad_200", "infrared", "model", kMakerUnnamed},

    {"pioneer_2dx", "drive", "model", kPartOfTheBase},
    {"pioneer_2dx", "bumper", "model", kPartOfTheBase},
    {"pioneer_2dx", "odometry", "model", kPartOfTheBase},
    {"pioneer_2dx", "sonar", "vendor", kMakerUnnamed},
    {"pioneer_2dx", "sonar", "model", kMakerUnnamed},

    {"pioneer_2dx_camera", "drive", "model", kPartOfTheBase},
    {"pioneer_2dx_camera", "bumper", "model", kPartOfTheBase},
    {"pioneer_2dx_camera", "odometry", "model", kPartOfTheBase},
    {"pioneer_2dx_camera", "sonar", "vendor", kMakerUnnamed},
    {"pioneer_2dx_camera", "sonar", "model", kMakerUnnamed},
    {"pioneer_2dx_camera", "camera", "vendor", kNoCertainOne},
    {"pioneer_2dx_camera", "camera", "model", kNoCertainOne},
    {"pioneer_2dx_gripper", "drive", "model", kPartOfTheBase},
    {"pioneer_2dx_gripper", "bumper", "model", kPartOfTheBase},
    {"pioneer_2dx_gripper", "odometry", "model", kPartOfTheBase},
    {"pioneer_2dx_gripper", "sonar", "vendor", kMakerUnnamed},
    {"pioneer_2dx_gripper", "sonar", "model", kMakerUnnamed},
    {"pioneer_2dx_gripper", "gripper_link", "model", kPartOfTheBase},

    {"nomad_xr4000", "drive", "model", kPartOfTheBase},
    {"nomad_xr4000", "bumper", "model", kPartOfTheBase},
    {"nomad_xr4000", "odometry", "model", kPartOfTheBase},
    {"nomad_xr4000", "sonar", "vendor", kMakerUnnamed},
    {"nomad_xr4000", "sonar", "model", kMakerUnnamed},

    {"create2", "drive", "model", kPartOfTheBase},
    {"create2", "bumper", "model", kPartOfTheBase},
    {"create2", "odometry", "model", kPartOfTheBase},

    {"peoplebot", "bumper", "model", kPartOfTheBase},
    {"peoplebot", "drive", "model", kPartOfTheBase},
    {"peoplebot", "odometry", "model", kPartOfTheBase},
    {"peoplebot", "sonar", "vendor", kMakerUnnamed},
    {"peoplebot", "sonar", "model", kMakerUnnamed},

    {"omni", "drive", "model", kNeverBuilt},
    {"omni", "drive", "port", kNeverBuilt},
    {"omni", "sonar", "model", kNeverBuilt},
    {"omni", "sonar", "port", kNeverBuilt},
    {"omni", "laser", "model", kNeverBuilt},
    {"omni", "laser", "port", kNeverBuilt},
    {"omni", "odometry", "model", kNeverBuilt},
    {"omni", "odometry", "port", kNeverBuilt},

    {"courier", "drive", "model", kNeverBuilt},
    {"courier", "drive", "port", kNeverBuilt},
    {"courier", "high", "model", kNeverBuilt},
    {"courier", "high", "port", kNeverBuilt},
    {"courier", "low", "model", kNeverBuilt},
    {"courier", "low", "port", kNeverBuilt},
    {"courier", "odometry", "model", kNeverBuilt},
    {"courier", "odometry", "port", kNeverBuilt},

    {"barn_base", "drive", "model", kNeverBuilt},
    {"barn_base", "drive", "port", kNeverBuilt},
    {"barn_base", "laser", "model", kNeverBuilt},
    {"barn_base", "laser", "port", kNeverBuilt},
    {"barn_base", "odometry", "model", kNeverBuilt},
    {"barn_base", "odometry", "port", kNeverBuilt},
};

// Returns the names of the shipped robots.
std::set<std::string> shipped_robots() {
  std::set<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(std::string(ORCA_SOURCE_DIR) + "/sim/robots"))
    if (file.path().extension() == ".urdf") names.insert(file.path().stem());
  return names;
}

// Returns the fields that a description leaves empty, as "drive.model".
std::set<std::string> empty_fields(const Fields& description) {
  std::set<std::string> empty;
  for (const auto& [path, value] : description) {
    if (!value.empty()) continue;
    const std::string device = path.substr(0, path.rfind('.') + 1);
    empty.insert(description.at(device + "name") + "." + path.substr(device.size()));
  }
  return empty;
}

}  // namespace

TEST_CASE("each field of the description of a shipped robot is what its file says", "[sim][description]") {
  // The rectangle around the base frame that holds the boxes of the file. Those of Pioneer and PeopleBot reach farthest behind: half
  // of 0.511 and 0.513 m, and the 0.0445 m by which they are mounted behind the wheels. Scout and Nomad 200 are round.
  const auto [robot, length, width] =
      GENERATE(table<std::string, std::string, std::string>({{"nomad_scout", "0", "0"},
                                                             {"nomad_200", "0", "0"},
                                                             {"create2", "0", "0"},
                                                             {"courier", "0", "0"},
                                                             {"pioneer_2dx", "0.6", "0.425"},
                                                             {"peoplebot", "0.602", "0.425"}}));
  CAPTURE(robot);
  const Fields found = description_of(robot);
  Fields wanted = expected(PlainFile(robot));
  wanted["length"] = length;
  wanted["width"] = width;
  for (const auto& [path, value] : wanted) {
    CAPTURE(path);
    REQUIRE(found.contains(path));
    CHECK(found.at(path) == value);
  }
  for (const auto& [path, value] : found) {
    CAPTURE(path, value);
    CHECK(wanted.contains(path));
  }
}

TEST_CASE("a description leaves a field empty only where no source tells it", "[sim][description]") {
  for (const std::string& robot : shipped_robots()) {
    std::set<std::string> unknown;
    for (const Unknown& field : kUnknown)
      if (field.robot == robot) unknown.insert(field.device + "." + field.field);
    CAPTURE(robot);
    CHECK(empty_fields(description_of(robot)) == unknown);
  }
  for (const Unknown& field : kUnknown) CHECK(shipped_robots().contains(field.robot));
}

TEST_CASE("the Scout is the one of the thesis's appendix A", "[sim][description]") {
  const Fields scout = description_of("nomad_scout");
  const std::map<std::string, std::string> appendix{
      {"name", "Dewey"},                                              // <name>Dewey
      {"vendor", "Nomadics"},                                         // <vendor>Nomadics
      {"model", "SuperScout"},                                        // <model>SuperScout
      {"radius", text_of(190e-3)},                                    // <radius>190
      {"bumper_radius", text_of(205e-3)},                             // <bumper_radius>205
      {"sonar_rings.0.vendor", "Polaroid"},                           // <vendor>Polaroid
      {"sonar_rings.0.update_interval", text_of(0.2)},                // <update_interval>0.2
      {"sonar_rings.0.number", "16"},                                 // number_of_sonars="16"
      {"sonar_rings.0.dphi", text_of(std::numbers::pi / 8)},          // dphi="225", tenths of a degree
      {"sonar_rings.0.angle_sonar0", "0"},                            // angle_sonar0_x_axis="0"
      {"sonar_rings.0.half_lobe", text_of(std::numbers::pi / 14.4)},  // half_lobe_angle="125"
      {"drives.0.type", "DIFFERENTIAL"},                              // <differential/>
      {"drives.0.max_speed", "1"}};                                   // <maxspeed>1000
  for (const auto& [path, value] : appendix) {
    CAPTURE(path);
    CHECK(scout.at(path) == value);
  }
  // Values of the appendix's own controller and of its driver's raw unit, which the robot file does not take over.
  const std::map<std::string, std::string> others{
      {"drives.0.max_steer_speed", "1"},   {"drives.0.steer_gain", "0.5"},
      {"drives.0.speed_change", "50"},     {"drives.0.big_turn_angle", "1"},
      {"drives.0.big_turn_speed", "12.5"}, {"sonar_rings.0.scale_factor", "0.0435"},
      {"sonar_rings.0.offset", "-12"}};
  for (const auto& [path, value] : others) {
    CAPTURE(path);
    CHECK(scout.at(path) != value);
  }
}
