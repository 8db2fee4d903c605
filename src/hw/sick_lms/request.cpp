// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/sick_lms/request.hpp"

#include <string>

namespace orca::hw::sick_lms {
namespace {

using Payload = framing::FrameBytes<kLongestPayload>;

constexpr unsigned kChooseMode = 0x20;
constexpr unsigned kInstallation = 0x00;
constexpr unsigned kWriteConfiguration = 0x77;

Telegram command(unsigned code) { return make_request(Payload().u8(code).view()); }

Payload mode_payload(unsigned mode) { return Payload().u8(kChooseMode).u8(mode); }

}  // namespace

Telegram request_status() { return command(0x31); }
Telegram request_type() { return command(0x3A); }
Telegram request_configuration() { return command(0x74); }

Telegram request_variant(const Variant& variant) {
  return make_request(Payload().u8(0x3B).u16(variant.angle).u16(variant.resolution).view());
}

Telegram request_mode(Mode mode) { return make_request(mode_payload(static_cast<unsigned>(mode)).view()); }

Telegram request_installation(std::string_view password) {
  Payload payload = mode_payload(kInstallation);
  for (const char c : password) payload.u8(static_cast<unsigned char>(c));
  return make_request(payload.view());
}

Result<Telegram> request_rate(unsigned baud) {
  switch (baud) {
    case 38400: return make_request(mode_payload(0x40).view());
    case 19200: return make_request(mode_payload(0x41).view());
    case 9600: return make_request(mode_payload(0x42).view());
    case 500000: return make_request(mode_payload(0x48).view());
    default:
      return fail(Code::invalid_argument, "a laser has no rate of " + std::to_string(baud) +
                                              " baud; choose 9600, 19200, 38400 or 500000");
  }
}

Result<Telegram> write_configuration(std::span<const std::uint8_t> block) {
  if (block.empty() || block.size() >= kLongestPayload)
    return fail(Code::invalid_argument, "a configuration of " + std::to_string(block.size()) +
                                            " bytes cannot be written; read it from the laser first");
  return make_request(Payload().u8(kWriteConfiguration).append(block).view());
}

}  // namespace orca::hw::sick_lms
