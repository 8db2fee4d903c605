// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "orca/base/result.hpp"
#include "orca/hw/camera/pixels.hpp"

namespace orca::hw::camera {

/// A decoder of the pictures of Motion JPEG: baseline JPEG, in which the Huffman tables may be missing.
///
/// Thread contract: not synchronised; it may move between threads.
class JpegDecoder {
 public:
  JpegDecoder();
  ~JpegDecoder();
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  /// Decodes a picture. Rows of the result follow each other without a gap. Bytes behind its end, and between its parts, do no
  /// harm.
  /// @param width, height  that it must have.
  /// @param into           width * height pixels of that many channels.
  /// @errors  data_loss, with what is wrong, if it is broken, cut off, of another size or progressive; `into` then holds nothing of
  ///          use. invalid_argument if `into` is too small.
  [[nodiscard]] Status decode(std::span<const std::uint8_t> bytes, std::size_t width, std::size_t height,
                              Channels channels, std::span<std::uint8_t> into);

 private:
  struct State;
  const std::unique_ptr<State> state_;
};

}  // namespace orca::hw::camera
