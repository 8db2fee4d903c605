// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/xr4000/request.hpp"

#include <algorithm>
#include <limits>

namespace orca::hw::xr4000 {
namespace {

using Payload = framing::FrameBytes<kLongestPayload>;

constexpr unsigned kVelocityMode = 4;

Frame request(Type type, const Payload& payload) { return make_frame({type, false, payload.view()}); }

std::uint32_t bits_of(std::int32_t value) { return static_cast<std::uint32_t>(value); }

}  // namespace

Frame hello() { return request(Type::hello, Payload().u8(kVersion)); }

Frame ask(Type type) { return request(type, {}); }

Frame drive(const Axes& speeds, const Axes& accelerations) {
  Payload payload;
  const auto add = [&](std::int32_t speed, std::int32_t acceleration) {
    payload.u8(kVelocityMode).u32(bits_of(speed)).u32(bits_of(acceleration));
  };
  add(speeds.x, accelerations.x);
  add(speeds.y, accelerations.y);
  add(speeds.rotation, accelerations.rotation);
  return request(Type::set_axes, payload);
}

Frame set_timer(Duration limit) {
  const auto time =
      std::clamp<Duration::rep>(limit / Duration{1ms}, 1, std::numeric_limits<std::uint32_t>::max());
  return request(Type::set_timer, Payload().u32(static_cast<std::uint32_t>(time)));
}

Frame set_integrator(const Axes& pose) {
  return request(Type::set_integrator,
                 Payload().u32(bits_of(pose.x)).u32(bits_of(pose.y)).u32(bits_of(pose.rotation)));
}

}  // namespace orca::hw::xr4000
