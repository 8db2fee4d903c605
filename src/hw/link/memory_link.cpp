// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/memory_link.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <mutex>
#include <utility>

namespace orca::hw::link {

// What the two ends share. Everything is protected by the mutex.
class MemoryCable {
 public:
  struct End {
    bool open = false;
    bool other_has_left = false;  // since this end or the other was opened
    std::deque<std::uint8_t> input;
    std::function<void()> ring;  // called when there is something to say
  };

  void ring(std::size_t side) const {
    if (ends[side].ring) ends[side].ring();
  }

  std::mutex mutex;
  std::array<End, 2> ends;
  std::optional<Line> line;
};

namespace {

// Returns the line of that name. It lives as long as one of its ends.
std::shared_ptr<MemoryCable> cable_of(const std::string& name) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<MemoryCable>> cables;
  const std::lock_guard lock(mutex);
  std::erase_if(cables, [](const auto& cable) { return cable.second.expired(); });
  std::shared_ptr<MemoryCable> cable = cables[name].lock();
  if (cable == nullptr) cables[name] = cable = std::make_shared<MemoryCable>();
  return cable;
}

Error other_end_gone(const ByteLink& link) {
  return fail(Code::unavailable, "the other end of the line is closed", link.name());
}

}  // namespace

MemoryLink::MemoryLink(MemoryOptions options)
    : options_(std::move(options)),
      cable_(cable_of(options_.name)),
      side_(static_cast<std::size_t>(options_.end)),
      set_(options_.line) {}

MemoryLink::~MemoryLink() { MemoryLink::close(); }

Result<Opening> MemoryLink::open() {
  if (is_open_) return Opening::done;
  const std::lock_guard lock(cable_->mutex);
  MemoryCable::End& own = cable_->ends[side_];
  MemoryCable::End& other = cable_->ends[1 - side_];
  if (own.open)
    return fail(Code::already_exists, "another link of this process has this end of the line open", name());
  if (!other.open && options_.patience > Duration{0}) {
    if (goes_on_waiting()) return Opening::under_way;
    return fail(Code::not_found, "no emulated device has a line of this name", name());
  }
  waits_since_.reset();
  is_open_ = own.open = true;
  own.other_has_left = other.other_has_left = false;
  if (options_.end == MemoryOptions::End::driver) cable_->line = set_;
  return Opening::done;
}

bool MemoryLink::goes_on_waiting() {
  if (!waits_since_) waits_since_ = options_.now();
  if (options_.now() - *waits_since_ < options_.patience) return true;
  waits_since_.reset();
  return false;
}

void MemoryLink::close() {
  if (!is_open_) return;
  const std::lock_guard lock(cable_->mutex);
  is_open_ = false;
  cable_->ends[side_] = {};
  if (options_.end == MemoryOptions::End::driver) cable_->line.reset();
  cable_->ends[1 - side_].other_has_left = true;
  cable_->ring(1 - side_);
}

Result<std::size_t> MemoryLink::read(std::span<std::uint8_t> into) {
  if (!is_open_) return not_open(*this);
  const std::lock_guard lock(cable_->mutex);
  MemoryCable::End& own = cable_->ends[side_];
  const std::size_t count = std::min(into.size(), own.input.size());
  if (count == 0 && !into.empty() && own.other_has_left) return other_end_gone(*this);
  const auto end = own.input.begin() + static_cast<std::ptrdiff_t>(count);
  std::copy(own.input.begin(), end, into.begin());
  own.input.erase(own.input.begin(), end);
  return count;
}

Status MemoryLink::write(std::span<const std::uint8_t> bytes) {
  if (!is_open_) return not_open(*this);
  if (Status fits = check_size(*this, bytes.size()); !fits.ok()) return fits;
  const std::lock_guard lock(cable_->mutex);
  if (cable_->ends[side_].other_has_left) return other_end_gone(*this);
  MemoryCable::End& other = cable_->ends[1 - side_];
  if (other.input.size() + bytes.size() > kMostPending) return takes_no_more(*this, other.input.size());
  other.input.insert(other.input.end(), bytes.begin(), bytes.end());
  cable_->ring(1 - side_);
  return ok();
}

Status MemoryLink::flush() {
  if (!is_open_) return not_open(*this);
  const std::lock_guard lock(cable_->mutex);
  return cable_->ends[side_].other_has_left ? Status(other_end_gone(*this)) : ok();
}

void MemoryLink::discard_input() {
  if (!is_open_) return;
  const std::lock_guard lock(cable_->mutex);
  cable_->ends[side_].input.clear();
}

bool MemoryLink::ring_at_input(std::function<void()> ring) {
  const std::lock_guard lock(cable_->mutex);
  cable_->ends[side_].ring = std::move(ring);
  return true;
}

Status MemoryLink::set_line(const Line& line) {
  const std::lock_guard lock(cable_->mutex);
  set_ = line;
  if (is_open_) cable_->line = set_;
  return ok();
}

double MemoryLink::byte_time() const {
  const std::optional<Line> set = line();
  return set && set->baud > 0 ? set->byte_time() : 0.0;
}

std::optional<Line> MemoryLink::line() const {
  const std::lock_guard lock(cable_->mutex);
  return cable_->line;
}

}  // namespace orca::hw::link
