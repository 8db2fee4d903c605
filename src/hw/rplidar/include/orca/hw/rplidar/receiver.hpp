// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include "orca/hw/framing/scanner.hpp"
#include "orca/hw/rplidar/capsule.hpp"
#include "orca/hw/rplidar/node.hpp"
#include "orca/hw/rplidar/response.hpp"

namespace orca::hw::rplidar {

/// A descriptor that announces points.
struct ScanStarted {
  DataType type = DataType::nodes;
  friend bool operator==(const ScanStarted&, const ScanStarted&) = default;
};

/// What the scanner has said.
using Event = std::variant<DeviceInfo, Health, SampleRates, ScanStarted, Point>;

/// Everything that a scanner sends, out of a byte stream that arrives in pieces of any size. What comes before the
/// descriptor of an answer is skipped: the text of a reset, and the rest of a scan that was stopped.
///
/// It has no clock: who waits for an answer needs a time limit.
///
/// Thread contract: not synchronised; one thread.
class Receiver {
 public:
  Receiver();

  /// Waits for a descriptor again. Call it for each request that is sent, Request::stop included.
  void expect_answer();

  /// Takes the next bytes and calls sink(const Event&) for each event, in order. The sink must not call the receiver.
  template <class Sink>
  void feed(std::span<const std::uint8_t> bytes, Sink&& sink) {
    while (!bytes.empty()) {
      if (answer_ == DataType::nodes) {
        nodes_.feed(bytes, [&](const Node& node) { sink(Event(point_of(node))); });
        return;
      }
      if (answer_ == DataType::capsules) {
        capsules_.feed(bytes, [&](const framing::Frame& frame) {
          if (const auto points = points_of(frame))
            for (const Point& point : *points) sink(Event(point));
        });
        return;
      }
      if (const auto event = take(bytes[0])) sink(*event);
      bytes = bytes.subspan(1);
    }
  }

  /// Returns the number of bytes that were skipped while a descriptor was waited for.
  [[nodiscard]] std::uint64_t skipped_bytes() const { return skipped_bytes_; }
  /// Returns whether points are expected.
  [[nodiscard]] bool is_scanning() const {
    return answer_ == DataType::nodes || answer_ == DataType::capsules;
  }
  /// Returns what was counted in the latest scan.
  [[nodiscard]] const framing::Statistics& scan_statistics() const {
    return is_express_ ? capsules_.statistics() : nodes_.statistics();
  }

 private:
  std::optional<Event> take(std::uint8_t byte);
  std::optional<Event> begin(DataType type);
  std::optional<Event> finish_part();
  std::optional<CapsulePoints::Points> points_of(const framing::Frame& frame);

  std::optional<DataType> answer_;  // nothing: a descriptor is waited for
  std::array<std::uint8_t, 20> part_{};
  std::size_t size_ = 0;  // of the descriptor or the part, as far as it has come
  bool is_express_ = false;
  NodeReader nodes_;
  framing::Scanner capsules_;
  CapsulePoints capsule_points_;
  std::uint64_t skipped_bytes_ = 0;
};

}  // namespace orca::hw::rplidar
