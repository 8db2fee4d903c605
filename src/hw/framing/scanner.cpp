// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/framing/scanner.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace orca::hw::framing {

Scanner::Scanner(const Protocol& protocol) : protocol_(protocol), buffer_(2 * protocol.longest) {}

// Copies as many bytes as there is room for. After next() has found nothing, fewer than the longest frame wait, so
// there is always room.
std::size_t Scanner::take(std::span<const std::uint8_t> bytes) {
  if (buffer_.size() - end_ < bytes.size() && begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, waiting());
    end_ = waiting();
    begin_ = 0;
  }
  const std::size_t count = std::min(bytes.size(), buffer_.size() - end_);
  std::memcpy(buffer_.data() + end_, bytes.data(), count);
  end_ += count;
  return count;
}

std::optional<Frame> Scanner::next() {
  while (waiting() > 0) {
    const Finding finding = judge();
    if (finding.kind == Finding::Kind::need_more) return std::nullopt;
    if (finding.kind == Finding::Kind::frame) return accept(finding.size);
    if (finding.kind == Finding::Kind::bad_checksum) ++statistics_.bad_checksums;
    skip_byte();
  }
  return std::nullopt;
}

Finding Scanner::judge() const {
  const Finding finding = protocol_.look({buffer_.data() + begin_, waiting()});
  const bool waits_in_vain = finding.kind == Finding::Kind::need_more && waiting() >= protocol_.longest;
  const bool is_impossible =
      finding.kind == Finding::Kind::frame && (finding.size == 0 || finding.size > waiting());
  return waits_in_vain || is_impossible ? Finding{} : finding;
}

Frame Scanner::accept(std::size_t size) {
  const Frame frame{{buffer_.data() + begin_, size}, index_, std::exchange(skipped_, 0)};
  begin_ += size;
  index_ += size;
  ++statistics_.frames;
  if (frame.skipped > 0) ++statistics_.resynchronisations;
  return frame;
}

void Scanner::skip_byte() {
  ++begin_;
  ++index_;
  ++skipped_;
  ++statistics_.skipped_bytes;
}

}  // namespace orca::hw::framing
