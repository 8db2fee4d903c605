// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "frames/frame_end.hpp"
#include "message.hpp"
#include "orca/base/mutex.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"

namespace orca::dds {

/// The participant that a message came from: the prefix of its DDS identity.
using Origin = std::array<std::byte, 12>;

/// The writer of a message: the thread that does so for all; the one that has it, as soon as it holds no lock; or the thread
/// for all when it next writes, a tick later at most, which saves waking it for each of many messages.
enum class By : std::uint8_t { outbox, caller, next };

/// Whoever is reached by a line: the end of an edge.
///
/// Thread contract: called by any thread, with the line's lock held: must not block, nor call the line.
class Passenger {
 public:
  virtual ~Passenger() = default;
  /// Learns the present session, before anything arrives.
  virtual void boarded(std::uint64_t session) = 0;
  /// Takes a parcel, in the order in which the peer's end has sent them.
  virtual void arrived(Parcel kind, std::span<const std::byte> contents) = 0;
  /// Learns that the peer is lost: nothing that was sent in the session and not answered will be.
  virtual void line_lost(const Error& reason) = 0;
  /// Learns that there is a peer again, which knows nothing of earlier sessions.
  virtual void line_joined(std::uint64_t session) = 0;
};

/// The parcels between two processes, all but the objects of Push: each arrives once and in order, whatever the network
/// does, or the line is lost.
///
/// Everybody in the network hears these numbers. So while there is a peer, a line believes its participant only, and no other
/// one that says what the peer would say next.
///
/// Both sides do the same. Each chooses a number at random and repeats it until the other has echoed it; only who has
/// echoed the present number is believed. So messages of a process that has ended mean nothing, however late they
/// arrive, and a process that has been started again is known by its new number. Parcels are numbered, and are repeated
/// until they are acknowledged. A session lasts until the peer is lost.
///
/// Thread contract: any thread.
class Line {
 public:
  /// Sends a message to the peer's process; may lose it. Called with the lock held: must not block.
  using Write = std::function<void(std::vector<std::byte> message, By by)>;

  struct Settings {
    std::uint64_t own_id = 0;    ///< Hash of this process's name.
    Duration liveliness{300ms};  ///< Without a sign of life for this long [s] the peer is lost.
  };

  /// The period in which tick() is to be called [s].
  static constexpr Duration kTick{20ms};

  /// @param peer  name of the other process.
  Line(std::string peer, const Settings& settings, Write write);

  /// Adds an end that has this number at both sides. It is called at once with the session, and with what the peer's end has
  /// sent so far: a peer may be met before all ends of this side are there.
  void add(std::uint64_t edge, Passenger& passenger);
  /// Removes an end. It is not called afterwards. The peer's end learns of it.
  void remove(std::uint64_t edge);

  /// Sends a parcel.
  /// @param session  for which it is meant: in another one it is not sent, but cut.
  frames::Sent send(std::vector<std::byte> parcel, std::uint64_t session,
                    frames::Loss loss = frames::Loss::never, By by = By::outbox);
  /// Sends a parcel in the present session, whichever it is.
  void send_now(std::vector<std::byte> parcel);

  /// Takes what has come from a process with the peer's name.
  void receive(const Message& message, const Origin& origin);
  /// Repeats what is due, and loses a peer that gives no sign of life. Called every kTick; time is counted in these calls,
  /// so that a process that was stopped for a while does not take its peers for lost.
  void tick();
  /// Greets the peer if it has not been met. Called when DDS has found it; tick() does the same, later.
  void greet_if_alone();
  /// Loses the peer, because the caller knows that it is gone. Without a peer it does nothing.
  void lose(const Error& reason);

  /// Returns whether the participant is the present peer's.
  [[nodiscard]] bool is_peer(const Origin& origin) const;
  [[nodiscard]] bool is_joined() const;
  /// Returns the name of the other process.
  [[nodiscard]] const std::string& peer() const { return peer_name_; }

 private:
  struct Sending {
    std::uint64_t sequence;
    std::vector<std::byte> parcel;
  };

  frames::Sent send_locked(std::vector<std::byte> parcel, frames::Loss loss, By by = By::outbox)
      ORCA_REQUIRES(mutex_);
  void note_stranger(const Message& message) ORCA_REQUIRES(mutex_);
  void meet(const Message& message, const Origin& origin) ORCA_REQUIRES(mutex_);
  void take_receipt(std::uint64_t received) ORCA_REQUIRES(mutex_);
  void take_parcel(const Message& message) ORCA_REQUIRES(mutex_);
  void dispatch_early() ORCA_REQUIRES(mutex_);
  void dispatch(std::span<const std::byte> parcel) ORCA_REQUIRES(mutex_);
  void end_session(const Error& reason) ORCA_REQUIRES(mutex_);
  void tick_joined() ORCA_REQUIRES(mutex_);
  void tick_alone() ORCA_REQUIRES(mutex_);
  void write(std::uint64_t sequence, std::span<const std::byte> parcel, std::uint64_t to, By by = By::outbox)
      ORCA_REQUIRES(mutex_);
  void greet(std::uint64_t to) ORCA_REQUIRES(mutex_) { write(0, {}, to); }
  void repeat() ORCA_REQUIRES(mutex_);
  void watch_receipts() ORCA_REQUIRES(mutex_);

  const std::string peer_name_;
  const Settings settings_;
  const Write write_;

  mutable Mutex mutex_;
  std::map<std::uint64_t, Passenger*> passengers_ ORCA_GUARDED_BY(mutex_);
  std::set<std::uint64_t> removed_ ORCA_GUARDED_BY(mutex_);  // edges whose late parcels mean nothing
  std::vector<std::vector<std::byte>> waiting_
      ORCA_GUARDED_BY(mutex_);  // parcels of edges that are not there yet
  std::size_t waiting_bytes_ ORCA_GUARDED_BY(mutex_) = 0;
  std::uint64_t session_ ORCA_GUARDED_BY(mutex_) = 1;
  std::uint64_t own_ ORCA_GUARDED_BY(mutex_);             // this side's number
  std::uint64_t peer_ ORCA_GUARDED_BY(mutex_) = 0;        // the peer's; 0: there is none
  std::uint64_t former_ ORCA_GUARDED_BY(mutex_) = 0;      // of the process that the peer has replaced
  Origin origin_ ORCA_GUARDED_BY(mutex_){};               // the peer's
  bool is_impersonated_ ORCA_GUARDED_BY(mutex_) = false;  // has been said
  std::deque<Sending> unacknowledged_ ORCA_GUARDED_BY(mutex_);
  std::size_t unacknowledged_bytes_ ORCA_GUARDED_BY(mutex_) = 0;
  std::uint64_t sent_ ORCA_GUARDED_BY(mutex_) = 0;      // sequence number of the last parcel
  std::uint64_t received_ ORCA_GUARDED_BY(mutex_) = 0;  // that of the peer, in order
  std::map<std::uint64_t, std::vector<std::byte>> early_
      ORCA_GUARDED_BY(mutex_);  // parcels behind one that is missing
  bool owes_receipt_ ORCA_GUARDED_BY(mutex_) = false;
  // Numbers of ticks.
  std::uint32_t silent_ ORCA_GUARDED_BY(mutex_) = 0;  // since the peer was heard
  std::uint32_t quiet_ ORCA_GUARDED_BY(mutex_) = 0;   // since anything was written
  std::uint32_t alone_ ORCA_GUARDED_BY(mutex_) = 0;   // since there is no peer
  // Since the oldest parcel became it, or was repeated.
  std::uint32_t unanswered_ ORCA_GUARDED_BY(mutex_) = 0;
  std::uint32_t patience_ ORCA_GUARDED_BY(mutex_);    // after which it is repeated
  std::uint64_t oldest_ ORCA_GUARDED_BY(mutex_) = 0;  // the sequence number of that parcel
};

}  // namespace orca::dds
