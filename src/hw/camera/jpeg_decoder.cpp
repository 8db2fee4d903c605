// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/camera/jpeg_decoder.hpp"

#include <csetjmp>
#include <cstdio>  // jpeglib.h needs it before

#include <jerror.h>
#include <jpeglib.h>

namespace orca::hw::camera {

// libjpeg reports what is broken by a function that must not return, so that the only way out is a long jump. It leads over frames
// of libjpeg and of functions below that have nothing to destroy.
struct JpegDecoder::State {
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  std::jmp_buf out{};
  char text[JMSG_LENGTH_MAX]{};  // what is wrong
  bool is_made = false;
};

namespace {

template <class State>
State& state_of(j_common_ptr jpeg) {
  return *static_cast<State*>(jpeg->client_data);
}

struct Wanted {
  std::size_t width;
  std::size_t height;
  Channels channels;
};

// Returns what is wrong with the picture that the header announces; null: nothing.
const char* wrong_header(const jpeg_decompress_struct& jpeg, const Wanted& wanted) {
  if (jpeg.image_width != wanted.width || jpeg.image_height != wanted.height)
    return "it has another size than the camera has announced";
  if (jpeg.progressive_mode != 0) return "it is a progressive JPEG, which is no picture of Motion JPEG";
  if (jpeg.jpeg_color_space != JCS_YCbCr && jpeg.jpeg_color_space != JCS_GRAYSCALE &&
      jpeg.jpeg_color_space != JCS_RGB)
    return "it has other colours than those of Motion JPEG";
  return nullptr;
}

// Nothing in here has a destructor.
const char* decode_rows(jpeg_decompress_struct& jpeg, std::span<const std::uint8_t> bytes,
                        const Wanted& wanted, std::uint8_t* into) {
  jpeg_mem_src(&jpeg, bytes.data(), bytes.size());
  if (jpeg_read_header(&jpeg, TRUE) != JPEG_HEADER_OK) return "it has no header";
  if (const char* const wrong = wrong_header(jpeg, wanted)) return wrong;
  jpeg.out_color_space = wanted.channels == Channels::grey ? JCS_GRAYSCALE : JCS_RGB;
  jpeg.dct_method = JDCT_ISLOW;
  (void)jpeg_start_decompress(&jpeg);
  const std::size_t row = wanted.width * static_cast<std::size_t>(wanted.channels);
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW to = into + jpeg.output_scanline * row;
    (void)jpeg_read_scanlines(&jpeg, &to, 1);
  }
  (void)jpeg_finish_decompress(&jpeg);
  return nullptr;
}

}  // namespace

JpegDecoder::JpegDecoder() : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.jpeg.err = jpeg_std_error(&state.errors);
  state.jpeg.client_data = &state;
  state.errors.error_exit = [](j_common_ptr jpeg) {
    State& failed = state_of<State>(jpeg);
    jpeg->err->format_message(jpeg, failed.text);
    std::longjmp(failed.out, 1);
  };
  // A warning means that a part of the picture is guessed. Bytes too many before a marker, which some cameras send with every
  // picture, spoil nothing.
  state.errors.emit_message = [](j_common_ptr jpeg, int level) {
    if (level < 0 && jpeg->err->msg_code != JWRN_EXTRANEOUS_DATA) jpeg->err->error_exit(jpeg);
  };
  state.errors.output_message = [](j_common_ptr /*jpeg*/) {};
  if (setjmp(state.out) != 0) return;  // another libjpeg than the one that it was compiled with, or no memory
  jpeg_create_decompress(&state.jpeg);
  state.is_made = true;
}

JpegDecoder::~JpegDecoder() {
  if (state_->is_made) jpeg_destroy_decompress(&state_->jpeg);
}

Status JpegDecoder::decode(std::span<const std::uint8_t> bytes, std::size_t width, std::size_t height,
                           Channels channels, std::span<std::uint8_t> into) {
  State& state = *state_;
  if (into.size() < width * height * static_cast<std::size_t>(channels))
    return fail(Code::invalid_argument, "there is no room for the picture");
  if (!state.is_made) return fail(Code::data_loss, state.text);
  if (bytes.empty()) return fail(Code::data_loss, "it is empty");
  if (setjmp(state.out) != 0) {
    jpeg_abort_decompress(&state.jpeg);
    return fail(Code::data_loss, state.text);
  }
  const char* const wrong = decode_rows(state.jpeg, bytes, {width, height, channels}, into.data());
  if (wrong == nullptr) return ok();
  jpeg_abort_decompress(&state.jpeg);
  return fail(Code::data_loss, wrong);
}

}  // namespace orca::hw::camera
