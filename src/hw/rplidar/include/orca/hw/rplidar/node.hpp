// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>

#include "orca/geometry/angle.hpp"
#include "orca/hw/framing/scanner.hpp"

namespace orca::hw::rplidar {

/// A measured point in the frame of the scanner: origin in the axis of rotation, x forward as the manual draws it, where
/// the scanner's angle is 0, y left, z up.
///
/// The scanner turns clockwise seen from above, so the angles of a scan decrease. A plain value.
struct Point {
  bool begins_scan = false;               ///< It is the first of a turn.
  double angle = 0.0;                     ///< [rad] in (-pi, pi], counter-clockwise.
  std::optional<double> range{};          ///< [m] nothing: no echo.
  std::optional<std::uint8_t> quality{};  ///< 0 to 63, strength of the echo; nothing in an express scan.
  friend bool operator==(const Point&, const Point&) = default;
};

/// Returns the angle of a Point.
/// @param degrees [deg]  clockwise, as the scanner counts.
[[nodiscard]] inline double counter_clockwise(double degrees) {
  return wrapped(-degrees * std::numbers::pi / 180.0);
}

inline constexpr std::size_t kNodeSize = 5;  ///< [bytes]
inline constexpr int kWholeTurn = 360 * 64;  ///< In the unit of start angles and of Node::angle.

/// A point as the scanner sends it after Request::scan. A plain value.
struct Node {
  bool begins_scan = false;
  std::uint8_t quality = 0;    ///< 0 to 63.
  std::uint16_t angle = 0;     ///< [1/64 deg] clockwise, less than kWholeTurn.
  std::uint16_t distance = 0;  ///< [1/4 mm] 0: no echo.
  friend bool operator==(const Node&, const Node&) = default;
};

/// Reads a node.
/// @pre     5 bytes.
/// @return  nothing if the start flag and its inverse are equal, the check bit is 0, or the angle is a whole turn or more.
[[nodiscard]] std::optional<Node> parse_node(std::span<const std::uint8_t> bytes);

[[nodiscard]] Point point_of(const Node& node);

/// The nodes of a byte stream that arrives in pieces of any size.
///
/// A node has only two bits to check it by. So the first one is not believed before a row of kRow nodes fits together:
/// each is good, their angles go forward in small steps, and at most one begins a scan. From then on a node is handed out
/// as soon as the next one fits to it. If it does not, bytes may be missing in either: both are dropped, and the bytes
/// are searched for the next row. The first node behind skipped bytes may be made of pieces and is dropped too.
///
/// Thread contract: not synchronised; one thread.
class NodeReader {
 public:
  static constexpr std::size_t kRow = 8;        ///< Nodes.
  static constexpr int kLargestStep = 20 * 64;  ///< [1/64 deg] between nodes, in either direction.

  /// Takes the next bytes and calls sink(const Node&) for each node, in order.
  template <class Sink>
  void feed(std::span<const std::uint8_t> bytes, Sink&& sink) {
    for (const std::uint8_t byte : bytes) {
      buffer_[size_++] = byte;
      while (const auto node = next()) sink(*node);
    }
  }

  /// Counts nodes as frames; there are no checksums.
  [[nodiscard]] const framing::Statistics& statistics() const { return statistics_; }

 private:
  std::optional<Node> next();
  [[nodiscard]] bool is_row() const;
  [[nodiscard]] std::optional<Node> node_at(std::size_t index) const;
  void find_row();
  void drop(std::size_t count);
  void skip(std::size_t count);

  std::array<std::uint8_t, kRow * kNodeSize> buffer_{};
  std::size_t size_ = 0;
  bool in_step_ = false;
  bool has_skipped_ = false;
  framing::Statistics statistics_;
};

}  // namespace orca::hw::rplidar
