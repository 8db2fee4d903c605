// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/rplidar/node.hpp"

#include <cstdlib>

namespace orca::hw::rplidar {

namespace {

// The shorter way from one angle to the other, forward positive.
int way_between(int from, int to) {
  const int way = (to - from + kWholeTurn) % kWholeTurn;
  return way > kWholeTurn / 2 ? way - kWholeTurn : way;
}

bool is_small_step(int from, int to) { return std::abs(way_between(from, to)) <= NodeReader::kLargestStep; }

}  // namespace

std::optional<Node> parse_node(std::span<const std::uint8_t> bytes) {
  const unsigned flags = bytes[0] & 3U;
  const int angle = (bytes[1] + 256 * bytes[2]) >> 1;
  const bool is_good = (flags == 1 || flags == 2) && (bytes[1] & 1U) != 0 && angle < kWholeTurn;
  if (!is_good) return std::nullopt;
  return Node{.begins_scan = flags == 1,
              .quality = static_cast<std::uint8_t>(bytes[0] >> 2),
              .angle = static_cast<std::uint16_t>(angle),
              .distance = static_cast<std::uint16_t>(bytes[3] + 256 * bytes[4])};
}

Point point_of(const Node& node) {
  Point point{.begins_scan = node.begins_scan,
              .angle = counter_clockwise(node.angle / 64.0),
              .quality = node.quality};
  if (node.distance != 0) point.range = node.distance / 4000.0;
  return point;
}

std::optional<Node> NodeReader::next() {
  if (!in_step_) find_row();
  if (!in_step_ || size_ < 2 * kNodeSize) return std::nullopt;
  const auto node = node_at(0);
  const auto after = node_at(1);
  if (!node || !after || !is_small_step(node->angle, after->angle)) {
    in_step_ = false;
    return std::nullopt;
  }
  drop(kNodeSize);
  ++statistics_.frames;
  return node;
}

void NodeReader::find_row() {
  if (size_ < buffer_.size()) return;
  if (!is_row()) {
    skip(1);
    has_skipped_ = true;
    return;
  }
  in_step_ = true;
  if (!has_skipped_) return;
  has_skipped_ = false;
  skip(kNodeSize);
  ++statistics_.resynchronisations;
}

bool NodeReader::is_row() const {
  int beginnings = 0;
  int way = 0;
  std::optional<Node> before;
  for (std::size_t i = 0; i < kRow; ++i) {
    const auto node = node_at(i);
    if (!node || (before && !is_small_step(before->angle, node->angle))) return false;
    beginnings += node->begins_scan ? 1 : 0;
    if (before) way += way_between(before->angle, node->angle);
    before = node;
  }
  return beginnings <= 1 && way > 0;
}

std::optional<Node> NodeReader::node_at(std::size_t index) const {
  return parse_node(std::span(buffer_).subspan(index * kNodeSize, kNodeSize));
}

void NodeReader::skip(std::size_t count) {
  drop(count);
  statistics_.skipped_bytes += count;
}

void NodeReader::drop(std::size_t count) {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(count),
            buffer_.begin() + static_cast<std::ptrdiff_t>(size_), buffer_.begin());
  size_ -= count;
}

}  // namespace orca::hw::rplidar
