// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <span>
#include <vector>

#include "orca/hw/framing/scanner.hpp"

/// What must hold for the frames in any stream of bytes.
namespace orca::hw::fuzz {

using Bytes = std::span<const std::uint8_t>;

inline void require(bool holds) {
  if (!holds) std::abort();
}

struct Found {
  std::uint64_t begin = 0;
  std::size_t size = 0;
  friend bool operator==(const Found&, const Found&) = default;
};

/// Scans a stream in pieces of that size, and calls `use` with each frame.
inline std::vector<Found> scan(const framing::Protocol& protocol, Bytes stream, std::size_t piece,
                               const std::function<void(Bytes)>& use) {
  framing::Scanner scanner(protocol);
  std::vector<Found> found;
  std::uint64_t in_frames = 0;
  const auto sink = [&](const framing::Frame& frame) {
    require(std::ranges::equal(frame.bytes, stream.subspan(frame.begin, frame.bytes.size())));
    found.push_back({frame.begin, frame.bytes.size()});
    in_frames += frame.bytes.size();
    use(frame.bytes);
  };
  for (Bytes rest = stream; !rest.empty(); rest = rest.subspan(std::min(piece, rest.size()))) {
    scanner.feed(rest.first(std::min(piece, rest.size())), sink);
    require(scanner.waiting() < protocol.longest);
  }
  scanner.give_up(sink);
  require(scanner.waiting() == 0 && scanner.received() == stream.size());
  require(scanner.statistics().frames == found.size());
  require(scanner.statistics().skipped_bytes + in_frames == stream.size());
  return found;
}

/// The same frames are found however the stream is cut.
inline void check_stream(const framing::Protocol& protocol, Bytes stream,
                         const std::function<void(Bytes)>& use) {
  const auto whole = scan(protocol, stream, stream.size() + 1, use);
  require(scan(protocol, stream, 1, use) == whole);
  require(scan(protocol, stream, 7, use) == whole);
}

}  // namespace orca::hw::fuzz
