// SPDX-License-Identifier: LGPL-3.0-or-later
#include "frame_splitter.hpp"

#include <cstdint>
#include <cstring>
#include <utility>

namespace orca::bytes {
namespace {

using Length = std::uint32_t;

constexpr std::size_t kLongest = std::size_t{64} << 20;  // [bytes]

}  // namespace

std::vector<std::byte> in_stream(const frames::Frame& frame) {
  std::vector<std::byte> bytes(sizeof(Length));
  frame.append_to(bytes);
  const auto length = static_cast<Length>(bytes.size() - sizeof(Length));
  std::memcpy(bytes.data(), &length, sizeof length);
  return bytes;
}

void FrameSplitter::append(std::span<const std::byte> bytes) {
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(std::exchange(used_, 0)));
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

Result<std::optional<std::span<const std::byte>>> FrameSplitter::next() {
  using Frame = std::optional<std::span<const std::byte>>;
  const auto rest = std::span<const std::byte>(bytes_).subspan(used_);
  Length length = 0;
  if (rest.size() < sizeof length) return Frame{};
  std::memcpy(&length, rest.data(), sizeof length);
  if (length < frames::kShortest || length > kLongest)
    return fail(Code::data_loss, "a frame of " + std::to_string(length) + " bytes; expected " +
                                     std::to_string(frames::kShortest) + " to " + std::to_string(kLongest));
  if (rest.size() - sizeof length < length) return Frame{};
  used_ += sizeof length + length;
  return Frame(rest.subspan(sizeof length, length));
}

}  // namespace orca::bytes
