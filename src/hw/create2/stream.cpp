// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/create2/stream.hpp"

#include <algorithm>

#include "orca/hw/create2/sensors.hpp"
#include "orca/hw/framing/checksums.hpp"

namespace orca::hw::create2 {

namespace {

constexpr std::uint8_t kHeader = 19;

// Whether packets, the first of which begin with these bytes, can fit exactly into a body of that length.
bool can_fit(std::span<const std::uint8_t> bytes, std::size_t length) {
  std::size_t at = 0;
  while (at < bytes.size()) {
    const auto size = data_size(bytes[at]);
    if (!size) return false;
    at += 1 + *size;
  }
  return length > 0 && at <= length;
}

}  // namespace

framing::Finding look(std::span<const std::uint8_t> bytes) {
  using Kind = framing::Finding::Kind;
  if (bytes[0] != kHeader) return {};
  if (bytes.size() < 2) return {Kind::need_more};
  const std::size_t length = bytes[1];
  if (!can_fit(bytes.subspan(2, std::min(length, bytes.size() - 2)), length)) return {};
  if (bytes.size() < length + 3) return {Kind::need_more};
  if (framing::sum_of_bytes(bytes.first(length + 3)) != 0) return {Kind::bad_checksum};
  return {Kind::frame, length + 3};
}

std::span<const std::uint8_t> body_of(std::span<const std::uint8_t> frame) {
  return frame.subspan(2, frame.size() - 3);
}

StreamFrame make_frame(std::span<const std::uint8_t> body) {
  StreamFrame frame;
  frame.u8(kHeader).u8(static_cast<unsigned>(body.size())).append(body);
  frame.u8(256U - framing::sum_of_bytes(frame.view()));
  return frame;
}

}  // namespace orca::hw::create2
