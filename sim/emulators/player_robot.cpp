// SPDX-License-Identifier: LGPL-3.0-or-later
#include "player_robot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "player_wire.hpp"

namespace orca::emulators {
namespace {

constexpr double kNoEcho = 5.0;  // [m] what a sonar without an echo tells

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
    {kPlayerPower, kPlayerData, 1}};

// Of requests of the base, by their number.
constexpr std::size_t kRequestSizes[] = {0, 0, 4, 4, 4, 24, 0};

void write_pose(PlayerWriter& out, const Pose2& pose, double height) {
  out.real(pose.x).real(pose.y).real(height).real(0.0).real(0.0).real(pose.yaw);
}

Pose2 sonar_at(int x_mm, int y_mm, int degrees) {
  return {0.001 * x_mm, 0.001 * y_mm, degrees * std::numbers::pi / 180.0};
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

void PlayerRobot::close(std::uint32_t interface) {
  if (--users_[interface] == 0 && interface == kPlayerPosition) rest();
}

std::vector<std::uint32_t> PlayerRobot::interfaces() const {
  std::vector<std::uint32_t> all;
  for (const std::uint32_t interface :
       {kPlayerPosition, kPlayerSonar, kPlayerBumper, kPlayerPower, kPlayerLaser})
    if (!settings_.missing.contains(interface) && (interface != kPlayerLaser || mirror_ != nullptr))
      all.push_back(interface);
  return all;
}

bool PlayerRobot::knows(std::uint32_t interface, std::uint32_t type, std::uint32_t subtype) {
  return std::ranges::any_of(kKnownMessages, [&](const KnownMessage& known) {
    return known.interface == interface && known.type == type && known.subtype == subtype;
  });
}

std::optional<PlayerRobot::Bytes> PlayerRobot::request(std::uint32_t interface, std::uint32_t subtype,
                                                       std::span<const std::uint8_t> payload) {
  if (!knows(interface, kPlayerRequest, subtype)) return std::nullopt;
  if (interface == kPlayerPosition) return request_of_base(subtype, payload);
  if (interface == kPlayerSonar) return subtype == 1 ? sonar_geometry() : Bytes{};
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

PlayerRobot::Bytes PlayerRobot::laser_configuration() const {
  const MirrorTurn turn = mirror_->last_turn().value_or(MirrorTurn{});
  const double last =
      turn.first_angle + turn.step * (static_cast<double>(std::max<std::size_t>(turn.ranges.size(), 1) - 1));
  PlayerWriter out;
  out.single(std::min(turn.first_angle, last)).single(std::max(turn.first_angle, last));
  out.single(std::abs(turn.step)).single(settings_.laser_range).single(0.001).word(0).single(75.0);
  return out.bytes();
}

PlayerRobot::Bytes PlayerRobot::data(std::uint32_t interface) const {
  switch (interface) {
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
  for (int i = 0; i < static_cast<int>(settings_.sonars.size()); ++i)
    out.single(body_.sonar(i).value_or(kNoEcho));
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
  const std::optional<MirrorTurn> turn = mirror_->last_turn();
  if (!turn || turn->ranges.empty() || now < next_scan_ || scanned_ == turn->stamp) return;
  scanned_ = turn->stamp;
  next_scan_ = now + settings_.scan_period;
  std::vector<double> ranges(turn->ranges.begin(), turn->ranges.end());
  const double last = turn->first_angle + turn->step * static_cast<double>(ranges.size() - 1);
  if (turn->step < 0.0) std::ranges::reverse(ranges);
  PlayerWriter out;
  out.single(std::min(turn->first_angle, last)).single(std::max(turn->first_angle, last));
  out.single(std::abs(turn->step)).single(settings_.laser_range).count(ranges.size());
  for (const double range : ranges) out.single(std::min(range, settings_.laser_range));
  out.octets(Bytes(ranges.size())).word(scans_++);
  scan_ = out.bytes();
}

}  // namespace orca::emulators
