// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes may come from the line of a Pioneer. They are read twice: as a stream, whose packets are written again as they
// were, and as the body of one packet, because few streams have good checksums.
#include <algorithm>

#include "frame_stream.hpp"
#include "orca/hw/p2os/config.hpp"
#include "orca/hw/p2os/gripper.hpp"
#include "orca/hw/p2os/packet.hpp"
#include "orca/hw/p2os/sip.hpp"

namespace {

using namespace orca::hw;
using fuzz::Bytes;
using fuzz::require;

void read_reports(Bytes body) {
  (void)p2os::parse_identity(body);
  (void)p2os::parse_config(body);
}

void read_sip(Bytes body) {
  for (const char* subclass : {"p2dx", "amigo"}) {
    const auto sip = p2os::parse_sip(body, p2os::choose_model(subclass).model);
    require(sip.has_value() || !sip.error().message.empty());
    if (sip) require(sip->x < 32768 && sip->echoes.size() <= p2os::Sip::kMostEchoes);
    if (sip && sip->ports) (void)p2os::gripper_of(*sip->ports);
  }
}

void read_body(Bytes body) {
  read_reports(body);
  read_sip(body);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Bytes input(data, size);
  fuzz::check_stream(p2os::kProtocol, input, [](Bytes packet) {
    const Bytes body = p2os::body_of(packet);
    require(std::ranges::equal(p2os::make_packet(body), packet));
    read_body(body);
  });
  read_body(input.first(std::min(size, p2os::kLongestBody)));
  return 0;
}
