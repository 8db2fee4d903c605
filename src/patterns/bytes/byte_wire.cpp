// SPDX-License-Identifier: LGPL-3.0-or-later
#include "byte_wire.hpp"

namespace orca::bytes {
namespace {

constexpr std::size_t kPortion = 4096;  // [bytes] carried at a time

}  // namespace

ByteWire::ByteWire(Courier& courier, std::size_t capacity)
    : courier_(courier), outgoing_(capacity), incoming_(capacity) {}

std::size_t ByteWire::write(std::span<const std::byte> bytes) {
  if (closed()) return 0;
  const std::size_t count = outgoing_.write(bytes);
  if (count > 0) courier_.notify();
  return count;
}

std::size_t ByteWire::read(std::span<std::byte> to) {
  const std::size_t count = incoming_.read(to);
  if (count > 0) courier_.notify();
  return count;
}

void ByteWire::set_receiver(Event* event) {
  const std::lock_guard lock(mutex_);
  receiver_ = event;
}

void ByteWire::set_sender(Event* event) {
  const std::lock_guard lock(mutex_);
  sender_ = event;
}

void ByteWire::notify(Event* const& event) {
  const std::lock_guard lock(mutex_);
  if (event != nullptr) event->notify();
}

void ByteWire::close() {
  closed_.store(true, std::memory_order_release);
  notify(receiver_);
  notify(sender_);
  courier_.notify();
}

bool ByteWire::carry() {
  if (put_ == portion_.size()) {
    portion_.resize(kPortion);
    portion_.resize(outgoing_.read(portion_));
    put_ = 0;
    if (portion_.empty()) return false;
    notify(sender_);
  }
  const std::size_t count = incoming_.write(std::span(portion_).subspan(put_));
  put_ += count;
  if (count > 0) notify(receiver_);
  return count > 0;
}

}  // namespace orca::bytes
