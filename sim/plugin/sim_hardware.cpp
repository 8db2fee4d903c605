// SPDX-License-Identifier: LGPL-3.0-or-later
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "moment_log.hpp"
#include "objects.hpp"
#include "orca/base/text.hpp"
#include "orca/hardware.hpp"
#include "orca/sim/robot_file.hpp"
#include "orca/sim/scaled_errors.hpp"
#include "orca/sim/world_file.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"
#include "own_sight.hpp"
#include "shared_world.hpp"
#include "sim_sensors.hpp"
#include "touch_guard.hpp"

namespace {

using namespace orca::sim;
using orca::Pose2;
using orca::Status;
using orca::TimePoint;

// Longest time that a motion command holds (DESIGN 11).
constexpr orca::Duration kMaxCommandAge = std::chrono::milliseconds(200);

constexpr double kFarthest = 1e5;  // [m] A world reaches no farther.

// The code of errors in a picture's scale (docs/world-files.md), which stands in two parameters of their own.
constexpr std::string_view kScaleOfPicture = "W023";

// Returns whether a line of output can hold the name as one of its words.
bool is_word(const std::string& name) {
  return !name.empty() && name.find(' ') == std::string::npos && orca::printable(name) == name;
}

/// A robot in the simulated world, behind the same interface as real hardware. Robots whose graph entries
/// name the same world file share one world.
class SimHardware final : public orca::hw::HardwareContainer, private orca::hw::Drawable {
 public:
  using HardwareContainer::HardwareContainer;

 private:
  std::vector<orca::HardwareFault> prepare() override {
    std::vector<orca::HardwareFault> errors;
    world_ = read_world_file(errors);
    robot_ = read_robot_file(errors);
    find_start(errors);
    if (const auto levels = this->levels(); !levels) errors.push_back({"errors", levels.error().message});
    if (!is_word(*name_))
      errors.push_back(
          {"name", orca::in_quotes(*name_) + " is no name of a robot: one word that results can show"});
    if (!robot_) return errors;
    if (const std::string why = unserved(*robot_); !why.empty())
      errors.push_back({"robot", "\"" + *robot_file_ + "\": " + why});
    declare_endpoints();
    for (const std::string& gap : gaps_at_own_sensors(*robot_))
      errors.push_back({.param = "robot", .text = gap, .only_warns = true});
    return errors;
  }

  std::optional<WorldModel> read_world_file(std::vector<orca::HardwareFault>& errors) const {
    if (world_file_->empty()) {
      errors.push_back({"world", "it is not set; name a world, e.g. \"../sim/worlds/office.xml\""});
      return std::nullopt;
    }
    orca::xml::Diagnostics diagnostics;
    std::optional<WorldModel> world =
        read_world(*world_file_, {given(*map_width_), given(*map_resolution_)}, diagnostics);
    append(diagnostics, "world", errors);
    return diagnostics.has_errors() ? std::nullopt : std::move(world);
  }

  static std::optional<double> given(double value) {
    return value > 0.0 ? std::optional(value) : std::nullopt;
  }

  std::optional<RobotModel> read_robot_file(std::vector<orca::HardwareFault>& errors) const {
    if (robot_file_->empty()) {
      errors.push_back({"robot", "it is not set; name a robot, e.g. \"../sim/robots/nomad_scout.urdf\""});
      return std::nullopt;
    }
    orca::xml::Diagnostics diagnostics;
    std::optional<RobotModel> robot = read_robot(*robot_file_, diagnostics);
    append(diagnostics, "robot", errors);
    return diagnostics.has_errors() ? std::nullopt : std::move(robot);
  }

  // Reports a fault inside a file with its place there, and a fault of the file as a whole, for instance that
  // it is missing, at the parameter that names the file.
  static void append(const orca::xml::Diagnostics& diagnostics, const char* param,
                     std::vector<orca::HardwareFault>& errors) {
    for (const auto& diagnostic : diagnostics.sorted()) {
      const bool whole_file = diagnostic.position.line == 0 || diagnostic.code == "G101";
      const std::string& file = diagnostic.position.file;
      if (whole_file) {
        errors.push_back({param, "\"" + file + "\": " + diagnostic.message});
        if (diagnostic.code == kScaleOfPicture) errors.back().follows_from = {"map_width", "map_resolution"};
      } else {
        errors.push_back({"", diagnostic.text()});
      }
    }
  }

  void find_start(std::vector<orca::HardwareFault>& errors) {
    start_ = {*x_, *y_, *heading_};
    if (!world_) return;
    if (!place_->empty()) {
      const Place* const place = world_->place(*place_);
      if (place == nullptr) {
        const std::vector<std::string> names = place_names();
        errors.push_back({"place", "\"" + *place_ + "\" is no place of " + *world_file_ +
                                       "; places: " + orca::listed(names) +
                                       orca::xml::did_you_mean(orca::xml::nearest_name(*place_, names))});
        return;
      }
      start_ = place->pose;
    }
    if (robot_) check_start_is_free(errors);
  }

  void check_start_is_free(std::vector<orca::HardwareFault>& errors) const {
    const Obstacle* hit = world_->obstacle_at(placed(robot_->footprint, start_), robot_->bottom, robot_->top);
    if (hit == nullptr) return;
    errors.push_back({start_param(),
                      "the robot \"" + *name_ + "\" would start inside \"" + hit->name + "\" at x " +
                          orca::xml::number_text(start_.x) + " m, y " + orca::xml::number_text(start_.y) +
                          " m; choose a free place",
                      {"world", "robot", "place", "x", "y", "heading"}});
  }

  [[nodiscard]] std::vector<std::string> place_names() const {
    std::vector<std::string> names;
    for (const Place& place : world_->places) names.push_back(place.name);
    return names;
  }

  void declare_endpoints() {
    sensors_ = std::make_unique<SimSensors>(*robot_, realism());
    for (orca::hw::SensorEndpoint* endpoint : sensors_->endpoints()) add_sensor(*endpoint);
    motion_ = std::make_unique<orca::hw::MotionHW>(limits_of(*robot_), kMaxCommandAge);
    set_motion(*motion_);
    if (*stop_on_touch_) guard_.emplace(*robot_, *motion_);
  }

  // Only robots that share a world can be in each other's way.
  [[nodiscard]] std::vector<orca::HardwareFault> conflicts_with(
      const HardwareContainer& earlier) const override {
    const auto& other = static_cast<const SimHardware&>(earlier);
    std::vector<orca::HardwareFault> faults;
    if (*world_file_ != *other.world_file_) return faults;
    faults.push_back({"world",
                      "it is the world of hardware " + orca::in_quotes(other.host().name()) +
                          " too, and a simulated world lives in one process",
                      {},
                      true});
    const std::string whose = "that of hardware " + orca::in_quotes(other.host().name());
    if (*name_ == *other.name_)
      faults.push_back({"name", "there is a robot " + orca::in_quotes(*name_) + " in this world already, " +
                                    whose + "; choose another name"});
    if (settings() != other.settings())
      faults.push_back({setting_unlike(other), "another robot, " + whose + ", has this world with " +
                                                   other.settings() + ", and this one wants " + settings() +
                                                   "; robots that share a world need the same"});
    if (overlap(placed(robot_->footprint, start_), placed(other.robot_->footprint, other.start_)))
      faults.push_back({start_param(), "the robot " + orca::in_quotes(*name_) +
                                           " would start where another one starts, " + whose +
                                           "; choose a free place"});
    return faults;
  }

  // Returns the first parameter of the shared world that differs.
  [[nodiscard]] const char* setting_unlike(const SimHardware& other) const {
    if (*realism_ != *other.realism_) return "realism";
    if (*errors_ != *other.errors_) return "errors";
    if (*map_width_ != *other.map_width_) return "map_width";
    return *map_resolution_ != *other.map_resolution_ ? "map_resolution" : "threads";
  }

  [[nodiscard]] const char* start_param() const { return place_->empty() ? "x" : "place"; }

  [[nodiscard]] orca::idl::Robot description() const override { return describe(*robot_, *name_); }

  orca::hw::Drawable* drawable() override { return this; }
  void keep_moments() override { keeps_moments_ = true; }
  void keep_motion() override { keeps_motion_ = true; }
  void draw(orca::Scene& scene) override {
    if (moments_)
      orca::sim::draw(shared_->snapshot(), *name_, *robot_, moments_->moments(), shared_->motion(id_), scene);
  }

  // A robot whose device is opened again is where it was left, in the same world.
  Status open() override {
    if (shared_ != nullptr) return skip_past();
    // The key contains the run, so that two systems in one process have separate worlds.
    const std::string key =
        std::to_string(reinterpret_cast<std::uintptr_t>(&host().executive())) + *world_file_;
    auto joined = SharedWorld::join(key, settings(), host().now(), [this] {
      return World(*world_, {.seed = host().run_seed(),
                             .errors = levels().value(),
                             .threads = static_cast<unsigned>(*threads_)});
    });
    if (!joined) return joined.error();
    shared_ = std::move(*joined);
    const orca::Result<RobotId> added = shared_->add_robot(*name_, *robot_, start_, kTruthPeriod);
    if (!added) return added.error();
    id_ = *added;
    if (keeps_moments_) shared_->keep_trajectory(id_);
    if (keeps_motion_) shared_->keep_motion(id_);
    moments_.emplace(*robot_);
    return orca::ok();
  }

  Status skip_past() {
    sensors_->skip(shared_->advance(id_, host().now()));
    return orca::ok();
  }

  [[nodiscard]] Realism realism() const { return realism_from(*realism_).value_or(Realism::nominal); }

  [[nodiscard]] orca::Result<ErrorLevels> levels() const { return scaled(error_levels(realism()), *errors_); }

  [[nodiscard]] std::string settings() const {
    std::string text = "realism " + *realism_;
    if (!errors_->empty()) text += ", errors " + orca::in_quotes(*errors_);
    if (*map_width_ > 0.0) text += ", map_width " + orca::xml::number_text(*map_width_) + " m";
    if (*map_resolution_ > 0.0) text += ", map_resolution " + orca::xml::number_text(*map_resolution_) + " m";
    if (*threads_ != 1) text += ", threads " + std::to_string(*threads_);
    return text;
  }

  Status drive(const orca::hw::DriveSetpoint& setpoint) override {
    if (guard_) guard_->driven(setpoint.velocity, host().now());
    return shared_->command(id_, setpoint, host().now());
  }

  [[nodiscard]] TimePoint next_poll() const override { return shared_->next_tick(id_); }

  // Advances the world, even if nobody listens.
  Status poll() override {
    const SharedWorld::Inbox inbox = shared_->advance(id_, host().now());
    for (const auto& contact : inbox.contacts) report(contact);
    for (const std::string& event : inbox.happened)
      host().write_log(orca::log::Level::info, "in the world: " + event);
    if (guard_) guard_->look(inbox);
    if (keeps_moments_) moments_->add(inbox);
    if (state() == orca::hw::HardwareState::active) {
      sensors_->publish(inbox);
    } else {
      sensors_->skip(inbox);
    }
    return orca::ok();
  }

  void report(const SharedWorld::Inbox::Contact& contact) {
    host().write_log(orca::log::Level::warning, contact.event.robot + " touches " + contact.event.other);
    orca::idl::Contact touched;
    touched.robot() = contact.event.robot;
    touched.other() = contact.event.other;
    touched.x(contact.robot.x);
    touched.y(contact.robot.y);
    touched.stamp(orca::to_time_value(contact.event.time));
    host().report(touched);
  }

  orca::Param<std::string> world_file_{
      *this,
      "world",
      "",
      {.file = true,
       .text =
           "World (.xml), occupancy bitmap (.png, .pgm) or worlds of cylinders (.csv, .csv.gz); FILE#7 is "
           "number 7 of those in the file."}};
  orca::Param<double> map_width_{
      *this,
      "map_width",
      0.0,
      {.unit = "m", .min = 0.0, .text = "Width of the whole bitmap; a bitmap needs this or map_resolution."}};
  orca::Param<double> map_resolution_{
      *this,
      "map_resolution",
      0.0,
      {.unit = "m", .min = 0.0, .text = "Side of one pixel of a bitmap, instead of map_width."}};
  orca::Param<std::string> robot_file_{
      *this, "robot", "", {.file = true, .text = "Description of the robot: URDF with an <orca> element."}};
  orca::Param<std::string> name_{
      *this, "name", "Dewey", {.text = "Name of this robot; each robot of a world has its own."}};
  orca::Param<std::string> place_{
      *this, "place", "", {.text = "Start at this place of the world instead of x, y, heading."}};
  orca::Param<double> x_{
      *this,
      "x",
      0.0,
      {.unit = "m", .min = -kFarthest, .max = kFarthest, .text = "Start position in the world frame."}};
  orca::Param<double> y_{
      *this,
      "y",
      0.0,
      {.unit = "m", .min = -kFarthest, .max = kFarthest, .text = "Start position in the world frame."}};
  orca::Param<double> heading_{
      *this,
      "heading",
      0.0,
      {.unit = "rad", .text = "Start heading, counter-clockwise from the world's x axis."}};
  orca::Param<std::string> realism_{*this,
                                    "realism",
                                    "nominal",
                                    {.choices = {"ideal", "nominal", "harsh"},
                                     .text = "Level of the errors of sensors, motors and odometry."}};
  orca::Param<std::string> errors_{
      *this,
      "errors",
      "",
      {.text = "Factors on single errors of that level, or on estimates that all levels share, to see what "
               "depends on them: slip=2; wheel_grip=0.5. Names: docs/simulation.md."}};
  orca::Param<bool> stop_on_touch_{
      *this,
      "stop_on_touch",
      true,
      {.fixed = true,
       .text = "Whether the base stands while a bumper is pressed (without bumpers: "
               "after it has touched something), or when its motors "
               "are stalled, until a command asks for another direction."}};
  orca::Param<std::int64_t> threads_{*this,
                                     "threads",
                                     1,
                                     {.min = 0.0,
                                      .max = 64.0,
                                      .text = "Number of threads that compute sensor readings; 0: one per "
                                              "processor. Results do not depend on it."}};

  std::optional<WorldModel> world_;
  std::optional<RobotModel> robot_;
  Pose2 start_;
  std::unique_ptr<SimSensors> sensors_;
  std::unique_ptr<orca::hw::MotionHW> motion_;
  std::optional<TouchGuard> guard_;
  std::shared_ptr<SharedWorld> shared_;
  RobotId id_{};
  bool keeps_moments_ = false;
  bool keeps_motion_ = false;
  std::optional<MomentLog> moments_;
};

}  // namespace

ORCA_HARDWARE(SimHardware, "orca.hw.Sim")
