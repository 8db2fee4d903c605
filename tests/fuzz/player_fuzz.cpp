// SPDX-License-Identifier: GPL-3.0-or-later
// Player: any bytes give messages and payloads, or an error with a text. What was read is the same after writing. The first
// byte chooses what the rest is: a stream in pieces of one size, or a payload.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "orca/hw/player/message_reader.hpp"
#include "orca/hw/player/payload.hpp"
#include "orca/hw/player/position2d.hpp"
#include "orca/hw/player/sensors.hpp"
#include "orca/hw/player/session.hpp"

namespace {

using namespace orca::hw::player;
using Input = std::span<const std::uint8_t>;

template <class Payload>
void try_payload(Input bytes) {
  const auto read = decode<Payload>(bytes);
  if (!read) {
    if (read.error().message.empty()) std::abort();
    return;
  }
  // Padding and the numbers of flags may differ from what was read; from then on nothing changes any more.
  const auto written = encode(*read);
  const auto again = decode<Payload>(written);
  if (!again || encode(*again) != written) std::abort();
}

constexpr std::array kPayloads = {
    try_payload<DeviceList>,      try_payload<DriverInfo>,    try_payload<Subscription>,
    try_payload<DataMode>,        try_payload<Capability>,    try_payload<Planar>,
    try_payload<Geometry>,        try_payload<Switch>,        try_payload<Position2dState>,
    try_payload<VelocityCommand>, try_payload<LaserScan>,     try_payload<LaserConfig>,
    try_payload<SonarRanges>,     try_payload<SonarGeometry>, try_payload<RangerValues>,
    try_payload<RangerGeometry>,  try_payload<RangerConfig>,  try_payload<RangerStamped>,
    try_payload<BumperState>,     try_payload<PowerState>};

struct Heard {
  std::vector<std::uint8_t> messages;
  bool ok = true;
};

Heard hear(Input stream, std::size_t piece, MessageReader::Side side) {
  MessageReader reader(side);
  Heard heard;
  for (std::size_t at = 0; at < stream.size(); at += piece) {
    const auto status =
        reader.feed(stream.subspan(at, std::min(piece, stream.size() - at)), [&](const Message& message) {
          const auto written = make_message(message.header, message.payload).value();
          heard.messages.insert(heard.messages.end(), written.begin(), written.end());
        });
    heard.ok = status.ok();
    if (!status.ok() && status.error().message.empty()) std::abort();
  }
  return heard;
}

void try_stream(Input stream, std::size_t piece) {
  for (const auto side : {MessageReader::Side::client, MessageReader::Side::server}) {
    const Heard whole = hear(stream, stream.size() + 1, side);
    const Heard cut = hear(stream, piece, side);
    if (whole.ok != cut.ok || whole.messages != cut.messages) std::abort();
    const std::size_t begin = side == MessageReader::Side::client ? std::min(kBannerSize, stream.size()) : 0;
    const Input read = stream.subspan(begin, std::min(whole.messages.size(), stream.size() - begin));
    if (!std::ranges::equal(whole.messages, read)) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const Input rest(data + 1, size - 1);
  if (data[0] < kPayloads.size())
    kPayloads[data[0]](rest);
  else
    try_stream(rest, 1 + data[0] % 64U);
  return 0;
}
