// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include <poll.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "orca/hw/link/byte_link.hpp"
#include "orca/hw/link/memory_link.hpp"

namespace orca::test {

using Bytes = std::vector<std::uint8_t>;

/// Returns the characters of a text as bytes.
inline Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }
inline std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

/// The two ends of a line in memory that nothing else of this process has.
struct MemoryEnds {
  std::unique_ptr<hw::link::MemoryLink> driver;
  std::unique_ptr<hw::link::MemoryLink> device;
};
inline MemoryEnds make_memory_ends() {
  static int number = 0;
  const std::string name = "test_" + std::to_string(++number);
  using Options = hw::link::MemoryOptions;
  return {std::make_unique<hw::link::MemoryLink>(Options{.name = name, .end = Options::End::driver}),
          std::make_unique<hw::link::MemoryLink>(Options{.name = name, .end = Options::End::device})};
}

/// Repeats a question until the answer is yes, at most 5 s.
template <class Question>
[[nodiscard]] bool soon(const Question& question) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (!question()) {
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

/// Opens a link, or fails the test.
inline void must_open(hw::link::ByteLink& link) {
  const Status opened = hw::link::open_within(link, 5s);
  if (!opened.ok()) FAIL("cannot open: " << opened.error().text());
}

/// Writes all of the bytes, or fails the test.
inline void must_write(hw::link::ByteLink& link, const Bytes& bytes) {
  const Status written = link.write(bytes);
  if (!written.ok()) FAIL("cannot write: " << written.error().text());
}

/// Reads what is there, up to `most`; fails the test at an error.
inline Bytes read_some(hw::link::ByteLink& link, std::size_t most = 4096) {
  Bytes bytes(most);
  const Result<std::size_t> count = link.read(bytes);
  if (!count) FAIL("cannot read: " << count.error().text());
  bytes.resize(*count);
  return bytes;
}

/// Reads until there are so many bytes, at most 5 s.
inline Bytes read_bytes(hw::link::ByteLink& link, std::size_t count) {
  Bytes all;
  (void)soon([&] {
    const Bytes some = read_some(link, count - all.size());
    all.insert(all.end(), some.begin(), some.end());
    return all.size() == count;
  });
  return all;
}

/// Reads until that is an error, at most 5 s, and returns its code; Code::internal: there was none.
inline Code error_of_reading(hw::link::ByteLink& link) {
  Code code = Code::internal;
  Bytes bytes(64);
  (void)soon([&] {
    const Result<std::size_t> count = link.read(bytes);
    if (!count) code = count.error().code;
    return !count;
  });
  return code;
}

/// Writes a byte until that is an error, at most 5 s, and returns its code; Code::internal: there was none.
inline Code error_of_writing(hw::link::ByteLink& link) {
  Code code = Code::internal;
  (void)soon([&] {
    const Status written = link.write(bytes_of("x"));
    if (!written.ok()) code = written.error().code;
    return !written.ok();
  });
  return code;
}

/// Returns whether a descriptor becomes readable within a time.
inline bool is_readable(int descriptor, std::chrono::milliseconds limit) {
  pollfd asked{descriptor, POLLIN, 0};
  return poll(&asked, 1, static_cast<int>(limit.count())) > 0;
}

/// Checks what every closed link says.
inline void check_closed(hw::link::ByteLink& link) {
  Bytes bytes(8);
  const Result<std::size_t> read = link.read(bytes);
  REQUIRE_FALSE(read.has_value());
  CHECK(read.error().code == Code::failed_precondition);
  const Status written = link.write(bytes_of("x"));
  REQUIRE_FALSE(written.ok());
  CHECK(written.error().code == Code::failed_precondition);
  CHECK_FALSE(link.flush().ok());
  CHECK(link.pending() == 0);
  CHECK(link.descriptor() == -1);
  link.discard_input();
  link.discard_output();
}

}  // namespace orca::test
