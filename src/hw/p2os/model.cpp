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
constexpr HalfRing kAtFront = {pose(147, 136, 90),   pose(193, 119, 50),  pose(227, 79, 30),
                               pose(245, 27, 10),    pose(245, -27, -10), pose(227, -79, -30),
                               pose(193, -119, -50), pose(147, -136, -90)};
constexpr HalfRing kAtRear = {pose(-144, -136, -90), pose(-189, -119, -130), pose(-223, -79, -150),
                              pose(-241, -27, -170), pose(-241, 27, 170),    pose(-223, 79, 150),
                              pose(-189, 119, 130),  pose(-144, 136, 90)};
constexpr HalfRing kPatrolFront = {pose(83, 229, 90),    pose(169, 202, 55),  pose(232, 134, 30),
                                   pose(263, 46, 10),    pose(263, -46, -10), pose(232, -134, -30),
                                   pose(169, -202, -55), pose(83, -229, -90)};
constexpr HalfRing kPatrolRear = {pose(-83, -229, -90),  pose(-169, -202, -125), pose(-232, -134, -150),
                                  pose(-263, -46, -170), pose(-263, 46, 170),    pose(-232, 134, 150),
                                  pose(-169, 202, 125),  pose(-83, 229, 90)};
// Seven sonars on each quarter of a PowerBot; the controller counts an eighth one that is not there.
constexpr Pose2 kNoSonar = pose(0, 0, 180);
constexpr HalfRing kPowerFrontLeft = {
    pose(152, 278, 90), pose(200, 267, 65), pose(241, 238, 45), pose(274, 200, 35),
    pose(300, 153, 25), pose(320, 96, 15),  pose(332, 33, 5),   kNoSonar};
constexpr HalfRing kPowerFrontRight = {
    pose(332, -33, -5),   pose(320, -96, -15),  pose(300, -153, -25), pose(274, -200, -35),
    pose(241, -238, -45), pose(200, -267, -65), pose(152, -278, -90), kNoSonar};
constexpr HalfRing kPowerRearRight = {
    pose(-298, -278, -90),  pose(-347, -267, -115), pose(-388, -238, -135), pose(-420, -200, -145),
    pose(-447, -153, -155), pose(-467, -96, -165),  pose(-478, -33, -175),  kNoSonar};
constexpr HalfRing kPowerRearLeft = {
    pose(-478, 33, 175),  pose(-467, 96, 165),  pose(-447, 153, 155), pose(-420, 200, 145),
    pose(-388, 238, 135), pose(-347, 267, 115), pose(-298, 278, 90),  kNoSonar};

template <class... HalfRings>
constexpr auto ring(const HalfRings&... halves) {
  std::array<Pose2, 8 * sizeof...(halves)> all{};
  auto to = all.begin();
  ((to = std::copy(halves.begin(), halves.end(), to)), ...);
  return all;
}

constexpr auto kDxRing = ring(kFront, kRear);
constexpr auto kAtRing = ring(kAtFront, kAtRear);
constexpr auto kPeopleBotRing = ring(kFront, kUpperFront, kRear);
constexpr auto kPerformanceRing = ring(kFront, kUpperFront, kRear, kUpperRear);
constexpr auto kPeopleBotShRing = ring(kFront, kRear, kUpperFront, kUpperRear);
constexpr auto kPatrolRing = ring(kPatrolFront, kPatrolRear);
constexpr auto kPowerRing = ring(kPowerFrontLeft, kPowerFrontRight, kPowerRearRight, kPowerRearLeft);
constexpr auto kPowerRearRing = ring(kPowerRearRight, kPowerRearLeft);
constexpr HalfRing kAmigoRing = {pose(76, 100, 90),     pose(125, 75, 41),   pose(150, 30, 15),
                                 pose(150, -30, -15),   pose(125, -75, -41), pose(76, -100, -90),
                                 pose(-140, -58, -145), pose(-140, 58, 145)};
constexpr HalfRing kAmigoShRing = {pose(70, 100, 90),     pose(125, 75, 41),   pose(144, 30, 15),
                                   pose(144, -30, -15),   pose(120, -75, -41), pose(70, -100, -90),
                                   pose(-146, -58, -145), pose(-146, 58, 145)};
constexpr std::array kPioneer1Ring = {pose(100, 100, 90),  pose(120, 80, 30),   pose(130, 40, 15),
                                      pose(130, 0, 0),     pose(130, -40, -15), pose(120, -80, -30),
                                      pose(100, -100, -90)};

// Scales of a model as the parameter files give them: millimetres per count, and rad/mm of a difference of the wheels.
constexpr Model scales(std::string_view subclass, std::string_view name, double distance, double range,
                       double difference) {
  return {.subclass = subclass,
          .name = name,
          .distance_unit = distance * kMillimetre,
          .range_unit = range * kMillimetre,
          .half_track = kMillimetre / difference};
}

// Controllers of the series SH count in millimetres.
constexpr Model in_millimetres(std::string_view subclass, std::string_view name, double difference) {
  return scales(subclass, name, 1.0, 1.0, difference);
}

constexpr Model shaped(Model model, double width, double length, double radius) {
  model.width = width * kMillimetre;
  model.length = length * kMillimetre;
  model.radius = radius * kMillimetre;
  model.max_speed = 2200 * kMillimetre;
  model.max_turn_rate = 500 * kDegree;
  return model;
}

constexpr Model sensing(Model model, std::span<const Pose2> poses) {
  model.sonar_poses = poses;
  return model;
}

constexpr Model limited(Model model, double max_speed, double max_turn_rate) {
  model.max_speed = max_speed * kMillimetre;
  model.max_turn_rate = max_turn_rate * kDegree;
  return model;
}

constexpr Model with_bumpers(Model model, int front, int rear) {
  model.front_bumpers = front;
  model.rear_bumpers = rear;
  return model;
}

// The middle of these bodies is behind the axle, as that of their sonars: docs/device-errors.md.
constexpr Model behind_axle(Model model) {
  model.behind = 44.5 * kMillimetre;
  return model;
}

constexpr Model dx(const Model& model) { return behind_axle(sensing(shaped(model, 425, 511, 250), kDxRing)); }

constexpr Model at(const Model& model, double width = 505) {
  return sensing(limited(shaped(model, width, 626, 500), 1200, 300), kAtRing);
}

constexpr Model people(const Model& model, double radius, std::span<const Pose2> ring, double length = 513) {
  return behind_axle(with_bumpers(sensing(shaped(model, 425, length, radius), ring), 5, 5));
}

constexpr Model patrol(const Model& model) {
  return with_bumpers(sensing(shaped(model, 425, 510, 250), kPatrolRing), 6, 6);
}

constexpr Model power(const Model& model, std::span<const Pose2> ring = kPowerRing) {
  Model all = with_bumpers(sensing(limited(shaped(model, 680, 911, 550), 2000, 360), ring), 7, 5);
  for (std::size_t i = 7; i < ring.size(); i += 8) all.absent_sonars |= 1U << i;
  return all;
}

constexpr Model amigo_shaped(const Model& model, std::span<const Pose2> ring) {
  return sensing(limited(shaped(model, 279, 330, 180), 1000, 300), ring);
}

constexpr Model amigo() {
  Model model = amigo_shaped(scales("amigo", "AmigoBot", 0.5083, 1.0, 0.011), kAmigoRing);
  model.velocity_unit = 0.6154 * kMillimetre;
  return model;
}

// Its size is in no parameter file, except for the radius.
constexpr Model pioneer1(std::string_view subclass, std::string_view name, double distance = 0.05066,
                         double radius = 220, double max_speed = 400) {
  Model model = scales(subclass, name, distance, 0.1734, 1.0 / 300.0);
  model = sensing(limited(shaped(model, 0, 0, radius), max_speed, 100), kPioneer1Ring);
  model.velocity_unit = 2.5332 * kMillimetre;
  model.angle_unit = 2.0 * std::numbers::pi / 1024.0;
  return model;
}

// Its sonars are at a board of their own, and not in the packets.
constexpr Model pioneer_lx(std::string_view subclass, std::string_view name) {
  const Model model = limited(shaped(in_millimetres(subclass, name, 0.0056), 500, 696, 348), 2500, 180);
  return with_bumpers(model, 3, 3);
}

constexpr Model seekur() {
  const Model model = in_millimetres("seekur", "Seekur", 0.0056);
  return with_bumpers(limited(shaped(model, 1270, 1410, 833), 2200, 190), 5, 3);
}

constexpr Model seekur_jr() {
  const Model model = in_millimetres("seekurjr", "Seekur Jr", 0.0056);
  return with_bumpers(limited(shaped(model, 830, 1200, 600), 1200, 80), 4, 4);
}

constexpr Model wheelchair() {
  const Model model = in_millimetres("wheelchair-sh", "wheelchair", 0.00373);
  return with_bumpers(limited(shaped(model, 680, 1340, 550), 2000, 360), 4, 3);
}

// It is pushed: it has no motors, and so no limits.
constexpr Model mapper() {
  Model model = limited(shaped(in_millimetres("mappr", "MapperBot", 0.011), 0, 0, 180), 0, 0);
  model.velocity_unit = 0.6154 * kMillimetre;
  return model;
}

constexpr Model p3dx_sh(std::string_view subclass) {
  return dx(in_millimetres(subclass, "Pioneer 3-DX (SH)", 0.0056));
}

constexpr Model p3at_sh(std::string_view subclass) {
  return at(in_millimetres(subclass, "Pioneer 3-AT (SH)", 0.0034));
}

constexpr Model peoplebot_sh(std::string_view subclass) {
  return people(in_millimetres(subclass, "PeopleBot (SH)", 0.0060), 340, kPeopleBotShRing);
}

constexpr std::array kModels = {
    dx(scales("p2dx", "Pioneer 2-DX", 0.84, 0.268, 0.0056)),
    dx(scales("p2ce", "Pioneer 2-CE", 0.826, 0.268, 0.0057)),
    dx(scales("p2de", "Pioneer 2-DXe", 0.969, 0.268, 0.0056)),
    dx(scales("p2df", "Pioneer 2-DXf", 0.485, 0.268, 0.0060)),
    dx(scales("p2d8", "Pioneer 2-DX8", 0.485, 1.0, 0.0056)),
    dx(scales("p2d8+", "Pioneer 2-DX8 Plus", 0.485, 1.0, 0.0056)),
    at(scales("p2at", "Pioneer 2-AT", 1.32, 0.268, 0.0034)),
    at(scales("p2at8", "Pioneer 2-AT8", 1.32, 1.0, 0.0034)),
    at(scales("p2at8+", "Pioneer 2-AT8 Plus", 0.465, 1.0, 0.0034)),
    at(scales("p2it", "Pioneer 2-IT", 1.136, 0.268, 0.0032)),
    people(scales("p2pb", "PeopleBot", 0.424, 0.268, 0.0056), 300, kPeopleBotRing),
    people(scales("p2pp", "Performance PeopleBot (P2)", 0.485, 0.268, 0.0060), 300, kPeopleBotRing),
    people(scales("perfpb", "Performance PeopleBot", 0.485, 1.0, 0.0060), 340, kPerformanceRing),
    people(scales("perfpb+", "Performance PeopleBot Plus", 0.485, 1.0, 0.0060), 340, kPerformanceRing, 511),
    peoplebot_sh("peoplebot-sh"),
    peoplebot_sh("peoplebot-sh-lms1xx"),
    peoplebot_sh("peoplebot-sh-lms500"),
    dx(scales("p3dx", "Pioneer 3-DX", 0.485, 1.0, 0.0056)),
    p3dx_sh("p3dx-sh"),
    p3dx_sh("p3dx-sh-lms1xx"),
    p3dx_sh("p3dx-sh-lms500"),
    at(scales("p3at", "Pioneer 3-AT", 0.465, 1.0, 0.0034)),
    p3at_sh("p3at-sh"),
    p3at_sh("p3at-sh-lms1xx"),
    p3at_sh("p3at-sh-lms500"),
    at(in_millimetres("p3atiw-sh", "Pioneer 3-AT (SH, indoor wheels)", 0.0034), 490),
    amigo(),
    amigo_shaped(in_millimetres("amigo-sh", "AmigoBot (SH)", 0.011), kAmigoShRing),
    amigo_shaped(in_millimetres("amigo-sh-tim3xx", "AmigoBot (SH)", 0.011), kAmigoShRing),
    patrol(in_millimetres("patrolbot-sh", "PatrolBot", 0.0056)),
    patrol(in_millimetres("mt400", "MT400", 0.0056)),
    patrol(in_millimetres("researchPB", "Research PatrolBot", 0.0056)),
    patrol(in_millimetres("researchPB-lms500", "Research PatrolBot", 0.0056)),
    power(scales("powerbot", "PowerBot", 0.5813, 1.0, 0.00373)),
    power(in_millimetres("powerbot-sh", "PowerBot (SH)", 0.00373)),
    power(in_millimetres("powerbot-sh-lms500", "PowerBot (SH)", 0.00373)),
    power(in_millimetres("powerbot-sh-uarcs", "PowerBot (SH, uARCS)", 0.00373), kPowerRearRing),
    wheelchair(),
    seekur(),
    seekur_jr(),
    pioneer_lx("pioneer-lx", "Pioneer LX"),
    pioneer_lx("pioneer-lx-ld", "Pioneer LX (LD)"),
    mapper(),
    pioneer1("pion1m", "Pioneer 1"),
    pioneer1("pion1x", "Pioneer 1"),
    pioneer1("psos1m", "Pioneer 1 (PSOS)"),
    pioneer1("psos1x", "Pioneer 1 (PSOS)"),
    pioneer1("psos43m", "Pioneer 1 (PSOS 4.3)"),
    pioneer1("pionat", "Pioneer AT", 0.07, 330, 500),
};

constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

ModelChoice choose_model(std::string_view subclass) {
  const auto is_it = [&](const Model& model) {
    return std::ranges::equal(model.subclass, subclass, {}, lower, lower);
  };
  const auto found = std::ranges::find_if(kModels, is_it);
  return found == kModels.end() ? ModelChoice{kModels.front(), false} : ModelChoice{*found, true};
}

std::span<const Model> models() { return kModels; }

}  // namespace orca::hw::p2os
