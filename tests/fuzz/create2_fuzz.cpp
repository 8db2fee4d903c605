// SPDX-License-Identifier: GPL-3.0-or-later
// Create 2: a stream gives the same frames however it is cut, and each frame is read without an error; a body of any bytes gives
// readings or an error. The first byte chooses.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "orca/hw/create2/sensors.hpp"

namespace {

using namespace orca::hw;
using Input = std::span<const std::uint8_t>;

std::vector<std::uint8_t> frames_of(Input stream, std::size_t piece) {
  framing::Scanner scanner(create2::kProtocol);
  std::vector<std::uint8_t> frames;
  const auto sink = [&](const framing::Frame& frame) {
    if (!create2::parse_body(create2::body_of(frame.bytes))) std::abort();
    frames.insert(frames.end(), frame.bytes.begin(), frame.bytes.end());
  };
  for (std::size_t at = 0; at < stream.size(); at += piece)
    scanner.feed(stream.subspan(at, std::min(piece, stream.size() - at)), sink);
  scanner.give_up(sink);
  return frames;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const Input rest(data + 1, size - 1);
  if (data[0] < 128)
    (void)create2::parse_body(rest);
  else if (frames_of(rest, rest.size()) != frames_of(rest, data[0] - 127U))
    std::abort();
  return 0;
}
