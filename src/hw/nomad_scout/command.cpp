// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/nomad_scout/command.hpp"

#include <algorithm>
#include <cmath>

#include "orca/hw/nomad_scout/base.hpp"

namespace orca::hw::nomad_scout {
namespace {

using Payload = framing::FrameBytes<kLongestPayload>;

constexpr unsigned kNoSonar = 255;  // ends the order
constexpr Duration kFiringStep{4ms};

unsigned magnitude(double value) { return static_cast<unsigned>(std::abs(in_tenths_of_inch(value))); }
unsigned signed_length(double value) { return sign_and_magnitude(in_tenths_of_inch(value)); }
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

Packet drive(const Wheels& speeds) {
  return of_wheels(Type::drive, signed_length(speeds.right), signed_length(speeds.left));
}

Packet get_state() { return make_packet(Type::get_state); }
Packet stop() { return make_packet(Type::stop); }
Packet limp() { return make_packet(Type::limp); }
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

}  // namespace orca::hw::nomad_scout
