// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/p2os/sync.hpp"

#include "orca/hw/framing/byte_reader.hpp"

namespace orca::hw::p2os {

std::optional<int> sync_step(std::span<const std::uint8_t> body) {
  if (body.empty() || body[0] > 2) return std::nullopt;
  return body[0];
}

std::optional<Identity> parse_identity(std::span<const std::uint8_t> body) {
  if (sync_step(body) != 2) return std::nullopt;
  framing::ByteReader reader(body.subspan(1));
  Identity identity;
  identity.name = reader.text_to_zero();
  identity.robot_class = reader.text_to_zero();
  identity.subclass = reader.text_to_zero();
  return identity;
}

}  // namespace orca::hw::p2os
