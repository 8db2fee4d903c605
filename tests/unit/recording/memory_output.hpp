// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/recording/output.hpp"
#include "orca/recording/reader.hpp"
#include "orca/recording/writer.hpp"

namespace orca::test {

using Bytes = std::vector<std::byte>;

/// A recording in memory, with the pieces in which it was written.
struct Memory {
  Bytes bytes;
  std::vector<std::size_t> pieces;  ///< Sizes.
  bool is_finished = false;
  std::optional<std::size_t> room;  ///< Pieces that still fit; nothing: all.
};

class MemoryOutput final : public recording::Output {
 public:
  explicit MemoryOutput(Memory& to) : to_(to) {}
  Status append(std::vector<std::byte> piece) override {
    if (to_.room && to_.pieces.size() == *to_.room) return fail(Code::unavailable, "the disk is full");
    to_.bytes.insert(to_.bytes.end(), piece.begin(), piece.end());
    to_.pieces.push_back(piece.size());
    return ok();
  }
  Status finish() override {
    to_.is_finished = true;
    return ok();
  }

 private:
  Memory& to_;
};

inline std::unique_ptr<recording::Output> to(Memory& memory) {
  return std::make_unique<MemoryOutput>(memory);
}

inline std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

/// A message as a test compares it.
struct Seen {
  std::string topic;
  recording::Stamp log_time = 0;
  recording::Stamp publish_time = 0;
  std::uint32_t sequence = 0;
  std::string payload;
  friend bool operator==(const Seen&, const Seen&) = default;
};

inline std::vector<Seen> all_messages(const recording::Reader& reader,
                                      const std::set<std::uint16_t>& channels = {}) {
  std::vector<Seen> all;
  (void)reader.messages(channels, [&](const recording::Message& message) {
    const std::string payload(reinterpret_cast<const char*>(message.payload.data()), message.payload.size());
    all.push_back({reader.channels().at(message.channel).topic, message.log_time, message.publish_time,
                   message.sequence, payload});
    return true;
  });
  return all;
}

/// Writes `count` messages, 10 ms apart, in turn on the topics "/a" and "/b", whose payloads are their numbers.
inline void write_numbers(recording::Writer& writer, int count) {
  const std::uint16_t schema = writer.add_schema("orca/msg/Number", "ros2msg", "string text");
  const std::uint16_t channels[] = {writer.add_channel(schema, "/a", "cdr", {{"orca.port", "a.out"}}),
                                    writer.add_channel(schema, "/b", "cdr", {})};
  for (int i = 0; i < count; ++i) {
    const std::string payload = std::to_string(i);
    const auto time = static_cast<recording::Stamp>(i) * 10'000'000;
    (void)writer.write(
        {channels[i % 2], static_cast<std::uint32_t>(i / 2 + 1), time, time / 2, bytes_of(payload)});
  }
}

}  // namespace orca::test
