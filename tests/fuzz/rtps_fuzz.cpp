// SPDX-License-Identifier: GPL-3.0-or-later
// What strangers send to a secured participant passes its gate only in the name of somebody whose certificate is good, and then as it
// is. The input is a sequence of packets: who is named as the sender (1 byte), the length (2 bytes), and the packet.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "dds/security/introductions.hpp"
#include "orca/base/files/key_folder.hpp"
#include "orca/base/log.hpp"
#include "orca/dds/gate.hpp"
#include "orca/keys/authority.hpp"

namespace {

using namespace orca;
using namespace orca::dds;
using Input = std::span<const std::uint8_t>;
using Packet = std::vector<std::uint8_t>;

constexpr std::size_t kSender = 8;   // [bytes] where its GUID begins in a packet
constexpr std::size_t kHeader = 20;  // [bytes]

void check(bool holds) {
  if (!holds) std::abort();
}

// Returns the gate of process "brain", whose neighbour "gone" has lost its certificate.
std::shared_ptr<Gate> make_gate() {
  log::set_level(log::Level::error);  // each refusal is a warning
  std::string folder = (std::filesystem::temp_directory_path() / "orca-rtps-fuzz-XXXXXX").string();
  check(mkdtemp(folder.data()) != nullptr);
  const auto now = std::chrono::system_clock::now();
  const keys::Validity validity{now - std::chrono::hours(1), now + std::chrono::hours(24)};
  const std::string system = folder + "/keys";
  check(keys::make_keys(system, {{"", "brain", {"*"}, {"*"}}, {"", "gone", {"*"}, {"*"}}}, validity).ok());
  check(static_cast<bool>(keys::revoke_keys(system, "gone", {}, validity)));
  auto gate = Gate::open(system + "/" + key_folder_name(""), "brain");
  std::filesystem::remove_all(folder);
  return std::move(gate).value();
}

struct Members {
  std::vector<keys::Mark> all;
  std::set<keys::Mark> good;
};

Members members_of(const Gate& gate) {
  Members members;
  const keys::KeyRing ring = gate.keys();
  for (const auto& [mark, certificate] : ring.known()) {
    members.all.push_back(mark);
    if (!certificate.revoked) members.good.insert(mark);
  }
  check(members.all.size() == 2 && members.good.size() == 1);
  return members;
}

keys::Mark mark_of_sender(const Packet& packet) {
  keys::Mark mark{};
  std::copy_n(packet.begin() + kSender, mark.size(), mark.begin());
  return mark;
}

// Checks that it hears only what was sent.
struct Receiver final : Introductions::Receiver {
  void OnDataReceived(const std::uint8_t* data, std::uint32_t size, const Introductions::Locator& /*here*/,
                      const Introductions::Locator& /*sender*/) override {
    check(sent.contains(Packet(data, data + size)));
  }
  std::set<Packet> sent;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kHead = 3;
  static const std::shared_ptr<Gate> gate = make_gate();
  static const Members members = members_of(*gate);
  Introductions introductions;
  Receiver receiver;
  for (Input rest(data, size); rest.size() >= kHead;) {
    const std::size_t length = std::min<std::size_t>(rest.size() - kHead, rest[1] + 256U * rest[2]);
    const Input bytes = rest.subspan(kHead, length);
    Packet packet(bytes.begin(), bytes.end());
    if (rest[0] < members.all.size() && packet.size() >= kSender + sizeof(keys::Mark))
      std::ranges::copy(members.all[rest[0]], packet.begin() + kSender);
    const bool is_in = gate->lets_in(packet, {});
    check(is_in == (packet.size() >= kHeader && members.good.contains(mark_of_sender(packet))));
    receiver.sent.insert(packet);
    if (is_in) introductions.pass(packet, receiver, {}, {});
    rest = rest.subspan(kHead + length);
  }
  return 0;
}
