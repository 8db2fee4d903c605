// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes may come from the line of a Scout. They are read as a stream, whose packets are written again as they were, and as
// one message, whose first byte is the type, because few streams have good sums.
#include <algorithm>
#include <cmath>

#include "frame_stream.hpp"
#include "orca/hw/nomad_scout/state.hpp"

namespace {

using namespace orca::hw;
using fuzz::Bytes;
using fuzz::require;

void read_message(const nomad_scout::Message& message) {
  const auto state = nomad_scout::parse_state(message);
  require(state.has_value() || !state.error().message.empty());
  if (!state) return;
  require(std::abs(state->heading) < 3.1416 && std::abs(state->position.x) <= 32767);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Bytes input(data, size);
  fuzz::check_stream(nomad_scout::kProtocol, input, [](Bytes packet) {
    const nomad_scout::Message message = nomad_scout::message_of(packet);
    require(std::ranges::equal(nomad_scout::make_packet(message.type, message.payload), packet));
    read_message(message);
  });
  if (size == 0) return 0;
  read_message({static_cast<nomad_scout::Type>(data[0]), input.subspan(1)});
  return 0;
}
