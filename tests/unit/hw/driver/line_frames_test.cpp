// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/line_frames.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <deque>
#include <vector>

#include "orca/hw/framing/scanner.hpp"

using namespace orca;
using namespace orca::hw;
using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;
using framing::Finding;

namespace {

// A frame is A, two bytes, Z.
constexpr framing::Protocol kProtocol{.look = [](std::span<const std::uint8_t> bytes) -> Finding {
                                        if (bytes[0] != 'A') return {};
                                        if (bytes.size() < 4) return {Finding::Kind::need_more, 0};
                                        return bytes[3] == 'Z' ? Finding{Finding::Kind::frame, 4} : Finding{};
                                      },
                                      .longest = 4};

/// A line whose bytes come when a test says so. A read gives no more than one piece.
class Wire final : public link::ByteLink {
 public:
  explicit Wire(double byte_time) : byte_time_(byte_time) {}

  void bring(Bytes bytes) { pieces_.push_back(std::move(bytes)); }

  Result<link::Opening> open() override { return link::Opening::done; }
  void close() override {}
  Result<std::size_t> read(std::span<std::uint8_t> into) override {
    if (pieces_.empty()) return std::size_t{0};
    const Bytes piece = std::move(pieces_.front());
    pieces_.pop_front();
    std::ranges::copy(piece, into.begin());
    return piece.size();
  }
  Status write(std::span<const std::uint8_t> /*bytes*/) override { return ok(); }
  Status flush() override { return ok(); }
  [[nodiscard]] std::size_t pending() const override { return 0; }
  void discard_input() override {}
  void discard_output() override {}
  [[nodiscard]] int descriptor() const override { return -1; }
  [[nodiscard]] std::string name() const override { return "wire"; }
  [[nodiscard]] double byte_time() const override { return byte_time_; }

 private:
  const double byte_time_;
  std::deque<Bytes> pieces_;
};

constexpr TimePoint at(Duration time) { return TimePoint{} + 10s + time; }

// The times at which frames were sent, by what came at which times.
std::vector<Duration> sent(double byte_time, const std::vector<std::pair<Duration, std::string>>& pieces) {
  Wire wire(byte_time);
  LineFrames frames(kProtocol);
  std::vector<Duration> times;
  for (const auto& [time, text] : pieces) {
    wire.bring(Bytes(text.begin(), text.end()));
    REQUIRE(frames
                .read(wire, at(time),
                      [&](const framing::Frame&, TimePoint when) { times.push_back(when - at(0s)); })
                .ok());
  }
  return times;
}

}  // namespace

TEST_CASE("a frame was sent when its first byte came, however long the rest of it takes", "[line_frames]") {
  CHECK(sent(0.0, {{0ms, "A"}, {50ms, "b"}, {90ms, "cZ"}}) == std::vector<Duration>{0ms});
  CHECK(sent(0.001, {{0ms, "A"}, {50ms, "b"}, {90ms, "cZ"}}) == std::vector<Duration>{-1ms});
}

TEST_CASE("a frame that comes at once was sent the time before that its bytes take on the line",
          "[line_frames]") {
  CHECK(sent(0.001, {{0ms, "AbcZ"}}) == std::vector<Duration>{-4ms});
  CHECK(sent(0.0, {{0ms, "AbcZ"}}) == std::vector<Duration>{0ms});
  CHECK(sent(0.001, {{0ms, "AbcZAbcZ"}}) == std::vector<Duration>{-8ms, -4ms});
}

TEST_CASE("bytes that were read late were sent the time of a byte before those behind them",
          "[line_frames]") {
  CHECK(sent(0.001, {{0ms, "Abc"}, {1ms, "Z"}}) == std::vector<Duration>{-3ms});
  CHECK(sent(0.001, {{8ms, "A"}, {8ms, "bcZ"}}) == std::vector<Duration>{4ms});
}

TEST_CASE("each of many frames is timed by its own bytes", "[line_frames]") {
  std::vector<std::pair<Duration, std::string>> pieces;
  std::vector<Duration> expected;
  for (int i = 0; i < 100; ++i) {
    const Duration begin = i * 100ms;
    pieces.push_back({begin, "?A"});
    pieces.push_back({begin + 20ms, "b"});
    pieces.push_back({begin + 60ms, "cZ"});
    expected.push_back(begin);
  }
  CHECK(sent(0.0, pieces) == expected);
}

TEST_CASE("a frame within one that was cut short keeps its own time", "[line_frames]") {
  Wire wire(0.0);
  LineFrames frames(kProtocol);
  std::vector<Duration> times;
  const auto note = [&](const framing::Frame&, TimePoint when) { times.push_back(when - at(0s)); };
  wire.bring({'A'});
  REQUIRE(frames.read(wire, at(0s), note).ok());
  wire.bring({'A', 'b', 'c'});
  REQUIRE(frames.read(wire, at(30ms), note).ok());
  CHECK(times.empty());
  wire.bring({'Z'});
  REQUIRE(frames.read(wire, at(40ms), note).ok());
  CHECK(times == std::vector<Duration>{30ms});
  CHECK(frames.statistics().skipped_bytes == 1);
}
