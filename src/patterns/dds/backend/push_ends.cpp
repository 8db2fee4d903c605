// SPDX-License-Identifier: LGPL-3.0-or-later
#include "push_ends.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace orca::dds {

using namespace frames;

namespace {

constexpr std::size_t kMostHeld = std::size_t{4} << 20;  // [bytes]

// Returns the frame that the server would have sent.
std::vector<std::byte> as_frame(Sample sample, std::uint64_t subscription) {
  constexpr std::uint64_t kNobodyWaits = 0;
  const std::array head{static_cast<std::uint64_t>(FrameKind::object), subscription, kNobodyWaits,
                        sample.label.layout_hash};
  static_assert(sizeof head == kHeadroom);
  std::memcpy(sample.bytes.data(), head.data(), sizeof head);
  return std::move(sample.bytes);
}

}  // namespace

// --- The server's end -------------------------------------------------------------------------------------

PublishingEnd::~PublishingEnd() {
  stop();
  publication_->release(bit_);
}

Sent PublishingEnd::send(const Frame& frame, Loss loss, Caller caller) {
  const bool nobody_waits = frame.kind() == FrameKind::object && frame.first_number() == 0;
  return nobody_waits ? publish(frame, loss) : DdsEnd::send(frame, loss, caller);
}

Sent PublishingEnd::publish(const Frame& frame, Loss loss) {
  if (is_cut()) return Sent::cut;
  const Direct wanted{session(), frame.number()};
  if (direct_ == wanted || go_direct(wanted))
    return publication_->add(frame.object(), bit_) ? Sent::yes : Sent::no_room;
  const Sent sent = DdsEnd::send(frame, loss);
  publication_->add(frame.object(), 0);
  return sent;
}

bool PublishingEnd::go_direct(const Direct& wanted) {
  if (heard_in_.load(std::memory_order_acquire) != wanted.session) return false;
  std::vector<std::byte> parcel = begin_parcel(place().edge, Parcel::direct);
  append(parcel, wanted.subscription);
  append(parcel, bit_);
  append(parcel, publication_->begin_epoch());
  if (place().line.send(std::move(parcel), wanted.session) != Sent::yes) return false;
  direct_ = wanted;
  return true;
}

void PublishingEnd::arrived(Parcel kind, std::span<const std::byte> contents) {
  if (kind == Parcel::heard) {
    heard_in_.store(line_session(), std::memory_order_release);
  } else {
    DdsEnd::arrived(kind, contents);
  }
}

// --- The client's end -------------------------------------------------------------------------------------

void SubscribingEnd::start(FrameHandlers handlers) {
  DdsEnd::start(std::move(handlers));
  subscription_->add(*this);
}

void SubscribingEnd::stop() {
  subscription_->remove(*this);
  DdsEnd::stop();
}

Sent SubscribingEnd::send(const Frame& frame, Loss loss, Caller caller) {
  if (frame.kind() == FrameKind::attach || frame.kind() == FrameKind::detach) forget_direct();
  return DdsEnd::send(frame, loss, caller);
}

void SubscribingEnd::forget_direct() {
  const MutexLock lock(topic_mutex_);
  direct_.reset();
  held_.clear();
  held_bytes_ = 0;
}

void SubscribingEnd::line_joined(std::uint64_t session) {
  forget_direct();
  DdsEnd::line_joined(session);
}

void SubscribingEnd::arrived(Parcel kind, std::span<const std::byte> contents) {
  if (kind == Parcel::direct) return go_direct(contents);
  if (kind == Parcel::frame) note_grant(contents);
  DdsEnd::arrived(kind, contents);
}

// Learns which part of the topic's objects is due, in order to count those that are lost.
void SubscribingEnd::note_grant(std::span<const std::byte> frame) {
  FrameReader reader(frame);
  if (reader.kind() != FrameKind::granted) return;
  (void)reader.read_number();  // the base period
  const MutexLock lock(topic_mutex_);
  multiple_ = std::max<std::uint64_t>(reader.read_number(), 1);
}

void SubscribingEnd::go_direct(std::span<const std::byte> contents) {
  const auto subscription = take_number(contents);
  const auto bit = take_number(contents);
  const auto epoch = take_number(contents);
  if (!subscription || !bit || !epoch) return;
  const MutexLock lock(topic_mutex_);
  direct_ = Direct{*subscription, *bit, static_cast<std::uint32_t>(*epoch)};
  held_bytes_ = 0;
  for (Held& held : std::exchange(held_, {})) pass_on(std::move(held.sample), held.missed);
}

void SubscribingEnd::take_sample(Sample sample, std::uint64_t missed) {
  if (!place().line.is_peer(sample.origin)) return;  // a stranger, or a process that has ended
  report_heard();
  const MutexLock lock(topic_mutex_);
  if (!direct_) return hold(std::move(sample), missed);
  pass_on(std::move(sample), missed);
}

void SubscribingEnd::report_heard() {
  const std::uint64_t session = line_session();
  if (reported_in_.exchange(session) == session) return;
  place().line.send(begin_parcel(place().edge, Parcel::heard), session, Loss::never, By::next);
}

void SubscribingEnd::hold(Sample sample, std::uint64_t missed) {
  if (sample.label.edges == 0) return;
  held_bytes_ += sample.bytes.size();
  held_.push_back({std::move(sample), missed});
  while (held_bytes_ > kMostHeld && held_.size() > 1) drop_oldest_held();
}

void SubscribingEnd::drop_oldest_held() {
  const std::uint64_t lost = held_.front().missed + 1;
  held_bytes_ -= held_.front().sample.bytes.size();
  held_.pop_front();
  held_.front().missed += lost;
}

void SubscribingEnd::pass_on(Sample sample, std::uint64_t missed) {
  if (sample.label.epoch < direct_->epoch) return;
  report_missed(missed / multiple_);
  if ((sample.label.edges & direct_->bit) == 0) return;
  if (is_behind()) return report_missed(1);
  deliver(as_frame(std::move(sample), direct_->subscription));
}

void SubscribingEnd::report_missed(std::uint64_t missed) {
  if (missed == 0) return;
  Frame losses(FrameKind::lost, direct_->subscription);
  losses.add(missed);
  std::vector<std::byte> bytes;
  losses.append_to(bytes);
  deliver(std::move(bytes));
}

}  // namespace orca::dds
