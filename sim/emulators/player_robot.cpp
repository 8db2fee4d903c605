// SPDX-License-Identifier: LGPL-3.0-or-later
#include "player_robot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "player_wire.hpp"

namespace orca::emulators {
namespace {

constexpr double kNoEcho = 5.0;                            // [m] what a sonar without an echo tells
constexpr double kLobe = 25.0 * std::numbers::pi / 180.0;  // [rad] in which a sonar hears
constexpr double kTurns = 75.0;                            // [Hz] of the mirror

struct KnownMessage {
  std::uint32_t interface;
  std::uint32_t type;
  std::uint32_t subtype;
};

constexpr KnownMessage kKnownMessages[] = {
    {kPlayerPosition, kPlayerData, 1},    {kPlayerPosition, kPlayerCommand, 1},
    {kPlayerPosition, kPlayerRequest, 1}, {kPlayerPosition, kPlayerRequest, 2},
    {kPlayerPosition, kPlayerRequest, 5}, {kPlayerPosition, kPlayerRequest, 6},
    {kPlayerSonar, kPlayerData, 1},       {kPlayerSonar, kPlayerRequest, 1},
    {kPlayerSonar, kPlayerRequest, 2},    {kPlayerLaser, kPlayerData, 1},
    {kPlayerLaser, kPlayerRequest, 1},    {kPlayerLaser, kPlayerRequest, 2},
    {kPlayerLaser, kPlayerRequest, 3},    {kPlayerBumper, kPlayerData, 1},
    {kPlayerPower, kPlayerData, 1},       {kPlayerRanger, kPlayerData, 1},
    {kPlayerRanger, kPlayerRequest, 1},   {kPlayerRanger, kPlayerRequest, 5}};

// Of requests of the base, by their number.
constexpr std::size_t kRequestSizes[] = {0, 0, 4, 4, 4, 24, 0};

void write_pose(PlayerWriter& out, const Pose2& pose, double height) {
  out.real(pose.x).real(pose.y).real(height).real(0.0).real(0.0).real(pose.yaw);
}

std::vector<std::uint8_t> ranger_scan(const std::vector<double>& ranges) {
  PlayerWriter out;
  out.count(ranges.size());
  for (const double range : ranges) out.real(range);
  return out.bytes();
}

Pose2 sonar_at(int x_mm, int y_mm, int degrees) {
  return {0.001 * x_mm, 0.001 * y_mm, degrees * std::numbers::pi / 180.0};
}

// [rad] from the first beam to the last, and between two.
struct Sector {
  double from = 0.0;
  double to = 0.0;
  double step = 0.0;
};

// What one turn of a mirror sees, counter-clockwise.
Sector sector_of(const MirrorTurn& turn) {
  const double steps = static_cast<double>(std::max<std::size_t>(turn.ranges.size(), 1) - 1);
  const double last = turn.first_angle + turn.step * steps;
  return {std::min(turn.first_angle, last), std::max(turn.first_angle, last), std::abs(turn.step)};
}

}  // namespace

std::vector<Pose2> pioneer_sonars() {
  return {sonar_at(69, 136, 90),      sonar_at(114, 119, 50),    sonar_at(148, 78, 30),
          sonar_at(166, 27, 10),      sonar_at(166, -27, -10),   sonar_at(148, -78, -30),
          sonar_at(114, -119, -50),   sonar_at(69, -136, -90),   sonar_at(-157, -136, -90),
          sonar_at(-203, -119, -130), sonar_at(-237, -78, -150), sonar_at(-255, -27, -170),
          sonar_at(-255, 27, 170),    sonar_at(-237, 78, 150),   sonar_at(-203, 119, 130),
          sonar_at(-157, 136, 90)};
}

PlayerRobot::PlayerRobot(Body& body, const Mirror* mirror, PlayerSettings settings)
    : body_(body), mirror_(mirror), settings_(std::move(settings)) {}

void PlayerRobot::close(std::uint32_t device) {
  if (--users_[device] == 0 && device == kPlayerPosition) rest();
}

std::vector<std::uint32_t> PlayerRobot::devices() const {
  std::vector<std::uint32_t> all;
  for (const std::uint32_t device :
       {kPlayerPosition, kPlayerSonar, kPlayerBumper, kPlayerPower, kPlayerLaser})
    if (!settings_.missing.contains(device) && (device != kPlayerLaser || mirror_ != nullptr))
      all.push_back(device);
  return all;
}

PlayerAddress PlayerRobot::address_of(std::uint32_t device) const {
  if (!settings_.shows_rangers || (device != kPlayerSonar && device != kPlayerLaser)) return {device, 0};
  return {kPlayerRanger, device == kPlayerSonar ? 0U : 1U};
}

std::optional<std::uint32_t> PlayerRobot::device_at(const PlayerAddress& address) const {
  for (const std::uint32_t device : devices())
    if (address_of(device) == address) return device;
  return std::nullopt;
}

bool PlayerRobot::knows(std::uint32_t device, std::uint32_t type, std::uint32_t subtype) const {
  const std::uint32_t interface = address_of(device).interface;
  return std::ranges::any_of(kKnownMessages, [&](const KnownMessage& known) {
    return known.interface == interface && known.type == type && known.subtype == subtype;
  });
}

std::optional<PlayerRobot::Bytes> PlayerRobot::request(std::uint32_t device, std::uint32_t subtype,
                                                       std::span<const std::uint8_t> payload) {
  if (!knows(device, kPlayerRequest, subtype)) return std::nullopt;
  if (device == kPlayerPosition) return request_of_base(subtype, payload);
  if (settings_.shows_rangers) return subtype == 1 ? ranger_geometry(device) : ranger_configuration(device);
  if (device == kPlayerSonar) return subtype == 1 ? sonar_geometry() : Bytes{};
  return subtype == 1 ? laser_geometry() : laser_configuration();
}

std::optional<PlayerRobot::Bytes> PlayerRobot::request_of_base(std::uint32_t subtype,
                                                               std::span<const std::uint8_t> payload) {
  if (payload.size() != kRequestSizes[subtype]) return std::nullopt;
  PlayerWriter answer;
  switch (subtype) {
    case 1:
      write_pose(answer, {}, 0.0);
      answer.real(settings_.width).real(settings_.length).real(0.0);
      break;
    case 2:
      power_ = player_word(payload, 0) != 0;
      drive();
      break;
    case 5: {
      const Pose2 here{player_real(payload, 0), player_real(payload, 8), player_real(payload, 16)};
      if (!std::isfinite(here.x) || !std::isfinite(here.y) || !std::isfinite(here.yaw)) return std::nullopt;
      define(here);
      break;
    }
    default: define({}); break;
  }
  return answer.bytes();
}

bool PlayerRobot::command(std::uint32_t subtype, std::span<const std::uint8_t> payload) {
  constexpr std::uint32_t kVelocity = 1;
  if (subtype != kVelocity || payload.size() != 28) return false;
  const Twist2 velocity{player_real(payload, 0), 0.0, player_real(payload, 16)};
  if (!std::isfinite(velocity.forward) || !std::isfinite(velocity.turn_rate)) return false;
  wanted_ = velocity;
  may_turn_ = player_word(payload, 24) != 0;
  drive();
  return true;
}

void PlayerRobot::rest() {
  wanted_ = {};
  power_ = false;
  drive();
}

void PlayerRobot::drive() { body_.drive(power_ && may_turn_ ? wanted_ : Twist2{}); }

void PlayerRobot::define(const Pose2& pose) {
  defined_ = pose;
  defined_at_ = body_.odometry();
}

PlayerRobot::Bytes PlayerRobot::sonar_geometry() const {
  PlayerWriter out;
  out.count(settings_.sonars.size());
  for (const Pose2& pose : settings_.sonars) write_pose(out, pose, 0.24);
  return out.bytes();
}

PlayerRobot::Bytes PlayerRobot::laser_geometry() const {
  PlayerWriter out;
  write_pose(out, settings_.laser_pose, settings_.laser_height);
  out.real(0.155).real(0.155).real(0.21);
  return out.bytes();
}

// A server tells angles of the robot, however its laser hangs.
std::optional<MirrorTurn> PlayerRobot::last_turn() const {
  std::optional<MirrorTurn> turn = mirror_->last_turn();
  if (!turn || !turn->upside_down) return turn;
  turn->first_angle = -turn->first_angle;
  turn->step = -turn->step;
  return turn;
}

PlayerRobot::Bytes PlayerRobot::laser_configuration() const {
  const Sector seen = sector_of(last_turn().value_or(MirrorTurn{}));
  PlayerWriter out;
  out.single(seen.from).single(seen.to).single(seen.step);
  out.single(settings_.laser_range).single(0.001).word(0).single(kTurns);
  return out.bytes();
}

// Sonars are elements of a device in the robot's middle, and a laser is a device of one element.
PlayerRobot::Bytes PlayerRobot::ranger_geometry(std::uint32_t device) const {
  const bool is_laser = device == kPlayerLaser;
  const std::vector<Pose2> elements = is_laser ? std::vector<Pose2>{{}} : settings_.sonars;
  PlayerWriter out;
  write_pose(out, is_laser ? settings_.laser_pose : Pose2{}, is_laser ? settings_.laser_height : 0.24);
  out.real(settings_.width).real(settings_.length).real(0.0).count(elements.size());
  for (const Pose2& element : elements) write_pose(out, element, 0.0);
  out.count(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) out.real(0.0).real(0.0).real(0.0);
  return out.bytes();
}

// What Stage calls the resolution is the angle over the number of beams, not that from beam to beam.
PlayerRobot::Bytes PlayerRobot::ranger_configuration(std::uint32_t device) const {
  const bool is_laser = device == kPlayerLaser;
  const MirrorTurn turn = is_laser ? last_turn().value_or(MirrorTurn{}) : MirrorTurn{};
  const Sector seen = is_laser ? sector_of(turn) : Sector{-0.5 * kLobe, 0.5 * kLobe, kLobe};
  const double beams = static_cast<double>(std::max<std::size_t>(turn.ranges.size(), 1));
  PlayerWriter out;
  out.real(seen.from).real(seen.to).real((seen.to - seen.from) / beams);
  out.real(0.0).real(is_laser ? settings_.laser_range : kNoEcho).real(0.001);
  return out.real(is_laser ? kTurns : 1.0 / to_seconds(settings_.cycle)).bytes();
}

PlayerRobot::Bytes PlayerRobot::data(std::uint32_t device) const {
  switch (device) {
    case kPlayerPosition: return state();
    case kPlayerSonar: return sonar_ranges();
    case kPlayerBumper: return pressed();
    default: return battery();
  }
}

PlayerRobot::Bytes PlayerRobot::state() const {
  const Pose2 here = defined_ * seen_from(defined_at_, body_.odometry());
  const Twist2 velocity = body_.velocity();
  PlayerWriter out;
  out.real(here.x).real(here.y).real(here.yaw);
  out.real(velocity.forward).real(velocity.left).real(velocity.turn_rate);
  return out.word(body_.is_stalled() ? 1 : 0).bytes();
}

PlayerRobot::Bytes PlayerRobot::sonar_ranges() const {
  PlayerWriter out;
  out.count(settings_.sonars.size());
  for (int i = 0; i < static_cast<int>(settings_.sonars.size()); ++i) {
    const double range = body_.sonar(i).value_or(kNoEcho);
    settings_.shows_rangers ? out.real(range) : out.single(range);
  }
  return out.bytes();
}

PlayerRobot::Bytes PlayerRobot::pressed() const {
  const unsigned bits = body_.bumpers();
  Bytes list;
  for (unsigned i = 0; i < settings_.front_bumpers; ++i)
    list.push_back(static_cast<std::uint8_t>((bits >> i) & 1U));
  for (unsigned i = 0; i < settings_.rear_bumpers; ++i)
    list.push_back(static_cast<std::uint8_t>((bits >> (8 + i)) & 1U));
  return PlayerWriter().octets(list).bytes();
}

// Of all that it might tell, the voltage.
PlayerRobot::Bytes PlayerRobot::battery() const {
  PlayerWriter out;
  return out.word(1).single(settings_.voltage).single(0.0).single(0.0).single(0.0).word(0).bytes();
}

void PlayerRobot::look(TimePoint now) {
  const std::optional<MirrorTurn> turn = last_turn();
  if (!turn || turn->ranges.empty() || now < next_scan_ || scanned_ == turn->stamp) return;
  scanned_ = turn->stamp;
  next_scan_ = now + settings_.scan_period;
  std::vector<double> ranges;
  for (const double range : turn->ranges) ranges.push_back(std::min(range, settings_.laser_range));
  if (turn->step < 0.0) std::ranges::reverse(ranges);
  ++scans_;
  scan_ = settings_.shows_rangers ? ranger_scan(ranges) : laser_scan(*turn, ranges);
}

PlayerRobot::Bytes PlayerRobot::laser_scan(const MirrorTurn& turn, const std::vector<double>& ranges) const {
  const Sector seen = sector_of(turn);
  PlayerWriter out;
  out.single(seen.from).single(seen.to).single(seen.step).single(settings_.laser_range).count(ranges.size());
  for (const double range : ranges) out.single(range);
  return out.octets(Bytes(ranges.size())).word(scans_ - 1).bytes();
}

}  // namespace orca::emulators
