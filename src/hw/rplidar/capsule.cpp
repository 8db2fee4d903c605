// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/rplidar/capsule.hpp"

#include <utility>

#include "orca/hw/rplidar/node.hpp"

namespace orca::hw::rplidar {

namespace {

constexpr std::size_t kHeaderSize = 4;  // marks with checksum, start angle
constexpr std::size_t kCabinSize = 5;   // two samples

std::uint8_t checksum(std::span<const std::uint8_t> capsule) {
  unsigned sum = 0;
  for (const std::uint8_t byte : capsule.subspan(2)) sum ^= byte;
  return static_cast<std::uint8_t>(sum);
}

// Its lowest two bits are the highest of the correction, whose other four are in the last byte of the cabin.
Capsule::Sample sample(unsigned low, unsigned high, unsigned correction) {
  return {static_cast<std::uint16_t>((low + 256U * high) >> 2),
          static_cast<std::uint8_t>((low & 3U) << 4 | correction)};
}

}  // namespace

framing::Finding look_at_capsule(std::span<const std::uint8_t> bytes) {
  using Kind = framing::Finding::Kind;
  if (bytes[0] >> 4 != 0xA) return {};
  if (bytes.size() > 1 && bytes[1] >> 4 != 0x5) return {};
  if (bytes.size() < kCapsuleSize) return {Kind::need_more};
  const unsigned sent = (bytes[0] & 0xFU) | (bytes[1] & 0xFU) << 4;
  if (sent != checksum(bytes.first(kCapsuleSize))) return {Kind::bad_checksum};
  return {Kind::frame, kCapsuleSize};
}

Capsule parse_capsule(std::span<const std::uint8_t> frame) {
  const unsigned start = frame[2] + 256U * frame[3];
  Capsule capsule{.is_first = (start & 0x8000U) != 0, .start = static_cast<std::uint16_t>(start & 0x7FFFU)};
  for (std::size_t i = 0; i < kCapsulePoints / 2; ++i) {
    const auto cabin = frame.subspan(kHeaderSize + i * kCabinSize, kCabinSize);
    capsule.samples[2 * i] = sample(cabin[0], cabin[1], cabin[4] & 0xFU);
    capsule.samples[2 * i + 1] = sample(cabin[2], cabin[3], cabin[4] >> 4U);
  }
  return capsule;
}

std::optional<CapsulePoints::Points> CapsulePoints::add(const Capsule& capsule) {
  std::optional<Points> points;
  if (capsule.is_first)
    forget();
  else if (previous_)
    points = points_until(capsule.start);
  previous_ = capsule;
  return points;
}

void CapsulePoints::forget() {
  previous_.reset();
  next_begins_scan_ = false;
}

// Angles before the correction are counted in 1/32 of 1/64 degree, so that they are whole numbers. A scan begins with the
// first point behind a whole turn, which may be that of the next capsule.
CapsulePoints::Points CapsulePoints::points_until(int next_start) {
  const int start = previous_->start % kWholeTurn;
  const int way = (next_start % kWholeTurn - start + kWholeTurn) % kWholeTurn;
  Points points;
  for (int k = 0; k < static_cast<int>(kCapsulePoints); ++k) {
    const Capsule::Sample& sample = previous_->samples[static_cast<std::size_t>(k)];
    const int fine = 32 * start + k * way;
    Point& point = points[static_cast<std::size_t>(k)];
    point.begins_scan =
        std::exchange(next_begins_scan_, fine / (32 * kWholeTurn) != (fine + way) / (32 * kWholeTurn));
    point.angle = counter_clockwise(fine / (32.0 * 64.0) - sample.correction / 8.0);
    if (sample.distance != 0) point.range = sample.distance / 1000.0;
  }
  return points;
}

}  // namespace orca::hw::rplidar
