// SPDX-License-Identifier: GPL-3.0-or-later
// One direction of a link of bytes, and the thread that carries them.
#include "byte_wire.hpp"

#include <catch2/catch.hpp>

#include <ctime>
#include <functional>
#include <thread>
#include <vector>

#include "courier.hpp"
#include "executives.hpp"

using namespace orca;
using namespace orca::bytes;
using namespace orca::test;

namespace {

// Processor time that the whole process has used.
Duration processor_time() {
  timespec used{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec);
}

std::vector<std::byte> some_bytes(std::size_t count) { return std::vector<std::byte>(count, std::byte{7}); }

std::size_t read_all(ByteWire& wire) {
  std::vector<std::byte> to(100);
  return wire.read(to);
}

}  // namespace

TEST_CASE("a wire is carried only while there are bytes and room for them", "[patterns][bytes]") {
  Courier idle;  // serves no wire: the test carries
  ByteWire wire(idle, 8);
  CHECK_FALSE(wire.carry());
  CHECK(wire.write(some_bytes(6)) == 6);
  CHECK(wire.carry());
  CHECK_FALSE(wire.carry());
  CHECK(wire.write(some_bytes(6)) == 6);
  CHECK(wire.carry());  // two of them
  CHECK_FALSE(wire.carry());
  CHECK(read_all(wire) == 8);
  CHECK(wire.carry());
  CHECK(read_all(wire) == 4);
  CHECK_FALSE(wire.carry());
}

TEST_CASE("a wire that was closed takes nothing more, but gives what had arrived", "[patterns][bytes]") {
  Courier idle;
  ByteWire wire(idle, 8);
  CHECK_FALSE(wire.closed());
  CHECK(wire.write(some_bytes(3)) == 3);
  CHECK(wire.carry());
  wire.close();
  CHECK(wire.closed());
  CHECK(wire.write(some_bytes(3)) == 0);
  CHECK(read_all(wire) == 3);
}

TEST_CASE("a courier is woken for a single byte, and for the room of a single byte", "[patterns][bytes]") {
  Courier courier;
  const auto wire = std::make_shared<ByteWire>(courier, 1);
  courier.serve(wire);
  const auto in_time = [](const std::function<std::size_t()>& moved) {
    for (int i = 0; i < 5000; ++i) {
      if (moved() == 1) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  };
  // One byte each in the sender's queue, with the courier, and in the receiver's queue.
  for (int byte = 0; byte < 3; ++byte) REQUIRE(in_time([&] { return wire->write(some_bytes(1)); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  CHECK(wire->write(some_bytes(1)) == 0);
  for (int byte = 0; byte < 3; ++byte) CHECK(in_time([&] { return read_all(*wire); }));
}

TEST_CASE("a courier without anything to carry sleeps", "[patterns][bytes]") {
  Courier courier;
  const auto wire = std::make_shared<ByteWire>(courier, 64);
  courier.serve(wire);
  CHECK(wire->write(some_bytes(10)) == 10);
  std::size_t arrived = 0;
  for (int i = 0; i < 5000 && arrived < 10; ++i) {
    arrived += read_all(*wire);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  REQUIRE(arrived == 10);
  const Duration before = processor_time();
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  CHECK(processor_time() - before < std::chrono::milliseconds(40));
}
