// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/supervisor/channel.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>

#include <cstring>
#include <random>

#include "channel/packets.hpp"
#include "open_descriptors.hpp"

using namespace orca;
using namespace orca::supervisor;

namespace {

constexpr Duration kLongTransfer = 20s;

std::vector<std::byte> bytes_of(std::size_t count, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::vector<std::byte> bytes(count);
  for (auto& byte : bytes) byte = static_cast<std::byte>(random());
  return bytes;
}

Message message_of(std::size_t count, std::uint64_t request = 0) {
  return {Kind::logged, request, bytes_of(count), {}};
}

Descriptor null_device() { return Descriptor(open("/dev/null", O_RDWR | O_CLOEXEC)); }

Message with_descriptors(std::size_t count) {
  Message message = message_of(10);
  for (std::size_t i = 0; i < count; ++i) message.descriptors.push_back(null_device());
  return message;
}

bool is_null_device(const Descriptor& descriptor) {
  struct stat one {
  }, other{};
  return fstat(descriptor.number(), &one) == 0 && stat("/dev/null", &other) == 0 &&
         one.st_rdev == other.st_rdev;
}

// A channel, and the bare socket of its peer.
struct Half {
  SocketPair pair = *make_socket_pair();
  Channel channel{std::move(pair.supervisor)};
  int peer = pair.host.number();

  void raw(const std::vector<std::byte>& bytes, int descriptor = -1) const {
    iovec data{const_cast<std::byte*>(bytes.data()), bytes.size()};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))] = {};
    msghdr header{};
    header.msg_iov = &data;
    header.msg_iovlen = 1;
    if (descriptor >= 0) {
      header.msg_control = control;
      header.msg_controllen = sizeof control;
      cmsghdr* const rights = CMSG_FIRSTHDR(&header);
      *rights = {CMSG_LEN(sizeof(int)), SOL_SOCKET, SCM_RIGHTS};
      std::memcpy(CMSG_DATA(rights), &descriptor, sizeof descriptor);
    }
    REQUIRE(sendmsg(peer, &header, MSG_NOSIGNAL) >= 0);
  }
};

struct Both {
  SocketPair pair = *make_socket_pair();
  Channel supervisor{std::move(pair.supervisor)};
  Channel host{std::move(pair.host)};
};

}  // namespace

TEST_CASE("A message crosses a channel with its descriptors", "[supervisor][channel]") {
  Both both;
  Message message = with_descriptors(2);
  message.request = 7;
  const auto body = message.body;
  REQUIRE(both.supervisor.post(std::move(message)).ok());
  const auto arrived = both.host.wait_for_message(kLongTransfer);
  REQUIRE(arrived);
  CHECK(arrived->kind == Kind::logged);
  CHECK(arrived->request == 7);
  CHECK(arrived->body == body);
  REQUIRE(arrived->descriptors.size() == 2);
  for (const auto& descriptor : arrived->descriptors) {
    CHECK(is_null_device(descriptor));
    CHECK((fcntl(descriptor.number(), F_GETFD) & FD_CLOEXEC) != 0);
  }
}

TEST_CASE("A channel with nothing to read gives nothing, at once", "[supervisor][channel]") {
  Both both;
  const auto nothing = both.host.receive();
  REQUIRE(nothing);
  CHECK_FALSE(nothing->has_value());
  CHECK(both.host.wait_for_message(10ms).error().code == Code::deadline_exceeded);
}

TEST_CASE("A message of any length arrives whole and in order", "[supervisor][channel]") {
  Both both;
  const std::size_t kFirst = kPacketBytes - 19;  // the tag and the head take 19 bytes
  const std::vector<std::size_t> lengths{0, 1, kFirst - 1, kFirst, kFirst + 1, 2 * kPacketBytes, 3 << 20, 5};
  std::thread writer([&] {
    for (std::size_t i = 0; i < lengths.size(); ++i)
      (void)both.supervisor.send(message_of(lengths[i], i + 1), kLongTransfer);
  });
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const auto arrived = both.host.wait_for_message(kLongTransfer);
    CHECK(arrived.has_value());
    CHECK((arrived && arrived->request == i + 1 && arrived->body == bytes_of(lengths[i])));
  }
  writer.join();
}

TEST_CASE("More descriptors than a packet takes arrive with their message", "[supervisor][channel]") {
  const std::size_t before = test::open_descriptors();
  {
    Both both;
    REQUIRE(both.supervisor.post(with_descriptors(2 * kPacketDescriptors + 1)).ok());
    const auto arrived = both.host.wait_for_message(kLongTransfer);
    REQUIRE(arrived);
    CHECK(arrived->descriptors.size() == 2 * kPacketDescriptors + 1);
    CHECK(std::ranges::all_of(arrived->descriptors, is_null_device));
  }
  CHECK(test::open_descriptors() == before);
}

TEST_CASE("A message that no channel carries is refused", "[supervisor][channel]") {
  Both both;
  CHECK(both.supervisor.post(message_of(kLongestBody + 1)).error().code == Code::invalid_argument);
  CHECK(both.supervisor.post(message_of(1)).ok());
  CHECK(both.host.wait_for_message(kLongTransfer)->body.size() == 1);
}

TEST_CASE("A peer that does not read is never waited for, and nothing that was taken is lost",
          "[supervisor][channel]") {
  Both both;
  Status posted;
  std::uint64_t taken = 0;
  while ((posted = both.supervisor.post(message_of(100'000, taken + 1))).ok()) REQUIRE(++taken < 1000);
  CHECK(posted.error().code == Code::deadline_exceeded);
  CHECK(taken * 100'000 > Channel::kDefaultBound);
  CHECK(both.supervisor.has_unsent());
  for (std::uint64_t i = 0; i < taken; ++i) {
    REQUIRE(both.supervisor.flush().ok());
    const auto arrived = both.host.wait_for_message(kLongTransfer);
    REQUIRE(arrived);
    CHECK(arrived->request == i + 1);
  }
  CHECK_FALSE(both.supervisor.has_unsent());
  CHECK(both.supervisor.post(message_of(1)).ok());
}

TEST_CASE("send() waits for a slow peer, but not beyond its limit", "[supervisor][channel]") {
  Both both;
  CHECK(both.supervisor.send(message_of(2 << 20), 20ms).error().code == Code::deadline_exceeded);
  std::thread reader([&] {
    std::this_thread::sleep_for(50ms);
    CHECK(both.host.wait_for_message(kLongTransfer)->body.size() == 2 << 20);
    CHECK(both.host.wait_for_message(kLongTransfer)->body.size() == 1);
  });
  CHECK(both.supervisor.send(message_of(1), kLongTransfer).ok());
  CHECK_FALSE(both.supervisor.has_unsent());
  reader.join();
}

TEST_CASE("What a peer has sent before it went is still read", "[supervisor][channel]") {
  SocketPair pair = *make_socket_pair();
  Channel supervisor(std::move(pair.supervisor));
  std::optional<Channel> host(std::in_place, std::move(pair.host));
  const bool reads_all = GENERATE(true, false);  // a peer that goes with unread data resets the connection
  REQUIRE(supervisor.post(message_of(1)).ok());
  if (reads_all) REQUIRE(host->wait_for_message(kLongTransfer));
  REQUIRE(host->post(message_of(3)).ok());
  host.reset();
  CHECK(supervisor.wait_for_message(kLongTransfer)->body.size() == 3);
  CHECK(supervisor.wait_for_message(kLongTransfer).error().code == Code::unavailable);
  CHECK(supervisor.receive().error().code == Code::unavailable);
  CHECK(supervisor.post(message_of(1)).error().code == Code::unavailable);
  CHECK_FALSE(supervisor.has_unsent());
}

TEST_CASE("A failed post() does not hide what has arrived", "[supervisor][channel]") {
  SocketPair pair = *make_socket_pair();
  Channel supervisor(std::move(pair.supervisor));
  REQUIRE(Channel(std::move(pair.host)).post(message_of(3)).ok());
  CHECK(supervisor.post(message_of(1)).error().code == Code::unavailable);
  CHECK(supervisor.wait_for_message(kLongTransfer)->body.size() == 3);
}

TEST_CASE("Impossible packets cut the channel off, and their descriptors are closed",
          "[supervisor][channel]") {
  const std::size_t before = test::open_descriptors();
  {
    Half half;
    Message message = with_descriptors(1);
    auto small = (*split(with_descriptors(1))).front().bytes;
    message.body.resize(2 * kPacketBytes);
    auto packets = *split(std::move(message));
    auto first = packets[0].bytes, next = packets[1].bytes;
    const auto with = [](std::vector<std::byte> bytes, std::size_t at, int value) {
      bytes.at(at) = static_cast<std::byte>(value);
      return bytes;
    };
    const auto shorter = [](std::vector<std::byte> bytes, std::size_t size) {
      return bytes.resize(size), bytes;
    };
    const auto [wrong, last] = GENERATE_COPY(table<std::string, std::vector<std::byte>>({
        {"begins with a later packet", next},
        {"has an unknown tag", with(first, 0, 0x55)},
        {"has an incomplete head", shorter(first, 18)},
        {"announces 4 GB", with(first, 12, 0xFF)},
        {"announces 4 billion descriptors", with(first, 16, 0xFF)},
        {"announces a descriptor that is not there", with(first, 13, 2)},
        {"has a byte more than it announces", shorter(small, 30)},
        {"is too short", shorter(first, kPacketBytes - 1)},
        {"is too long", shorter(first, kPacketBytes + 1)},
        {"is far too long", shorter(first, kPacketBytes + 20'000)},
    }));
    INFO(wrong);
    const Descriptor sent = null_device();
    half.raw(last, sent.number());
    const auto error = half.channel.wait_for_message(kLongTransfer).error();
    CHECK(error.code == Code::data_loss);
    half.raw(first);
    CHECK(half.channel.receive().error().message == error.message);
  }
  CHECK(test::open_descriptors() == before);
}

TEST_CASE("A first packet where a later one is due cuts the channel off", "[supervisor][channel]") {
  Half half;
  const auto packets = *split(message_of(2 * kPacketBytes));
  half.raw(packets[0].bytes);
  half.raw(packets[0].bytes);
  CHECK(half.channel.wait_for_message(kLongTransfer).error().code == Code::data_loss);
}

TEST_CASE("A receiver without free descriptors reports it and leaks none", "[supervisor][channel]") {
  Both both;
  REQUIRE(both.supervisor.post(with_descriptors(20)).ok());
  const std::size_t before = test::open_descriptors();
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  const rlimit few{before + 5, limit.rlim_max};
  setrlimit(RLIMIT_NOFILE, &few);
  const auto arrived = both.host.receive();
  setrlimit(RLIMIT_NOFILE, &limit);
  REQUIRE_FALSE(arrived);
  CHECK(arrived.error().code == Code::data_loss);
  CHECK(test::open_descriptors() == before);
}

TEST_CASE("Random packets never crash the receiver and leave no descriptor open", "[supervisor][channel]") {
  const std::size_t before = test::open_descriptors();
  std::mt19937 random(20261122);
  for (int run = 0; run < 2000; ++run) {
    Half half;
    const Descriptor sent = null_device();
    auto packets = *split(with_descriptors(random() % 3));
    for (Packet& packet : packets) {
      for (auto flips = random() % 4; flips > 0; --flips)
        packet.bytes[random() % packet.bytes.size()] = static_cast<std::byte>(random());
      if (random() % 4 == 0) packet.bytes.resize(random() % (packet.bytes.size() + 2));
      half.raw(packet.bytes, random() % 2 == 0 ? sent.number() : -1);
    }
    while (true) {
      const auto message = half.channel.receive();
      if (!message || !*message) break;
    }
  }
  CHECK(test::open_descriptors() == before);
}

TEST_CASE("Messages of several threads stay whole", "[supervisor][channel]") {
  Both both;
  constexpr int kThreads = 4, kEach = 50;
  std::vector<std::thread> writers;
  for (std::uint64_t i = 1; i <= kThreads; ++i)
    writers.emplace_back([&both, i] {
      for (int n = 0; n < kEach; ++n) {
        Message message{Kind::logged, i, std::vector<std::byte>(200'000, static_cast<std::byte>(i)), {}};
        (void)both.host.send(std::move(message), kLongTransfer);
      }
    });
  int whole = 0;
  for (int n = 0; n < kThreads * kEach; ++n) {
    const auto message = both.supervisor.wait_for_message(kLongTransfer);
    if (!message) break;
    const auto expected = static_cast<std::byte>(message->request);
    whole += message->body.size() == 200'000 &&
             std::ranges::all_of(message->body, [&](std::byte byte) { return byte == expected; });
  }
  for (auto& writer : writers) writer.join();
  CHECK(whole == kThreads * kEach);
}
