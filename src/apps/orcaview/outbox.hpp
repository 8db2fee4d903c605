// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orca/supervisor/control.hpp"

namespace orca::view {

/// A frame to a page: a text, bytes, or an object that all pages share.
struct Frame {
  enum class Kind { text, bytes, object };
  Kind kind = Kind::text;
  std::string text{};                                  ///< Or bytes.
  std::shared_ptr<const supervisor::Tapped> passed{};  ///< The object.
  std::uint32_t look = 0;                              ///< That it is for.
  std::uint32_t left_out = 0;                          ///< Objects of this look that were not sent, so far.
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
  static constexpr std::size_t kMostBytes =
      std::size_t{4} << 20;  ///< [bytes] of objects, of all looks together, but for one that is alone.

  /// Adds an answer.
  /// @return whether there is room. If not, the page does not read, and should be closed.
  bool add(std::string text);
  /// As add(), for a message that is no text.
  bool add_bytes(std::string bytes);

  /// Begins to take objects.
  /// @param interval  least time between two of them that go out; 0: all that there is room for.
  void begin(std::uint32_t look, std::chrono::nanoseconds interval);
  void end(std::uint32_t look);
  /// Adds an object that a look has seen, and drops the oldest for which there is no room.
  void add_object(std::uint32_t look, std::shared_ptr<const supervisor::Tapped> passed);

  /// Drops all objects that wait, because they hold no more.
  void forget_objects();

  /// Takes the next frame: answers first, then the look that waits longest.
  std::optional<Frame> take(Moment now);
  /// Returns when there will be a frame to take; nothing if none waits.
  [[nodiscard]] std::optional<Moment> due() const;

  [[nodiscard]] bool has_answers() const { return !answers_.empty(); }
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
  bool add(Frame frame);
  void drop_oldest(Look& look);
  [[nodiscard]] std::size_t waiting_objects() const;
  [[nodiscard]] Look& heaviest();

  std::deque<Frame> answers_;
  std::map<std::uint32_t, Look> looks_;
  std::size_t answer_bytes_ = 0;
  std::size_t object_bytes_ = 0;
  std::uint64_t dropped_ = 0;
};

/// Appends a number to the bytes of a frame, as it is in memory.
template <class Number>
void append(std::string& bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

/// Returns what stands before an object in a frame to a page: 32 bytes, little-endian (docs/orcaview-messages.md).
[[nodiscard]] std::string object_head(const Frame& frame);
/// The same for the reply to a question.
[[nodiscard]] std::string reply_head(std::uint32_t id);

}  // namespace orca::view
