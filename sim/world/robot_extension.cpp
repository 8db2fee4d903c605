// SPDX-License-Identifier: LGPL-3.0-or-later
#include "robot_extension.hpp"

#include <algorithm>
#include <numeric>

#include "orca/sim/world.hpp"
#include "orca/xml/number.hpp"

namespace orca::sim::detail {
namespace {

constexpr std::size_t kMaxTransducers = 256;

// Takes over a value if there is one; the error is told already if not.
template <class To, class From>
void set(To& to, const std::optional<From>& from) {
  if (from) to = *from;
}

void read_drive(const Attributes& e, Drive& drive) {
  e.allow(
      {"type", "max_speed", "max_steer_speed", "max_acceleration", "max_steer_acceleration", "track",
       "wheel_diameter", "lag", "dead_time", "steer_gain", "speed_step", "big_turn_angle", "big_turn_speed"},
      {});
  set(drive.type, e.choice("type", {"differential"}));
  set(drive.max_speed, e.quantity("max_speed", "m/s", Sign::positive));
  set(drive.max_steer_speed, e.quantity("max_steer_speed", "rad/s", Sign::positive));
  set(drive.max_acceleration, e.quantity("max_acceleration", "m/s2", Sign::positive));
  set(drive.max_steer_acceleration, e.quantity("max_steer_acceleration", "rad/s2", Sign::positive));
  set(drive.track, e.quantity("track", "m", Sign::positive));
  set(drive.wheel_diameter, e.quantity("wheel_diameter", "m", Sign::positive));
  set(drive.lag, e.duration_or("lag", drive.lag));
  set(drive.dead_time, e.duration_or("dead_time", drive.dead_time));
  set(drive.steer_gain, e.quantity_or("steer_gain", "", Sign::positive, drive.steer_gain));
  set(drive.speed_step, e.quantity_or("speed_step", "m/s", Sign::not_negative, drive.speed_step));
  set(drive.big_turn_angle, e.quantity_or("big_turn_angle", "rad", Sign::positive, drive.big_turn_angle));
  set(drive.big_turn_speed,
      e.quantity_or("big_turn_speed", "rad/s", Sign::not_negative, drive.big_turn_speed));
  if (drive.dead_time > std::chrono::seconds{5})
    e.error_at("dead_time", 22, "a dead time of more than 5 s is not simulated");
}

void read_order(const Attributes& e, SonarRing& ring) {
  ring.order.resize(ring.count);
  std::iota(ring.order.begin(), ring.order.end(), std::size_t{0});
  if (!e.has("order")) return;
  const auto given = e.numbers("order", ring.count);
  if (!given) return;
  std::vector<double> sorted = *given;
  std::ranges::sort(sorted);
  for (std::size_t k = 0; k < ring.count; ++k)
    if (sorted[k] != static_cast<double>(k))
      return e.error_at(
          "order", 22,
          "the firing order must name each transducer from 0 to " + std::to_string(ring.count - 1) + " once");
  std::ranges::transform(*given, ring.order.begin(), [](double k) { return static_cast<std::size_t>(k); });
}

void check_period(const Attributes& e, Duration period) {
  if (period < World::kTick || period > std::chrono::hours{1})
    e.error_at("period", 22, "the period must be between the simulation's tick of 10 ms and an hour");
}

void check_ring(const Attributes& e, const SonarRing& ring) {
  if (ring.half_lobe > 0.5 * std::numbers::pi)
    e.error_at("half_lobe", 22, "half_lobe must be at most 90 deg");
  if (ring.min_range >= ring.max_range && ring.max_range > 0.0)
    e.error_at("min_range", 22, "min_range must be less than max_range");
  if (ring.period > Duration{0}) check_period(e, ring.period);
}

SonarRing read_ring(const Attributes& e, double robot_radius) {
  e.allow({"name", "count", "first_angle", "pitch", "half_lobe", "min_range", "max_range", "quantum",
           "radius", "period", "link", "order"},
          {});
  SonarRing ring;
  set(ring.name, e.name("name"));
  set(ring.count, e.count("count", 1, kMaxTransducers));
  set(ring.first_angle, e.quantity_or("first_angle", "rad", Sign::any, 0.0));
  set(ring.pitch, e.quantity("pitch", "rad", Sign::any));
  set(ring.half_lobe, e.quantity("half_lobe", "rad", Sign::positive));
  set(ring.min_range, e.quantity("min_range", "m", Sign::not_negative));
  set(ring.max_range, e.quantity("max_range", "m", Sign::positive));
  set(ring.quantum, e.quantity_or("quantum", "m", Sign::not_negative, 0.0));
  set(ring.radius, e.quantity_or("radius", "m", Sign::not_negative, robot_radius));
  set(ring.period, e.duration("period", Sign::positive));
  set(ring.link, e.text("link"));
  read_order(e, ring);
  check_ring(e, ring);
  return ring;
}

void read_odometer(const Attributes& e, RobotModel& model) {
  e.allow({"period"}, {});
  const auto period = e.duration("period", Sign::positive);
  if (!period) return;
  check_period(e, *period);
  model.odometer = Odometer{*period};
}

void read_child(const Attributes& e, RobotModel& model, bool& has_drive) {
  const std::string& kind = e.element().name();
  const bool again = (kind == "drive" && has_drive) || (kind == "odometry" && model.odometer);
  if (again) return e.error(10, "there is a <" + kind + "> already; a robot has one");
  if (kind == "drive") {
    has_drive = true;
    read_drive(e, model.drive);
  } else if (kind == "odometry") {
    read_odometer(e, model);
  } else if (kind == "sonar_ring") {
    SonarRing ring = read_ring(e, model.radius);
    if (model.sonar(ring.name) != nullptr)
      return e.error_at("name", 10,
                        "there is a sonar ring \"" + ring.name + "\" already; choose another name");
    model.sonars.push_back(std::move(ring));
  }
}

}  // namespace

void read_extension(const xml::Element& orca, RobotModel& model, xml::Diagnostics& diagnostics) {
  const Attributes e(orca, 'R', diagnostics);
  e.allow({"vendor", "model", "radius", "bumper_radius"}, {"drive", "sonar_ring", "odometry"});
  model.vendor = e.text_or("vendor", "");
  model.model = e.text_or("model", "");
  set(model.radius, e.quantity("radius", "m", Sign::positive));
  set(model.bumper_radius, e.quantity_or("bumper_radius", "m", Sign::positive, model.radius));
  if (model.bumper_radius < model.radius)
    e.error_at("bumper_radius", 22, "bumper_radius must not be less than radius: the bumper is outside");
  bool has_drive = false;
  for (const xml::Element& child : orca.children()) read_child({child, 'R', diagnostics}, model, has_drive);
  if (!has_drive) e.error(4, "<orca> needs the element <drive>");
}

}  // namespace orca::sim::detail
