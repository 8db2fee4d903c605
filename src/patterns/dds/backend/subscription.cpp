// SPDX-License-Identifier: LGPL-3.0-or-later
#include "subscription.hpp"

#include <utility>

namespace orca::dds {

Status Subscription::open(Participant& participant, const TopicOptions& topic) {
  auto reader = participant.make_reader(topic, [this](Sample sample) { take(std::move(sample)); });
  if (!reader) return reader.error();
  reader_ = std::move(reader).value();
  return ok();
}

void Subscription::add(SampleSink& sink) {
  const std::lock_guard lock(mutex_);
  sinks_.push_back(&sink);
}

void Subscription::remove(SampleSink& sink) {
  const std::lock_guard lock(mutex_);
  std::erase(sinks_, &sink);
}

void Subscription::take(Sample sample) {
  const std::lock_guard lock(mutex_);
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
