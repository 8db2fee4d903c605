// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/emulators/create2_firmware.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "orca/emulators/firmware.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/hw/framing/checksums.hpp"

namespace orca::emulators {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr Duration kFramePeriod = 15ms;
constexpr int kMostSpeed = 500;  // [mm/s]
constexpr std::string_view kBootText = "bl-start\r\nr3_robot/tags/release-3.5.x\r\n";
constexpr std::size_t kRightWheel = 0;
constexpr std::size_t kLeftWheel = 1;

enum Opcode {
  kReset2 = 7,
  kStart = 128,
  kBaud = 129,
  kControl = 130,
  kSafe = 131,
  kFull = 132,
  kPower = 133,
  kSpot = 134,
  kClean = 135,
  kMax = 136,
  kDriveArc = 137,
  kSong = 140,
  kSensors = 142,
  kDock = 143,
  kDriveDirect = 145,
  kDrivePwm = 146,
  kStream = 148,
  kQueryList = 149,
  kPauseStream = 150,
  kStopInterface = 173
};

struct DataSize {
  int opcode;
  std::size_t size;
};

// 138 and 144: brushes; 139, 162, 163, 164: lights and digits; 141: play a song; 165: buttons; 167, 168: schedule and time.
constexpr DataSize kDataSizes[] = {{kBaud, 1},        {138, 1},          {141, 1},       {kSensors, 1},
                                   {kPauseStream, 1}, {165, 1},          {162, 2},       {139, 3},
                                   {144, 3},          {168, 3},          {kDriveArc, 4}, {163, 4},
                                   {164, 4},          {kDriveDirect, 4}, {kDrivePwm, 4}, {167, 15}};

// Returns how many bytes of data belong to a command, of which the first ones are there.
std::size_t data_of(Bytes command) {
  const int opcode = command[0];
  if (opcode == kStream || opcode == kQueryList) return command.size() > 1 ? 1U + command[1] : 1U;
  if (opcode == kSong) return command.size() > 2 ? 2U + 2U * command[2] : 2U;
  const auto* const found = std::ranges::find(kDataSizes, opcode, &DataSize::opcode);
  return found == std::end(kDataSizes) ? 0 : found->size;
}

int signed_of(Bytes data, std::size_t index) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(256 * data[index] + data[index + 1]));
}

struct Span {
  int first;
  int last;
};

// Returns the packets of a group, or the packet itself; an empty span if there is none.
Span packets_of(int number) {
  switch (number) {
    case 0: return {7, 26};
    case 1: return {7, 16};
    case 2: return {17, 20};
    case 3: return {21, 26};
    case 4: return {27, 34};
    case 5: return {35, 42};
    case 6: return {7, 42};
    case 100: return {7, 58};
    case 101: return {43, 58};
    case 106: return {46, 51};
    case 107: return {54, 58};
    default: return number >= 7 && number <= 58 ? Span{number, number} : Span{1, 0};
  }
}

bool has_two_bytes(int packet) {
  constexpr int kTwo[] = {19, 20, 22, 23, 25, 26, 27, 28, 29, 30, 31, 33, 39, 40,
                          41, 42, 43, 44, 46, 47, 48, 49, 50, 51, 54, 55, 56, 57};
  return std::ranges::find(kTwo, packet) != std::end(kTwo);
}

}  // namespace

Create2Firmware::Create2Firmware(Body& body, Create2Settings settings)
    : body_(body), settings_(settings), baud_(settings.baud) {}

void Create2Firmware::take(Bytes bytes, std::uint32_t baud, TimePoint now) {
  host_baud_ = baud;
  listen(now);
  if (starts_until_ || (baud != 0 && baud != baud_)) return;
  for (const std::uint8_t byte : bytes) {
    if (starts_until_) return;  // it was told to begin anew
    command_.push_back(byte);
    obey(now);
  }
}

// Carries the command out as soon as its data are there. As long as the interface is off, it waits for no data of others.
void Create2Firmware::obey(TimePoint now) {
  const bool is_heard = mode_ != Create2Mode::off || command_[0] == kStart || command_[0] == kReset2;
  if (is_heard && command_.size() < 1 + data_of(command_)) return;
  const std::vector<std::uint8_t> command = std::exchange(command_, {});
  if (!is_heard) return;
  note_command(commands_, command[0]);
  carry_out(command[0], Bytes(command).subspan(1), now);
}

void Create2Firmware::carry_out(int opcode, Bytes data, TimePoint now) {
  switch (opcode) {
    case kDriveArc:
    case kDriveDirect:
    case kDrivePwm: return set_wheels(opcode, data);
    case kBaud: return set_baud(data[0]);
    case kSensors: return answer(data, now);
    case kQueryList: return answer(data.subspan(1), now);
    case kStream:
      stream_.assign(data.begin() + 1, data.end());
      streams_ = !stream_.empty();
      next_frame_ = now + kFramePeriod;
      return;
    case kPauseStream:
      streams_ = data[0] != 0 && !stream_.empty();
      next_frame_ = now + kFramePeriod;
      return;
    default: return change_mode(opcode, now);
  }
}

void Create2Firmware::change_mode(int opcode, TimePoint now) {
  switch (opcode) {
    case kReset2: return reset(now);
    case kStart:
    case kPower:
    case kSpot:
    case kClean:
    case kMax:
    case kDock: mode_ = Create2Mode::passive; return stop();
    case kControl:
    case kSafe: mode_ = Create2Mode::safe; return;
    case kFull: mode_ = Create2Mode::full; return;
    case kStopInterface:
      mode_ = Create2Mode::off;
      streams_ = false;
      return stop();
    default: return;
  }
}

void Create2Firmware::set_wheels(int opcode, Bytes data) {
  if (mode_ != Create2Mode::safe && mode_ != Create2Mode::full) return;
  const int first = signed_of(data, 0);
  const int second = signed_of(data, 2);
  if (opcode == kDriveArc) {
    drive_arc(first, second);
  } else {
    const double unit = opcode == kDrivePwm ? kMostSpeed / 255.0 : 1.0;
    wheels_ = {static_cast<int>(std::lround(unit * first)), static_cast<int>(std::lround(unit * second))};
    arc_ = {};
  }
  for (int& wheel : wheels_) wheel = std::clamp(wheel, -kMostSpeed, kMostSpeed);
  drive();
}

// A radius of 1 or -1 means to turn on the spot, and two others to go straight on.
void Create2Firmware::drive_arc(int speed, int radius) {
  arc_ = {speed, radius};
  if (radius == -32768 || radius == 32767) {
    wheels_ = {speed, speed};
  } else if (std::abs(radius) == 1) {
    wheels_ = {speed * radius, -speed * radius};
  } else {
    const double bend = radius == 0 ? 0.0 : 500.0 * settings_.wheel_base / radius;
    wheels_ = {static_cast<int>(std::lround(speed * (1.0 + bend))),
               static_cast<int>(std::lround(speed * (1.0 - bend)))};
  }
}

void Create2Firmware::set_baud(int code) {
  constexpr std::uint32_t kRates[] = {300,   600,   1200,  2400,  4800,  9600,
                                      14400, 19200, 28800, 38400, 57600, 115200};
  if (code < 12) baud_ = kRates[code];
}

void Create2Firmware::stop() {
  wheels_ = {};
  arc_ = {};
  drive();
}

void Create2Firmware::drive() {
  const double right = 0.001 * wheels_[kRightWheel];
  const double left = 0.001 * wheels_[kLeftWheel];
  body_.drive({.forward = 0.5 * (right + left), .turn_rate = (right - left) / settings_.wheel_base});
}

void Create2Firmware::reset(TimePoint now) {
  stop();
  mode_ = Create2Mode::off;
  baud_ = settings_.baud;
  streams_ = false;
  stream_.clear();
  ways_ = {};
  distance_ = angle_ = 0.0;
  line_.clear();
  starts_until_ = now + settings_.power_up;
}

// Begins to listen after power-on.
void Create2Firmware::listen(TimePoint now) {
  if (!starts_until_ || now < *starts_until_) return;
  starts_until_.reset();
  command_.clear();
  send({reinterpret_cast<const std::uint8_t*>(kBootText.data()), kBootText.size()}, now);
}

std::vector<std::uint8_t> Create2Firmware::advance(TimePoint now) {
  listen(now);
  count();
  stay_safe();
  for (; streams_ && now >= next_frame_; next_frame_ += kFramePeriod) send_stream(next_frame_);
  return line_.leave(now, host_baud_ == 0 || host_baud_ == baud_);
}

// Adds to the ways of the wheels what the body has come since the last time.
void Create2Firmware::count() {
  const Pose2 pose = body_.odometry();
  const Travel2 travel = arc_between(last_pose_.value_or(pose), pose);
  last_pose_ = pose;
  const double turning = 0.5 * travel.turn * settings_.wheel_base;
  ways_[kRightWheel] += travel.forward + turning;
  ways_[kLeftWheel] += travel.forward - turning;
  distance_ += travel.forward;
  angle_ += travel.turn;
}

void Create2Firmware::stay_safe() {
  const bool is_charged = charger_ && settings_.heeds_charger;
  if (mode_ != Create2Mode::safe || !(body_.is_lifted() || is_charged || is_at_cliff())) return;
  mode_ = Create2Mode::passive;
  ++safety_stops_;
  stop();
}

// Cliffs count when it goes forward, and backward where it turns within its own circle.
bool Create2Firmware::is_at_cliff() const {
  const int speed = wheels_[kRightWheel] + wheels_[kLeftWheel];
  const int turning = std::abs(wheels_[kRightWheel] - wheels_[kLeftWheel]);
  return body_.cliffs() != 0 && (speed > 0 || (speed < 0 && turning > std::abs(speed)));
}

// A frame is left out when the one before it has not left yet.
void Create2Firmware::send_stream(TimePoint now) {
  if (line_.idle_at() > now) return;
  std::vector<std::uint8_t> frame{19, 0};
  for (const std::uint8_t number : stream_) {
    frame.push_back(number);
    for (int packet = packets_of(number).first; packet <= packets_of(number).last; ++packet)
      add_packet(frame, packet);
  }
  frame[1] = static_cast<std::uint8_t>(frame.size() - 2);
  frame.push_back(static_cast<std::uint8_t>(256 - hw::framing::sum_of_bytes(frame)));
  send(frame, now);
}

void Create2Firmware::answer(Bytes packets, TimePoint now) {
  std::vector<std::uint8_t> data;
  for (const std::uint8_t number : packets)
    for (int packet = packets_of(number).first; packet <= packets_of(number).last; ++packet)
      add_packet(data, packet);
  send(data, now);
}

void Create2Firmware::add_packet(std::vector<std::uint8_t>& bytes, int packet) {
  const int value = value_of(packet);
  if (has_two_bytes(packet)) bytes.push_back(static_cast<std::uint8_t>((value >> 8) & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
}

// What is not listed is 0: it senses nothing, or draws no current.
int Create2Firmware::value_of(int packet) {
  if (packet < 19) return contact_value(packet);
  if (packet == 19) return static_cast<int>(std::lround(1000.0 * std::exchange(distance_, 0.0)));
  if (packet == 20)
    return static_cast<int>(std::lround(std::exchange(angle_, 0.0) * 180.0 / std::numbers::pi));
  return packet < 35 ? battery_value(packet) : motor_value(packet);
}

int Create2Firmware::contact_value(int packet) const {
  if (packet == 7) return (body_.bumpers() & 3) | (body_.is_lifted() ? 0x0C : 0);
  if (packet >= 9 && packet <= 12) return (body_.cliffs() >> (packet - 9)) & 1;
  return packet == 14 && body_.is_stalled() ? 0x18 : 0;
}

int Create2Firmware::battery_value(int packet) const {
  switch (packet) {
    case 21: return charger_ ? 2 : 0;
    case 22: return settings_.voltage;
    case 23: return charger_ ? 1200 : -250;
    case 24: return 25;
    case 25: return settings_.charge;
    case 26: return settings_.capacity;
    case 34: return charger_ ? 1 : 0;
    default: return 0;
  }
}

int Create2Firmware::motor_value(int packet) const {
  const auto counts = [&](std::size_t wheel) {
    const double turns = ways_[wheel] / (std::numbers::pi * settings_.wheel_diameter);
    return static_cast<int>(std::llround(turns * settings_.counts_per_turn) & 0xFFFF);
  };
  switch (packet) {
    case 35: return static_cast<int>(mode_) + settings_.mode_offset;
    case 38: return static_cast<int>(stream_.size());
    case 39: return arc_[0];
    case 40: return arc_[1];
    case 41: return wheels_[kRightWheel];
    case 42: return wheels_[kLeftWheel];
    case 43: return counts(kLeftWheel);
    case 44: return counts(kRightWheel);
    case 58: return wheels_[kRightWheel] + wheels_[kLeftWheel] > 0 ? 1 : 0;
    default: return 0;
  }
}

void Create2Firmware::send(Bytes bytes, TimePoint now) {
  line_.send(bytes, host_baud_ == 0 ? 0.0 : 10.0 / baud_, now);
}

}  // namespace orca::emulators
