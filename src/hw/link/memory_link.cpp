// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/memory_link.hpp"

#include <sys/eventfd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <deque>
#include <mutex>

#include "orca/base/descriptor.hpp"
#include "orca/base/exhaustion.hpp"

namespace orca::hw::link {

// What the two ends share. Everything is protected by the mutex.
class MemoryCable {
 public:
  struct End {
    bool open = false;
    bool other_has_left = false;  // since this end or the other was opened
    std::deque<std::uint8_t> input;
    Descriptor bell;  // readable while there is something to say
    bool rung = false;

    void update_bell();
  };

  explicit MemoryCable(const MemoryOptions& options)
      : capacity(std::min(options.capacity, kMostPending)), descriptors(options.descriptors) {}

  const std::size_t capacity;
  const bool descriptors;
  std::mutex mutex;
  std::array<End, 2> ends;
};

void MemoryCable::End::update_bell() {
  const bool wanted = other_has_left || !input.empty();
  if (!bell || wanted == rung) return;
  eventfd_t taken = 0;
  (void)(wanted ? eventfd_write(bell.number(), 1) : eventfd_read(bell.number(), &taken));
  rung = wanted;
}

namespace {

Error other_end_gone(const ByteLink& link) {
  return fail(Code::unavailable, "the other end of the line is closed", link.name());
}

}  // namespace

MemoryLink::MemoryLink(std::shared_ptr<MemoryCable> cable, std::size_t side, std::string name)
    : cable_(std::move(cable)), side_(side), name_(std::move(name)) {}

MemoryLink::~MemoryLink() { MemoryLink::close(); }

Result<Opening> MemoryLink::open() {
  const std::lock_guard lock(cable_->mutex);
  MemoryCable::End& own = cable_->ends[side_];
  if (own.open) return Opening::done;
  if (cable_->descriptors) {
    own.bell = Descriptor(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC));
    if (!own.bell) {
      throw_if_exhausted(errno);
      return fail(Code::unavailable, "the system gives no descriptor", name());
    }
  }
  own.rung = false;
  own.open = true;
  own.other_has_left = false;
  own.update_bell();
  MemoryCable::End& other = cable_->ends[1 - side_];
  other.other_has_left = false;
  other.update_bell();
  return Opening::done;
}

void MemoryLink::close() {
  const std::lock_guard lock(cable_->mutex);
  MemoryCable::End& own = cable_->ends[side_];
  if (!own.open) return;
  own.open = false;
  own.input.clear();
  own.bell.reset();
  MemoryCable::End& other = cable_->ends[1 - side_];
  other.other_has_left = true;
  other.update_bell();
}

Result<std::size_t> MemoryLink::read(std::span<std::uint8_t> into) {
  const std::lock_guard lock(cable_->mutex);
  MemoryCable::End& own = cable_->ends[side_];
  if (!own.open) return not_open(*this);
  const std::size_t count = std::min(into.size(), own.input.size());
  if (count == 0 && !into.empty() && own.other_has_left) return other_end_gone(*this);
  const auto end = own.input.begin() + static_cast<std::ptrdiff_t>(count);
  std::copy(own.input.begin(), end, into.begin());
  own.input.erase(own.input.begin(), end);
  own.update_bell();
  return count;
}

Status MemoryLink::write(std::span<const std::uint8_t> bytes) {
  const std::lock_guard lock(cable_->mutex);
  const MemoryCable::End& own = cable_->ends[side_];
  if (!own.open) return not_open(*this);
  if (Status fits = check_size(*this, bytes.size()); !fits.ok()) return fits;
  if (own.other_has_left) return other_end_gone(*this);
  MemoryCable::End& other = cable_->ends[1 - side_];
  if (other.input.size() + bytes.size() > cable_->capacity) return takes_no_more(*this, other.input.size());
  other.input.insert(other.input.end(), bytes.begin(), bytes.end());
  other.update_bell();
  return ok();
}

Status MemoryLink::flush() {
  const std::lock_guard lock(cable_->mutex);
  const MemoryCable::End& own = cable_->ends[side_];
  if (!own.open) return not_open(*this);
  return own.other_has_left ? Status(other_end_gone(*this)) : ok();
}

void MemoryLink::discard_input() {
  const std::lock_guard lock(cable_->mutex);
  cable_->ends[side_].input.clear();
  cable_->ends[side_].update_bell();
}

int MemoryLink::descriptor() const {
  const std::lock_guard lock(cable_->mutex);
  return cable_->ends[side_].bell.number();
}

std::pair<std::unique_ptr<MemoryLink>, std::unique_ptr<MemoryLink>> make_memory_links(
    const MemoryOptions& options) {
  const auto cable = std::make_shared<MemoryCable>(options);
  return {std::unique_ptr<MemoryLink>(new MemoryLink(cable, 0, options.name + " (first end)")),
          std::unique_ptr<MemoryLink>(new MemoryLink(cable, 1, options.name + " (second end)"))};
}

}  // namespace orca::hw::link
