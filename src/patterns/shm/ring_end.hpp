// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bulk_loans.hpp"
#include "frames/frame_end.hpp"
#include "orca/base/mutex.hpp"
#include "orca/base/strand.hpp"
#include "orca/patterns/shm/shm_edges.hpp"
#include "ring.hpp"

namespace orca::shm {

/// Which end of an edge: the client writes the first ring of a segment, the server the second.
enum class Side : std::size_t { client, server };

/// The ring that an end reads, and the bulk data that comes with it.
struct Incoming {
  Incoming(const RingSegment& segment, Side writer);
  void restart(const RingSegment& segment, Side writer);

  RingReader ring;
  Borrowing bulk;
};

/// The ring that an end writes, and the bulk data that it lends.
struct Outgoing {
  Outgoing(const RingSegment& segment, Side writer);
  void restart(const RingSegment& segment, Side writer);

  RingWriter ring;
  std::shared_ptr<Loans> bulk = Loans::make();
};

/// One end of a link through two rings. Frames are written straight into one of them, and read straight out of the
/// other. A peer that writes what cannot be, or does not read, is cut off.
///
/// Thread contract: as FrameEnd, ShmEnd and Intake. The handlers run in take_in(), one at a time.
class RingEnd final : public frames::FrameEnd, public Intake, public ShmEnd {
 public:
  /// @param strand  of the port; outlives the end.
  /// @param name    for people: "a.out to b.in".
  RingEnd(Side side, RingSegment segment, Strand& strand, ShmPeer peer, std::string name);
  ~RingEnd() override;

  void start(frames::FrameHandlers handlers) override;
  void stop() override;
  frames::Sent send(const frames::Frame& frame, frames::Loss loss = frames::Loss::never,
                    frames::Caller caller = frames::Caller::goes_on) override;
  [[nodiscard]] bool is_cut() const override { return cut_.load(std::memory_order_acquire); }
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] frames::Traffic& traffic() const override { return traffic_; }

  bool take_in() override;

  void cut(Error reason) override;
  void renew(RingSegment segment) override;
  [[nodiscard]] ShmCounters counters() const override;

 private:
  // An order of another thread.
  struct Change {
    Error reason;
    std::optional<RingSegment> segment;
    bool is_gone = false;  // the peer's process has ended
  };

  [[nodiscard]] bool has_news() const;
  bool apply_change();
  void replace(RingSegment segment);
  void receive_all();
  Status receive_frames();
  Status handle(std::span<const std::byte> record);
  void flush();
  void lose(const Error& reason);
  void cut_off(const Error& reason);
  [[nodiscard]] std::optional<Error> fault() const;
  [[nodiscard]] bool is_closed_by_peer() const { return incoming_.ring.is_closed(); }

  frames::Sent write_or_keep(const frames::Frame& frame, frames::Loss loss) ORCA_REQUIRES(mutex_);
  frames::Sent keep(const frames::Frame& frame) ORCA_REQUIRES(mutex_);
  bool write_unsent() ORCA_REQUIRES(mutex_);
  void note_fault(const Error& error) ORCA_REQUIRES(mutex_);
  void note_too_large() ORCA_REQUIRES(mutex_);

  const Side side_;
  Strand& strand_;
  const ShmPeer peer_;
  const std::string name_;
  mutable frames::Traffic traffic_;
  frames::FrameHandlers handlers_;
  RingSegment segment_;

  Mutex reading_;  // held by whoever takes in
  Incoming incoming_;
  std::atomic<bool> cut_{false};

  mutable Mutex mutex_;
  Outgoing outgoing_ ORCA_GUARDED_BY(mutex_);
  std::deque<std::vector<std::byte>> unsent_
      ORCA_GUARDED_BY(mutex_);  // frames that found no room yet, oldest first
  std::size_t unsent_bytes_ ORCA_GUARDED_BY(mutex_) = 0;
  std::optional<Error> fault_ ORCA_GUARDED_BY(mutex_);  // of the peer, noticed while writing
  bool warned_ ORCA_GUARDED_BY(mutex_) = false;         // of a frame that is too large
  std::atomic<bool> waits_{false};                      // something is unsent, or there is a fault

  Mutex change_mutex_;
  std::optional<Change> change_ ORCA_GUARDED_BY(change_mutex_);
  std::atomic<bool> is_to_change_{false};
};

}  // namespace orca::shm
