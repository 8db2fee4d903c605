// SPDX-License-Identifier: LGPL-3.0-or-later
#include "compression.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <string>

namespace orca::recording {
namespace {

constexpr std::size_t kStep = std::size_t{1} << 20;           // [bytes] by which a content grows
constexpr std::uint64_t kLargest = std::uint64_t{512} << 20;  // [bytes] of a chunk's content
constexpr int kLevel = 1;

Error no_memory() {
  return fail(Code::unavailable, "there is no memory to compress a chunk, or to open one");
}
Error damaged(const std::string& what) { return fail(Code::data_loss, "a chunk is damaged: " + what); }

// Gives `out` room for more, up to the size that is claimed. Returns false if there is none.
bool grow(Bytes& out, std::size_t used, std::uint64_t size) {
  if (used >= size) return false;
  out.resize(std::min<std::uint64_t>(size, used + kStep));
  return true;
}

struct ZstdDeleter {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

Result<Bytes> unpack_zstd(std::span<const std::byte> frame, std::uint64_t size) {
  const std::unique_ptr<ZSTD_DCtx, ZstdDeleter> context(ZSTD_createDCtx());
  if (!context) return no_memory();
  Bytes out;
  std::size_t used = 0;
  ZSTD_inBuffer in{frame.data(), frame.size(), 0};
  for (std::size_t rest = 1; rest != 0;) {
    grow(out, used, size);
    ZSTD_outBuffer to{out.data() + used, out.size() - used, 0};
    const std::size_t before = in.pos;
    rest = ZSTD_decompressStream(context.get(), &to, &in);
    if (ZSTD_isError(rest) != 0) return damaged(ZSTD_getErrorName(rest));
    used += to.pos;
    if (rest != 0 && to.pos == 0 && in.pos == before)
      return damaged("it ends too early, or holds more than it says");
  }
  if (used != size || in.pos != in.size) return damaged("it does not hold as many bytes as it says");
  out.resize(used);
  return out;
}

struct Lz4Deleter {
  void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
};

Result<Bytes> unpack_lz4(std::span<const std::byte> frame, std::uint64_t size) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) return no_memory();
  const std::unique_ptr<LZ4F_dctx, Lz4Deleter> context(made);
  Bytes out;
  std::size_t used = 0;
  std::size_t read = 0;
  for (std::size_t rest = 1; rest != 0;) {
    grow(out, used, size);
    std::size_t written = out.size() - used;
    std::size_t taken = frame.size() - read;
    rest = LZ4F_decompress(context.get(), out.data() + used, &written, frame.data() + read, &taken, nullptr);
    if (LZ4F_isError(rest) != 0) return damaged(LZ4F_getErrorName(rest));
    used += written;
    read += taken;
    if (rest != 0 && written == 0 && taken == 0)
      return damaged("it ends too early, or holds more than it says");
  }
  if (used != size || read != frame.size()) return damaged("it does not hold as many bytes as it says");
  out.resize(used);
  return out;
}

}  // namespace

Result<Bytes> compress(std::span<const std::byte> bytes) {
  Bytes out(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size) != 0) return no_memory();  // it has room, so nothing else is in its way
  out.resize(size);
  return out;
}

Result<Bytes> decompress(std::string_view compression, std::span<const std::byte> frame, std::uint64_t size) {
  if (size > kLargest) return damaged("it says that it holds " + std::to_string(size) + " bytes");
  if (compression.empty()) {
    if (frame.size() != size) return damaged("it does not hold as many bytes as it says");
    return Bytes(frame.begin(), frame.end());
  }
  if (compression == kZstd) return unpack_zstd(frame, size);
  if (compression == "lz4") return unpack_lz4(frame, size);
  return fail(Code::unimplemented,
              "a chunk is compressed with " + std::string(compression) + "; zstd and lz4 can be read");
}

}  // namespace orca::recording
