// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/player/payload.hpp"

#include <string>

#include "fields.hpp"

namespace orca::hw::player {

template <class Payload>
std::vector<std::uint8_t> encode(const Payload& payload) {
  XdrWriter writer;
  fields(writer, payload);
  return std::move(writer).take();
}

template <class Payload>
Result<Payload> decode(std::span<const std::uint8_t> bytes) {
  XdrReader reader(bytes);
  Payload payload;
  fields(reader, payload);
  reader.finish();
  if (reader.trouble().empty()) return payload;
  return fail(Code::data_loss, std::string(Payload::kName) + ", " + std::to_string(bytes.size()) +
                                   " bytes: " + reader.trouble() + "; check that the peer speaks Player 3.x");
}

// One line for each structure that users may read and write.
#define ORCA_PLAYER_PAYLOAD(Payload)                         \
  template std::vector<std::uint8_t> encode(const Payload&); \
  template Result<Payload> decode(std::span<const std::uint8_t>)
ORCA_PLAYER_PAYLOAD(DeviceList);
ORCA_PLAYER_PAYLOAD(DriverInfo);
ORCA_PLAYER_PAYLOAD(Subscription);
ORCA_PLAYER_PAYLOAD(DataMode);
ORCA_PLAYER_PAYLOAD(Capability);
ORCA_PLAYER_PAYLOAD(Planar);
ORCA_PLAYER_PAYLOAD(Geometry);
ORCA_PLAYER_PAYLOAD(Switch);
ORCA_PLAYER_PAYLOAD(Position2dState);
ORCA_PLAYER_PAYLOAD(VelocityCommand);
ORCA_PLAYER_PAYLOAD(LaserScan);
ORCA_PLAYER_PAYLOAD(LaserConfig);
ORCA_PLAYER_PAYLOAD(SonarRanges);
ORCA_PLAYER_PAYLOAD(SonarGeometry);
ORCA_PLAYER_PAYLOAD(RangerValues);
ORCA_PLAYER_PAYLOAD(RangerGeometry);
ORCA_PLAYER_PAYLOAD(RangerConfig);
ORCA_PLAYER_PAYLOAD(RangerStamped);
ORCA_PLAYER_PAYLOAD(BumperState);
ORCA_PLAYER_PAYLOAD(PowerState);
#undef ORCA_PLAYER_PAYLOAD

}  // namespace orca::hw::player
