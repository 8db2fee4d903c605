// SPDX-License-Identifier: GPL-3.0-or-later
#include "fake_camera.hpp"

#include <sys/eventfd.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace orca::test {
namespace {

constexpr std::size_t kPage = 4096;

template <class T>
T& as(void* argument) {
  return *static_cast<T*>(argument);
}

std::uint32_t bytes_per_pixel(std::uint32_t number) {
  if (number == V4L2_PIX_FMT_YUYV) return 2;
  return number == V4L2_PIX_FMT_RGB24 || number == V4L2_PIX_FMT_BGR24 ? 3 : 1;
}

}  // namespace

class FakeVideo final : public hw::camera::VideoCalls {
 public:
  explicit FakeVideo(FakeCamera& camera) : camera_(camera) {}

  int open(const std::string& /*path*/) override { return camera_.open(); }
  void close(int /*descriptor*/) override { camera_.close(); }
  int control(int /*descriptor*/, unsigned long request, void* argument) override {
    return camera_.control(request, argument);
  }
  void* map(int /*descriptor*/, std::size_t length, std::int64_t offset) override {
    return camera_.map(length, offset);
  }
  void unmap(void* at, std::size_t length) override { camera_.unmap(at, length); }
  [[nodiscard]] Duration now() const override { return camera_.clock(); }

 private:
  FakeCamera& camera_;
};

FakeCamera::FakeCamera(FakeCameraSettings settings, std::function<TimePoint()> now)
    : settings_(std::move(settings)), now_(std::move(now)) {}

std::unique_ptr<hw::camera::VideoCalls> FakeCamera::calls() { return std::make_unique<FakeVideo>(*this); }

Duration FakeCamera::clock() const { return now_().time_since_epoch() + kEpoch; }

void FakeCamera::expose(const Bytes& bytes, const Exposure& exposure) {
  const std::lock_guard lock(mutex_);
  put(bytes, exposure, exposure.stamp.value_or(clock()));
}

void FakeCamera::play(Duration period, std::function<Bytes(std::uint32_t)> picture) {
  const std::lock_guard lock(mutex_);
  period_ = period;
  picture_ = std::move(picture);
}

void FakeCamera::unplug() {
  const std::lock_guard lock(mutex_);
  settings_.is_plugged_in = false;
  ring();  // its user's poll() ends, as with POLLERR
}

void FakeCamera::plug_in() {
  const std::lock_guard lock(mutex_);
  settings_.is_plugged_in = true;
}

void FakeCamera::refuse(int reason) {
  const std::lock_guard lock(mutex_);
  refusal_ = reason;
}

void FakeCamera::lend(bool lent) {
  const std::lock_guard lock(mutex_);
  lent_ = lent;
}

void FakeCamera::set(const std::function<void(FakeCameraSettings&)>& change) {
  const std::lock_guard lock(mutex_);
  change(settings_);
}

bool FakeCamera::streams() const {
  const std::lock_guard lock(mutex_);
  return streams_;
}

bool FakeCamera::is_open() const {
  const std::lock_guard lock(mutex_);
  return event_ >= 0;
}

std::vector<std::string> FakeCamera::complaints() const {
  const std::lock_guard lock(mutex_);
  return complaints_;
}

int FakeCamera::open() {
  const std::lock_guard lock(mutex_);
  if (refusal_ != 0) return -refusal_;
  if (!settings_.is_plugged_in) return -ENOENT;
  if (event_ >= 0) complain("opened twice");
  event_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  format_ = {};
  return event_;
}

void FakeCamera::close() {
  const std::lock_guard lock(mutex_);
  for (const Buffer& buffer : buffers_)
    if (buffer.mappings != 0) complain("closed while a buffer is mapped");
  ::close(std::exchange(event_, -1));
  buffers_.clear();
  streams_ = false;
}

int FakeCamera::control(unsigned long request, void* argument) {
  const std::lock_guard lock(mutex_);
  if (event_ < 0) return EBADF;
  if (!settings_.is_plugged_in) return ENODEV;
  if (const auto refused = settings_.refusals.find(request); refused != settings_.refusals.end())
    return refused->second;
  switch (request) {
    case VIDIOC_QUERYCAP: return query_capabilities(as<v4l2_capability>(argument));
    case VIDIOC_ENUM_FMT: return list_format(as<v4l2_fmtdesc>(argument));
    case VIDIOC_S_FMT: return set_format(as<v4l2_format>(argument));
    case VIDIOC_S_PARM: return set_rate(as<v4l2_streamparm>(argument));
    case VIDIOC_REQBUFS: return make_buffers(as<v4l2_requestbuffers>(argument));
    case VIDIOC_QUERYBUF: return describe_buffer(as<v4l2_buffer>(argument));
    case VIDIOC_QBUF: return queue(as<v4l2_buffer>(argument));
    case VIDIOC_DQBUF: return dequeue(as<v4l2_buffer>(argument));
    case VIDIOC_STREAMON: return start();
    case VIDIOC_STREAMOFF: return stop();
    case VIDIOC_G_CTRL: return get(as<v4l2_control>(argument));
    default: complain("an order that it does not know"); return ENOTTY;
  }
}

int FakeCamera::query_capabilities(v4l2_capability& about) const {
  about = {};
  std::strncpy(reinterpret_cast<char*>(about.card), settings_.card.c_str(), sizeof about.card);
  about.capabilities = settings_.can | V4L2_CAP_DEVICE_CAPS | V4L2_CAP_META_CAPTURE;  // of all its files
  about.device_caps = settings_.can;                                                  // of this one
  return 0;
}

int FakeCamera::list_format(v4l2_fmtdesc& about) const {
  if (about.type != V4L2_BUF_TYPE_VIDEO_CAPTURE || about.index >= settings_.formats.size()) return EINVAL;
  about.pixelformat = settings_.formats[about.index].number;
  return 0;
}

const FakeCameraSettings::Size* FakeCamera::size_nearest(std::uint32_t number, std::uint32_t width,
                                                         std::uint32_t height) const {
  const auto format = std::ranges::find(settings_.formats, number, &FakeCameraSettings::Format::number);
  if (format == settings_.formats.end()) return nullptr;
  const auto off = [&](const FakeCameraSettings::Size& size) {
    return std::abs(static_cast<int>(size.width) - static_cast<int>(width)) +
           std::abs(static_cast<int>(size.height) - static_cast<int>(height));
  };
  return &*std::ranges::min_element(format->sizes, {}, off);
}

int FakeCamera::set_format(v4l2_format& format) {
  if (format.type != V4L2_BUF_TYPE_VIDEO_CAPTURE) return EINVAL;
  if (lent_ || !buffers_.empty()) return EBUSY;
  v4l2_pix_format& pixels = format.fmt.pix;
  size_ = size_nearest(pixels.pixelformat, pixels.width, pixels.height);
  if (size_ == nullptr) return EINVAL;
  pixels.width = size_->width;
  pixels.height = size_->height;
  pixels.field = V4L2_FIELD_NONE;
  const bool is_jpeg = pixels.pixelformat == V4L2_PIX_FMT_MJPEG;
  pixels.bytesperline = is_jpeg ? 0 : pixels.width * bytes_per_pixel(pixels.pixelformat) + settings_.padding;
  const std::uint32_t rows = pixels.pixelformat == V4L2_PIX_FMT_NV12 ? pixels.height * 3 / 2 : pixels.height;
  pixels.sizeimage = is_jpeg ? pixels.width * pixels.height * 3 + 4096 : pixels.bytesperline * rows;
  pixels.colorspace = V4L2_COLORSPACE_SRGB;
  format_ = pixels;
  return 0;
}

int FakeCamera::set_rate(v4l2_streamparm& param) {
  if (!settings_.has_rates) return ENOTTY;
  if (size_ == nullptr || param.type != V4L2_BUF_TYPE_VIDEO_CAPTURE) return EINVAL;
  v4l2_fract& period = param.parm.capture.timeperframe;
  const double asked = static_cast<double>(period.denominator) / period.numerator;
  period = {1000, static_cast<std::uint32_t>(std::lround(1000.0 * std::min(asked, size_->rate)))};
  return 0;
}

int FakeCamera::make_buffers(v4l2_requestbuffers& request) {
  if (request.type != V4L2_BUF_TYPE_VIDEO_CAPTURE || request.memory != V4L2_MEMORY_MMAP) return EINVAL;
  if (lent_ || streams_) return EBUSY;
  for (const Buffer& buffer : buffers_)
    if (buffer.mappings != 0) return EBUSY;
  if (request.count > 0 && format_.sizeimage == 0) complain("buffers before a format");
  request.count = std::min(request.count, settings_.most_buffers);
  if (!memory_) memory_ = Descriptor(memfd_create("pictures", MFD_CLOEXEC));
  length_ = (format_.sizeimage + kPage - 1) / kPage * kPage;
  buffers_.assign(request.count, {});
  if (ftruncate(memory_.number(), static_cast<off_t>(length_ * request.count)) != 0) return ENOMEM;
  return 0;
}

int FakeCamera::describe_buffer(v4l2_buffer& buffer) const {
  if (buffer.index >= buffers_.size()) return EINVAL;
  buffer.length = static_cast<std::uint32_t>(length_);
  buffer.m.offset = static_cast<std::uint32_t>(buffer.index * length_);
  return 0;
}

void* FakeCamera::map(std::size_t length, std::int64_t offset) {
  const std::lock_guard lock(mutex_);
  if (!settings_.can_map) return nullptr;
  if (length != length_ || offset % static_cast<std::int64_t>(length_) != 0)
    complain("another length mapped");
  ++buffers_.at(static_cast<std::size_t>(offset) / length_).mappings;
  void* const at = mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, memory_.number(), offset);
  return at == MAP_FAILED ? nullptr : at;
}

void FakeCamera::unmap(void* at, std::size_t length) {
  const std::lock_guard lock(mutex_);
  if (length != length_ || munmap(at, length) != 0) complain("unmapped what is not mapped");
  const auto mapped = std::ranges::find_if(buffers_, [](const Buffer& each) { return each.mappings != 0; });
  if (mapped == buffers_.end())
    complain("unmapped too often");
  else
    --mapped->mappings;
}

int FakeCamera::queue(const v4l2_buffer& buffer) {
  if (buffer.index >= buffers_.size() || buffer.memory != V4L2_MEMORY_MMAP) return EINVAL;
  if (buffers_[buffer.index].is_queued) complain("a buffer queued twice");
  buffers_[buffer.index].is_queued = true;
  empty_.push_back(buffer.index);
  return 0;
}

int FakeCamera::start() {
  if (empty_.size() < 2) complain("started with too few buffers");
  streams_ = true;
  sequence_ = 0;
  due_ = now_() + period_;
  return 0;
}

int FakeCamera::stop() {
  streams_ = false;
  for (Buffer& buffer : buffers_) buffer.is_queued = false;
  empty_.clear();
  full_.clear();
  return 0;
}

int FakeCamera::get(v4l2_control& control) const {
  const auto found = settings_.controls.find(control.id);
  if (found == settings_.controls.end()) return EINVAL;
  control.value = found->second;
  return 0;
}

void FakeCamera::catch_up() {
  for (; picture_ && streams_ && due_ <= now_(); due_ += period_)
    put(picture_(sequence_), {}, due_.time_since_epoch() + kEpoch);
}

void FakeCamera::put(const Bytes& bytes, const Exposure& exposure, Duration stamp) {
  if (!streams_ || !settings_.is_plugged_in) return;
  const std::uint32_t sequence = sequence_++;
  if (empty_.empty()) return;
  v4l2_buffer full{};
  full.index = empty_.front();
  empty_.pop_front();
  const std::size_t count = std::min(bytes.size(), length_);
  if (pwrite(memory_.number(), bytes.data(), count, static_cast<off_t>(full.index * length_)) !=
      static_cast<ssize_t>(count))
    complain("no room for a picture");
  full.sequence = sequence;
  full.bytesused = exposure.bytesused.value_or(static_cast<std::uint32_t>(bytes.size()));
  full.flags = settings_.stamps | exposure.flags;
  full.timestamp.tv_sec = std::chrono::duration_cast<std::chrono::seconds>(stamp).count();
  full.timestamp.tv_usec = std::chrono::duration_cast<std::chrono::microseconds>(stamp % 1s).count();
  buffers_[full.index].is_queued = false;
  full.index = exposure.index.value_or(full.index);
  full_.push_back(full);
  ring();
}

void FakeCamera::ring() {
  const std::uint64_t once = 1;
  if (event_ >= 0 && write(event_, &once, sizeof once) != sizeof once) complain("nobody hears its bell");
}

int FakeCamera::dequeue(v4l2_buffer& buffer) {
  if (!streams_) return EINVAL;
  catch_up();
  if (full_.empty()) return EAGAIN;
  buffer = full_.front();
  full_.pop_front();
  std::uint64_t rings = 0;
  if (full_.empty() && read(event_, &rings, sizeof rings) != sizeof rings) complain("its bell was silent");
  return 0;
}

}  // namespace orca::test
