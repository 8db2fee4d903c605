// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

#include "bytes.hpp"
#include "orca/base/result.hpp"

namespace orca::recording {

inline constexpr std::string_view kZstd = "zstd";

/// Returns bytes as a zstd frame of the fastest regular level.
/// @errors  unavailable without memory.
[[nodiscard]] Result<Bytes> compress(std::span<const std::byte> bytes);

/// Returns the content of a chunk. Takes no more memory than the content needs, whatever the sizes claim.
/// @param compression  "zstd", "lz4" (its frame format), or "".
/// @param size         [bytes] of the content, as the file claims.
/// @errors  data_loss if the frame is damaged or its content has another size; unimplemented for another compression;
///          unavailable without memory.
[[nodiscard]] Result<Bytes> decompress(std::string_view compression, std::span<const std::byte> frame,
                                       std::uint64_t size);

}  // namespace orca::recording
