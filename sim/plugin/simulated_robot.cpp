// SPDX-License-Identifier: LGPL-3.0-or-later
#include "simulated_robot.hpp"

#include <filesystem>
#include <utility>

#include "objects.hpp"
#include "orca/base/hash.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/time.hpp"
#include "orca/sim/robot_file.hpp"
#include "orca/sim/stand.hpp"
#include "orca/sim/world_file.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"
#include "own_sight.hpp"

namespace orca::sim {
namespace {

// The code of errors in a picture's scale (docs/world-files.md), which stands in two parameters of their own.
constexpr std::string_view kScaleOfPicture = "W023";

// Returns whether a line of output can hold the name as one of its words.
bool is_word(const std::string& name) {
  return !name.empty() && name.find(' ') == std::string::npos && printable(name) == name;
}

// A world is known by its file's name, so that it may lie elsewhere, and something in it may be moved, with the same robots.
std::uint64_t seed_in(const std::string& world, std::uint64_t run_seed) {
  Fnv1a key;
  key.add_u64(run_seed);
  key.add_text(std::filesystem::path(world).filename().string());
  return key.value();
}

std::optional<double> given(double value) { return value > 0.0 ? std::optional(value) : std::nullopt; }

// Reports a fault inside a file with its place there, and a fault of the file as a whole, for instance that
// it is missing, at the parameter that names the file.
void append(const xml::Diagnostics& diagnostics, const char* param, std::vector<HardwareFault>& errors) {
  for (const auto& diagnostic : diagnostics.sorted()) {
    const bool only_warns = diagnostic.severity == xml::Severity::warning;
    const bool whole_file = diagnostic.position.line == 0 || diagnostic.code == "G101";
    const std::string& file = diagnostic.position.file;
    if (whole_file) {
      errors.push_back({param, "\"" + file + "\": " + diagnostic.message});
      if (diagnostic.code == kScaleOfPicture) errors.back().follows_from = {"map_width", "map_resolution"};
    } else if (only_warns) {
      errors.push_back({param, diagnostic.position.text() + ": " + diagnostic.message});
    } else {
      errors.push_back({"", diagnostic.text()});
    }
    errors.back().only_warns = only_warns;
  }
}

// Says what touched what, and how fast a robot and a person were who met.
std::string text_of(const ContactEvent& contact) {
  const std::string touch = contact.robot + " touches " + contact.other;
  if (!contact.person_speed) return touch;
  const auto way = [](double speed) {
    return speed > 0.0 ? " moves at " + xml::number_text(std::round(100.0 * speed) / 100.0) + " m/s"
                       : " stands";
  };
  return touch + ": the robot" + way(contact.speed) + ", the person" + way(*contact.person_speed);
}

void report(const SharedWorld::Inbox::Contact& contact, hw::HardwareHost& host) {
  host.write_log(log::Level::warning, text_of(contact.event));
  idl::Contact touched;
  touched.robot() = contact.event.robot;
  touched.other() = contact.event.other;
  touched.x(contact.robot.x);
  touched.y(contact.robot.y);
  touched.stamp(to_time_value(contact.event.time));
  host.report(touched);
}

}  // namespace

std::vector<HardwareFault> SimulatedRobot::prepare() {
  std::vector<HardwareFault> errors;
  world_ = read_world_file(errors);
  robot_ = read_robot_file(errors);
  find_start(errors);
  if (const auto found = levels(); !found) errors.push_back({"errors", found.error().message});
  if (!is_word(*name_))
    errors.push_back({"name", in_quotes(*name_) + " is no name of a robot: one word that results can show"});
  if (!robot_) return errors;
  for (HardwareFault& fault : declare()) errors.push_back(std::move(fault));
  return errors;
}

std::optional<WorldModel> SimulatedRobot::read_world_file(std::vector<HardwareFault>& errors) const {
  if (world_file_->empty()) {
    errors.push_back({"world", "it is not set; name a world, e.g. \"../sim/worlds/office.xml\""});
    return std::nullopt;
  }
  xml::Diagnostics diagnostics;
  std::optional<WorldModel> world =
      read_world(*world_file_, {given(*map_width_), given(*map_resolution_)}, diagnostics);
  append(diagnostics, "world", errors);
  return diagnostics.has_errors() ? std::nullopt : std::move(world);
}

std::optional<RobotModel> SimulatedRobot::read_robot_file(std::vector<HardwareFault>& errors) const {
  if (robot_file_->empty()) {
    errors.push_back({"robot", "it is not set; name a robot, e.g. \"../sim/robots/nomad_scout.urdf\""});
    return std::nullopt;
  }
  xml::Diagnostics diagnostics;
  std::optional<RobotModel> robot = read_robot(*robot_file_, diagnostics, *packages_);
  append(diagnostics, "robot", errors);
  return diagnostics.has_errors() ? std::nullopt : std::move(robot);
}

void SimulatedRobot::find_start(std::vector<HardwareFault>& errors) {
  start_ = {*x_, *y_, *heading_};
  if (!world_) return;
  if (!place_->empty()) {
    const Place* const place = world_->place(*place_);
    if (place == nullptr) {
      std::vector<std::string> names;
      for (const Place& known : world_->places) names.push_back(known.name);
      errors.push_back({"place", "\"" + *place_ + "\" is no place of " + *world_file_ + "; places: " +
                                     listed(names) + xml::did_you_mean(xml::nearest_name(*place_, names))});
      return;
    }
    start_ = place->pose;
  }
  if (robot_) check_start_is_free(errors);
}

void SimulatedRobot::check_start_is_free(std::vector<HardwareFault>& errors) const {
  for (const StandsIn& there : what_holds(*robot_, start_, *world_))
    errors.push_back({start_param(),
                      "the robot \"" + *name_ + "\" would start inside \"" + there.name + "\" at x " +
                          xml::number_text(start_.x) + " m, y " + xml::number_text(start_.y) + " m, " +
                          how_to_clear(there) + "; choose a free place",
                      {"world", "robot", "place", "x", "y", "heading"}});
}

std::vector<HardwareFault> SimulatedRobot::conflicts_with(const HardwareContainer& earlier) const {
  const auto& other = static_cast<const SimulatedRobot&>(earlier);
  std::vector<HardwareFault> faults;
  if (*world_file_ != *other.world_file_) return faults;
  faults.push_back({"world",
                    "it is the world of hardware " + in_quotes(other.host().name()) +
                        " too, and a simulated world lives in one process",
                    {},
                    true});
  const std::string whose = "that of hardware " + in_quotes(other.host().name());
  if (*name_ == *other.name_)
    faults.push_back({"name", "there is a robot " + in_quotes(*name_) + " in this world already, " + whose +
                                  "; choose another name"});
  if (settings() != other.settings())
    faults.push_back({setting_unlike(other), "another robot, " + whose + ", has this world with " +
                                                 other.settings() + ", and this one wants " + settings() +
                                                 "; robots that share a world need the same"});
  if (stand_in_each_other(*robot_, start_, *other.robot_, other.start_, Extent::with_paddles))
    faults.push_back(
        {start_param(), "the robot " + in_quotes(*name_) + " would start where another one starts, " + whose +
                            ", " + how_to_clear(way_out_of(*other.robot_, other.start_, *robot_, start_)) +
                            "; choose a free place"});
  return faults;
}

const char* SimulatedRobot::setting_unlike(const SimulatedRobot& other) const {
  if (*realism_ != *other.realism_) return "realism";
  if (*errors_ != *other.errors_) return "errors";
  if (*dead_sonars_ != *other.dead_sonars_) return "dead_sonars";
  if (*map_width_ != *other.map_width_) return "map_width";
  return *map_resolution_ != *other.map_resolution_ ? "map_resolution" : "threads";
}

Status SimulatedRobot::open() {
  if (shared_ != nullptr) {
    miss(shared_->advance(id_, host().now()));
    return ok();
  }
  // The key contains the run, so that two systems in one process have separate worlds.
  const std::string key =
      std::to_string(reinterpret_cast<std::uintptr_t>(&host().executive())) + *world_file_;
  auto joined = SharedWorld::join(key, settings(), host().now(), [this] {
    return World(*world_, {.seed = seed_in(*world_file_, host().run_seed()),
                           .errors = levels().value(),
                           .threads = static_cast<unsigned>(*threads_)});
  });
  if (!joined) return joined.error();
  shared_ = std::move(*joined);
  outside_.enter(shared_);
  const Result<RobotId> added = shared_->add_robot(*name_, *robot_, start_, kTruthPeriod);
  if (!added) return added.error();
  id_ = *added;
  if (keeps_moments_) shared_->keep_trajectory(id_);
  if (keeps_motion_) shared_->keep_motion(id_);
  moments_.emplace(*robot_);
  return ok();
}

Result<ErrorLevels> SimulatedRobot::levels() const {
  Result<ErrorLevels> levels = scaled(error_levels(realism()), *errors_);
  if (levels) levels->sonar_dead = *dead_sonars_;
  return levels;
}

std::string SimulatedRobot::settings() const {
  std::string text = "realism " + *realism_;
  if (!errors_->empty()) text += ", errors " + in_quotes(*errors_);
  if (*dead_sonars_ > 0.0) text += ", dead_sonars " + xml::number_text(*dead_sonars_);
  if (*map_width_ > 0.0) text += ", map_width " + xml::number_text(*map_width_) + " m";
  if (*map_resolution_ > 0.0) text += ", map_resolution " + xml::number_text(*map_resolution_) + " m";
  if (*threads_ != 1) text += ", threads " + std::to_string(*threads_);
  return text;
}

void SimulatedRobot::draw(Scene& scene) {
  if (!moments_ && world_ && robot_) draw_start(*world_, *name_, *robot_, start_, scene);
  if (!moments_) return;
  scene.people = shared_->people();
  sim::draw(shared_->snapshot(), *name_, *robot_, moments_->moments(), shared_->motion(id_),
            shared_->encounters(id_), scene);
}

idl::Robot SimulatedRobot::description() const { return describe(*robot_, *name_); }

Realism SimulatedRobot::realism() const { return realism_from(*realism_).value_or(Realism::nominal); }

// Says how much time the world has left out, when that is enough to matter.
void SimulatedRobot::note_lost(Duration lost) {
  constexpr Duration kWorthTelling = 500ms;
  lost_ += lost;
  if (lost_ < kWorthTelling) return;
  host().write_log(log::Level::warning,
                   "the world stood still for " + seconds_text(std::exchange(lost_, Duration{0})) +
                       ", and goes on without that time: this process had no processor, or was stopped");
}

void SimulatedRobot::go_on() {
  const SharedWorld::Inbox inbox = shared_->advance(id_, host().now());
  for (const auto& contact : inbox.contacts) report(contact, host());
  for (const std::string& event : inbox.happened)
    host().write_log(log::Level::info, "in the world: " + event);
  note_lost(inbox.lost);
  if (!inbox.truth.empty()) host().truly_at(*name_, inbox.truth.back().pose);
  if (keeps_moments_) moments_->add(inbox);
  sense(inbox);
}

}  // namespace orca::sim
