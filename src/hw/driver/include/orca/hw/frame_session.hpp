// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <utility>

#include "orca/hw/line_frames.hpp"
#include "orca/hw/line_session.hpp"

namespace orca::hw {

/// The conversation with a device that sends frames by itself. It needs to be asked nothing: it is known when the first good frame
/// has come.
///
/// Thread contract: as LineSession.
class FrameSession final : public LineSession {
 public:
  /// A function that takes a frame. @param sent  when its first byte left the device.
  using Take = std::function<void(const framing::Frame& frame, TimePoint sent)>;

  /// @param link  outlives the object. @pre  as for framing::Scanner.
  FrameSession(link::ByteLink& link, const framing::Protocol& protocol, Take take)
      : link_(link), protocol_(protocol), take_(std::move(take)) {}

  Status begin(TimePoint now) override;
  /// @errors  not_found if no good frame has come within 2 s; those of the link.
  Result<bool> advance(TimePoint now) override;
  [[nodiscard]] TimePoint next() const override { return begun_ + kPatience; }
  [[nodiscard]] LineCounts counts() const override { return counts_of(frames_.statistics()); }

  /// Reads what there is, and hands out the frames that it completes.
  /// @errors  those of the link.
  Status read(TimePoint now) { return frames_.read(link_, now, take_); }

 private:
  static constexpr Duration kPatience = std::chrono::seconds(2);

  link::ByteLink& link_;
  const framing::Protocol protocol_;
  const Take take_;
  LineFrames frames_{protocol_};
  TimePoint begun_{};
};

}  // namespace orca::hw
