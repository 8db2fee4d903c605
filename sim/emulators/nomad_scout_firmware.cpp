// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/emulators/nomad_scout_firmware.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "orca/emulators/firmware.hpp"
#include "orca/hw/framing/checksums.hpp"

namespace orca::emulators {
namespace {

using Bytes = std::span<const std::uint8_t>;
using hw::framing::Finding;

constexpr std::size_t kLongestScoutPacket = 258;
constexpr Duration kHalfPacketTime = 500ms;
constexpr double kTenthOfInch = 0.00254;
constexpr double kTenthOfDegree = std::numbers::pi / 1800.0;
constexpr std::uint8_t kNothingHeard = 255;
constexpr std::size_t kRight = 0;
constexpr std::size_t kLeft = 1;

enum ScoutType {
  kAc = 1,
  kSp = 2,
  kPr = 3,
  kVm = 5,
  kGs = 7,
  kNak = 8,
  kSt = 9,
  kLp = 10,
  kDp = 12,
  kZr = 13,
  kConfSn = 15,
  kConfTm = 18,
  kGetSn = 20,
  kGetRc = 21,
  kGetRv = 22,
  kGetRa = 23,
  kGetBp = 27,
  kDa = 30,
  kWs = 31,
  kConfSer = 35,
  kMv = 43,
  kSpecial = 128
};

// 01, length (type, payload, sum) with its low byte first, type, payload, sum of all before, 5C.
Finding find_scout_packet(Bytes bytes) {
  if (bytes[0] != 0x01) return {};
  if (bytes.size() < 3) return {Finding::Kind::need_more};
  const std::size_t length = bytes[1] + 256U * bytes[2];
  if (length < 2 || length + 4 > kLongestScoutPacket) return {};
  if (bytes.size() < length + 4) return {Finding::Kind::need_more};
  if (bytes[length + 3] != 0x5C) return {};
  if (hw::framing::sum_of_bytes(bytes.first(length + 2)) != bytes[length + 2])
    return {Finding::Kind::bad_checksum};
  return {Finding::Kind::frame, length + 4};
}

int unsigned_at(Bytes payload, std::size_t index) { return payload[index] + 256 * payload[index + 1]; }

// Negative numbers have their highest bit set, and their magnitude in the others.
int signed_at(Bytes payload, std::size_t index) {
  const int bits = unsigned_at(payload, index);
  return bits < 0x8000 ? bits : 0x8000 - bits;
}

void add_number(std::vector<std::uint8_t>& payload, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) payload.push_back(static_cast<std::uint8_t>((value >> (8 * i)) & 0xFF));
}

// Its counters have 16 bits, so they come back to the other end.
void add_signed(std::vector<std::uint8_t>& payload, double value) {
  const auto counter = static_cast<std::int16_t>(std::lround(value) & 0xFFFF);
  const auto magnitude = static_cast<std::uint32_t>(std::min(std::abs(int{counter}), 0x7FFF));
  add_number(payload, counter < 0 ? 0x8000 + magnitude : magnitude, 2);
}

// Returns how many bytes the payload of a command has at least.
std::size_t payload_of(int type) {
  switch (type) {
    case kAc:
    case kSp:
    case kPr:
    case kVm: return 6;
    case kDp:
    case kDa:
    case kWs: return 4;
    case kConfSn: return 17;
    case kConfTm: return 1;
    case kConfSer: return 3;
    case kMv: return 12;
    default: return 0;
  }
}

}  // namespace

NomadScoutFirmware::NomadScoutFirmware(Body& body, NomadScoutSettings settings)
    : body_(body),
      settings_(settings),
      scanner_({.look = find_scout_packet, .longest = kLongestScoutPacket}),
      watchdog_(settings.watchdog) {
  sonars_.fill(kNothingHeard);
}

void NomadScoutFirmware::take(Bytes bytes, std::uint32_t baud, TimePoint now) {
  host_baud_ = baud;
  switch_on(now);
  if (now < *on_since_) return;                     // it is starting
  if (baud != 0 && baud != settings_.baud) return;  // it sees other bits, and no packet
  const auto take_packet = [&](const hw::framing::Frame& frame) { obey(frame.bytes, now); };
  if (now - last_byte_ > kHalfPacketTime) scanner_.give_up(take_packet);
  last_byte_ = now;
  scanner_.feed(bytes, take_packet);
}

void NomadScoutFirmware::switch_on(TimePoint now) {
  if (!on_since_) on_since_ = now;
}

void NomadScoutFirmware::reset(TimePoint now) {
  restart();
  on_since_ = now + settings_.power_up;
  line_.clear();
  scanner_.give_up([](const hw::framing::Frame&) {});
}

void NomadScoutFirmware::restart() {
  stop();
  power_ = fed_ = false;
  watchdog_ = settings_.watchdog;
  sonar_interval_ = Duration{0};
  sonars_.fill(kNothingHeard);
  wheels_ = {};
  promises_.clear();
  define({});
}

void NomadScoutFirmware::obey(Bytes packet, TimePoint now) {
  last_command_ = now;
  fed_ = true;
  const int type = packet[3];
  note_command(commands_, type);
  const Bytes payload = packet.subspan(4, packet.size() - 6);
  if (payload.size() < payload_of(type)) return send(kNak, {}, now);
  if (carry_out(type, payload, now) || set(type, payload, now)) return send(type, state(now), now);
  if (give_group(type, now)) return;
  if (type == kWs) {
    promises_.push_back({type, now + std::chrono::seconds(payload[3]), {payload[0] != 0, payload[1] != 0}});
  } else if (type == kZr) {
    restart();
    on_since_ = now;
    promises_.push_back({type, now + settings_.zeroing});
  } else {
    send(kNak, {}, now);
  }
}

// Carries out a command to move. @return whether it is one.
bool NomadScoutFirmware::carry_out(int type, Bytes payload, TimePoint now) {
  if (type == kVm || type == kPr) {
    const int mode = type == kVm ? 1 : 2;
    set_axis(kRight, mode, signed_at(payload, 0), now);
    set_axis(kLeft, mode, signed_at(payload, 2), now);
  } else if (type == kMv) {
    for (const std::size_t axis : {kRight, kLeft})
      set_axis(axis, unsigned_at(payload, 4 * axis), signed_at(payload, 4 * axis + 2), now);
  } else if (type == kSt) {
    power_ = true;
    stop();
  } else if (type == kLp) {
    stop();
    power_ = false;
  } else {
    return false;
  }
  drive();
  return true;
}

// Torques and absolute positions are not known here, and change nothing.
void NomadScoutFirmware::set_axis(std::size_t axis, int mode, int value, TimePoint now) {
  Wheel& wheel = wheels_[axis];
  if (mode == 1 || mode == 2) power_ = true;
  if (mode == 1) {
    wheel.speed = kTenthOfInch * value;
    wheel.until = kForever;
  }
  if (mode == 2) move_by(wheel, kTenthOfInch * value, now);
  if (mode == 3) wheel.speed = 0.0;
  if (mode == 4) wheel.acceleration = kTenthOfInch * std::abs(value);
  if (mode == 5) wheel.move_speed = kTenthOfInch * std::abs(value);
}

void NomadScoutFirmware::move_by(Wheel& wheel, double distance, TimePoint now) {
  const double time = wheel.move_speed > 0.0 ? std::abs(distance) / wheel.move_speed : 0.0;
  wheel.speed = time > 0.0 ? std::copysign(wheel.move_speed, distance) : 0.0;
  wheel.until = saturating_add(now, Duration(std::llround(1e9 * time)));
}

// Takes a setting. @return whether it is one, or asks for the state only.
bool NomadScoutFirmware::set(int type, Bytes payload, TimePoint now) {
  switch (type) {
    case kGs:
    case kConfSer: return true;
    case kAc:
      for (const std::size_t axis : {kRight, kLeft}) set_axis(axis, 4, unsigned_at(payload, 2 * axis), now);
      return true;
    case kSp:
      for (const std::size_t axis : {kRight, kLeft}) set_axis(axis, 5, unsigned_at(payload, 2 * axis), now);
      return true;
    case kDp:
      define({kTenthOfInch * signed_at(payload, 0), kTenthOfInch * signed_at(payload, 2), pose().yaw});
      return true;
    case kDa: define({pose().x, pose().y, kTenthOfDegree * signed_at(payload, 0)}); return true;
    case kConfTm: watchdog_ = std::chrono::seconds(payload[0]); return true;
    case kConfSn: set_sonars(payload, now); return true;
    default: return false;
  }
}

void NomadScoutFirmware::set_sonars(Bytes payload, TimePoint now) {
  sonar_interval_ = std::chrono::milliseconds(4 * payload[0]);
  sonar_order_.clear();
  for (const std::uint8_t number : payload.subspan(1, 16)) {
    if (number == 255) break;
    if (number < sonars_.size()) sonar_order_.push_back(number);
  }
  next_sonar_ = 0;
  next_firing_ = now + sonar_interval_;
}

bool NomadScoutFirmware::give_group(int type, TimePoint now) {
  const std::vector<std::uint8_t> all = state(now);
  const auto part = [&](std::ptrdiff_t from, std::ptrdiff_t to) {
    return std::vector<std::uint8_t>(all.begin() + from, all.begin() + to);
  };
  std::vector<std::uint8_t> answer;
  switch (type) {
    case kGetSn: answer = part(0, 16); break;
    case kGetRc: send(type, part(19, 27), now); return true;
    case kGetRv: send(type, part(27, 33), now); return true;
    case kGetBp: answer = part(16, 19); break;
    case kGetRa:
      for (const Wheel& wheel : wheels_) add_signed(answer, wheel.acceleration / kTenthOfInch);
      add_number(answer, 0, 2);
      send(type, answer, now);
      return true;
    case kSpecial: send(type, {0, 0}, now); return true;  // no program of the user is there
    default: return false;
  }
  add_number(answer, clock(now), 4);
  send(type, answer, now);
  return true;
}

void NomadScoutFirmware::stop() {
  for (Wheel& wheel : wheels_) wheel.speed = 0.0;
  drive();
}

void NomadScoutFirmware::drive() {
  const double right = power_ ? wheels_[kRight].speed : 0.0;
  const double left = power_ ? wheels_[kLeft].speed : 0.0;
  body_.drive({.forward = 0.5 * (right + left), .turn_rate = (right - left) / settings_.track});
}

std::vector<std::uint8_t> NomadScoutFirmware::advance(TimePoint now) {
  switch_on(now);
  if (now < *on_since_) return {};
  end_moves(now);
  watch(now);
  fire(now);
  keep_promises(now);
  return line_.leave(now, host_baud_ == 0 || host_baud_ == settings_.baud);
}

void NomadScoutFirmware::end_moves(TimePoint now) {
  for (Wheel& wheel : wheels_) {
    if (wheel.speed == 0.0 || now < wheel.until) continue;
    wheel.speed = 0.0;
    drive();
  }
}

void NomadScoutFirmware::watch(TimePoint now) {
  if (watchdog_ == Duration{0} || !fed_ || now - last_command_ <= watchdog_) return;
  fed_ = false;
  if (wheels_[kRight].speed != 0.0 || wheels_[kLeft].speed != 0.0) ++watchdog_stops_;
  stop();
}

void NomadScoutFirmware::fire(TimePoint now) {
  for (; fires_sonars() && now >= next_firing_; next_firing_ += sonar_interval_) {
    const std::uint8_t number = sonar_order_[next_sonar_];
    const std::optional<double> range = body_.sonar(number);
    sonars_[number] =
        range ? static_cast<std::uint8_t>(std::clamp(std::lround(*range / 0.0254), 1L, 255L)) : kNothingHeard;
    next_sonar_ = (next_sonar_ + 1) % sonar_order_.size();
  }
}

void NomadScoutFirmware::keep_promises(TimePoint now) {
  const auto is_due = [&](const Promise& promise) {
    const auto stands = [&](std::size_t i) { return !promise.stopped[i] || wheels_[i].speed == 0.0; };
    const bool waits_for_wheels = promise.stopped[kRight] || promise.stopped[kLeft];
    return now >= promise.until || (waits_for_wheels && stands(kRight) && stands(kLeft));
  };
  for (const Promise& promise : promises_)
    if (is_due(promise)) send(promise.type, state(now), now);
  std::erase_if(promises_, is_due);
}

void NomadScoutFirmware::define(const Pose2& pose) {
  defined_ = pose;
  defined_at_ = body_.odometry();
}

Pose2 NomadScoutFirmware::pose() const { return defined_ * seen_from(defined_at_, body_.odometry()); }

std::uint32_t NomadScoutFirmware::clock(TimePoint now) const {
  return static_cast<std::uint32_t>(std::max(now - *on_since_, Duration{0}) / 1ms);
}

std::vector<std::uint8_t> NomadScoutFirmware::state(TimePoint now) const {
  std::vector<std::uint8_t> payload(sonars_.begin(), sonars_.end());
  add_number(payload, body_.bumpers(), 3);
  const Pose2 at = pose();
  add_signed(payload, at.x / kTenthOfInch);
  add_signed(payload, at.y / kTenthOfInch);
  const long heading = std::lround(at.yaw / kTenthOfDegree);
  add_number(payload, static_cast<std::uint32_t>((heading + 3600) % 3600), 2);
  add_number(payload, 0, 2);  // no turret
  const Twist2 velocity = body_.velocity();
  const double turning = 0.5 * settings_.track * velocity.turn_rate;
  add_signed(payload, (velocity.forward + turning) / kTenthOfInch);
  add_signed(payload, (velocity.forward - turning) / kTenthOfInch);
  add_number(payload, 0, 4);  // no turret, no compass
  payload.push_back(
      static_cast<std::uint8_t>((velocity.forward != 0.0 ? 1 : 0) | (velocity.turn_rate != 0.0 ? 2 : 0)));
  add_number(payload, clock(now), 4);
  payload.push_back(settings_.processor);
  payload.push_back(settings_.motors);
  return payload;
}

void NomadScoutFirmware::send(int type, const std::vector<std::uint8_t>& payload, TimePoint now) {
  std::vector<std::uint8_t> packet{0x01};
  add_number(packet, static_cast<std::uint32_t>(payload.size() + 2), 2);
  packet.push_back(static_cast<std::uint8_t>(type));
  packet.insert(packet.end(), payload.begin(), payload.end());
  packet.push_back(hw::framing::sum_of_bytes(packet));
  packet.push_back(0x5C);
  line_.send(packet, host_baud_ == 0 ? 0.0 : 10.0 / settings_.baud, now);
}

}  // namespace orca::emulators
