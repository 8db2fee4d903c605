// SPDX-License-Identifier: LGPL-3.0-or-later
#include "line.hpp"

#include <algorithm>
#include <random>
#include <utility>

#include "orca/base/log.hpp"

namespace orca::dds {

using frames::Loss;
using frames::Sent;

namespace {

constexpr std::size_t kWindow = std::size_t{4}
                                << 20;  // [bytes] unacknowledged, above which what may be is refused
constexpr std::size_t kMostUnsent = std::size_t{64} << 20;   // [bytes]
constexpr std::size_t kLargest = std::size_t{32} << 20;      // [bytes] of a parcel
constexpr std::size_t kRepeatAtOnce = std::size_t{1} << 20;  // [bytes]
constexpr std::size_t kMostEarly = 256;                      // parcels

// Ticks.
constexpr std::uint32_t kFirstPatience = 3;
constexpr std::uint32_t kMostPatience = 25;
constexpr std::uint32_t kHeartbeat = 2;
constexpr std::uint32_t kEager = 100;  // greets at each tick; later more rarely
constexpr std::uint32_t kRare = 5;
constexpr std::size_t kMostUnclaimed = std::size_t{1}
                                       << 20;  // [bytes] of parcels for ends that are not there yet

std::uint64_t random_number() {
  std::random_device device;
  return std::uniform_int_distribution<std::uint64_t>(1)(device);  // 0 is no number of a process
}

}  // namespace

Line::Line(std::string peer, const Settings& settings, Write write)
    : peer_name_(std::move(peer)),
      settings_(settings),
      write_(std::move(write)),
      own_(random_number()),
      patience_(kFirstPatience) {}

void Line::add(std::uint64_t edge, Passenger& passenger) {
  const MutexLock lock(mutex_);
  passengers_[edge] = &passenger;
  removed_.erase(edge);
  passenger.boarded(session_);
  waiting_bytes_ = 0;
  for (std::vector<std::byte>& parcel : std::exchange(waiting_, {})) dispatch(parcel);
}

void Line::remove(std::uint64_t edge) {
  const MutexLock lock(mutex_);
  passengers_.erase(edge);
  removed_.insert(edge);
  if (peer_ != 0) (void)send_locked(begin_parcel(edge, Parcel::closed), Loss::never);
}

bool Line::is_peer(const Origin& origin) const {
  const MutexLock lock(mutex_);
  return peer_ != 0 && origin == origin_;
}

bool Line::is_joined() const {
  const MutexLock lock(mutex_);
  return peer_ != 0;
}

// --- Sending ----------------------------------------------------------------------------------------------

Sent Line::send(std::vector<std::byte> parcel, std::uint64_t session, Loss loss, By by) {
  const MutexLock lock(mutex_);
  return session == session_ ? send_locked(std::move(parcel), loss, by) : Sent::cut;
}

void Line::send_now(std::vector<std::byte> parcel) {
  const MutexLock lock(mutex_);
  (void)send_locked(std::move(parcel), Loss::never);
}

Sent Line::send_locked(std::vector<std::byte> parcel, Loss loss, By by) {
  if (parcel.size() > kLargest) return Sent::too_large;
  if (loss == Loss::allowed && unacknowledged_bytes_ > kWindow) return Sent::no_room;
  unacknowledged_bytes_ += parcel.size();
  unacknowledged_.push_back({++sent_, std::move(parcel)});
  if (peer_ != 0) write(sent_, unacknowledged_.back().parcel, peer_, by);
  return Sent::yes;
}

void Line::write(std::uint64_t sequence, std::span<const std::byte> parcel, std::uint64_t to, By by) {
  quiet_ = 0;
  owes_receipt_ = false;
  write_(encode({settings_.own_id, own_, to, sequence, received_, parcel}), by);
}

// Writes again what was not acknowledged, the oldest first.
void Line::repeat() {
  std::size_t bytes = 0;
  for (const Sending& sending : unacknowledged_) {
    if (bytes > kRepeatAtOnce) break;
    bytes += sending.parcel.size();
    write(sending.sequence, sending.parcel, peer_, By::next);
  }
}

// --- Receiving --------------------------------------------------------------------------------------------

void Line::receive(const Message& message, const Origin& origin) {
  const MutexLock lock(mutex_);
  if (message.own == former_) return;
  if (peer_ != 0 && origin != origin_) return note_stranger(message);
  if (message.peer != own_) return greet(message.own);  // it does not know this side, or no longer
  if (message.own != peer_) meet(message, origin);
  silent_ = 0;
  take_receipt(message.received);
  if (message.sequence != 0) take_parcel(message);
}

// Another participant speaks in the peer's name. A process that was started again may do so; it is met when the one before it
// is lost, which does not take long. Whoever else does so wants to give orders in its place.
void Line::note_stranger(const Message& message) {
  if (message.own != peer_ || std::exchange(is_impersonated_, true)) return;
  log::warning(peer_name_,
               "another program in the network speaks in its name over DDS; nothing of that is believed");
}

// A process has echoed this side's number, so it is alive.
void Line::meet(const Message& message, const Origin& origin) {
  const bool is_first = session_ == 1 && peer_ == 0;
  if (peer_ != 0)
    end_session(fail(Code::unavailable, "process " + peer_name_ + " was replaced by a new one"));
  former_ = std::exchange(peer_, message.own);
  origin_ = origin;
  alone_ = 0;
  repeat();  // what has waited for it
  greet(peer_);
  if (is_first) return;
  for (const auto& [edge, passenger] : passengers_) passenger->line_joined(session_);
}

void Line::take_receipt(std::uint64_t received) {
  if (received > sent_) return;  // it makes no sense
  while (!unacknowledged_.empty() && unacknowledged_.front().sequence <= received) {
    unacknowledged_bytes_ -= unacknowledged_.front().parcel.size();
    unacknowledged_.pop_front();
    patience_ = kFirstPatience;
  }
}

void Line::take_parcel(const Message& message) {
  owes_receipt_ = true;
  if (message.sequence <= received_) return;  // known already
  if (message.sequence != received_ + 1) {    // one before it was lost, and will be repeated
    if (early_.size() < kMostEarly)
      early_.try_emplace(message.sequence, message.parcel.begin(), message.parcel.end());
    return;
  }
  ++received_;
  dispatch(message.parcel);
  dispatch_early();
}

void Line::dispatch_early() {
  for (auto next = early_.begin(); next != early_.end() && next->first <= received_ + 1;
       next = early_.erase(next)) {
    if (next->first <= received_) continue;
    ++received_;
    dispatch(next->second);
  }
}

void Line::dispatch(std::span<const std::byte> parcel) {
  const auto open = open_parcel(parcel);
  if (!open) return;
  const auto passenger = passengers_.find(open->edge);
  if (passenger != passengers_.end()) return passenger->second->arrived(open->kind, open->contents);
  if (removed_.contains(open->edge) || waiting_bytes_ + parcel.size() > kMostUnclaimed) return;
  waiting_bytes_ += parcel.size();
  waiting_.emplace_back(parcel.begin(), parcel.end());
}

// --- Losing the peer --------------------------------------------------------------------------------------

void Line::lose(const Error& reason) {
  const MutexLock lock(mutex_);
  if (peer_ == 0) return;
  end_session(reason);
  own_ = random_number();
  peer_ = 0;
}

void Line::end_session(const Error& reason) {
  log::info(peer_name_, "its link over DDS is lost: " + reason.message);
  ++session_;
  unacknowledged_.clear();
  unacknowledged_bytes_ = 0;
  sent_ = received_ = 0;
  early_.clear();
  waiting_.clear();
  waiting_bytes_ = 0;
  owes_receipt_ = false;
  silent_ = unanswered_ = 0;
  patience_ = kFirstPatience;
  for (const auto& [edge, passenger] : passengers_) passenger->line_lost(reason);
}

void Line::tick() {
  {
    const MutexLock lock(mutex_);
    if (peer_ == 0) return tick_alone();
    tick_joined();
    if (silent_ * kTick <= settings_.liveliness && unacknowledged_bytes_ <= kMostUnsent) return;
  }
  lose(fail(Code::unavailable, "process " + peer_name_ + " has given no sign of life for " +
                                   std::to_string(settings_.liveliness / 1ms) + " ms"));
}

void Line::greet_if_alone() {
  const MutexLock lock(mutex_);
  if (peer_ == 0) greet(0);
}

void Line::tick_alone() {
  if (++alone_ < kEager || alone_ % kRare == 0) greet(0);
}

void Line::tick_joined() {
  ++silent_;
  watch_receipts();
  if (owes_receipt_ || ++quiet_ >= kHeartbeat) greet(peer_);
}

void Line::watch_receipts() {
  const std::uint64_t oldest = unacknowledged_.empty() ? 0 : unacknowledged_.front().sequence;
  if (oldest == 0 || std::exchange(oldest_, oldest) != oldest) {
    unanswered_ = 0;
    return;
  }
  if (++unanswered_ < patience_) return;
  unanswered_ = 0;
  patience_ = std::min(2 * patience_, kMostPatience);
  repeat();
}

}  // namespace orca::dds
