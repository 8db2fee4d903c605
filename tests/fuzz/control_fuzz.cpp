// SPDX-License-Identifier: GPL-3.0-or-later
// Any packets of a control channel give an error or messages, and any message an error or an order or a report that can be
// encoded again.
#include <fcntl.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>

#include "channel/packets.hpp"
#include "orca/supervisor/control.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace {

using namespace orca::supervisor;

// Its descriptors are open, as those that come through a socket.
Message copy_of(const Message& message, std::size_t descriptors) {
  static const orca::Descriptor nothing(open("/dev/null", O_RDONLY | O_CLOEXEC));
  Message copy{message.kind, message.request, message.body, {}};
  while (copy.descriptors.size() < descriptors)
    copy.descriptors.emplace_back(fcntl(nothing.number(), F_DUPFD_CLOEXEC, 3));
  return copy;
}

// What is read is written as it came.
template <class Decode, class Encode>
void try_words(const Message& message, std::size_t descriptors, Decode decode, Encode encode) {
  auto words = decode(copy_of(message, descriptors));
  if (words && encode(std::move(*words)).body != message.body) std::abort();
}

void try_all(const Message& message, std::size_t descriptors) {
  const auto encoded = [](auto words) { return encode(std::move(words), 0); };
  try_words(message, descriptors, decode_order, encoded);
  try_words(message, descriptors, decode_report, encoded);
  try_words(message, descriptors, decode_ask, encoded);
  try_words(message, descriptors, decode_answer, encoded);
  try_words(message, descriptors, decode_line_word, encoded);
}

}  // namespace

// The input is a sequence of packets: two bytes of length, then the packet.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto rest = std::as_bytes(std::span(data, size));
  PacketJoiner joiner;
  while (rest.size() >= 2) {
    const std::size_t length = std::min(
        rest.size() - 2, std::to_integer<std::size_t>(rest[0]) | std::to_integer<std::size_t>(rest[1]) << 8);
    const auto message = joiner.add(rest.subspan(2, length), {});
    if (!message) return 0;
    if (*message)
      for (const std::size_t descriptors : {0U, 1U, 3U}) try_all(**message, descriptors);
    rest = rest.subspan(2 + length);
  }
  return 0;
}
