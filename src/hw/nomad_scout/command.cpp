// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/nomad_scout/command.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "orca/hw/nomad_scout/number.hpp"

namespace orca::hw::nomad_scout {
namespace {

using Payload = framing::FrameBytes<kLongestPayload>;

constexpr unsigned kNoSonar = 255;  // ends the order
constexpr Duration kFiringStep{4ms};

unsigned magnitude(double value) { return static_cast<unsigned>(std::abs(in_tenths_of_inch(value))); }
unsigned signed_length(double value) { return sign_and_magnitude(in_tenths_of_inch(value)); }
unsigned signed_angle(double angle) { return sign_and_magnitude(in_tenths_of_degree(angle)); }

// The third axis is the turret of larger robots.
Packet of_wheels(Type type, unsigned right, unsigned left) {
  return make_packet(type, Payload().u16(right).u16(left).u16(0).view());
}

unsigned whole_seconds(Duration limit) {
  const Duration rounded_up = limit + (Duration{1s} - Duration{1});
  return static_cast<unsigned>(std::clamp<Duration::rep>(rounded_up / Duration{1s}, 0, 255));
}

}  // namespace

Packet set_accelerations(const Wheels& accelerations) {
  return of_wheels(Type::accelerations, magnitude(accelerations.right), magnitude(accelerations.left));
}

Packet set_speeds(const Wheels& speeds) {
  return of_wheels(Type::speeds, magnitude(speeds.right), magnitude(speeds.left));
}

Packet move(const Wheels& distances) {
  return of_wheels(Type::move, signed_length(distances.right), signed_length(distances.left));
}

Packet drive(const Wheels& speeds) {
  return of_wheels(Type::drive, signed_length(speeds.right), signed_length(speeds.left));
}

Packet get_state() { return make_packet(Type::get_state); }
Packet stop() { return make_packet(Type::stop); }
Packet limp() { return make_packet(Type::limp); }
Packet zero() { return make_packet(Type::zero); }

Packet define_position(double x, double y) {
  return make_packet(Type::define_position, Payload().u16(signed_length(x)).u16(signed_length(y)).view());
}

Packet define_angles(double heading, double turret) {
  return make_packet(Type::define_angles,
                     Payload().u16(signed_angle(heading)).u16(signed_angle(turret)).view());
}

Packet start_sonars(Duration interval, std::span<const std::uint8_t> order) {
  Payload payload;
  payload.u8(static_cast<unsigned>(std::clamp<Duration::rep>(interval / kFiringStep, 1, 255)));
  for (std::size_t i = 0; i < kSonars; ++i) payload.u8(i < order.size() ? order[i] : kNoSonar);
  return make_packet(Type::configure_sonars, payload.view());
}

Packet stop_sonars() {
  Payload payload;
  payload.u8(0);
  for (std::size_t i = 0; i < kSonars; ++i) payload.u8(kNoSonar);
  return make_packet(Type::configure_sonars, payload.view());
}

Packet set_watchdog(Duration limit) {
  return make_packet(Type::set_watchdog, Payload().u8(whole_seconds(limit)).view());
}

Packet get_group(Type group) { return make_packet(group); }

Packet wait_until_stopped(bool right, bool left, Duration limit) {
  return make_packet(Type::wait, Payload().u8(right).u8(left).u8(0).u8(whole_seconds(limit)).view());
}

Packet configure_port(std::uint8_t port, std::uint16_t baud) {
  return make_packet(Type::configure_port, Payload().u8(port).u16(baud).view());
}

Packet set_axes(const std::array<Axis, 3>& axes) {
  Payload payload;
  for (const Axis& axis : axes)
    payload.u16(static_cast<unsigned>(axis.mode)).u16(sign_and_magnitude(axis.value));
  return make_packet(Type::axes, payload.view());
}

Result<Packet> special(std::span<const std::uint8_t> bytes) {
  if (bytes.size() > kLongestPayload)
    return fail(Code::invalid_argument, "a special packet with " + std::to_string(bytes.size()) +
                                            " bytes; the robot takes at most " +
                                            std::to_string(kLongestPayload) + "; send them in parts");
  return make_packet(Type::special, bytes);
}

}  // namespace orca::hw::nomad_scout
