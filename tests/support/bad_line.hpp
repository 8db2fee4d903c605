// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/emulators/firmware.hpp"
#include "orca/hw/framing/scanner.hpp"

namespace orca::test {

/// A device with a bad line: what it sends is changed on the way, and what it is sent may come back to the host.
///
/// Thread contract: as the device.
template <class Device>
class BadLine final : public emulators::Firmware {
 public:
  using Bytes = std::vector<std::uint8_t>;

  /// @param body  an emulators::Body or Mirror, as the device needs it.
  template <class Body, class... More>
  explicit BadLine(Body& body, More&&... more) : device_(body, std::forward<More>(more)...) {}

  /// Lets a function change all that the device sends from now on; none: nothing.
  void spoil(std::function<void(Bytes& sent)> change) { change_ = std::move(change); }
  /// Each byte that the device is sent comes back.
  void echo(bool on) { echoes_ = on; }
  [[nodiscard]] Device& device() { return device_; }

  void take(std::span<const std::uint8_t> bytes, std::uint32_t baud, TimePoint now) override {
    if (echoes_) echo_.insert(echo_.end(), bytes.begin(), bytes.end());
    device_.take(bytes, baud, now);
  }
  std::vector<std::uint8_t> advance(TimePoint now) override {
    Bytes sent = device_.advance(now);
    if (change_) change_(sent);
    sent.insert(sent.begin(), echo_.begin(), echo_.end());
    echo_.clear();
    return sent;
  }
  void reset(TimePoint now) override { device_.reset(now); }
  void note_host(bool is_there, TimePoint now) override { device_.note_host(is_there, now); }

 private:
  Device device_;
  std::function<void(Bytes&)> change_;
  bool echoes_ = false;
  Bytes echo_;
};

/// Returns what flips a bit of some bytes, chosen at random with that chance [0..1].
[[nodiscard]] inline std::function<void(std::vector<std::uint8_t>&)> flipped_bits(double chance) {
  return [chance, random = RandomStream(1, "test", "bad line")](std::vector<std::uint8_t>& sent) mutable {
    for (std::uint8_t& byte : sent)
      if (random.uniform(0.0, 1.0) < chance) byte = static_cast<std::uint8_t>(byte ^ (1U << (random() % 8)));
  };
}

/// Returns what puts these bytes behind each n-th byte.
[[nodiscard]] inline std::function<void(std::vector<std::uint8_t>&)> garbage_after(
    int n, std::vector<std::uint8_t> garbage) {
  return [n, garbage = std::move(garbage), count = 0](std::vector<std::uint8_t>& sent) mutable {
    std::vector<std::uint8_t> all;
    for (const std::uint8_t byte : sent) {
      all.push_back(byte);
      if (++count % n == 0) all.insert(all.end(), garbage.begin(), garbage.end());
    }
    sent = std::move(all);
  };
}

/// Returns what holds all bytes back for so many steps of the device, and then lets them go at once.
[[nodiscard]] inline std::function<void(std::vector<std::uint8_t>&)> glued(int steps) {
  return [steps, count = 0, held = std::vector<std::uint8_t>()](std::vector<std::uint8_t>& sent) mutable {
    held.insert(held.end(), sent.begin(), sent.end());
    sent.clear();
    if (++count % steps == 0) sent.swap(held);
  };
}

/// Returns what changes every 40th byte, so that no longer packet is whole. Two changes do not make up for each other in a sum.
[[nodiscard]] inline std::function<void(std::vector<std::uint8_t>&)> all_spoiled() {
  return [count = 0U](std::vector<std::uint8_t>& sent) mutable {
    for (std::uint8_t& byte : sent)
      if (++count % 40 == 0) byte = static_cast<std::uint8_t>(byte ^ (1U << (count / 40 % 7)));
  };
}

/// Returns what flips one bit of one in so many frames that the device sends, wherever in the frame.
[[nodiscard]] inline std::function<void(std::vector<std::uint8_t>&)> one_frame_spoiled_in(
    int n, const hw::framing::Protocol& protocol) {
  return [n, scanner = hw::framing::Scanner(protocol), random = RandomStream(1, "test", "spoiled"),
          count = 0](std::vector<std::uint8_t>& sent) mutable {
    std::vector<std::uint8_t> passed;
    scanner.feed(sent, [&](const hw::framing::Frame& frame) {
      const auto begin = static_cast<std::ptrdiff_t>(passed.size());
      passed.insert(passed.end(), frame.bytes.begin(), frame.bytes.end());
      if (++count % n == 0)
        passed[static_cast<std::size_t>(begin) + random() % frame.bytes.size()] ^=
            static_cast<std::uint8_t>(1U << (random() % 8));
    });
    sent = std::move(passed);
  };
}

}  // namespace orca::test
