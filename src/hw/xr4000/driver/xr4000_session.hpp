// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/line_frames.hpp"
#include "orca/hw/line_session.hpp"
#include "orca/hw/xr4000/answers.hpp"

namespace orca::hw::xr4000 {

/// The connection to the agent of an XR4000: finds out whether there is one, and then sends requests and takes their
/// answers, which come in the order of the requests.
///
/// What a line sends back to us (local echo) is ignored.
///
/// Thread contract: not synchronised; the container's strand.
/// @source  docs/hardware/xr4000.md
class XrSession final : public LineSession {
 public:
  /// A function that takes an answer, and when its first byte arrived. The answer is valid only during the call.
  using Take = std::function<void(const Message& answer, TimePoint stamp)>;

  /// @param link  outlives the object.
  explicit XrSession(link::ByteLink& link) : link_(link) {}

  Status begin(TimePoint now) override;
  /// @errors  those of LineSession; unavailable if it is an agent of another version or robot, or if its library has failed.
  Result<bool> advance(TimePoint now) override;
  /// Returns when the last request has waited too long for its answer; kForever if it was answered.
  [[nodiscard]] TimePoint next() const override { return asked_ ? deadline_ : kForever; }
  [[nodiscard]] LineCounts counts() const override { return counts_of(frames_.statistics()); }

  /// Reads what there is and hands out the answers. @pre  the agent has been found.
  /// @errors  those of the link.
  Status receive(TimePoint now, const Take& take);

  /// Returns whether requests may be sent: the last one was answered, or had waited too long when receive() was called.
  [[nodiscard]] bool is_free() const { return !asked_; }
  /// Sends a request, whose answer is awaited, behind those of the requests before it.
  /// @errors  those of ByteLink::write().
  Status ask(const Frame& request, TimePoint now);
  /// Sends a request whose answer is of no interest.
  Status tell(const Frame& request) { return link_.write(request.view()); }

 private:
  Status meet(const Message& answer);
  Status call(TimePoint now);
  [[nodiscard]] Error nobody() const;
  void take_frame(const framing::Frame& frame, TimePoint stamp, const Take& take);

  link::ByteLink& link_;
  LineFrames frames_{kProtocol};
  int tries_ = 0;
  bool found_ = false;
  bool echoes_ = false;  // something that we have sent came back
  std::optional<Type> asked_{};
  TimePoint deadline_{};
};

}  // namespace orca::hw::xr4000
