// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "frames/frame_end.hpp"
#include "line.hpp"
#include "orca/base/mutex.hpp"
#include "orca/base/strand.hpp"
#include "outbox.hpp"

namespace orca::dds {

/// The place of an end: its edge, the line to the process at the other end, and its port.
struct EndPlace {
  Line& line;
  Outbox& outbox;                           ///< The line's.
  std::uint64_t edge;                       ///< The same number at both ends.
  Strand& strand;                           ///< The port's; outlives the end.
  std::string name;                         ///< For people: "a.out to b.in".
  std::function<Duration()> clock_ahead{};  ///< As in DdsPeer.
};

/// One end of an edge through DDS. Frames go as parcels of a line, and wait here until the strand of the port takes them
/// in. Events of the line wait in the same queue, so that the strand sees all in order.
///
/// Thread contract: as FrameEnd, Intake and Passenger. The handlers run in take_in(), one at a time.
class DdsEnd : public frames::FrameEnd, public Intake, public Passenger {
 public:
  explicit DdsEnd(EndPlace place);
  ~DdsEnd() override;

  void start(frames::FrameHandlers handlers) override;
  void stop() override;
  frames::Sent send(const frames::Frame& frame, frames::Loss loss = frames::Loss::never,
                    frames::Caller caller = frames::Caller::goes_on) override;
  [[nodiscard]] bool is_cut() const override { return cut_.load(std::memory_order_acquire); }
  [[nodiscard]] const std::string& name() const override { return place_.name; }
  [[nodiscard]] frames::Traffic& traffic() const override { return traffic_; }

  bool take_in() override;

  void arrived(Parcel kind, std::span<const std::byte> contents) override;
  void line_lost(const Error& reason) override;
  void line_joined(std::uint64_t session) override;
  void boarded(std::uint64_t session) override;

 protected:
  /// Lets the strand handle a frame.
  void deliver(std::vector<std::byte> frame);
  /// Returns whether so much waits for the strand that objects of Push are better dropped.
  [[nodiscard]] bool is_behind() const;
  [[nodiscard]] std::uint64_t session() const { return session_.load(std::memory_order_acquire); }
  [[nodiscard]] const EndPlace& place() const { return place_; }
  /// Returns the session of the line, which the strand may not know yet.
  [[nodiscard]] std::uint64_t line_session() const { return line_session_.load(std::memory_order_acquire); }

 private:
  // An event that waits for the strand.
  struct News {
    enum class What { frame, cut, joined, fault } what;
    std::vector<std::byte> frame{};
    Error reason{};
    std::uint64_t session = 0;
  };

  void add(News news);
  void take_news() ORCA_REQUIRES(reading_);
  void handle(const News& news);
  Status handle_frame(std::span<const std::byte> bytes);
  void begin_session(std::uint64_t session);
  void lose(const Error& reason);
  void cut_off(const Error& reason);

  const EndPlace place_;
  mutable frames::Traffic traffic_;
  frames::FrameHandlers handlers_;
  std::atomic<bool> cut_{false};
  std::atomic<bool> warned_{false};  // of a frame that is too large
  std::atomic<std::uint64_t> session_{0};
  std::atomic<std::uint64_t> line_session_{0};
  Mutex reading_;  // held by whoever takes in
  std::vector<News> taken_ ORCA_GUARDED_BY(reading_);

  mutable Mutex mutex_;
  std::vector<News> news_ ORCA_GUARDED_BY(mutex_);
  std::size_t waiting_bytes_ ORCA_GUARDED_BY(mutex_) = 0;
  std::atomic<bool> has_news_{false};
};

}  // namespace orca::dds
