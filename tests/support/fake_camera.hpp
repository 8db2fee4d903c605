// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <linux/videodev2.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/hw/camera/video_calls.hpp"

namespace orca::test {

using Bytes = std::vector<std::uint8_t>;

/// What a camera can do, as tests set it.
struct FakeCameraSettings {
  struct Size {
    std::uint32_t width;
    std::uint32_t height;
    double rate;  // [Hz] the highest one
  };
  struct Format {
    std::uint32_t number;
    std::vector<Size> sizes;
  };
  std::string card = "Fake Camera";
  std::vector<Format> formats{{V4L2_PIX_FMT_RGB24, {{16, 16, 30.0}}}};
  std::uint32_t can = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::uint32_t most_buffers = 32;
  std::uint32_t padding = 0;  // [bytes] behind each row
  std::uint32_t stamps = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  bool is_plugged_in = true;
  bool has_rates = true;
  bool can_map = true;
  std::map<std::uint32_t, std::int32_t> controls{};
  std::map<unsigned long, int> refusals{};  // errno by request, instead of doing it
};

/// What is unusual about a picture.
struct Exposure {
  std::uint32_t flags = 0;                   // more of V4L2_BUF_FLAG_
  std::optional<std::uint32_t> bytesused{};  // what the driver says, instead of the truth
  std::optional<Duration> stamp{};           // the same
  std::optional<std::uint32_t> index{};      // the same
};

/// A camera behind VideoCalls that follows the protocol of Video4Linux2's streaming as the kernel's documents have it, with
/// buffers in a memory file, and an eventfd that has input while a picture waits. It notes where its user does not follow it.
///
/// Thread contract: any thread.
class FakeCamera {
 public:
  /// @param now  the clock of the run; that of the time stamps is kEpoch later.
  FakeCamera(FakeCameraSettings settings, std::function<TimePoint()> now);
  static constexpr Duration kEpoch = 1000s;

  /// Returns the calls that lead to it. It outlives them.
  [[nodiscard]] std::unique_ptr<hw::camera::VideoCalls> calls();

  /// Takes a picture, which is lost if no buffer waits for it.
  void expose(const Bytes& bytes, const Exposure& exposure = {});
  /// Takes pictures by itself, one per period, from the start of each stream on.
  void play(Duration period, std::function<Bytes(std::uint32_t)> picture);
  void unplug();
  void plug_in();
  /// Lets open() fail with that errno; 0: no more.
  void refuse(int reason);
  /// Lets another program use it, or no more.
  void lend(bool lent);
  void set(const std::function<void(FakeCameraSettings&)>& change);

  [[nodiscard]] bool streams() const;
  [[nodiscard]] bool is_open() const;
  /// Returns what its user has done that the protocol forbids, and what was left behind.
  [[nodiscard]] std::vector<std::string> complaints() const;

 private:
  friend class FakeVideo;

  struct Buffer {
    bool is_queued = false;
    std::uint32_t mappings = 0;
  };

  int open();
  void close();
  int control(unsigned long request, void* argument);
  void* map(std::size_t length, std::int64_t offset);
  void unmap(void* at, std::size_t length);
  [[nodiscard]] Duration clock() const;

  int query_capabilities(v4l2_capability& about) const;
  int list_format(v4l2_fmtdesc& about) const;
  int set_format(v4l2_format& format);
  int set_rate(v4l2_streamparm& param);
  int make_buffers(v4l2_requestbuffers& request);
  int describe_buffer(v4l2_buffer& buffer) const;
  int queue(const v4l2_buffer& buffer);
  int dequeue(v4l2_buffer& buffer);
  int start();
  int stop();
  int get(v4l2_control& control) const;
  void catch_up();
  void put(const Bytes& bytes, const Exposure& exposure, Duration stamp);
  void ring();
  void complain(const std::string& what) { complaints_.push_back(what); }
  [[nodiscard]] const FakeCameraSettings::Size* size_nearest(std::uint32_t number, std::uint32_t width,
                                                             std::uint32_t height) const;

  mutable std::mutex mutex_;
  FakeCameraSettings settings_;
  const std::function<TimePoint()> now_;
  bool lent_ = false;
  int refusal_ = 0;
  int event_ = -1;  // its user's descriptor
  Descriptor memory_;
  std::size_t length_ = 0;  // of a buffer
  v4l2_pix_format format_{};
  const FakeCameraSettings::Size* size_ = nullptr;
  std::vector<Buffer> buffers_;
  std::deque<std::uint32_t> empty_;
  std::deque<v4l2_buffer> full_;
  bool streams_ = false;
  std::uint32_t sequence_ = 0;
  Duration period_{0};
  TimePoint due_{};
  std::function<Bytes(std::uint32_t)> picture_;
  std::vector<std::string> complaints_;
};

}  // namespace orca::test
