// SPDX-License-Identifier: GPL-3.0-or-later
// The order in which announcements and handshakes of participants reach Fast DDS.
#include "dds/security/introductions.hpp"

#include <catch2/catch.hpp>

#include <initializer_list>
#include <string>
#include <thread>
#include <vector>

using namespace orca::dds;

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kAnnouncement = 0xC2;
constexpr std::uint8_t kHandshake = 0xC3;
constexpr std::uint8_t kObject = 0x03;

// A packet of a participant: an RTPS header, a timestamp, and data of the writer with that last byte.
Bytes packet(std::uint8_t participant, std::uint8_t writer) {
  Bytes bytes{'R', 'T', 'P', 'S', 2, 3, 1, 15};
  bytes.insert(bytes.end(), 12, participant);
  bytes.insert(bytes.end(), {0x09, 0x01, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  const std::uint8_t kind = writer == kAnnouncement ? 1 : 2;
  const std::uint8_t which = writer == kHandshake ? 1 : 0;
  bytes.insert(bytes.end(), {0x15, 0x05, 16, 0, 0, 0, 16, 0, 0, 0, 0, 0, 0, kind, which, writer, 0, 0, 0, 1});
  return bytes;
}

// Notes what it receives: the participant, and the last byte of its writer.
class Receiver final : public Introductions::Receiver {
 public:
  void OnDataReceived(const std::uint8_t* data, const std::uint32_t size,
                      const Introductions::Locator& /*here*/,
                      const Introductions::Locator& /*sender*/) override {
    REQUIRE(size == packet(0, 0).size());
    heard += std::to_string(data[8]) +
             (data[47] == kAnnouncement ? "a"
              : data[47] == kHandshake  ? "h"
                                        : "o") +
             " ";
  }
  std::string heard;
};

void pass(Introductions& introductions, Receiver& receiver, std::initializer_list<Bytes> packets) {
  for (const Bytes& one : packets) introductions.pass(one, receiver, {}, {});
}

}  // namespace

TEST_CASE("a handshake is heard after the announcement of its sender, everything else at once",
          "[patterns][dds][security]") {
  Introductions introductions;
  Receiver receiver;
  pass(introductions, receiver, {packet(1, kHandshake), packet(2, kHandshake), packet(1, kObject)});
  CHECK(receiver.heard == "1o ");
  pass(introductions, receiver, {packet(1, kAnnouncement)});
  CHECK(receiver.heard == "1o 1a 1h ");
  pass(introductions, receiver, {packet(1, kHandshake), packet(1, kAnnouncement)});
  CHECK(receiver.heard == "1o 1a 1h 1h 1a ");
  pass(introductions, receiver, {packet(2, kAnnouncement)});
  CHECK(receiver.heard == "1o 1a 1h 1h 1a 2a 2h ");
}

TEST_CASE("a handshake whose sender is never announced is forgotten", "[patterns][dds][security]") {
  Introductions introductions;
  Receiver receiver;
  for (int i = 0; i < 1000; ++i) pass(introductions, receiver, {packet(1, kHandshake)});
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  pass(introductions, receiver, {packet(2, kHandshake), packet(1, kAnnouncement)});
  CHECK(receiver.heard == "1a ");
}

TEST_CASE("packets that end anywhere, or lie about their lengths, are passed on as they are",
          "[patterns][dds][security]") {
  struct Any final : Introductions::Receiver {
    void OnDataReceived(const std::uint8_t* /*data*/, const std::uint32_t size,
                        const Introductions::Locator& /*here*/,
                        const Introductions::Locator& /*sender*/) override {
      sizes.push_back(size);
    }
    std::vector<std::size_t> sizes;
  };
  Introductions introductions;
  Any receiver;
  const Bytes whole = packet(1, kObject);
  for (std::size_t size = 20; size <= whole.size(); ++size)
    introductions.pass(std::span(whole).first(size), receiver, {}, {});
  CHECK(receiver.sizes.size() == whole.size() - 19);
  Bytes liar = whole;
  liar[22] = 0xFF;
  liar[23] = 0xFF;
  introductions.pass(liar, receiver, {}, {});
  CHECK(receiver.sizes.back() == liar.size());
}
