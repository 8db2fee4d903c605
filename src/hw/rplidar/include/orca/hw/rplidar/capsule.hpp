// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "orca/hw/framing/scanner.hpp"
#include "orca/hw/rplidar/node.hpp"

namespace orca::hw::rplidar {

inline constexpr std::size_t kCapsuleSize = 84;  ///< [bytes]
inline constexpr std::size_t kCapsulePoints = 32;

/// Points as the scanner sends them after Request::express_scan. A plain value.
struct Capsule {
  struct Sample {
    std::uint16_t distance = 0;   ///< [mm] 0: no echo; less than 16384.
    std::uint8_t correction = 0;  ///< [1/8 deg] to subtract from the angle; less than 64.
    friend bool operator==(const Sample&, const Sample&) = default;
  };
  bool is_first = false;    ///< The first one after the request.
  std::uint16_t start = 0;  ///< [1/64 deg] clockwise angle of the first sample, before its correction.
  std::array<Sample, kCapsulePoints> samples{};
  friend bool operator==(const Capsule&, const Capsule&) = default;
};

/// Recognises a capsule at the first of these bytes, by two marks of four bits and a checksum.
[[nodiscard]] framing::Finding look_at_capsule(std::span<const std::uint8_t> bytes);

/// The framing of an express scan, for a framing::Scanner.
inline constexpr framing::Protocol kCapsuleProtocol{.look = look_at_capsule, .longest = kCapsuleSize};

/// @pre  `frame` is one that a scanner with kCapsuleProtocol has found.
[[nodiscard]] Capsule parse_capsule(std::span<const std::uint8_t> frame);

/// The points of successive capsules. The angle between points is known only when the start of the next capsule is, so
/// the points of a capsule are handed out with the next one.
///
/// Point k of 0 to 31 is at start + k / 32 of the way to the next start, less its correction. The correction has no sign,
/// and k counts from 0, as in the vendor's SDK; the vendor's text calls the highest of its bits a sign.
///
/// Thread contract: not synchronised.
class CapsulePoints {
 public:
  using Points = std::array<Point, kCapsulePoints>;

  /// Returns the points of the capsule before, which end where this one begins; nothing if there is none, or if this one
  /// is the first of a scan.
  std::optional<Points> add(const Capsule& capsule);

  /// Forgets the capsule before, because one was lost: it would be drawn out over the gap.
  void forget();

 private:
  [[nodiscard]] Points points_until(int next_start);

  std::optional<Capsule> previous_;
  bool next_begins_scan_ = false;
};

}  // namespace orca::hw::rplidar
