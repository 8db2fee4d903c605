// SPDX-License-Identifier: LGPL-3.0-or-later
#include "ring.hpp"

#include <algorithm>
#include <string>

namespace orca::shm {
namespace {

using Length = std::uint64_t;

constexpr Length kSkip = ~Length{0};
constexpr std::size_t kHead = sizeof(Length);

constexpr std::uint64_t padded(std::uint64_t size) { return (size + kHead - 1) / kHead * kHead; }

std::atomic_ref<Length> length_at(std::span<std::byte> data, std::size_t offset) {
  return std::atomic_ref(*reinterpret_cast<Length*>(data.data() + offset));
}

// Bytes for the contents of a record in a piece of free memory, which is a multiple of 8.
std::size_t contents(std::size_t piece) { return piece < kHead ? 0 : piece - kHead; }

Error impossible(const std::string& what, std::uint64_t found, std::uint64_t written, std::uint64_t read) {
  return fail(Code::data_loss, "its ring in shared memory holds " + what + " " + std::to_string(found) +
                                   " (written " + std::to_string(written) + ", read " + std::to_string(read) +
                                   ")");
}

}  // namespace

Ring ring_in(std::span<std::byte> segment, std::size_t index) {
  const std::size_t capacity = (segment.size() - kControlSize) / 2;
  return {reinterpret_cast<RingControl*>(segment.data()) + index,
          segment.subspan(kControlSize + index * capacity, capacity)};
}

std::size_t RingWriter::largest() const { return ring_.data.size() - kHead; }

// Returns the room at the present position. It ends with the ring.
Result<RingWriter::Room> RingWriter::look_for_room() {
  const std::uint64_t read = ring_.control->read.load(std::memory_order_seq_cst);
  const std::uint64_t used = written_ - read;
  if (read > written_ || used > ring_.data.size() || read % kHead != 0)
    return impossible("the reader's position", read, written_, read);
  if (used == 0 && offset(written_) != 0) {
    origin_ = written_;
    ring_.control->origin.store(origin_, std::memory_order_relaxed);  // seen by whoever sees the next record
  }
  const std::size_t free = ring_.data.size() - used;
  return Room{written_, contents(std::min(free, ring_.data.size() - offset(written_))), free};
}

// Returns the room at the beginning of the ring, behind what is skipped at its end.
std::optional<RingWriter::Room> RingWriter::room_at_front(std::size_t free) const {
  const std::size_t skipped = ring_.data.size() - offset(written_);
  if (free <= skipped) return std::nullopt;
  return Room{written_ + skipped, contents(free - skipped), free};
}

std::span<std::byte> RingWriter::place(const Room& room) const {
  return ring_.data.subspan(offset(room.at) + kHead, room.size);
}

Written RingWriter::commit(const Room& room, std::size_t size) {
  if (room.at != written_) length_at(ring_.data, offset(written_)).store(kSkip, std::memory_order_relaxed);
  length_at(ring_.data, offset(room.at)).store(size, std::memory_order_relaxed);
  written_ = room.at + kHead + padded(size);
  ring_.control->written.store(written_, std::memory_order_release);
  return Written::yes;
}

void RingReader::take_over(const Ring& ring) {
  ring_ = ring;
  read_ = origin_ = end_ = after_ = 0;
}

Status RingReader::look() {
  const std::uint64_t written = ring_.control->written.load(std::memory_order_acquire);
  const std::uint64_t read = read_.load(std::memory_order_relaxed);
  if (written < read || written - read > ring_.data.size() || written % kHead != 0)
    return impossible("the writer's position", written, written, read);
  const std::uint64_t origin = ring_.control->origin.load(std::memory_order_relaxed);
  if (written != read && origin != origin_) {
    if (origin != read) return impossible("the origin", origin, written, read);
    origin_ = origin;
  }
  end_ = written;
  return ok();
}

Result<std::optional<std::span<const std::byte>>> RingReader::next() {
  using Record = std::optional<std::span<const std::byte>>;
  std::uint64_t at = read_.load(std::memory_order_relaxed);
  if (at == end_) return Record{};
  std::size_t offset = (at - origin_) & (ring_.data.size() - 1);
  Length length = length_at(ring_.data, offset).load(std::memory_order_relaxed);
  if (length == kSkip && end_ - at > ring_.data.size() - offset) {
    at += ring_.data.size() - offset;
    offset = 0;
    length = length_at(ring_.data, 0).load(std::memory_order_relaxed);
  }
  const std::uint64_t room = std::min<std::uint64_t>(end_ - at, ring_.data.size() - offset);
  if (length > room - kHead) return impossible("a record of the length", length, end_, at);
  after_ = at + kHead + padded(length);
  return Record(ring_.data.subspan(offset + kHead, length));
}

void RingReader::release() {
  read_.store(after_, std::memory_order_relaxed);
  ring_.control->read.store(after_, std::memory_order_seq_cst);
}

}  // namespace orca::shm
