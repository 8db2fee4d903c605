// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/rplidar/receiver.hpp"

#include <algorithm>

namespace orca::hw::rplidar {

Receiver::Receiver() : capsules_(kCapsuleProtocol) {}

void Receiver::expect_answer() {
  skipped_bytes_ += answer_ ? 0 : size_;
  answer_.reset();
  size_ = 0;
}

std::optional<Event> Receiver::take(std::uint8_t byte) {
  part_[size_++] = byte;
  if (answer_) return size_ == part_size(*answer_) ? finish_part() : std::nullopt;
  if (size_ < kDescriptorSize) return std::nullopt;
  if (const auto type = parse_descriptor(std::span(part_).first(kDescriptorSize))) return begin(*type);
  std::copy(part_.begin() + 1, part_.begin() + kDescriptorSize, part_.begin());
  --size_;
  ++skipped_bytes_;
  return std::nullopt;
}

std::optional<Event> Receiver::begin(DataType type) {
  answer_ = type;
  size_ = 0;
  if (type != DataType::nodes && type != DataType::capsules) return std::nullopt;
  is_express_ = type == DataType::capsules;
  nodes_ = NodeReader();
  capsules_ = framing::Scanner(kCapsuleProtocol);
  capsule_points_.forget();
  return ScanStarted{type};
}

std::optional<Event> Receiver::finish_part() {
  const DataType type = *answer_;
  const auto part = std::span(part_).first(size_);
  answer_.reset();
  size_ = 0;
  switch (type) {
    case DataType::info: return parse_info(part);
    case DataType::health: return parse_health(part);
    default: return parse_sample_rates(part);
  }
}

std::optional<CapsulePoints::Points> Receiver::points_of(const framing::Frame& frame) {
  if (frame.skipped > 0) capsule_points_.forget();
  return capsule_points_.add(parse_capsule(frame.bytes));
}

}  // namespace orca::hw::rplidar
