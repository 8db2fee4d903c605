// SPDX-License-Identifier: GPL-3.0-or-later
#include "byte_queue.hpp"

#include <catch2/catch.hpp>

#include <thread>

using namespace orca::bytes;

namespace {

std::vector<std::byte> numbered_bytes(std::size_t first, std::size_t count) {
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i < count; ++i) bytes.push_back(static_cast<std::byte>((first + i) % 251));
  return bytes;
}

std::vector<std::byte> take(ByteQueue& queue, std::size_t most) {
  std::vector<std::byte> bytes(most);
  bytes.resize(queue.read(bytes));
  return bytes;
}

}  // namespace

TEST_CASE("a byte queue takes what it has room for and gives it back in order, around its end too",
          "[patterns][bytes]") {
  ByteQueue queue(10);
  std::size_t written = 0;
  std::size_t read = 0;
  for (int lap = 0; lap < 20; ++lap) {
    CHECK(queue.write(numbered_bytes(written, 7)) == 7);
    written += 7;
    CHECK(queue.write(numbered_bytes(written, 7)) == 3);
    written += 3;
    CHECK(queue.write(numbered_bytes(written, 1)) == 0);
    CHECK(take(queue, 4) == numbered_bytes(read, 4));
    CHECK(take(queue, 100) == numbered_bytes(read + 4, 6));
    CHECK(take(queue, 100).empty());
    read += 10;
  }
}

TEST_CASE("one thread may write to a byte queue while another reads", "[patterns][bytes]") {
  constexpr std::size_t kCount = 200'000;
  ByteQueue queue(64);
  std::thread writer([&] {
    for (std::size_t sent = 0; sent < kCount;)
      sent += queue.write(numbered_bytes(sent, std::min<std::size_t>(37, kCount - sent)));
  });
  bool in_order = true;
  for (std::size_t got = 0; got < kCount;) {
    const auto bytes = take(queue, 23);
    in_order = in_order && bytes == numbered_bytes(got, bytes.size());
    got += bytes.size();
  }
  writer.join();
  CHECK(in_order);
}
