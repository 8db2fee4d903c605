// SPDX-License-Identifier: LGPL-3.0-or-later
#include "ring_end.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/log.hpp"

namespace orca::shm {

using namespace frames;

namespace {

constexpr std::size_t kMostUnsent = std::size_t{64} << 20;  // [bytes]

Ring ring_of(const RingSegment& segment, Side writer) {
  return ring_in(segment.memory().bytes(), static_cast<std::size_t>(writer));
}
LoanControl& loans_of(const RingSegment& segment, Side writer) {
  return loans_in(segment.memory().bytes(), static_cast<std::size_t>(writer));
}
Side other(Side side) { return side == Side::client ? Side::server : Side::client; }

}  // namespace

Incoming::Incoming(const RingSegment& segment, Side writer)
    : ring(ring_of(segment, writer)), bulk(segment.share(), loans_of(segment, writer)) {}

void Incoming::restart(const RingSegment& segment, Side writer) {
  ring.take_over(ring_of(segment, writer));
  bulk.restart(segment.share(), loans_of(segment, writer));
}

Outgoing::Outgoing(const RingSegment& segment, Side writer) : ring(ring_of(segment, writer)) {
  bulk->restart(segment.share(), loans_of(segment, writer));
}

void Outgoing::restart(const RingSegment& segment, Side writer) {
  ring = RingWriter(ring_of(segment, writer));
  bulk->restart(segment.share(), loans_of(segment, writer));
}

RingEnd::RingEnd(Side side, RingSegment segment, Strand& strand, ShmPeer peer, std::string name)
    : side_(side),
      strand_(strand),
      peer_(std::move(peer)),
      name_(std::move(name)),
      segment_(std::move(segment)),
      incoming_(segment_, other(side)),
      outgoing_(segment_, side) {}

RingEnd::~RingEnd() { stop(); }

void RingEnd::start(FrameHandlers handlers) {
  handlers_ = std::move(handlers);
  strand_.add_intake(*this);
}

void RingEnd::stop() {
  strand_.remove_intake(*this);
  const MutexLock reading(reading_);
  const MutexLock lock(mutex_);
  handlers_ = {};
  cut_ = true;
  outgoing_.ring.close();
  outgoing_.bulk->leave();
  ring(*peer_.doorbell);
}

// --- Writing ----------------------------------------------------------------------------------------------

Sent RingEnd::send(const Frame& frame, Loss loss, Caller /*caller*/) {
  Sent outcome = Sent::cut;
  {
    const MutexLock lock(mutex_);
    if (is_cut() || fault_) return Sent::cut;
    outcome = write_or_keep(frame, loss);
    outgoing_.bulk->settle(outcome == Sent::yes);
  }
  if (outcome == Sent::yes) ring(*peer_.doorbell);
  return outcome;
}

Sent RingEnd::write_or_keep(const Frame& frame, Loss loss) {
  if (!unsent_.empty()) return loss == Loss::allowed ? Sent::no_room : keep(frame);
  Loans* const bulk = outgoing_.bulk.get();
  const Result<Written> written =
      outgoing_.ring.write([&](std::span<std::byte> to) { return frame.write(to, bulk); });
  if (!written) {
    note_fault(written.error());
    return Sent::cut;
  }
  if (*written == Written::too_large) note_too_large();
  switch (*written) {
    case Written::yes: return Sent::yes;
    case Written::too_large: return Sent::too_large;
    default: return loss == Loss::allowed ? Sent::no_room : keep(frame);
  }
}

// Keeps a frame until the peer has read others.
Sent RingEnd::keep(const Frame& frame) {
  std::vector<std::byte> bytes;
  frame.append_to(bytes, outgoing_.bulk.get());
  if (bytes.size() > outgoing_.ring.largest()) {
    note_too_large();
    return Sent::too_large;
  }
  unsent_bytes_ += bytes.size();
  unsent_.push_back(std::move(bytes));
  waits_ = true;
  outgoing_.ring.set_waits(true);
  write_unsent();  // the peer may have read meanwhile, without a look at the announcement
  if (unsent_bytes_ > kMostUnsent)
    note_fault(fail(Code::unavailable, std::to_string(unsent_bytes_) + " bytes wait to be read by it"));
  return Sent::yes;
}

// Returns whether anything was written.
bool RingEnd::write_unsent() {
  bool any = false;
  while (!unsent_.empty() && !fault_) {
    const std::vector<std::byte>& bytes = unsent_.front();
    const Result<Written> written = outgoing_.ring.write([&](std::span<std::byte> to) {
      if (bytes.size() <= to.size()) std::copy(bytes.begin(), bytes.end(), to.begin());
      return bytes.size();
    });
    if (!written) note_fault(written.error());
    if (!written || *written != Written::yes) return any;
    unsent_bytes_ -= bytes.size();
    unsent_.pop_front();
    any = true;
  }
  if (unsent_.empty() && !fault_) {
    outgoing_.ring.set_waits(false);
    waits_ = false;
  }
  return any;
}

void RingEnd::flush() {
  bool any = false;
  {
    const MutexLock lock(mutex_);
    any = !unsent_.empty() && write_unsent();
  }
  if (any) ring(*peer_.doorbell);
}

void RingEnd::note_fault(const Error& error) {
  fault_ = error;
  waits_ = true;
  strand_.wake();  // which cuts the peer off
}

void RingEnd::note_too_large() {
  if (std::exchange(warned_, true)) return;
  log::warning(name_, "an object takes more than the " + std::to_string(outgoing_.ring.largest()) +
                          " bytes that this link can carry; it and others like it are dropped");
}

// --- Reading ----------------------------------------------------------------------------------------------

bool RingEnd::has_news() const {
  if (is_to_change_.load(std::memory_order_acquire)) return true;
  return !is_cut() && (incoming_.ring.has_news() || waits_.load(std::memory_order_relaxed));
}

bool RingEnd::take_in() {
  if (!has_news()) return false;
  if (!reading_.try_lock()) return false;
  const MutexLock reading(reading_, std::adopt_lock);
  if (!handlers_.receive) return false;
  const bool changed = apply_change();
  if (is_cut()) return changed;
  const std::uint64_t before = traffic_.frames_received.load(std::memory_order_relaxed);
  receive_all();
  return changed || is_cut() || traffic_.frames_received.load(std::memory_order_relaxed) != before;
}

void RingEnd::receive_all() {
  const bool closed = is_closed_by_peer();  // first: what was written before is still received
  flush();
  Status received = receive_frames();
  if (const auto found = fault(); received.ok() && found) received = *found;
  if (!received.ok()) {
    cut_off(received.error());
  } else if (closed) {
    lose(fail(Code::unavailable, "the other end of " + name_ + " has gone"));
  }
}

Status RingEnd::receive_frames() {
  if (Status looked = incoming_.ring.look(); !looked.ok()) return looked;
  bool any = false;
  for (;;) {
    const auto record = incoming_.ring.next();
    if (!record) return record.error();
    if (!record->has_value()) break;
    Status handled = handle(**record);
    incoming_.ring.release();
    any = true;
    if (!handled.ok()) return handled;
  }
  if (any && incoming_.ring.writer_waits()) ring(*peer_.doorbell);
  return ok();
}

Status RingEnd::handle(std::span<const std::byte> record) {
  traffic_.frames_received.fetch_add(1, std::memory_order_relaxed);
  if (record.size() >= detail::kLeastBulk) incoming_.bulk.look();
  FrameReader frame(record, &incoming_.bulk);
  if (Status handled = handlers_.receive(frame); !handled.ok()) return handled;
  return frame.status();
}

std::optional<Error> RingEnd::fault() const {
  if (!waits_.load(std::memory_order_relaxed)) return std::nullopt;
  const MutexLock lock(mutex_);
  return fault_;
}

// --- Losing the peer, and getting another ------------------------------------------------------------------

void RingEnd::cut_off(const Error& reason) {
  traffic_.peers_cut_off.fetch_add(1, std::memory_order_relaxed);
  log::warning(name_, "its peer is cut off: " + reason.message);
  lose(reason);
  if (peer_.on_cut_off) peer_.on_cut_off(reason);
}

void RingEnd::lose(const Error& reason) {
  {
    const MutexLock lock(mutex_);
    cut_.store(true, std::memory_order_release);
    outgoing_.ring.close();
  }
  ring(*peer_.doorbell);
  handlers_.cut(reason);
}

void RingEnd::cut(Error reason) {
  {
    const MutexLock lock(change_mutex_);
    change_ = Change{std::move(reason), std::nullopt, true};
  }
  is_to_change_.store(true, std::memory_order_release);
  strand_.wake();
}

void RingEnd::renew(RingSegment segment) {
  {
    const MutexLock lock(change_mutex_);
    const Error reason = change_ ? change_->reason : fail(Code::unavailable, "its peer was replaced");
    const bool is_gone = change_ && change_->is_gone;
    change_.emplace(Change{reason, std::move(segment), is_gone});
  }
  is_to_change_.store(true, std::memory_order_release);
  strand_.wake();
}

bool RingEnd::apply_change() {
  if (!is_to_change_.exchange(false, std::memory_order_acq_rel)) return false;
  std::optional<Change> change;
  {
    const MutexLock lock(change_mutex_);
    change.swap(change_);
  }
  if (!change) return false;
  if (!is_cut()) lose(change->reason);
  if (change->is_gone) {
    const MutexLock lock(mutex_);
    outgoing_.bulk->take_back();
  }
  if (change->segment) replace(std::move(*change->segment));
  return true;
}

void RingEnd::replace(RingSegment segment) {
  {
    const MutexLock lock(mutex_);
    segment_ = std::move(segment);
    incoming_.restart(segment_, other(side_));
    outgoing_.restart(segment_, side_);
    unsent_.clear();
    unsent_bytes_ = 0;
    fault_.reset();
    waits_ = false;
    cut_.store(false, std::memory_order_release);
  }
  handlers_.renewed();
}

ShmCounters RingEnd::counters() const {
  return {traffic_.frames_received, traffic_.objects_lost, traffic_.peers_cut_off};
}

}  // namespace orca::shm
