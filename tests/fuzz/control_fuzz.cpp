// SPDX-License-Identifier: GPL-3.0-or-later
// Any packets of a control channel give an error or messages, and any message an error or an order or a report that can be
// encoded again.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "channel/packets.hpp"
#include "orca/supervisor/control.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace {

using namespace orca::supervisor;

Message copy_of(const Message& message, std::size_t descriptors) {
  return {message.kind, message.request, message.body, std::vector<orca::Descriptor>(descriptors)};
}

void decode_both(const Message& message, std::size_t descriptors) {
  if (auto order = decode_order(copy_of(message, descriptors)))
    if (encode(std::move(*order)).body != message.body) std::abort();
  if (auto report = decode_report(copy_of(message, descriptors)))
    if (encode(std::move(*report)).body != message.body) std::abort();
  if (auto ask = decode_ask(copy_of(message, descriptors)))
    if (encode(std::move(*ask), 0).body != message.body) std::abort();
  if (auto answer = decode_answer(copy_of(message, descriptors)))
    if (encode(std::move(*answer), 0).body != message.body) std::abort();
  if (auto word = decode_line_word(copy_of(message, descriptors)))
    if (encode(std::move(*word)).body != message.body) std::abort();
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
      for (const std::size_t descriptors : {0U, 1U, 3U}) decode_both(**message, descriptors);
    rest = rest.subspan(2 + length);
  }
  return 0;
}
