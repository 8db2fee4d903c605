// SPDX-License-Identifier: LGPL-3.0-or-later
#include "topic_ends.hpp"

namespace orca::dds::of_ros {
namespace {

constexpr std::size_t kMostQueued = std::size_t{4} << 20;  // [bytes] that wait for the outbox
constexpr std::size_t kMostWaiting = 256;                  // objects that wait for a strand
constexpr std::size_t kMostBytes = std::size_t{16} << 20;  // [bytes] that they had as messages

}  // namespace

bool TopicPublication::post(const std::shared_ptr<TopicPublication>& to, const ObjectRef& object,
                            Outbox& outbox) {
  if (!to->is_latched() && to->queued.load(std::memory_order_relaxed) >= kMostQueued) return false;
  outbox.post({to, object, {}, {}, object.type().write(object.get(), {})});
  return true;
}

PushToTopic::PushToTopic(Strand& strand, PushSource& source, std::shared_ptr<TopicPublication> publication,
                         Outbox& outbox, std::shared_ptr<Bell> bell, Unread unread)
    : strand_(strand),
      source_(source),
      publication_(std::move(publication)),
      outbox_(outbox),
      bell_(std::move(bell)),
      unread_(unread) {
  strand_.add_intake(*this);
}

PushToTopic::~PushToTopic() {
  bell_->remove();
  strand_.remove_intake(*this);
  const MutexLock lock(mutex_);
  if (attached_) source_.detach();
}

std::optional<Duration> PushToTopic::deliver(ObjectRef&& object) {
  Unread first = Unread::first;
  if (TopicPublication::post(publication_, object, outbox_) &&
      unread_.compare_exchange_strong(first, Unread::nothing))
    bell_->ring();  // it may leave now
  return std::nullopt;
}

bool PushToTopic::take_in() {
  if (!mutex_.try_lock()) return false;
  const MutexLock lock(mutex_, std::adopt_lock);
  const Unread unread = unread_;
  const bool wanted = unread == Unread::all || unread == Unread::first || publication_->has_readers() ||
                      (unread == Unread::moves && publication_->are_frames_heard());
  if (wanted == attached_) return false;
  attached_ = wanted;
  if (wanted)
    source_.attach(*this, {});
  else
    source_.detach();
  return true;
}

Status TopicIntake::open(RosParticipant& participant, const RosChannel& channel) {
  opened_ = strand_.executive().now();
  auto reader = participant.make_reader(channel, [this](std::span<const std::byte> payload) {
    ObjectRef object = read(payload, strand_.executive().now());
    if (!object) return;
    keep(std::move(object), payload.size());
    strand_.wake();
  });
  if (!reader) return reader.error();
  reader_ = std::move(reader).value();
  strand_.add_intake(*this);
  return ok();
}

void TopicIntake::close() {
  if (reader_ == nullptr) return;
  reader_.reset();
  strand_.remove_intake(*this);
}

// The oldest are dropped, as from any queue of sensors.
void TopicIntake::keep(ObjectRef object, std::size_t size) {
  const MutexLock lock(mutex_);
  waiting_.push_back({std::move(object), size});
  waiting_bytes_ += size;
  while (waiting_.size() > 1 && (waiting_.size() > kMostWaiting || waiting_bytes_ > kMostBytes)) {
    waiting_bytes_ -= waiting_.front().size;
    waiting_.pop_front();
    ++lost_;
  }
}

bool TopicIntake::take_in() {
  if (!reading_.try_lock()) return false;
  const MutexLock reading(reading_, std::adopt_lock);
  std::deque<Waiting> taken;
  std::uint64_t lost = 0;
  {
    const MutexLock lock(mutex_);
    taken.swap(waiting_);
    waiting_bytes_ = 0;
    lost = std::exchange(lost_, 0);
  }
  if (lost > 0) pass_on_losses(lost);
  for (Waiting& waiting : taken) pass_on(std::move(waiting.object));
  return !taken.empty();
}

void TopicSource::attach(PushSink& sink, const UpdateRate& rate) {
  const MutexLock lock(mutex_);
  sink_ = &sink;
  rate_ = rate;
  sink.granted(grant_rate(rate, Duration{0}));
}

void TopicSource::detach() {
  const MutexLock lock(mutex_);
  sink_ = nullptr;
}

void TopicSource::change(const UpdateRate& rate) {
  const MutexLock lock(mutex_);
  rate_ = rate;
  if (sink_ != nullptr) sink_->granted(grant_rate(rate, Duration{0}));
}

void TopicSource::pass_on(ObjectRef object) {
  const MutexLock lock(mutex_);
  if (sink_ == nullptr || count_++ % rate_.multiple != 0) return;
  const TimePoint now = strand_.executive().now();
  if (rate_.interval > Duration{0} && now < next_) return;
  next_ = now + rate_.interval;
  // A publisher of a topic waits for nobody.
  if (sink_->deliver(std::move(object)).has_value()) sink_->give_up(object);
}

void TopicSource::pass_on_losses(std::uint64_t objects) {
  const MutexLock lock(mutex_);
  if (sink_ != nullptr) sink_->lost(objects);
}

}  // namespace orca::dds::of_ros
