// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/idl/cdr_reader.hpp"
#include "orca/idl/cdr_writer.hpp"

namespace orca::ros {

/// [bytes] What comes before the fields: the encoding and two bytes of options.
inline constexpr std::size_t kEncapsulation = 4;
/// Plain CDR, version 1, little-endian: the only encoding that the middlewares of ROS 2 use.
inline constexpr std::array<std::byte, 2> kPlainCdr{std::byte{0}, std::byte{1}};

/// Returns a message (orca/ros/generated/messages.hpp) as it travels, with its encapsulation.
/// @thread  any.
template <class Message>
[[nodiscard]] std::vector<std::byte> to_cdr(const Message& message) {
  detail::CdrWriter measuring({});
  measuring.write(message);
  std::vector<std::byte> bytes(kEncapsulation + measuring.size());
  std::memcpy(bytes.data(), kPlainCdr.data(), kPlainCdr.size());
  detail::CdrWriter(std::span(bytes).subspan(kEncapsulation)).write(message);
  return bytes;
}

/// Reads what to_cdr() or another program has written. The bytes are not trusted.
/// @errors  data_loss for another encoding, and for bytes that are no such message; it says where.
/// @thread  any.
template <class Message>
[[nodiscard]] Status from_cdr(std::span<const std::byte> bytes, Message& message) {
  constexpr std::string_view kName = Reflection<Message>::name;
  if (bytes.size() < kEncapsulation || std::memcmp(bytes.data(), kPlainCdr.data(), kPlainCdr.size()) != 0)
    return fail(Code::data_loss, std::string(kName) + " is not in plain little-endian CDR");
  detail::CdrReader reader(bytes.subspan(kEncapsulation));
  reader.read(message);
  return reader.status(kName);
}

}  // namespace orca::ros
