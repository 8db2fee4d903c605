// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/emulators/xr4000_firmware.hpp"

#include <algorithm>
#include <cmath>

#include "orca/hw/framing/checksums.hpp"

namespace orca::emulators {
namespace {

using Bytes = std::span<const std::uint8_t>;
using hw::framing::Finding;

constexpr std::size_t kLongestXrFrame = 135;
constexpr Duration kHalfFrameTime = 500ms;
constexpr double kMillimetre = 0.001;
constexpr int kXrSpeeds[] = {1500, 1500, 500};
constexpr int kXrAccelerations[] = {1500, 1500, 5000};
constexpr int kStopAcceleration = 1000;
constexpr std::uint8_t kNotReady = 1 | 2 | 4;
constexpr std::size_t kX = 0;
constexpr std::size_t kY = 1;
constexpr std::size_t kRotation = 2;

enum XrType {
  kHello = 1,
  kGetState = 2,
  kSetAxes = 3,
  kResetMotionTimer = 4,
  kSetTimer = 5,
  kSetIntegrator = 6,
  kGetSonar = 7,
  kGetInfrared = 8,
  kGetBumper = 9,
  kGetBattery = 10
};

enum XrMode { kNone = 0, kVelocity = 4, kStopMode = 5 };

enum XrReturn {
  kOk = 0,
  kMissingArgument = -2,
  kInvalidArgument = -3,
  kNoSuchCommand = -4,
  kAxesNotReady = -10
};

// 58 52, length of the payload with its low byte first, type, payload, CRC of all behind 58 52 with its low byte first.
Finding find_xr_frame(Bytes bytes) {
  if (bytes[0] != 0x58 || (bytes.size() > 1 && bytes[1] != 0x52)) return {};
  if (bytes.size() < 5) return {Finding::Kind::need_more};
  const std::size_t length = bytes[2] + 256U * bytes[3];
  if (length > 128) return {};
  if (bytes.size() < length + 7) return {Finding::Kind::need_more};
  const unsigned crc = bytes[length + 5] + 256U * bytes[length + 6];
  if (hw::framing::crc_ccitt(bytes.subspan(2, length + 3)) != crc) return {Finding::Kind::bad_checksum};
  return {Finding::Kind::frame, length + 7};
}

int number_at(Bytes payload, std::size_t index) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) bits |= std::uint32_t{payload[index + i]} << (8 * i);
  return static_cast<std::int32_t>(bits);
}

void append(std::vector<std::uint8_t>& payload, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) payload.push_back(static_cast<std::uint8_t>((value >> (8 * i)) & 0xFF));
}

void append_thousandths(std::vector<std::uint8_t>& payload, double value) {
  append(payload, static_cast<std::uint32_t>(std::lround(value / kMillimetre) & 0xFFFFFFFF), 4);
}

// Returns how many bytes the payload of a request has at least.
std::size_t size_of_request(int type) {
  switch (type) {
    case kHello: return 1;
    case kSetAxes: return 27;
    case kSetTimer: return 4;
    case kSetIntegrator: return 12;
    default: return 0;
  }
}

}  // namespace

Xr4000Firmware::Xr4000Firmware(Body& body, const Xr4000Settings& settings)
    : body_(body),
      settings_(settings),
      scanner_({.look = find_xr_frame, .longest = kLongestXrFrame}),
      timeout_(settings.timeout) {}

void Xr4000Firmware::take(Bytes bytes, std::uint32_t baud, TimePoint now) {
  host_baud_ = baud;
  switch_on(now);
  if (now < *on_since_) return;                     // it is starting
  if (baud != 0 && baud != settings_.baud) return;  // it sees other bits, and no frame
  const auto take_frame = [&](const hw::framing::Frame& frame) { obey(frame.bytes, now); };
  if (now - last_byte_ > kHalfFrameTime) scanner_.give_up(take_frame);
  last_byte_ = now;
  scanner_.feed(bytes, take_frame);
}

void Xr4000Firmware::switch_on(TimePoint now) {
  if (!on_since_) on_since_ = moved_at_ = now;
}

void Xr4000Firmware::reset(TimePoint now) {
  go_limp();
  timeout_ = settings_.timeout;
  on_since_ = now + settings_.power_up;
  line_.clear();
  scanner_.give_up([](const hw::framing::Frame&) {});
  define({});
}

void Xr4000Firmware::obey(Bytes frame, TimePoint now) {
  const int type = frame[4];
  if (type >= 0x80) return;  // an answer: its own, sent back
  requests_.push_back(type);
  const Bytes payload = frame.subspan(5, frame.size() - 7);
  const int returned =
      payload.size() < size_of_request(type) ? kMissingArgument : carry_out(type, payload, now);
  std::vector<std::uint8_t> answer;
  append(answer, static_cast<std::uint32_t>(returned), 1);
  if (returned == kOk) add_readings(type, answer, now);
  send(0x80 | type, answer, now);
}

// Carries a request out. @return what the library returns.
int Xr4000Firmware::carry_out(int type, Bytes payload, TimePoint now) {
  if (type == kSetAxes) return set_axes(payload);
  if (type != kHello && failure_ != kOk) return failure_;
  if (type == kResetMotionTimer) fed_at_ = now;
  if (type == kSetTimer) {
    timeout_ = std::chrono::milliseconds(static_cast<std::uint32_t>(number_at(payload, 0)));
    fed_at_ = now;
  }
  if (type == kSetIntegrator)
    define({kMillimetre * number_at(payload, 4), -kMillimetre * number_at(payload, 0),
            wrapped(kMillimetre * number_at(payload, 8))});
  return type >= kHello && type <= kGetBattery ? kOk : kNoSuchCommand;
}

int Xr4000Firmware::set_axes(Bytes payload) {
  if ((status_ & kNotReady) != 0) return kAxesNotReady;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const int mode = payload[9 * i];
    if (mode != kNone && mode != kVelocity && mode != kStopMode) return kInvalidArgument;
  }
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const int mode = payload[9 * i];
    if (mode == kNone) continue;
    power_ = true;
    const bool stops = mode == kStopMode;
    const int acceleration = stops ? kStopAcceleration : number_at(payload, 9 * i + 5);
    axes_[i].wanted = stops ? 0.0 : std::clamp(number_at(payload, 9 * i + 1), -kXrSpeeds[i], kXrSpeeds[i]);
    axes_[i].acceleration = std::clamp(acceleration, 0, kXrAccelerations[i]);
  }
  return kOk;
}

void Xr4000Firmware::add_readings(int type, std::vector<std::uint8_t>& answer, TimePoint now) const {
  switch (type) {
    case kHello: append(answer, settings_.version, 1); return append(answer, settings_.robot_type, 1);
    case kGetState: return add_state(answer, now);
    case kGetSonar: return add_sonars(answer);
    case kGetInfrared: return answer.resize(answer.size() + 96);
    case kGetBumper: return add_bumpers(answer);
    case kGetBattery:
      for (const std::uint16_t channel : settings_.batteries) append(answer, channel, 2);
      return;
    default: return;
  }
}

void Xr4000Firmware::add_state(std::vector<std::uint8_t>& answer, TimePoint now) const {
  const Pose2 at = pose();
  const Twist2 velocity = body_.velocity();
  append(answer, status_, 1);
  append(answer, clock(now), 4);
  for (const double value : {-at.y, at.x, at.yaw}) append_thousandths(answer, value);
  for (const double value : {-velocity.left, velocity.forward, velocity.turn_rate})
    append_thousandths(answer, value);
}

// The sensor counts whole inches up to 299.
void Xr4000Firmware::add_sonars(std::vector<std::uint8_t>& answer) const {
  for (int i = 0; i < 48; ++i) {
    const std::optional<double> range = body_.sonar(i);
    const long inches = range && *range < 8.0 ? std::lround(*range / 0.0254) : 300;
    const long reading = inches < 300 ? std::lround(25.4 * static_cast<double>(inches)) : 0xFFFF;
    append(answer, static_cast<std::uint32_t>(reading), 2);
  }
}

// Sensor 0 of the front door is 52.5 degrees to the right, and the 24 of all doors go on to the left in steps of 15 degrees.
void Xr4000Firmware::add_bumpers(std::vector<std::uint8_t>& answer) const {
  const std::size_t begin = answer.size();
  answer.resize(begin + 60);
  for (int bit = 0; bit < settings_.bumper_count; ++bit) {
    if (((body_.bumpers() >> bit) & 1) == 0) continue;
    const double degrees = 360.0 * bit / settings_.bumper_count;
    const auto place = static_cast<std::size_t>(std::lround((degrees + 52.5) / 15.0)) % 24;
    answer[begin + 20 * (place / 8) + place % 8] = 1;
  }
}

std::vector<std::uint8_t> Xr4000Firmware::advance(TimePoint now) {
  switch_on(now);
  accelerate(now);
  watch(now);
  return line_.leave(now, host_baud_ == 0 || host_baud_ == settings_.baud);
}

void Xr4000Firmware::accelerate(TimePoint now) {
  const double time = to_seconds(now - moved_at_);
  moved_at_ = now;
  bool changes = false;
  for (Axis& axis : axes_) {
    const double step = axis.acceleration * time;
    const double next = axis.speed + std::clamp(axis.wanted - axis.speed, -step, step);
    changes = changes || next != axis.speed;
    axis.speed = next;
  }
  if (changes) drive();
}

void Xr4000Firmware::watch(TimePoint now) {
  if (!power_ || timeout_ <= Duration{0} || now - fed_at_ <= timeout_) return;
  ++limp_stops_;
  go_limp();
}

void Xr4000Firmware::set_status(std::uint8_t bits) {
  status_ = bits;
  if ((bits & kNotReady) != 0) go_limp();
}

void Xr4000Firmware::go_limp() {
  power_ = false;
  axes_ = {};
  drive();
}

void Xr4000Firmware::drive() {
  body_.drive({.forward = kMillimetre * axes_[kY].speed,
               .left = -kMillimetre * axes_[kX].speed,
               .turn_rate = kMillimetre * axes_[kRotation].speed});
}

void Xr4000Firmware::define(const Pose2& pose) {
  defined_ = pose;
  defined_at_ = body_.odometry();
}

Pose2 Xr4000Firmware::pose() const { return defined_ * seen_from(defined_at_, body_.odometry()); }

std::uint32_t Xr4000Firmware::clock(TimePoint now) const {
  return static_cast<std::uint32_t>((now - *on_since_) / Duration{1ms} & 0xFFFFFFFF);
}

void Xr4000Firmware::send(int type, const std::vector<std::uint8_t>& payload, TimePoint now) {
  std::vector<std::uint8_t> frame{0x58, 0x52};
  append(frame, static_cast<std::uint32_t>(payload.size()), 2);
  append(frame, static_cast<std::uint32_t>(type), 1);
  frame.insert(frame.end(), payload.begin(), payload.end());
  append(frame, hw::framing::crc_ccitt(Bytes(frame).subspan(2)), 2);
  line_.send(frame, host_baud_ == 0 ? 0.0 : 10.0 / settings_.baud, now);
}

}  // namespace orca::emulators
