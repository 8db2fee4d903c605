// SPDX-License-Identifier: GPL-3.0-or-later
// What surrounds an end of an edge through DDS, without DDS: the test plays the other process and the topic.
#pragma once

#include <catch2/catch.hpp>

#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "dds/backend/line.hpp"
#include "dds/backend/outbox.hpp"
#include "dds/backend/push_ends.hpp"
#include "orca/base/executive.hpp"
#include "orca/base/strand.hpp"

namespace orca::test {

/// The origin of what the played peer writes, to its line and to the topic.
inline const dds::Origin kPeerOrigin{std::byte{2}};
inline constexpr std::uint64_t kPlayedEdge = 7;

/// A line whose peer the test plays, and the place of an end on it.
class PlayedPeer {
 public:
  /// A parcel that the end has sent.
  struct Said {
    dds::Parcel kind;
    std::vector<std::byte> contents;
    dds::By by;
  };

  explicit PlayedPeer(Executive& executive)
      : strand_(executive, {"end", 0}),
        line_("far", dds::Line::Settings{1, 10s},
              [this](const std::vector<std::byte>& bytes, dds::By by) { note(bytes, by); }) {}

  [[nodiscard]] dds::EndPlace place() { return {line_, outbox_, kPlayedEdge, strand_, "a.out to b.in"}; }
  [[nodiscard]] dds::Line& line() { return line_; }
  [[nodiscard]] dds::Outbox& outbox() { return outbox_; }
  [[nodiscard]] Strand& strand() { return strand_; }

  /// Lets the peer meet the line.
  /// @param number  under which it takes part; another one is another process.
  void meet(std::uint64_t number = 5) {
    if (std::exchange(number_, number) != number) sequence_ = 0;
    line_.greet_if_alone();
    send(0, {});
    REQUIRE(line_.is_joined());
  }

  /// Lets the peer send a parcel.
  void say(dds::Parcel kind, const std::vector<std::uint64_t>& numbers = {}) {
    std::vector<std::byte> parcel = dds::begin_parcel(kPlayedEdge, kind);
    for (const std::uint64_t number : numbers) dds::append(parcel, number);
    send(++sequence_, parcel);
  }
  void say(const frames::Frame& frame) {
    std::vector<std::byte> parcel = dds::begin_parcel(kPlayedEdge, dds::Parcel::frame);
    frame.append_to(parcel);
    send(++sequence_, parcel);
  }

  /// Returns what the end has sent since the last time.
  [[nodiscard]] std::vector<Said> heard() { return std::exchange(heard_, {}); }

 private:
  void note(const std::vector<std::byte>& bytes, dds::By by) {
    std::span<const std::byte> rest = bytes;
    const auto message = dds::take_message(rest);
    REQUIRE(message);
    own_ = message->own;
    if (message->sequence == 0 || message->peer == 0) return;
    const auto parcel = dds::open_parcel(message->parcel);
    REQUIRE(parcel);
    CHECK(parcel->edge == kPlayedEdge);
    heard_.push_back({parcel->kind, {parcel->contents.begin(), parcel->contents.end()}, by});
  }

  void send(std::uint64_t sequence, std::span<const std::byte> parcel) {
    const std::vector<std::byte> bytes = dds::encode({9, number_, own_, sequence, 0, parcel});
    std::span<const std::byte> rest = bytes;
    line_.receive(*dds::take_message(rest), kPeerOrigin);
  }

  Strand strand_;
  dds::Outbox outbox_{[] {}};
  std::uint64_t own_ = 0;
  std::uint64_t number_ = 0;
  std::uint64_t sequence_ = 0;
  std::vector<Said> heard_;
  dds::Line line_;
};

/// The topic's writer, which notes what it is given.
class NotedTopic final : public dds::TopicWriter {
 public:
  struct Object {
    ObjectRef object;
    std::size_t size;
    dds::Label label;
  };

  bool write(const ObjectRef& object, std::size_t size, const dds::Label& label) override {
    const std::lock_guard lock(mutex_);
    objects_.push_back({object, size, label});
    return true;
  }
  bool write(std::vector<std::byte> /*messages*/) override { return true; }

  /// @pre  the outbox has ended, or it is certain that it has written.
  [[nodiscard]] std::vector<Object> objects() const {
    const std::lock_guard lock(mutex_);
    return objects_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Object> objects_;
};

}  // namespace orca::test
