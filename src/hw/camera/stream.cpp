// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/camera/stream.hpp"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "choice.hpp"
#include "orca/base/exhaustion.hpp"
#include "orca/base/text.hpp"
#include "trouble.hpp"

namespace orca::hw::camera {
namespace {

constexpr std::uint32_t kBuffers = 4;  // one that is looked at, one that is filled, and two for a late strand
constexpr std::uint32_t kFewest = 2;
constexpr std::uint32_t kMost = 32;        // as many as Video4Linux2 gives
constexpr Duration kOldest = 60s;          // that a picture may be; what says more has a clock that is wrong
constexpr Duration kExposureUnit = 100us;  // of V4L2_CID_EXPOSURE_ABSOLUTE
constexpr std::uint32_t kLongestGap = 1U << 31U;  // in sequence numbers; a longer one is a step back

v4l2_buffer buffer_of(std::uint32_t index) {
  v4l2_buffer buffer{};
  buffer.index = index;
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  return buffer;
}

bool is_monotonic(const v4l2_buffer& buffer) {
  return (buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
}

Duration stamp_of(const v4l2_buffer& buffer) {
  return std::chrono::seconds(buffer.timestamp.tv_sec) + std::chrono::microseconds(buffer.timestamp.tv_usec);
}

std::string text_in(const std::uint8_t* bytes, std::size_t most) {
  const auto* const text = reinterpret_cast<const char*>(bytes);
  return printable(std::string(text, strnlen(text, most)));
}

}  // namespace

Error Stream::failed(const std::string& what, int reason) const {
  if (reason == ENODEV || reason == ENXIO)
    return fail(Code::not_found, "the camera has gone: was " + path_ + " unplugged?");
  return fail(Code::unavailable, path_ + " " + what + ": " + std::strerror(reason));
}

Result<Mode> Stream::open(const Wish& wish) {
  close();
  descriptor_ = calls_.open(path_);
  if (descriptor_ < 0) {
    const int reason = -descriptor_;
    descriptor_ = -1;
    throw_if_exhausted(reason);
    return explain_refusal(path_, reason);
  }
  bool is_busy = false;
  const Status met = meet();
  Result<Mode> mode = met.ok() ? choose_mode(calls_, descriptor_, wish, is_busy) : Result<Mode>(met.error());
  if (mode) return mode;
  close();
  return is_busy ? explain_refusal(path_, EBUSY) : mode;
}

// Finds out whether it is a camera whose pictures are read from buffers.
Status Stream::meet() {
  v4l2_capability about{};
  if (const int reason = calls_.control(descriptor_, VIDIOC_QUERYCAP, &about); reason != 0)
    return explain_refusal(path_, reason);
  card_ = text_in(about.card, sizeof about.card);
  const std::uint32_t can =
      (about.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? about.device_caps : about.capabilities;
  if ((can & V4L2_CAP_VIDEO_CAPTURE) == 0)
    return explain_no_camera(path_, card_,
                             (can & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0
                                 ? "gives pictures in several planes, which this driver does not read"
                                 : "gives no pictures: it is another file of a camera, or another device");
  if ((can & V4L2_CAP_STREAMING) == 0)
    return explain_no_camera(path_, card_, "has no streaming, by which this driver reads pictures");
  return ok();
}

Status Stream::start() {
  if (is_started()) return ok();
  last_.reset();
  Status made = set_up_buffers();
  if (!made.ok()) {
    stop();
    return made;
  }
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  const int reason = calls_.control(descriptor_, VIDIOC_STREAMON, &type);
  if (reason != 0) stop();
  if (reason == ENOSPC)
    return fail(
        Code::unavailable,
        "the bus has no room for the pictures of " + path_ +
            "; is another camera on it? Ask for smaller pictures or a lower rate, or use another USB port");
  if (reason != 0) return failed("sends no pictures", reason);
  half_exposure_ = half_exposure();
  return ok();
}

Status Stream::set_up_buffers() {
  v4l2_requestbuffers request{};
  request.count = kBuffers;
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  const int reason = calls_.control(descriptor_, VIDIOC_REQBUFS, &request);
  if (reason == EBUSY) {
    close();
    return explain_refusal(path_, EBUSY);
  }
  if (reason != 0) return failed("gives no buffers", reason);
  if (request.count < kFewest || request.count > kMost)
    return fail(Code::unavailable, path_ + " gives " + std::to_string(request.count) + " buffers; at least " +
                                       std::to_string(kFewest) + " are needed");
  for (std::uint32_t i = 0; i < request.count; ++i)
    if (Status mapped = map_buffer(i); !mapped.ok()) return mapped;
  for (std::uint32_t i = 0; i < request.count; ++i)
    if (Status queued = queue(i); !queued.ok()) return queued;
  return ok();
}

Status Stream::map_buffer(std::uint32_t index) {
  v4l2_buffer buffer = buffer_of(index);
  if (const int reason = calls_.control(descriptor_, VIDIOC_QUERYBUF, &buffer); reason != 0)
    return failed("gives no buffers", reason);
  void* const at = buffer.length > 0 ? calls_.map(descriptor_, buffer.length, buffer.m.offset) : nullptr;
  if (at == nullptr)
    return fail(Code::unavailable, "the buffers of " + path_ + " cannot be mapped into memory");
  buffers_.push_back({static_cast<std::uint8_t*>(at), buffer.length});
  return ok();
}

Status Stream::queue(std::uint32_t index) {
  v4l2_buffer buffer = buffer_of(index);
  const int reason = calls_.control(descriptor_, VIDIOC_QBUF, &buffer);
  return reason == 0 ? ok() : Status(failed("takes no buffer", reason));
}

// Only an exposure that was set is known; one that the camera chooses changes.
Duration Stream::half_exposure() const {
  v4l2_control automatic{};
  automatic.id = V4L2_CID_EXPOSURE_AUTO;
  if (calls_.control(descriptor_, VIDIOC_G_CTRL, &automatic) == 0 &&
      automatic.value != V4L2_EXPOSURE_MANUAL && automatic.value != V4L2_EXPOSURE_SHUTTER_PRIORITY)
    return Duration{0};
  v4l2_control exposure{};
  exposure.id = V4L2_CID_EXPOSURE_ABSOLUTE;
  if (calls_.control(descriptor_, VIDIOC_G_CTRL, &exposure) != 0) return Duration{0};
  return std::clamp(exposure.value * kExposureUnit, Duration{0}, Duration{1s}) / 2;
}

void Stream::stop() {
  if (descriptor_ < 0 || !is_started()) return;
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  (void)calls_.control(descriptor_, VIDIOC_STREAMOFF, &type);
  for (const Buffer& buffer : buffers_) calls_.unmap(buffer.at, buffer.length);
  buffers_.clear();
  v4l2_requestbuffers none{};
  none.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  none.memory = V4L2_MEMORY_MMAP;
  (void)calls_.control(descriptor_, VIDIOC_REQBUFS, &none);
}

void Stream::close() {
  stop();
  if (descriptor_ >= 0) calls_.close(descriptor_);
  descriptor_ = -1;
}

Result<std::optional<Stream::Taken>> Stream::dequeue() {
  v4l2_buffer buffer = buffer_of(0);
  const int reason = calls_.control(descriptor_, VIDIOC_DQBUF, &buffer);
  if (reason == EAGAIN) return std::optional<Taken>();
  if (reason != 0) return failed("gives no more pictures", reason);
  if (buffer.index >= buffers_.size())
    return fail(Code::unavailable, path_ + " gives a buffer that it does not have; its driver is wrong");
  Taken taken{buffer.index, buffer.bytesused, buffer.sequence, Duration{0}};
  const bool is_broken = (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0;
  if (is_broken || buffer.bytesused > buffers_[buffer.index].length) taken.length = 0;
  const Duration since = is_monotonic(buffer) ? calls_.now() - stamp_of(buffer) : Duration{0};
  if (since < Duration{0} || since > kOldest || !is_monotonic(buffer)) return std::optional(taken);
  const bool is_of_start = (buffer.flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  taken.age = is_of_start ? std::max(since - half_exposure_, Duration{0}) : since + half_exposure_;
  return std::optional(taken);
}

Result<bool> Stream::take(const std::function<void(const Frame&)>& use) {
  std::optional<Taken> latest;
  for (std::size_t i = 0; i < buffers_.size();
       ++i) {  // a camera that is faster than this loop does not hold it up
    const Result<std::optional<Taken>> next = dequeue();
    if (!next) return next.error();
    if (!*next) break;
    if (latest)
      if (Status queued = queue(latest->index); !queued.ok()) return queued.error();
    latest = *next;
  }
  if (!latest) return false;
  Frame frame{{buffers_[latest->index].at, latest->length}, latest->age, 0};
  if (last_)
    if (const std::uint32_t gap = latest->sequence - *last_ - 1; gap < kLongestGap) frame.lost = gap;
  last_ = latest->sequence;
  use(frame);
  if (Status queued = queue(latest->index); !queued.ok()) return queued.error();
  return true;
}

Status Stream::check_present() {
  v4l2_capability about{};
  const int reason = calls_.control(descriptor_, VIDIOC_QUERYCAP, &about);
  return reason == 0 ? ok() : Status(failed("does not answer", reason));
}

}  // namespace orca::hw::camera
