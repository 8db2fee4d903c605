// SPDX-License-Identifier: LGPL-3.0-or-later
#include "camera_driver.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "orca/base/portable_math.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/geometry.hpp"
#include "orca/idl/time.hpp"

namespace orca::hw::camera {
namespace {

constexpr Duration kLook = 100ms;     // between two looks, if no picture wakes it sooner
constexpr Duration kPresence = 1s;    // between two looks whether an idle camera is there
constexpr Duration kLeastWait = 3s;   // for a picture: cameras need a second or two for the first one
constexpr double kLongPeriods = 5.0;  // for which to wait at least
constexpr double kSameRate = 0.05;    // a relative difference that is none

std::string rate_text(std::optional<double> rate) {
  char text[40] = " at a rate that it does not tell";
  if (rate) std::snprintf(text, sizeof text, " at %.3g Hz", *rate);
  return text;
}

std::string size_text(std::size_t width, std::size_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

}  // namespace

CameraDriver::CameraDriver(HardwareHost& host, std::unique_ptr<VideoCalls> calls)
    : HardwareContainer(host), calls_(std::move(calls)) {}

std::vector<HardwareFault> CameraDriver::prepare() {
  if (!device_->starts_with('/'))
    return {{"device", in_quotes(printable(*device_)) +
                           " is no path; write /dev/video0, or a camera's path in /dev/v4l/by-id"}};
  set_line_name(*device_);
  stream_.emplace(*calls_, *device_);
  endpoint_.emplace(from_seconds(1.0 / *rate_));
  add_sensor(*endpoint_);
  return {};
}

idl::Robot CameraDriver::description() const {
  idl::Sensor camera;
  camera.name(*name_);
  camera.model("Video4Linux2 camera");
  camera.port(*device_);
  camera.type(std::string(endpoint_->type().name));
  camera.update_interval(to_seconds(endpoint_->period()));
  idl::Robot robot;
  robot.name(*name_);
  robot.model("Video4Linux2 camera");
  robot.sensors().push_back(camera);
  return robot;
}

Channels CameraDriver::channels() const { return *encoding_ == "MONO8" ? Channels::grey : Channels::rgb; }

Status CameraDriver::open() {
  const Result<Mode> mode = stream_->open({.width = static_cast<std::size_t>(*width_),
                                           .height = static_cast<std::size_t>(*height_),
                                           .rate = *rate_,
                                           .channels = channels()});
  counts_ = {};
  told_spoiled_ = false;
  if (!mode) return mode.error();
  mode_ = *mode;
  checked_ = host().now();
  note_mode();
  return ok();
}

// Says what the camera gives, and what of it was not asked for, unless it was said before.
void CameraDriver::note_mode() {
  const Layout& layout = mode_.layout;
  const std::string size = size_text(layout.width, layout.height);
  const std::string text =
      "connected to " + stream_->card() + ": " + size + ", " + mode_.format + rate_text(mode_.rate);
  if (std::exchange(noted_, text) == text) return;
  host().write_log(log::Level::info, text);
  const std::string asked = size_text(static_cast<std::size_t>(*width_), static_cast<std::size_t>(*height_));
  if (size != asked)
    host().write_log(log::Level::warning, "the camera gives pictures of " + size + ", not " + asked +
                                              " as its parameters ask; these are used");
  if (mode_.rate && std::abs(*mode_.rate - *rate_) > kSameRate * *rate_)
    host().write_log(log::Level::warning, "the camera gives pictures" + rate_text(mode_.rate) + ", not" +
                                              rate_text(*rate_) + " as its parameters ask");
}

void CameraDriver::close() {
  if (stream_) stream_->close();
}

Status CameraDriver::start() {
  if (Status started = stream_->start(); !started.ok()) return started;
  good_ = host().now();
  was_whole_ = true;
  heard();  // it has until longest_silence() for its first picture
  return ok();
}

void CameraDriver::stop() { stream_->stop(); }

Status CameraDriver::poll() {
  const TimePoint now = host().now();
  if (!stream_->is_started()) {
    if (now < checked_ + kPresence) return ok();
    checked_ = now;
    return stream_->check_present();
  }
  const Result<bool> taken = stream_->take([this](const Frame& frame) { take(frame); });
  if (!taken) return taken.error();
  if (!*taken || now - good_ < longest_wait()) return ok();
  return fail(Code::data_loss, "pictures come, but no whole one for " + seconds_text(longest_wait()) + ": " +
                                   spoiled_ + "; is its cable good, and is the bus not overloaded?");
}

TimePoint CameraDriver::next_poll() const {
  return stream_->is_started() ? host().now() + kLook : checked_ + kPresence;
}

Duration CameraDriver::longest_wait() const {
  return std::max(kLeastWait, from_seconds(kLongPeriods / mode_.rate.value_or(*rate_)));
}

// While nobody uses it, it says nothing.
Duration CameraDriver::longest_silence() const {
  return stream_->is_started() ? longest_wait() : Duration::max();
}

Status CameraDriver::drive(const DriveSetpoint& /*setpoint*/) {
  return fail(Code::failed_precondition, "a camera does not move");
}

void CameraDriver::take(const Frame& frame) {
  const TimePoint now = host().now();
  const TimePoint stamp = now - frame.age;
  heard(stamp);
  counts_.bad_checksums += frame.lost;
  auto image = endpoint_->loan();
  if (const Status developed = develop(frame, *image); !developed.ok())
    return note_spoiled(frame, developed.error().message);
  if (!was_whole_ || frame.lost > 0) ++counts_.resynchronisations;
  was_whole_ = true;
  ++counts_.frames;
  good_ = now;
  fill(*image, stamp);
  endpoint_->publish(std::move(image));
}

// The pixels go from the device's buffer to where the picture will be read.
Status CameraDriver::develop(const Frame& frame, idl::Image& image) {
  const Layout& layout = mode_.layout;
  if (frame.bytes.empty()) return fail(Code::data_loss, "the kernel's driver says that it is broken");
  image.data().resize_for_overwrite(layout.width * layout.height * static_cast<std::size_t>(channels()));
  const std::span<std::uint8_t> into(image.data().data(), image.data().size());
  if (layout.format == PixelFormat::mjpeg)
    return jpeg_.decode(frame.bytes, layout.width, layout.height, channels(), into);
  if (convert(layout, frame.bytes, channels(), into)) return ok();
  return fail(Code::data_loss, "it has " + std::to_string(frame.bytes.size()) + " bytes instead of " +
                                   std::to_string(bytes_of_picture(layout)));
}

void CameraDriver::fill(idl::Image& image, TimePoint stamp) const {
  const double width = static_cast<double>(mode_.layout.width);
  image.encoding(channels() == Channels::grey ? idl::MONO8 : idl::RGB8);
  image.width(static_cast<std::uint32_t>(mode_.layout.width));
  image.height(static_cast<std::uint32_t>(mode_.layout.height));
  image.step(static_cast<std::uint32_t>(mode_.layout.width * static_cast<std::size_t>(channels())));
  const double half = 0.5 * *field_of_view_;
  image.focal_length(half > 0.0 ? 0.5 * width * portable::cos(half) / portable::sin(half) : 0.0);
  image.pose().position(make_point(*x_, *y_, *z_));
  image.pose().rotation().roll(*roll_);
  image.pose().rotation().pitch(*pitch_);
  image.pose().rotation().yaw(*yaw_);
  image.pose().stamp(to_time_value(stamp));
}

void CameraDriver::note_spoiled(const Frame& frame, const std::string& why) {
  ++counts_.bad_checksums;
  counts_.skipped_bytes += frame.bytes.size();
  was_whole_ = false;
  spoiled_ = why;
  if (std::exchange(told_spoiled_, true)) return;
  host().write_log(log::Level::warning,
                   "a picture is spoiled: " + printable(why) + "; such pictures are left out and counted");
}

}  // namespace orca::hw::camera
