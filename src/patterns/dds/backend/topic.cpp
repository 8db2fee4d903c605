// SPDX-License-Identifier: LGPL-3.0-or-later
#include "topic.hpp"

#include <utility>

namespace orca::dds {
namespace {

constexpr int kMostEdges = 62;                             // what a label has room for
constexpr std::size_t kMostQueued = std::size_t{4} << 20;  // [bytes]

}  // namespace

std::optional<std::uint64_t> Publication::reserve() {
  for (int i = 0; i < kMostEdges; ++i) {
    const std::uint64_t bit = std::uint64_t{1} << i;
    if ((taken_ & bit) != 0) continue;
    taken_ |= bit;
    return bit;
  }
  return std::nullopt;
}

bool Publication::add(const ObjectRef& object, std::uint64_t bit) {
  if (pending_ != object) {
    flush();
    if (writer_->queued.load(std::memory_order_relaxed) >= kMostQueued) return false;
    pending_ = object;
  }
  due_ |= bit;
  return true;
}

void Publication::flush() {
  if (!pending_) return;
  const Label label{pending_.type().layout_hash, std::exchange(due_, 0), epoch_};
  const std::size_t size = pending_.type().write(pending_.get(), {});
  outbox_.post({writer_, std::exchange(pending_, {}), label, {}, size});
}

Status Subscription::open(Participant& participant, const TopicOptions& topic) {
  auto reader = participant.make_reader(topic, [this](Sample sample) { take(std::move(sample)); });
  if (!reader) return reader.error();
  reader_ = std::move(reader).value();
  return ok();
}

void Subscription::add(SampleSink& sink) {
  const MutexLock lock(mutex_);
  sinks_.push_back(&sink);
}

void Subscription::remove(SampleSink& sink) {
  const MutexLock lock(mutex_);
  std::erase(sinks_, &sink);
}

void Subscription::take(Sample sample) {
  const MutexLock lock(mutex_);
  const std::uint64_t missed = missed_before(sample);
  if (sinks_.empty()) return;
  for (std::size_t i = 0; i + 1 < sinks_.size(); ++i) sinks_[i]->take_sample(sample, missed);
  sinks_.back()->take_sample(std::move(sample), missed);
}

// Others may write to the topic, too; for them nothing is counted.
std::uint64_t Subscription::missed_before(const Sample& sample) {
  const std::uint64_t expected = sample.origin == origin_ ? last_ + 1 : sample.sequence;
  origin_ = sample.origin;
  last_ = sample.sequence;
  return sample.sequence > expected ? sample.sequence - expected : 0;
}

}  // namespace orca::dds
