// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orca/supervisor/control.hpp"

namespace orca::view {

/// A frame to a page: a text, or a head and the bytes of an object that all pages share.
struct Frame {
  bool is_text = true;
  std::string head;
  std::shared_ptr<const supervisor::Tapped> passed{};  ///< Its object follows the head.
};

/// The frames that wait until a page takes them. Answers wait up to a bound; of the objects of a look only the newest do, so
/// that a page that stalls costs the same memory after an hour as after a second.
///
/// A plain value; time is an argument.
class Outbox {
 public:
  using Moment = std::chrono::steady_clock::time_point;
  static constexpr std::size_t kBound = std::size_t{8} << 20;  ///< [bytes] of answers.
  static constexpr std::size_t kMostObjects = 64;              ///< Of a look without a rate.
  static constexpr std::size_t kMostBytes = std::size_t{4}
                                            << 20;  ///< [bytes] of objects, of all looks together.

  /// Adds an answer.
  /// @return whether there is room. If not, the page does not read, and should be closed.
  bool add(std::string text);
  /// Adds the reply to a question. As add().
  bool add_reply(std::uint32_t id, std::shared_ptr<const supervisor::Tapped> reply);

  /// Begins to take objects.
  /// @param interval  least time between two of them that go out; 0: all that there is room for.
  void begin(std::uint32_t look, std::chrono::nanoseconds interval);
  void end(std::uint32_t look);
  /// Adds an object that a look has seen, and drops the oldest for which there is no room.
  void add_object(std::uint32_t look, std::shared_ptr<const supervisor::Tapped> passed);

  /// Takes the next frame: answers first, then the look that waits longest.
  std::optional<Frame> take(Moment now);
  /// Returns when there will be a frame to take; nothing if none waits.
  [[nodiscard]] std::optional<Moment> due() const;

  /// Returns how many objects were dropped because the page was slow.
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
  [[nodiscard]] std::size_t waiting_bytes() const { return answer_bytes_ + object_bytes_; }

 private:
  struct Look {
    std::chrono::nanoseconds interval{0};
    Moment due{};
    std::uint32_t left_out = 0;
    std::deque<std::shared_ptr<const supervisor::Tapped>> waiting{};
  };
  void drop_oldest(Look& look);

  std::deque<Frame> answers_;
  std::map<std::uint32_t, Look> looks_;
  std::size_t answer_bytes_ = 0;
  std::size_t object_bytes_ = 0;
  std::uint64_t dropped_ = 0;
};

/// Returns the head of a frame that carries an object: 32 bytes, little-endian.
/// @param kind      1: an object at a port, 2: the reply to a question.
/// @param left_out  objects that were not sent to the page.
[[nodiscard]] std::string object_head(std::uint8_t kind, std::uint32_t id, const supervisor::Tapped& passed,
                                      std::uint32_t left_out);

}  // namespace orca::view
