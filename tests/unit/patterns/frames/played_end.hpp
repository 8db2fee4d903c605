// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "frames/frame_end.hpp"

namespace orca::test {

/// What a test and the end that it plays have in common.
struct Played {
  std::vector<frames::Frame> sent;           ///< What went to the peer.
  std::vector<frames::Loss> losses;          ///< Whether each of these might have been dropped.
  std::vector<frames::Caller> callers;       ///< Who sent each of these.
  frames::Sent outcome = frames::Sent::yes;  ///< Of what is sent from now on.
  int too_large = 0;                         ///< So many frames from now on are too large.
  bool is_cut = false;
  frames::FrameHandlers handlers{};
  frames::Traffic traffic{};

  /// Lets the peer send a frame.
  Status say(const frames::Frame& frame) const {
    std::vector<std::byte> bytes;
    frame.append_to(bytes);
    frames::FrameReader reader(bytes);
    return handlers.receive(reader);
  }
  /// Returns the kinds of what was sent since the last time.
  [[nodiscard]] std::vector<frames::FrameKind> kinds() {
    std::vector<frames::FrameKind> kinds;
    for (const frames::Frame& frame : std::exchange(sent, {})) kinds.push_back(frame.kind());
    losses.clear();
    callers.clear();
    return kinds;
  }
};

/// One end of a link without a transport.
class PlayedEnd final : public frames::FrameEnd {
 public:
  explicit PlayedEnd(Played& played) : played_(played) {}

  void start(frames::FrameHandlers handlers) override { played_.handlers = std::move(handlers); }
  void stop() override { played_.handlers = {}; }
  frames::Sent send(const frames::Frame& frame, frames::Loss loss, frames::Caller caller) override {
    if (played_.too_large > 0) return --played_.too_large, frames::Sent::too_large;
    if (played_.outcome != frames::Sent::yes) return played_.outcome;
    played_.sent.push_back(frame);
    played_.losses.push_back(loss);
    played_.callers.push_back(caller);
    return frames::Sent::yes;
  }
  [[nodiscard]] bool is_cut() const override { return played_.is_cut; }
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] frames::Traffic& traffic() const override { return played_.traffic; }

 private:
  Played& played_;
  const std::string name_ = "a.out to b.in";
};

/// Makes a frame with numbers.
inline frames::Frame frame_of(frames::FrameKind kind, std::uint64_t number,
                              const std::vector<std::uint64_t>& numbers = {}) {
  frames::Frame frame(kind, number);
  for (const std::uint64_t one : numbers) frame.add(one);
  return frame;
}

}  // namespace orca::test
