// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/player/message_reader.hpp"

#include <algorithm>

namespace orca::hw::player {

MessageReader::MessageReader(Side side)
    : part_(side == Side::client ? Part::banner : Part::header),
      awaited_(side == Side::client ? kBannerSize : kHeaderSize) {}

std::size_t MessageReader::take(std::span<const std::uint8_t> bytes) {
  const std::size_t count = std::min(bytes.size(), awaited_ - buffer_.size());
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
  if (buffer_.size() == awaited_ && part_ == Part::banner)
    finish_banner();
  else if (buffer_.size() == awaited_ && part_ == Part::header)
    finish_header();
  return count;
}

void MessageReader::finish_banner() {
  auto version = parse_banner(buffer_);
  if (!version) {
    trouble_ = version.error();
    return;
  }
  server_version_ = *version;
  await_header();
}

void MessageReader::finish_header() {
  const auto header = decode_header(buffer_);
  if (!header) {
    trouble_ = header.error();
    return;
  }
  header_ = *header;
  part_ = Part::payload;
  awaited_ = kHeaderSize + header_.size;
}

void MessageReader::await_header() {
  part_ = Part::header;
  awaited_ = kHeaderSize;
  buffer_.clear();
}

}  // namespace orca::hw::player
