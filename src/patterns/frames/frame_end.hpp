// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "frame.hpp"
#include "orca/base/result.hpp"

namespace orca::frames {

/// The outcome of sending a frame.
enum class Sent {
  yes,        ///< It is on its way, or as soon as there is room.
  no_room,    ///< It was dropped, as it may be: there was no room.
  too_large,  ///< It was dropped, because it will never find room.
  cut,        ///< It was dropped, because the link is cut.
};

/// The permission to drop a frame for which the link has no room at present.
enum class Loss { never, allowed };

/// The caller's haste: one that waits for the outcome anyway lets the link spend the caller's time on the frame.
enum class Caller { goes_on, waits };

/// The functions that an end calls. None may block; no two run at the same time.
struct FrameHandlers {
  /// Handles a frame; an error cuts the peer off.
  std::function<Status(FrameReader&)> receive;
  /// Called once when the link is cut by either side. Nothing is received afterwards, unless it is renewed.
  std::function<void(const Error&)> cut;
  /// Called when a link that was cut has a new peer. The peer knows nothing of what was sent to the old one.
  std::function<void()> renewed;
};

/// The counters of ends of links: of all that share them.
struct Traffic {
  std::atomic<std::uint64_t> frames_received{0};
  std::atomic<std::uint64_t> objects_lost{0};
  std::atomic<std::uint64_t> peers_cut_off{0};
};

/// One end of a link that carries frames to and from a peer, by some kind of transport. A peer that sends
/// invalid data is cut off: nothing passes in either direction any more, and the event is counted and logged.
///
/// Thread contract: send(), is_cut() and name() from any thread; start() and stop() from one task.
class FrameEnd {
 public:
  virtual ~FrameEnd() = default;
  FrameEnd() = default;
  FrameEnd(const FrameEnd&) = delete;
  FrameEnd& operator=(const FrameEnd&) = delete;

  /// Starts to receive.
  virtual void start(FrameHandlers handlers) = 0;
  /// Ends receiving, and cuts the link. No handler runs afterwards.
  virtual void stop() = 0;

  /// Sends a frame, at once or as soon as the link has room.
  virtual Sent send(const Frame& frame, Loss loss = Loss::never, Caller caller = Caller::goes_on) = 0;

  [[nodiscard]] virtual bool is_cut() const = 0;
  /// Returns a name for people: "a.out to b.in".
  [[nodiscard]] virtual const std::string& name() const = 0;
  [[nodiscard]] virtual Traffic& traffic() const = 0;
};

}  // namespace orca::frames
