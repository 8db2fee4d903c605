// SPDX-License-Identifier: GPL-3.0-or-later
#include "frame_splitter.hpp"

#include <catch2/catch.hpp>

#include <vector>

using namespace orca;
using namespace orca::bytes;
using namespace orca::frames;

TEST_CASE("frames are found in a stream of any portions", "[patterns][bytes]") {
  std::vector<std::byte> stream;
  for (std::uint64_t number = 1; number <= 5; ++number) {
    Frame frame(FrameKind::detach, number);
    frame.add(std::string(number * 10, 'x'));
    const auto bytes = in_stream(frame);
    stream.insert(stream.end(), bytes.begin(), bytes.end());
  }
  for (std::size_t portion = 1; portion <= stream.size(); ++portion) {
    FrameSplitter splitter;
    std::vector<std::uint64_t> numbers;
    for (std::size_t at = 0; at < stream.size(); at += portion) {
      splitter.append(std::span(stream).subspan(at, std::min(portion, stream.size() - at)));
      for (auto frame = splitter.next(); frame.value().has_value(); frame = splitter.next())
        numbers.push_back(FrameReader(**frame).number());
    }
    CHECK(numbers == std::vector<std::uint64_t>{1, 2, 3, 4, 5});
  }
}

TEST_CASE("a length that no frame has is an error", "[patterns][bytes]") {
  for (const std::uint32_t length : {0U, 8U, 0xffffffffU}) {
    FrameSplitter splitter;
    splitter.append(std::as_bytes(std::span(&length, 1)));
    const auto frame = splitter.next();
    REQUIRE_FALSE(frame.has_value());
    CHECK(frame.error().code == Code::data_loss);
  }
}
