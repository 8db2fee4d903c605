// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/faulty_link.hpp"

#include <algorithm>

#include "byte_faults.hpp"

namespace orca::hw::link {
namespace {

constexpr std::size_t kMostHeld = 65536;  // [bytes]

}  // namespace

FaultyLink::FaultyLink(std::unique_ptr<ByteLink> link, FaultPlan plan)
    : link_(std::move(link)),
      now_(plan.now),
      in_(std::make_unique<ByteFaults>(Direction::in, plan.in, plan)),
      out_(std::make_unique<ByteFaults>(Direction::out, plan.out, plan)) {
  change_modes(plan.modes);
}

FaultyLink::~FaultyLink() = default;

Result<Opening> FaultyLink::open() {
  const std::lock_guard lock(mutex_);
  if (modes_.ended) return gone();
  return link_->open();
}

void FaultyLink::close() {
  const std::lock_guard lock(mutex_);
  link_->close();
  held_.clear();
  waiting_.clear();
  failure_.reset();
}

Result<std::size_t> FaultyLink::read(std::span<std::uint8_t> into) {
  const std::lock_guard lock(mutex_);
  const Status sent = send_waiting();
  take_in();
  const std::size_t count = hand_out(into);
  if (count > 0 || into.empty() || !held_.empty()) return count;
  if (modes_.ended) return gone();
  if (failure_) return *failure_;
  return sent.ok() ? Result<std::size_t>(0) : sent.error();
}

// Reads what is there, lets the faults befall it and holds it until it is due.
void FaultyLink::take_in() {
  std::array<std::uint8_t, 512> bytes{};
  while (held_.size() < kMostHeld && !failure_ && !modes_.ended) {
    const Result<std::size_t> count = link_->read(bytes);
    if (!count) failure_ = count.error();
    if (!count || *count == 0) return;
    FaultModes changed = modes_;
    hold(in_->pass(std::span(bytes).first(*count), changed, counts_));
    change_modes(changed);
  }
}

void FaultyLink::hold(const std::vector<std::uint8_t>& bytes) {
  const TimePoint now = now_();
  for (const std::uint8_t byte : bytes) {
    const bool joins = modes_.glue > Duration{0} && !held_.empty() && held_.back().due > now;
    const TimePoint due = joins ? held_.back().due : now + modes_.delay + modes_.glue;
    held_.push_back({byte, due});
    counter(Fault::glue) += joins;
    counter(Fault::delay) += modes_.delay > Duration{0};
  }
}

std::size_t FaultyLink::hand_out(std::span<std::uint8_t> into) {
  const TimePoint now = now_();
  const auto late = std::ranges::find_if(held_, [&](const Held& each) { return each.due > now; });
  const std::size_t due = std::min(into.size(), static_cast<std::size_t>(late - held_.begin()));
  const std::size_t count = modes_.byte_by_byte ? std::min<std::size_t>(due, 1) : due;
  counter(Fault::split) += count < due;
  for (std::size_t i = 0; i < count; ++i) into[i] = held_[i].byte;
  held_.erase(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(count));
  return count;
}

Status FaultyLink::write(std::span<const std::uint8_t> bytes) {
  const std::lock_guard lock(mutex_);
  if (modes_.ended) return gone();
  if (Status fits = check_size(*this, bytes.size()); !fits.ok()) return fits;
  if (Status able = link_->flush(); !able.ok()) return able;
  if (Status sent = send_waiting(); !sent.ok()) return sent;
  if (!modes_.refuses && waiting_.empty()) return send(bytes);
  ++counter(Fault::refusal);
  if (waiting_.size() + bytes.size() > kMostPending) return takes_no_more(*this, waiting_.size());
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  return ok();
}

// Lets the faults befall bytes and sends them. They may have become more than the inner link takes at once.
Status FaultyLink::send(std::span<const std::uint8_t> bytes) {
  FaultModes changed = modes_;
  const std::vector<std::uint8_t> faulty = out_->pass(bytes, changed, counts_);
  if (modes_.echo) {
    hold(faulty);
    counter(Fault::echo) += faulty.size();
  }
  change_modes(changed);
  for (auto rest = std::span(faulty); !rest.empty();) {
    const auto part = rest.first(std::min(rest.size(), kMostPending));
    if (Status written = link_->write(part); !written.ok()) return written;
    rest = rest.subspan(part.size());
  }
  return ok();
}

Status FaultyLink::send_waiting() {
  if (modes_.refuses || waiting_.empty()) return ok();
  Status sent = send(waiting_);
  if (sent.ok() || sent.error().code == Code::unavailable) waiting_.clear();
  return sent.ok() || sent.error().code != Code::deadline_exceeded ? sent : ok();
}

Status FaultyLink::flush() {
  const std::lock_guard lock(mutex_);
  if (modes_.ended) return gone();
  if (Status sent = send_waiting(); !sent.ok()) return sent;
  return link_->flush();
}

std::size_t FaultyLink::pending() const {
  const std::lock_guard lock(mutex_);
  return waiting_.size() + link_->pending();
}

void FaultyLink::discard_input() {
  const std::lock_guard lock(mutex_);
  take_in();
  held_.clear();
  link_->discard_input();
}

void FaultyLink::discard_output() {
  const std::lock_guard lock(mutex_);
  waiting_.clear();
  link_->discard_output();
}

FaultModes FaultyLink::modes() const {
  const std::lock_guard lock(mutex_);
  return modes_;
}

void FaultyLink::set_modes(const FaultModes& modes) {
  const std::lock_guard lock(mutex_);
  change_modes(modes);
}

void FaultyLink::change_modes(const FaultModes& modes) {
  counter(Fault::end) += modes.ended && !modes_.ended;
  modes_ = modes;
}

std::uint64_t FaultyLink::count(Fault fault) const {
  const std::lock_guard lock(mutex_);
  return counts_[static_cast<std::size_t>(fault)];
}

Error FaultyLink::gone() const {
  return fail(Code::unavailable, "the device has gone (a fault that was asked for)", name());
}

}  // namespace orca::hw::link
