// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/p2os/model.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace orca::hw::p2os {
namespace {

constexpr double kMillimetre = 0.001;
constexpr double kDegree = std::numbers::pi / 180.0;

constexpr Pose2 pose(double x_mm, double y_mm, double heading_deg) {
  return {x_mm * kMillimetre, y_mm * kMillimetre, heading_deg * kDegree};
}

using HalfRing = std::array<Pose2, 8>;

constexpr HalfRing kFront = {pose(69, 136, 90),    pose(114, 119, 50),  pose(148, 78, 30),
                             pose(166, 27, 10),    pose(166, -27, -10), pose(148, -78, -30),
                             pose(114, -119, -50), pose(69, -136, -90)};
constexpr HalfRing kRear = {pose(-157, -136, -90), pose(-203, -119, -130), pose(-237, -78, -150),
                            pose(-255, -27, -170), pose(-255, 27, 170),    pose(-237, 78, 150),
                            pose(-203, 119, 130),  pose(-157, 136, 90)};
constexpr HalfRing kUpperFront = {pose(-20, 136, 90),  pose(24, 119, 50),   pose(58, 78, 30),
                                  pose(77, 27, 10),    pose(77, -27, -10),  pose(58, -78, -30),
                                  pose(24, -119, -50), pose(-20, -136, -90)};
constexpr HalfRing kUpperRear = {pose(-191, -136, -90), pose(-237, -119, -130), pose(-271, -78, -150),
                                 pose(-290, -27, -170), pose(-290, 27, 170),    pose(-271, 78, 150),
                                 pose(-237, 119, 130),  pose(-191, 136, 90)};

template <class... HalfRings>
constexpr auto ring(const HalfRings&... halves) {
  std::array<Pose2, 8 * sizeof...(halves)> all{};
  auto to = all.begin();
  ((to = std::copy(halves.begin(), halves.end(), to)), ...);
  return all;
}

constexpr auto kDxRing = ring(kFront, kRear);
constexpr auto kPeopleBotRing = ring(kFront, kUpperFront, kRear);
constexpr auto kPerformanceRing = ring(kFront, kUpperFront, kRear, kUpperRear);

// Scales of a model as the parameter files give them: millimetres per count, and rad/mm of a difference of the wheels.
constexpr Model scales(std::string_view subclass, std::string_view name, double distance, double range,
                       double difference) {
  return {.subclass = subclass,
          .name = name,
          .distance_unit = distance * kMillimetre,
          .range_unit = range * kMillimetre,
          .half_track = kMillimetre / difference};
}

constexpr Model shaped(Model model, double width, double length, double radius) {
  model.width = width * kMillimetre;
  model.length = length * kMillimetre;
  model.radius = radius * kMillimetre;
  model.max_speed = 2200 * kMillimetre;
  model.max_turn_rate = 500 * kDegree;
  return model;
}

constexpr Model sensing(Model model, int sonars, std::span<const Pose2> poses = {}, int bumpers = 0) {
  model.sonars = sonars;
  model.sonar_poses = poses;
  model.bumpers = bumpers;
  return model;
}

constexpr Model limited(Model model, double max_speed, double max_turn_rate) {
  model.max_speed = max_speed * kMillimetre;
  model.max_turn_rate = max_turn_rate * kDegree;
  return model;
}

constexpr Model with_laser(Model model, double x, double y) {
  model.laser = Vec2{x * kMillimetre, y * kMillimetre};
  return model;
}

constexpr Model dx(std::string_view subclass, std::string_view name, double distance, double range,
                   double difference) {
  return sensing(shaped(scales(subclass, name, distance, range, difference), 425, 511, 250), 16, kDxRing);
}

constexpr Model at(std::string_view subclass, std::string_view name, double range) {
  return sensing(limited(shaped(scales(subclass, name, 1.32, range, 0.0034), 505, 626, 500), 1200, 300), 16);
}

constexpr Model performance(std::string_view subclass, std::string_view name, double distance,
                            double length) {
  return sensing(shaped(scales(subclass, name, distance, 1.0, 0.0060), 425, length, 340), 32,
                 kPerformanceRing);
}

constexpr Model with_bumpers(Model model) {
  model.bumpers = 5;
  return model;
}

constexpr Model amigo() {
  Model model =
      sensing(limited(shaped(scales("amigo", "AmigoBot", 0.5083, 1.0, 0.011), 279, 330, 180), 1000, 300), 8);
  model.velocity_unit = 0.6154 * kMillimetre;
  return model;
}

constexpr std::array kModels = {
    with_laser(dx("p2dx", "Pioneer 2-DX", 0.84, 0.268, 0.0056), 17, 8),
    dx("p2ce", "Pioneer 2-CE", 0.826, 0.268, 0.0057),
    dx("p2de", "Pioneer 2-DXe", 0.969, 0.268, 0.0056),
    scales("p2df", "Pioneer 2-DXf", 0.485, 0.268, 0.0060),
    dx("p2d8", "Pioneer 2-DX8", 0.485, 1.0, 0.0056),
    dx("p2d8+", "Pioneer 2-DX8", 0.485, 1.0, 0.0056),
    with_laser(at("p2at", "Pioneer 2-AT", 0.268), 160, 7),
    at("p2at8", "Pioneer 2-AT8", 1.0),
    sensing(shaped(scales("p2pb", "PeopleBot", 0.424, 0.268, 0.0056), 425, 513, 300), 24, kPeopleBotRing, 5),
    sensing(shaped(scales("p2pp", "Performance PeopleBot (P2)", 0.485, 0.268, 0.0060), 425, 513, 300), 24, {},
            5),
    with_laser(with_bumpers(performance("perfpb", "Performance PeopleBot", 0.485, 513)), 21, 0),
    with_bumpers(performance("perfpb+", "Performance PeopleBot", 0.485, 511)),
    performance("peoplebot-sh", "PeopleBot (SH controller)", 1.0, 513),
    with_laser(dx("p3dx", "Pioneer 3-DX", 0.485, 1.0, 0.0056), 18, 0),
    dx("p3dx-sh", "Pioneer 3-DX (SH)", 1.0, 1.0, 0.0056),
    amigo(),
};

constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

ModelChoice choose_model(std::string_view subclass) {
  const auto is_it = [&](const Model& model) {
    return std::ranges::equal(model.subclass, subclass, {}, {}, lower);
  };
  const auto found = std::ranges::find_if(kModels, is_it);
  return found == kModels.end() ? ModelChoice{kModels.front(), false} : ModelChoice{*found, true};
}

std::span<const Model> models() { return kModels; }

}  // namespace orca::hw::p2os
