// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "frames/frame.hpp"
#include "orca/base/result.hpp"

namespace orca::bytes {

/// Returns the frame behind its length [bytes, 32 bits], as it travels in a stream.
[[nodiscard]] std::vector<std::byte> in_stream(const frames::Frame& frame);

/// A stream of bytes that is cut into frames.
class FrameSplitter {
 public:
  void append(std::span<const std::byte> bytes);
  /// Returns the next whole frame without its length, valid until the next call; nothing if it is not whole yet.
  /// @errors  data_loss for an impossible length.
  Result<std::optional<std::span<const std::byte>>> next();

 private:
  std::vector<std::byte> bytes_;
  std::size_t used_ = 0;
};

}  // namespace orca::bytes
