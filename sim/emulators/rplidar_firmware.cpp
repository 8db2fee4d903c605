// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/emulators/rplidar_firmware.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "orca/emulators/firmware.hpp"

namespace orca::emulators {
namespace {

using hw::framing::Finding;

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr unsigned kStrength = 47;  // of an echo, up to 63
constexpr std::size_t kMostArguments = 16;
constexpr std::size_t kCapsuleSamples = 32;
constexpr Duration kLongestWait = 2ms;  // of points for the line

// What GET_LIDAR_CONF can ask for.
enum Entry : std::uint32_t {
  kModeCount = 0x70,
  kModeSampleTime = 0x71,   // [us/256]
  kModeMaxDistance = 0x74,  // [m/256]
  kModeAnswerType = 0x75,
  kTypicalMode = 0x7C,
  kModeName = 0x7F
};

struct ScanMode {
  const char* name;
  std::uint8_t answer;  // type of the scan's data
  int faster;           // than a standard scan
};
constexpr std::array kModes = {ScanMode{"Standard", 0x81, 1}, ScanMode{"Express", 0x82, 2}};

// The bytes of a number, the low one first.
std::vector<std::uint8_t> little_endian(std::uint32_t value, int bytes) {
  std::vector<std::uint8_t> all;
  for (int i = 0; i < bytes; ++i) all.push_back(static_cast<std::uint8_t>(value >> (8 * i) & 0xFFU));
  return all;
}

std::uint32_t number_at(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size && at + i < bytes.size(); ++i)
    value |= std::uint32_t{bytes[at + i]} << (8 * i);
  return value;
}

std::uint8_t exclusive_or(std::span<const std::uint8_t> bytes) {
  unsigned sum = 0;
  for (const std::uint8_t byte : bytes) sum ^= byte;
  return static_cast<std::uint8_t>(sum);
}

// Start A5 and the request; if that has bit 7: the number of bytes that follow, those bytes, and the exclusive or of all.
Finding find_request(std::span<const std::uint8_t> bytes) {
  if (bytes[0] != 0xA5) return {};
  if (bytes.size() < 2) return {Finding::Kind::need_more};
  if (bytes[1] == 0xA5) return {};
  if ((bytes[1] & 0x80) == 0) return {Finding::Kind::frame, 2};
  if (bytes.size() < 3) return {Finding::Kind::need_more};
  if (bytes[2] > kMostArguments) return {};
  const std::size_t size = bytes[2] + 4U;
  if (bytes.size() < size) return {Finding::Kind::need_more};
  const bool is_good = exclusive_or(bytes.first(size)) == 0;
  return is_good ? Finding{Finding::Kind::frame, size} : Finding{Finding::Kind::bad_checksum};
}

std::uint8_t low(unsigned value) { return static_cast<std::uint8_t>(value & 0xFF); }
std::uint8_t high(unsigned value) { return static_cast<std::uint8_t>(value >> 8 & 0xFF); }

// Firmware before 1.24 does not know the request.
bool knows_configuration(const RplidarSettings& settings) {
  const std::pair version{settings.firmware_major, settings.firmware_minor};
  return settings.has_express && version >= std::pair<std::uint8_t, std::uint8_t>{1, 24};
}

// Returns nothing for what it does not know.
std::vector<std::uint8_t> configuration(const RplidarSettings& settings, std::uint32_t entry,
                                        std::size_t number) {
  if (entry == kModeCount) return little_endian(kModes.size(), 2);
  if (entry == kTypicalMode) return little_endian(kModes.size() - 1, 2);
  if (number >= kModes.size()) return {};
  const ScanMode& mode = kModes[number];
  switch (entry) {
    case kModeSampleTime:
      return little_endian(static_cast<std::uint32_t>(settings.sample / mode.faster / 1us) * 256U, 4);
    case kModeMaxDistance: return little_endian(static_cast<std::uint32_t>(256.0 * settings.max_range), 4);
    case kModeAnswerType: return {mode.answer};
    case kModeName: {
      const std::string name = mode.name;
      return {name.c_str(), name.c_str() + name.size() + 1};
    }
    default: return {};
  }
}

}  // namespace

RplidarFirmware::RplidarFirmware(Mirror& mirror, RplidarSettings settings)
    : mirror_(mirror),
      settings_(std::move(settings)),
      scanner_({.look = find_request, .longest = kMostArguments + 4}) {}

void RplidarFirmware::reset(TimePoint now) {
  line_.clear();
  even_at_ = now + settings_.spin_up;
  switch_on(now);
}

void RplidarFirmware::switch_on(TimePoint now) {
  scanner_.give_up([](const hw::framing::Frame&) {});
  scan_ = Scan::none;
  ready_ = false;
  ready_at_ = now + settings_.boot;
}

void RplidarFirmware::power_motor(bool on, TimePoint now) {
  if (on && !motor_) even_at_ = now + settings_.spin_up;
  next_sample_ = std::max(next_sample_, even_at_);
  motor_ = on;
}

void RplidarFirmware::set_health(std::uint8_t state, std::uint16_t error) {
  health_ = state;
  error_ = error;
  if (state == 2) scan_ = Scan::none;
}

void RplidarFirmware::take(std::span<const std::uint8_t> bytes, std::uint32_t baud, TimePoint now) {
  host_baud_ = baud;
  if (!ready_ || (baud != 0 && baud != settings_.baud)) return;  // it sees other bits, and no request
  scanner_.feed(bytes, [&](const hw::framing::Frame& frame) { obey(frame.bytes, now); });
}

std::vector<std::uint8_t> RplidarFirmware::advance(TimePoint now) {
  if (!ready_at_) reset(now);
  if (!ready_ && now >= *ready_at_) {
    ready_ = true;
    say_who(*ready_at_);
  }
  if (scan_ != Scan::none) measure(now);
  return line_.leave(now, host_baud_ == 0 || host_baud_ == settings_.baud);
}

// The text after power-on, which is not part of the protocol.
void RplidarFirmware::say_who(TimePoint now) {
  const std::string text = "RP LIDAR System.\r\nFirmware Ver " + std::to_string(settings_.firmware_major) +
                           "." + std::to_string(settings_.firmware_minor) + ", HW Ver " +
                           std::to_string(settings_.hardware) + "\r\n";
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  send(bytes, now);
}

// Any request ends a scan.
void RplidarFirmware::obey(std::span<const std::uint8_t> request, TimePoint now) {
  note_command(requests_, request[1]);
  scan_ = Scan::none;
  switch (request[1]) {
    case 0x20: return begin_scan(Scan::nodes, true, now);
    case 0x21: return begin_scan(Scan::nodes, false, now);
    case 0x82:
      if (settings_.has_express) begin_scan(Scan::capsules, true, now);
      return;
    case 0x40: return restart(now);
    case 0x50: return answer_info(now);
    case 0x52: return answer_health(now);
    case 0x59:
      if (settings_.has_express) answer_sample_times(now);
      return;
    case 0x84:
      if (request.size() >= 8) answer_configuration(request.subspan(3, request.size() - 4), now);
      return;
    default: return;
  }
}

// The motor goes on.
void RplidarFirmware::restart(TimePoint now) {
  if (settings_.resets_heal) set_health(0, 0);
  switch_on(now);
}

void RplidarFirmware::answer_info(TimePoint now) {
  std::vector<std::uint8_t> info{settings_.model, settings_.firmware_minor, settings_.firmware_major,
                                 settings_.hardware};
  info.insert(info.end(), settings_.serial.begin(), settings_.serial.end());
  answer(0x04, info, now);
}

void RplidarFirmware::answer_health(TimePoint now) {
  answer(0x06, std::array<std::uint8_t, 3>{health_, low(error_), high(error_)}, now);
}

void RplidarFirmware::answer_sample_times(TimePoint now) {
  const auto time = static_cast<unsigned>(settings_.sample.count() / 1000);  // [us]
  answer(0x15, std::array<std::uint8_t, 4>{low(time), high(time), low(time / 2), high(time / 2)}, now);
}

// The answer repeats what was asked for. @param asked  the entry, and the number of a mode if the entry is of modes.
void RplidarFirmware::answer_configuration(std::span<const std::uint8_t> asked, TimePoint now) {
  const std::uint32_t entry = number_at(asked, 0, 4);
  const std::vector<std::uint8_t> value = configuration(settings_, entry, number_at(asked, 4, 2));
  if (!knows_configuration(settings_) || value.empty()) return;
  std::vector<std::uint8_t> data = little_endian(entry, 4);
  data.insert(data.end(), value.begin(), value.end());
  answer(0x20, data, now);
}

// A5 5A, the size of what follows, and its type.
void RplidarFirmware::answer(std::uint8_t type, std::span<const std::uint8_t> data, TimePoint now) {
  std::vector<std::uint8_t> bytes{0xA5, 0x5A, low(static_cast<unsigned>(data.size())), 0, 0, 0, type};
  bytes.insert(bytes.end(), data.begin(), data.end());
  send(bytes, now);
}

// What is announced has no end: 40 (hex) in the byte before the type.
void RplidarFirmware::begin_scan(Scan scan, bool waits_for_motor, TimePoint now) {
  constexpr std::array<std::uint8_t, 7> kNodes{0xA5, 0x5A, 0x05, 0x00, 0x00, 0x40, 0x81};
  constexpr std::array<std::uint8_t, 7> kCapsules{0xA5, 0x5A, 0x54, 0x00, 0x00, 0x40, 0x82};
  if (health_ == 2) return;
  send(scan == Scan::nodes ? kNodes : kCapsules, now);
  scan_ = scan;
  capsule_.clear();
  is_first_capsule_ = true;
  begins_turn_ = false;
  next_sample_ = waits_for_motor ? std::max(now, even_at_) : now;
}

Duration RplidarFirmware::sample_time() const {
  return scan_ == Scan::capsules ? settings_.sample / 2 : settings_.sample;
}

// Without a motor that turns there is nothing to measure.
void RplidarFirmware::measure(TimePoint now) {
  if (!motor_) {
    next_sample_ = std::max(now, next_sample_);
    return;
  }
  for (; now >= next_sample_; next_sample_ += sample_time()) measure_once(next_sample_);
}

void RplidarFirmware::measure_once(TimePoint now) {
  if (scan_ == Scan::capsules)
    add_to_capsule(now);
  else
    send_node(now);
  turn_by(sample_time());
}

void RplidarFirmware::turn_by(Duration time) {
  phase_ += time;
  if (phase_ < settings_.turn) return;
  phase_ -= settings_.turn;
  begins_turn_ = true;
  ++turns_;
}

// Returns the angle of the motor [1/64 deg], clockwise.
unsigned RplidarFirmware::angle() const {
  return static_cast<unsigned>(to_seconds(phase_) / to_seconds(settings_.turn) * 360.0 * 64.0);
}

// Returns the distance in the direction of the motor, in a part of a metre; 0: no echo.
unsigned RplidarFirmware::distance(double per_metre, unsigned most) const {
  const double range = range_at(-kTwoPi * to_seconds(phase_) / to_seconds(settings_.turn));
  if (!(range <= settings_.max_range)) return 0;
  return std::min(static_cast<unsigned>(std::lround(per_metre * range)), most);
}

// What the line cannot carry in time is left out.
void RplidarFirmware::send_node(TimePoint now) {
  if (line_.idle_at() > now + kLongestWait) return;
  const unsigned quarters = distance(4000.0, 0xFFFF);
  const unsigned start = std::exchange(begins_turn_, false) ? 1 : 2;  // the flag and its inverse
  const unsigned strength = quarters != 0 ? kStrength : 0;
  const unsigned word = angle() << 1 | 1;
  send(std::array<std::uint8_t, 5>{low(strength << 2 | start), low(word), high(word), low(quarters),
                                   high(quarters)},
       now);
}

void RplidarFirmware::add_to_capsule(TimePoint now) {
  if (capsule_.empty()) capsule_start_ = angle();
  capsule_.push_back(distance(1000.0, 0x3FFF));
  if (capsule_.size() < kCapsuleSamples) return;
  send_capsule(now);
  capsule_.clear();
}

// Two marks with the halves of a checksum, the first angle, and in 5 bytes two distances with corrections of their angles, which
// are 0 here.
void RplidarFirmware::send_capsule(TimePoint now) {
  if (line_.idle_at() > now + kLongestWait) return;
  const unsigned start = capsule_start_ | (std::exchange(is_first_capsule_, false) ? 0x8000U : 0U);
  std::vector<std::uint8_t> bytes{0, 0, low(start), high(start)};
  for (std::size_t i = 0; i < kCapsuleSamples; i += 2) {
    for (const unsigned sample : {capsule_[i], capsule_[i + 1]}) {
      bytes.push_back(low(sample << 2));
      bytes.push_back(high(sample << 2));
    }
    bytes.push_back(0);
  }
  const unsigned sum = exclusive_or(bytes);
  bytes[0] = low(0xA0U | (sum & 0x0FU));
  bytes[1] = low(0x50U | sum >> 4U);
  send(bytes, now);
}

// Returns what the mirror's nearest beam shows [m]; infinite: nothing. @param angle  [rad] from ahead to the left.
double RplidarFirmware::range_at(double angle) const {
  constexpr double kNothing = std::numeric_limits<double>::infinity();
  const std::optional<MirrorTurn> turn = mirror_.last_turn();
  if (!turn || turn->ranges.empty()) return kNothing;
  const double turned = (angle - turn->first_angle) / turn->step;
  const double whole = kTwoPi / std::abs(turn->step);  // beams of a whole turn
  const auto beam = static_cast<std::size_t>(std::llround(turned - whole * std::floor(turned / whole)));
  if (beam < turn->ranges.size()) return turn->ranges[beam];
  return static_cast<double>(beam) > whole - 0.5 ? turn->ranges.front() : kNothing;
}

}  // namespace orca::emulators
