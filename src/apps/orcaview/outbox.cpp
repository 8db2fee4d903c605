// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "outbox.hpp"

#include <algorithm>

namespace orca::view {
namespace {

constexpr double kNanoseconds = 1e9;

std::uint32_t capped(std::uint64_t number) {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(number, UINT32_MAX));
}

}  // namespace

std::string object_head(const Frame& frame) {
  std::string head;
  append(head, std::uint32_t{1});
  append(head, frame.look);
  append(head, static_cast<double>(frame.passed->passed) / kNanoseconds);
  append(head, static_cast<double>(frame.passed->created) / kNanoseconds);
  append(head, capped(frame.passed->lost));
  append(head, frame.left_out);
  return head;
}

std::string reply_head(std::uint32_t id) {
  std::string head;
  append(head, std::uint32_t{2});
  append(head, id);
  constexpr std::size_t kSize = 32;
  head.resize(kSize);
  return head;
}

bool Outbox::add(std::string text) { return add(Frame{Frame::Kind::text, std::move(text)}); }

bool Outbox::add_bytes(std::string bytes) { return add(Frame{Frame::Kind::bytes, std::move(bytes)}); }

// One frame finds room whatever its size.
bool Outbox::add(Frame frame) {
  if (answer_bytes_ > 0 && answer_bytes_ + frame.text.size() > kBound) return false;
  answer_bytes_ += frame.text.size();
  answers_.push_back(std::move(frame));
  return true;
}

void Outbox::begin(std::uint32_t look, std::chrono::nanoseconds interval) {
  looks_[look].interval = interval;
}

void Outbox::end(std::uint32_t look) {
  const auto found = looks_.find(look);
  if (found == looks_.end()) return;
  for (const auto& passed : found->second.waiting) object_bytes_ -= passed->object.size();
  looks_.erase(found);
}

void Outbox::drop_oldest(Look& look) {
  object_bytes_ -= look.waiting.front()->object.size();
  look.waiting.pop_front();
  ++look.left_out;
}

void Outbox::add_object(std::uint32_t look, std::shared_ptr<const supervisor::Tapped> passed) {
  const auto found = looks_.find(look);
  if (found == looks_.end()) return;
  Look& own = found->second;
  object_bytes_ += passed->object.size();
  own.waiting.push_back(std::move(passed));
  // With a rate the older ones are not wanted; otherwise they are missed.
  const std::size_t most = own.interval.count() > 0 ? 1 : kMostObjects;
  while (own.waiting.size() > most) {
    if (own.interval.count() == 0) ++dropped_;
    drop_oldest(own);
  }
  while (object_bytes_ > kMostBytes && waiting_objects() > 1) {
    ++dropped_;
    drop_oldest(heaviest());
  }
}

std::size_t Outbox::waiting_objects() const {
  std::size_t count = 0;
  for (const auto& [id, look] : looks_) count += look.waiting.size();
  return count;
}

// Returns the look with the most bytes that wait. @pre  something waits.
Outbox::Look& Outbox::heaviest() {
  const auto weight = [](const auto& entry) {
    std::size_t bytes = 0;
    for (const auto& passed : entry.second.waiting) bytes += passed->object.size();
    return std::pair(bytes, entry.second.waiting.size());
  };
  return std::ranges::max_element(looks_, {}, weight)->second;
}

void Outbox::forget_objects() {
  for (auto& [number, look] : looks_) look.waiting.clear();
  object_bytes_ = 0;
}

std::optional<Frame> Outbox::take(Moment now) {
  if (!answers_.empty()) {
    Frame frame = std::move(answers_.front());
    answers_.pop_front();
    answer_bytes_ -= frame.text.size();
    return frame;
  }
  auto longest = looks_.end();
  for (auto look = looks_.begin(); look != looks_.end(); ++look)
    if (!look->second.waiting.empty() && look->second.due <= now &&
        (longest == looks_.end() || look->second.due < longest->second.due))
      longest = look;
  if (longest == looks_.end()) return std::nullopt;
  Look& look = longest->second;
  std::shared_ptr<const supervisor::Tapped> passed = std::move(look.waiting.front());
  look.waiting.pop_front();
  object_bytes_ -= passed->object.size();
  const bool is_late = now - look.due >= look.interval;  // a new beat begins
  look.due = (is_late ? now : look.due) + look.interval;
  return Frame{Frame::Kind::object, {}, std::move(passed), longest->first, look.left_out};
}

std::optional<Outbox::Moment> Outbox::due() const {
  if (!answers_.empty()) return Moment{};
  std::optional<Moment> first;
  for (const auto& [id, look] : looks_)
    if (!look.waiting.empty() && (!first || look.due < *first)) first = look.due;
  return first;
}

}  // namespace orca::view
