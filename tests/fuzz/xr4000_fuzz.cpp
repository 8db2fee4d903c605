// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes may come from the line of an XR4000's agent. They are read as a stream, whose frames are written again as they were,
// and as one message, whose first byte is the type, because few streams have good checksums.
#include <algorithm>
#include <cmath>

#include "frame_stream.hpp"
#include "orca/hw/xr4000/answers.hpp"
#include "orca/hw/xr4000/base.hpp"

namespace {

using namespace orca;
using namespace orca::hw;
using fuzz::Bytes;
using fuzz::require;

template <class Readings>
void check(const Result<Readings>& readings) {
  require(readings.has_value() || !readings.error().message.empty());
}

void read_state(const xr4000::Message& message) {
  const auto state = xr4000::parse_state(message);
  check(state);
  if (!state) return;
  require(is_finite(xr4000::velocity_of(state->speeds)));
  xr4000::IntegratorOdometry odometry;
  odometry.add({});
  odometry.add(state->integrator);
  require(std::abs(odometry.pose().yaw) < 3.1416 && std::abs(odometry.pose().x) < 2.2e6);
}

void read_message(const xr4000::Message& message) {
  read_state(message);
  check(xr4000::parse_hello(message));
  check(xr4000::parse_sonars(message));
  check(xr4000::parse_infrared(message));
  check(xr4000::parse_batteries(message));
  const auto bumpers = xr4000::parse_bumpers(message);
  check(bumpers);
  if (bumpers)
    for (const xr4000::Touch touch : *bumpers) require(touch <= xr4000::Touch::high);
  if (const auto returned = xr4000::returned_of(message)) require(!xr4000::text_of(*returned).empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Bytes input(data, size);
  fuzz::check_stream(xr4000::kProtocol, input, [](Bytes frame) {
    const xr4000::Message message = xr4000::message_of(frame);
    require(std::ranges::equal(xr4000::make_frame(message), frame));
    read_message(message);
  });
  if (size == 0) return 0;
  read_message({static_cast<xr4000::Type>(data[0] % 16), true, input.subspan(1)});
  return 0;
}
