// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orca/component/param.hpp"
#include "orca/hw/camera/jpeg_decoder.hpp"
#include "orca/hw/camera/stream.hpp"
#include "orca/hw/container.hpp"
#include "orca/idl/sensing.hpp"

namespace orca::hw::camera {

/// The driver of a camera: its parameters, its pictures as an endpoint, and what is counted of them.
///
/// Thread contract: as HardwareContainer.
class CameraDriver : public HardwareContainer {
 public:
  CameraDriver(HardwareHost& host, std::unique_ptr<VideoCalls> calls);

  std::vector<HardwareFault> prepare() final;
  [[nodiscard]] idl::Robot description() const final;

 protected:
  Status open() final;
  void close() final;
  Status start() final;
  void stop() final;
  Status poll() final;
  Status drive(const DriveSetpoint& setpoint) final;
  [[nodiscard]] TimePoint next_poll() const final;
  [[nodiscard]] int descriptor() const final { return stream_ ? stream_->descriptor() : -1; }
  [[nodiscard]] bool recovers() const final { return true; }
  [[nodiscard]] Duration longest_silence() const final;
  [[nodiscard]] LineCounts counts() const final { return counts_; }

 private:
  [[nodiscard]] Channels channels() const;
  [[nodiscard]] Duration longest_wait() const;
  void note_mode();
  void take(const Frame& frame);
  Status develop(const Frame& frame, idl::Image& image);
  void fill(idl::Image& image, TimePoint stamp) const;
  void note_spoiled(const Frame& frame, const std::string& why);

  const std::unique_ptr<VideoCalls> calls_;
  Param<std::string> device_{
      *this,
      "device",
      "/dev/video0",
      {.text = "The camera: /dev/video0, or better its name in /dev/v4l/by-id, which stays with it."}};
  Param<std::string> name_{*this, "name", "camera", {.text = "Name of this camera, one word."}};
  Param<std::int64_t> width_{
      *this, "width", 640, {.min = 16, .max = 8192, .text = "Pixels in a row of a picture."}};
  Param<std::int64_t> height_{*this, "height", 480, {.min = 16, .max = 8192, .text = "Rows of a picture."}};
  Param<double> rate_{
      *this, "rate", 30.0, {.unit = "Hz", .min = 0.2, .max = 500.0, .text = "Pictures in a second."}};
  Param<std::string> encoding_{*this,
                               "encoding",
                               "RGB8",
                               {.choices = {"RGB8", "MONO8"},
                                .text = "What a pixel is: red, green and blue, or its brightness alone."}};
  Param<double> field_of_view_{
      *this,
      "field_of_view",
      0.0,
      {.unit = "rad",
       .min = 0.0,
       .max = 3.0,
       .text = "Angle between what is at the left and at the right edge of a picture, without "
               "distortion; 0: not known."}};
  Param<double> x_{
      *this, "x", 0.0, {.unit = "m", .text = "Where it sits on the robot: ahead of the middle."}};
  Param<double> y_{*this, "y", 0.0, {.unit = "m", .text = "To the left of the middle."}};
  Param<double> z_{*this, "z", 0.0, {.unit = "m", .text = "Height of its lens above the floor."}};
  Param<double> yaw_{
      *this,
      "yaw",
      0.0,
      {.unit = "rad", .text = "Direction of its line of sight, 0 ahead, positive to the left."}};
  Param<double> pitch_{
      *this, "pitch", 0.0, {.unit = "rad", .text = "Its inclination, positive: it looks down."}};
  Param<double> roll_{
      *this,
      "roll",
      0.0,
      {.unit = "rad",
       .text = "Its turn about the line of sight; pi: it hangs upside down, and so do its pictures."}};

  std::optional<SensorHW<idl::Image>> endpoint_;
  std::optional<Stream> stream_;
  JpegDecoder jpeg_;
  Mode mode_;
  std::string noted_;  // what was said of the mode
  LineCounts counts_;
  bool was_whole_ = true;      // the last picture, and none was lost
  bool told_spoiled_ = false;  // since the camera was opened
  std::string spoiled_;        // why the last one was that
  TimePoint good_{};           // when a good picture came, or the camera was started
  TimePoint checked_{};        // when it was looked whether it is there
};

}  // namespace orca::hw::camera
