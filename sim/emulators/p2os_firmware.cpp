// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/emulators/p2os_firmware.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>

#include "orca/emulators/firmware.hpp"
#include "orca/hw/framing/checksums.hpp"
#include "p2os_gripper.hpp"
#include "p2os_servo.hpp"

namespace orca::emulators {
namespace {

using Bytes = std::span<const std::uint8_t>;
using hw::framing::Finding;

constexpr std::size_t kLongest = 258;
constexpr double kTurnDegree = std::numbers::pi / 180.0;
constexpr int kSonarsEachTime = 8;  // two groups fire in a cycle
constexpr std::uint8_t kSyncLost = 0xFF;

enum Number {
  kPulse = 0,
  kOpen = 1,
  kClose = 2,
  kEnable = 4,
  kSetv = 6,
  kSeto = 7,
  kMove = 8,
  kRotate = 9,
  kSetrv = 10,
  kVel = 11,
  kHead = 12,
  kDhead = 13,
  kConfig = 18,
  kRvel = 21,
  kSonar = 28,
  kStop = 29,
  kVel2 = 32,
  kBumpstall = 44,
  kHostbaud = 50,
  kEstop = 55,
  kReset = 253
};

// Header FA FB, number of bytes that follow, body, checksum with its high byte first.
Finding find_packet(Bytes bytes) {
  if (bytes[0] != 0xFA) return {};
  if (bytes.size() < 3) return {Finding::Kind::need_more};
  const std::size_t follow = bytes[2];
  if (bytes[1] != 0xFB || follow < 3) return {};
  if (bytes.size() < follow + 3) return {Finding::Kind::need_more};
  const Bytes body = bytes.subspan(3, follow - 2);
  const unsigned sum = bytes[follow + 1] * 256U + bytes[follow + 2];
  if (hw::framing::sum_of_words(body) != sum) return {Finding::Kind::bad_checksum};
  return {Finding::Kind::frame, follow + 3};
}

// The argument of a command. Negative numbers come as their magnitude. What is missing is 0.
int argument_of(Bytes body) {
  if (body.size() < 4) return 0;
  const int magnitude = body[2] + 256 * body[3];
  return body[1] == 0x1B ? -magnitude : magnitude;
}

void add_word(std::vector<std::uint8_t>& body, long value) {
  body.push_back(static_cast<std::uint8_t>(value & 0xFF));
  body.push_back(static_cast<std::uint8_t>((value >> 8) & 0xFF));
}

void add_text(std::vector<std::uint8_t>& body, const std::string& text) {
  body.insert(body.end(), text.begin(), text.end());
  body.push_back(0);
}

struct Scale {
  const char* subclass;
  double distance_unit;
  double range_unit;
  double half_track;
  int sonars;
};

constexpr Scale kScales[] = {
    {"p2dx", 0.00084, 0.000268, 1.0 / 5.6, 16},  {"p2de", 0.000969, 0.000268, 1.0 / 5.6, 16},
    {"p2pb", 0.000424, 0.000268, 1.0 / 5.6, 24}, {"p3dx", 0.000485, 0.001, 1.0 / 5.6, 16},
    {"p3at", 0.000465, 0.001, 1.0 / 3.4, 16},    {"p3dx-sh", 0.001, 0.001, 1.0 / 5.6, 16}};

constexpr std::uint8_t kType = 0x20;

class Fields {
 public:
  Fields& text(const std::string& value) {
    bytes.insert(bytes.end(), value.begin(), value.end());
    return byte(0);
  }
  Fields& byte(unsigned value) {
    bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
    return *this;
  }
  Fields& word(unsigned value) { return byte(value).byte(value >> 8); }
  Fields& words(std::initializer_list<unsigned> values) {
    for (const unsigned value : values) word(value);
    return *this;
  }
  std::vector<std::uint8_t> bytes{kType};
};

unsigned milliseconds(Duration time) {
  return static_cast<unsigned>(std::chrono::duration_cast<std::chrono::milliseconds>(time).count());
}

unsigned code_of(std::uint32_t baud) {
  constexpr std::uint32_t kRates[] = {9600, 19200, 38400, 57600, 115200};
  unsigned code = 0;
  for (unsigned i = 0; i < 5; ++i)
    if (kRates[i] == baud) code = i;
  return code;
}

// Of what a robot in the simulator does not have, gains and limits of motor power, it says 0.
std::vector<std::uint8_t> p2os_config(const P2osSettings& settings, unsigned gripper) {
  const bool has_rear = settings.sonars > 8;
  Fields fields;
  fields.text(settings.robot_class).text(settings.subclass).text("ORCA");
  fields.byte(0).words({500, 2200, 300, 2000, 500});  // tops: deg/s, mm/s, deg/s2, mm/s2; PWM
  fields.text(settings.name).byte(milliseconds(settings.cycle)).byte(code_of(settings.baud)).byte(0);
  fields.word(gripper).word(1).byte(has_rear ? 1 : 0);             // gripper, front and rear sonars
  fields.word(110).word(0).word(milliseconds(settings.watchdog));  // low battery 11 V, RevCount
  fields.byte(0).words({0, 0, 0, 0});           // two SIPs; stall value and count; joystick
  fields.words({100, 400, 100, 100, 0, 0, 0});  // turning: deg/s, mm/s, deg/s2 twice; gains
  fields.words({300, 300, 0, 0, 0});            // driving: mm/s2 twice; gains
  fields.byte(settings.front_bumpers)
      .byte(settings.rear_bumpers)
      .byte(0)
      .byte(40)
      .byte(settings.resets_baud ? 2 : 0);
  fields.byte(0).word(0).byte(0).byte(0).word(0).word(0);  // gyro, drift, aux rates, ticks, shutdown
  return fields.text("1.0").bytes;
}

}  // namespace

std::optional<P2osSettings> p2os_settings(std::string_view subclass) {
  for (const Scale& scale : kScales)
    if (scale.subclass == subclass) {
      P2osSettings settings;
      settings.subclass = subclass;
      settings.distance_unit = scale.distance_unit;
      settings.range_unit = scale.range_unit;
      settings.half_track = scale.half_track;
      settings.sonars = scale.sonars;
      return settings;
    }
  return std::nullopt;
}

std::vector<std::string> p2os_subclasses() {
  std::vector<std::string> names;
  for (const Scale& scale : kScales) names.emplace_back(scale.subclass);
  return names;
}

P2osFirmware::P2osFirmware(Body& body, P2osSettings settings)
    : body_(body),
      settings_(std::move(settings)),
      scanner_({.look = find_packet, .longest = kLongest}),
      baud_(settings_.baud),
      servo_(std::make_unique<P2osServo>()),
      gripper_(std::make_unique<P2osGripper>(body)) {}

P2osFirmware::~P2osFirmware() = default;

void P2osFirmware::take(Bytes bytes, std::uint32_t baud, TimePoint now) {
  host_baud_ = baud;
  if (baud != 0 && baud != baud_) return;  // it sees other bits, and no packet
  scanner_.feed(bytes, [&](const hw::framing::Frame& frame) {
    obey(frame.bytes.subspan(3, frame.bytes.size() - 5), now);
  });
}

void P2osFirmware::obey(Bytes body, TimePoint now) {
  last_command_ = now;
  fed_ = true;
  const int number = body[0];
  if (!open_) return shake_hands(number, now);
  note_command(commands_, number);
  const int value = argument_of(body);
  if (!gripper_->take(number, value, now)) carry_out(number, value, now);
}

// SYNC0, SYNC1, SYNC2 are sent back, the last one with the names of the robot; then OPEN, which is 1 like SYNC1.
void P2osFirmware::shake_hands(int number, TimePoint now) {
  if (syncs_ == 3 && number == kOpen) {
    open_ = true;
    next_information_ = now + settings_.cycle;
    return;
  }
  if (number == 0) syncs_ = 0;
  if (number != syncs_ || number > 2) {
    syncs_ = 0;
    return send({kSyncLost}, now);
  }
  ++syncs_;
  std::vector<std::uint8_t> answer{static_cast<std::uint8_t>(number)};
  if (number == 2)
    for (const std::string* const text : {&settings_.name, &settings_.robot_class, &settings_.subclass})
      add_text(answer, *text);
  send(std::move(answer), now);
}

void P2osFirmware::carry_out(int number, int value, TimePoint now) {
  if (set_motion(number, value)) return drive();
  switch (number) {
    case kClose: return close();
    case kEnable: power_ = value != 0 && !button_; return drive();
    case kSetv: return servo_->set_speed(0.001 * std::abs(value));
    case kSetrv: return servo_->set_turn_rate(kTurnDegree * std::abs(value));
    case kSeto: origin_ = body_.odometry(); return;
    case kConfig: return tell_settings(now);
    case kSonar: return switch_sonar(value);
    case kStop:
    case kEstop: return stop();
    case kBumpstall: bumpers_stall_ = value; return;
    case kHostbaud: return set_baud(value);
    case kReset: return restart();
    default: return;
  }
}

// Returns whether it was a command to move.
bool P2osFirmware::set_motion(int number, int value) {
  switch (number) {
    case kMove: servo_->move(0.001 * value, body_.odometry()); return true;
    case kHead: servo_->turn_to(kTurnDegree * value + origin_.yaw); return true;
    case kDhead: servo_->turn_to(kTurnDegree * value + body_.odometry().yaw); return true;
    case kVel: servo_->drive(0.001 * value); return true;
    case kRotate:
    case kRvel: servo_->turn(kTurnDegree * value); return true;
    case kVel2: set_wheels(value); return true;
    default: return false;
  }
}

// The low byte is the right wheel's.
void P2osFirmware::set_wheels(int value) {
  const double right = 0.02 * static_cast<std::int8_t>(value & 0xFF);
  const double left = 0.02 * static_cast<std::int8_t>((value >> 8) & 0xFF);
  servo_->drive(0.5 * (left + right));
  servo_->turn(0.5 * (right - left) / settings_.half_track);
}

void P2osFirmware::switch_sonar(int value) { sonar_ = value != 0 && settings_.has_sonar_power; }

void P2osFirmware::set_baud(int code) {
  constexpr std::uint32_t kRates[] = {9600, 19200, 38400, 57600, 115200};
  if (code >= 0 && code < 5 && kRates[code] <= settings_.fastest) baud_ = kRates[code];
}

void P2osFirmware::stop() {
  servo_->stop();
  drive();
}

Twist2 P2osFirmware::wanted() { return servo_->velocity(body_.odometry()); }

void P2osFirmware::drive() { body_.drive(power_ ? wanted() : Twist2{}); }

void P2osFirmware::tell_settings(TimePoint now) {
  if (settings_.tells_settings) send(p2os_config(settings_, gripper_->kind()), now);
}

void P2osFirmware::close() {
  stop();
  gripper_->forget_host();
  power_ = sonar_ = open_ = false;
  syncs_ = 0;
  if (settings_.resets_baud) baud_ = settings_.baud;
}

void P2osFirmware::reset(TimePoint) { restart(); }

void P2osFirmware::restart() {
  close();
  baud_ = settings_.baud;
  bumpers_stall_ = 0;
  origin_ = body_.odometry();
  line_.clear();
}

void P2osFirmware::press_button(bool pressed) {
  button_ = pressed;
  if (pressed) power_ = false;
  gripper_->lock(pressed);
  drive();
}

void P2osFirmware::cut_power() {
  power_ = false;
  drive();
}

std::vector<std::uint8_t> P2osFirmware::advance(TimePoint now) {
  if (fed_ && now - last_command_ > settings_.watchdog) {
    fed_ = false;
    if (!(wanted() == Twist2{})) ++watchdog_stops_;
    stop();
    gripper_->halt();
  }
  gripper_->advance(now);
  if (servo_->has_goal()) drive();
  for (; open_ && now >= next_information_; next_information_ += settings_.cycle) {
    send_information(next_information_);
    if (auto packet = gripper_->take_packet()) send(std::move(*packet), next_information_);
  }
  return line_.leave(now, host_baud_ == 0 || host_baud_ == baud_);
}

void P2osFirmware::send(std::vector<std::uint8_t> body, TimePoint now) {
  const unsigned sum = hw::framing::sum_of_words(body);
  std::vector<std::uint8_t> packet{0xFA, 0xFB, static_cast<std::uint8_t>(body.size() + 2)};
  packet.insert(packet.end(), body.begin(), body.end());
  packet.push_back(static_cast<std::uint8_t>(sum >> 8));
  packet.push_back(static_cast<std::uint8_t>(sum & 0xFF));
  line_.send(packet, byte_time(), now);
}

// Where it is, in the frame in which its odometry was set to 0.
Pose2 P2osFirmware::pose() const { return seen_from(origin_, body_.odometry()); }

bool P2osFirmware::is_stalled() const {
  const unsigned bumpers = body_.bumpers();
  const bool front = (bumpers_stall_ & 1) != 0 && (bumpers & 0x7F) != 0;
  const bool rear = (bumpers_stall_ & 2) != 0 && ((bumpers >> 8) & 0x7F) != 0;
  return body_.is_stalled() || front || rear;
}

void P2osFirmware::send_information(TimePoint now) {
  const Pose2 here = pose();
  const Twist2 velocity = body_.velocity();
  const double turning = velocity.turn_rate * settings_.half_track;
  const bool moves = !(velocity == Twist2{});
  std::vector<std::uint8_t> body{static_cast<std::uint8_t>(moves ? 0x33 : 0x32)};
  add_word(body, std::lround(here.x / settings_.distance_unit) & 0x7FFF);
  add_word(body, std::lround(here.y / settings_.distance_unit) & 0x7FFF);
  add_word(body, std::lround(here.yaw * 4096.0 / (2.0 * std::numbers::pi)));
  add_word(body, std::lround(1000.0 * (velocity.forward - turning)));
  add_word(body, std::lround(1000.0 * (velocity.forward + turning)));
  body.push_back(
      static_cast<std::uint8_t>(std::lround(10.0 * body_.battery_voltage().value_or(settings_.voltage))));
  const unsigned stall = is_stalled() ? 1 : 0;
  const unsigned bumpers = body_.bumpers();
  body.push_back(static_cast<std::uint8_t>(stall | (((bumpers >> 8) & 0x7F) << 1)));
  body.push_back(static_cast<std::uint8_t>(stall | ((bumpers & 0x7F) << 1)));
  add_word(body, 0);  // heading of its own control
  add_word(body, (power_ ? 1 : 0) | (sonar_ ? 2 : 0) | (button_ ? 0x20 : 0));
  body.push_back(0);  // no compass
  const std::vector<std::uint8_t> heard = echoes();
  body.insert(body.end(), heard.begin(), heard.end());
  // Analog port, gripper, analog, digital in and out.
  body.insert(body.end(), {0, gripper_->state(), 0, gripper_->digital_in(), 0});
  if (const auto charged = body_.is_charged()) {  // newer firmware appends voltage and state of the charger
    add_word(body, std::lround(10.0 * body_.battery_voltage().value_or(settings_.voltage)));
    body.push_back(*charged ? 1 : 0);
  }
  send(std::move(body), now);
}

// Returns the number of new readings, and the readings.
std::vector<std::uint8_t> P2osFirmware::echoes() {
  if (!sonar_) return {0};
  const int count = std::min(kSonarsEachTime, settings_.sonars);
  std::vector<std::uint8_t> heard{static_cast<std::uint8_t>(count)};
  for (int i = 0; i < count; ++i) {
    heard.push_back(static_cast<std::uint8_t>(next_sonar_));
    add_word(heard, std::lround(body_.sonar(next_sonar_).value_or(5.0) / settings_.range_unit));
    next_sonar_ = (next_sonar_ + 1) % settings_.sonars;
  }
  return heard;
}

}  // namespace orca::emulators
