// SPDX-License-Identifier: GPL-3.0-or-later
// The conversation with a camera by Video4Linux2: with one that tests make, and with the kernel where it has none.
#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <iostream>
#include <thread>

#include "fake_camera.hpp"
#include "orca/hw/camera/stream.hpp"
#include "orca/hw/link/device_files.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using namespace orca::hw::camera;
using Catch::Contains;
using Settings = FakeCameraSettings;

namespace {

// A camera on a desk whose clock a test sets.
struct Desk {
  explicit Desk(Settings settings = {}) : camera(std::move(settings), [this] { return now; }) {}
  ~Desk() {
    stream.close();
    CHECK(camera.complaints().empty());
    CHECK_FALSE(camera.is_open());
  }
  void start() {
    REQUIRE(stream.open(wish));
    REQUIRE(stream.start().ok());
  }
  // Takes the latest picture; the test fails if there is none.
  struct Seen {
    Bytes bytes;
    Duration age;
    std::uint64_t lost;
  };
  Seen look() {
    Seen seen{};
    const Result<bool> taken = stream.take([&](const Frame& frame) {
      seen = {Bytes(frame.bytes.begin(), frame.bytes.end()), frame.age, frame.lost};
    });
    REQUIRE(taken);
    CHECK(*taken);
    return seen;
  }
  bool sees_nothing() {
    const Result<bool> taken = stream.take([](const Frame&) { FAIL("a picture"); });
    return taken && !*taken;
  }
  Error error_of_opening() {
    const Result<Mode> opened = stream.open(wish);
    if (opened) FAIL("it opens");
    CHECK_FALSE(camera.is_open());
    return opened.error();
  }

  TimePoint now{5s};
  Wish wish{16, 16, 30.0, Channels::rgb};
  FakeCamera camera;
  std::unique_ptr<VideoCalls> calls = camera.calls();
  Stream stream{*calls, "/dev/video7"};
};

Settings with_formats(std::vector<Settings::Format> formats) {
  Settings settings;
  settings.formats = std::move(formats);
  return settings;
}

constexpr Settings::Size kSmall{640, 480, 30.0};

std::string format_chosen(const std::vector<Settings::Format>& formats, const Wish& wish) {
  Desk desk(with_formats(formats));
  const Result<Mode> mode = desk.stream.open(wish);
  REQUIRE(mode);
  return mode->format + " " + std::to_string(mode->layout.width) + " x " +
         std::to_string(mode->layout.height) + " at " + std::to_string(std::lround(mode->rate.value_or(0.0)));
}

}  // namespace

TEST_CASE("pictures come while the stream is started, with their bytes", "[camera][stream]") {
  Desk desk;
  CHECK(desk.stream.descriptor() == -1);
  desk.start();
  CHECK(desk.stream.card() == "Fake Camera");
  CHECK(desk.stream.descriptor() >= 0);
  CHECK(desk.sees_nothing());
  for (std::uint8_t i = 0; i < 10; ++i) {  // more than there are buffers
    const Bytes picture(16 * 16 * 3, i);
    desk.camera.expose(picture);
    CHECK(desk.look().bytes == picture);
    CHECK(desk.sees_nothing());
  }
  desk.stream.stop();
  CHECK_FALSE(desk.camera.streams());
  CHECK(desk.stream.descriptor() == -1);
  REQUIRE(desk.stream.start().ok());
  desk.camera.expose(Bytes(16 * 16 * 3, 1));
  CHECK(desk.look().lost == 0);
}

TEST_CASE(
    "the size that is nearest to the wish is taken, then a rate that suffices, then what is converted with "
    "the least work",
    "[camera][stream]") {
  using Formats = std::vector<Settings::Format>;
  const Formats usb{{V4L2_PIX_FMT_YUYV, {kSmall, {1280, 720, 10.0}}},
                    {V4L2_PIX_FMT_MJPEG, {kSmall, {1280, 720, 30.0}, {1920, 1080, 30.0}}}};
  CHECK(format_chosen(usb, {640, 480, 30.0}) == "YUYV 640 x 480 at 30");
  CHECK(format_chosen(usb, {1280, 720, 30.0}) == "MJPG 1280 x 720 at 30");
  CHECK(format_chosen(usb, {1280, 720, 10.0}) == "YUYV 1280 x 720 at 10");
  CHECK(format_chosen(usb, {1920, 1080, 5.0}) == "MJPG 1920 x 1080 at 5");
  CHECK(format_chosen(usb, {4000, 3000, 60.0}) == "MJPG 1920 x 1080 at 30");
  const Formats all{{V4L2_PIX_FMT_MJPEG, {kSmall}}, {V4L2_PIX_FMT_GREY, {kSmall}},
                    {V4L2_PIX_FMT_BGR24, {kSmall}}, {V4L2_PIX_FMT_NV12, {kSmall}},
                    {V4L2_PIX_FMT_YUYV, {kSmall}},  {V4L2_PIX_FMT_RGB24, {kSmall}}};
  CHECK(format_chosen(all, {640, 480, 30.0, Channels::rgb}) == "RGB3 640 x 480 at 30");
  CHECK(format_chosen(all, {640, 480, 30.0, Channels::grey}) == "GREY 640 x 480 at 30");
  const Formats half(all.begin(), all.begin() + 2);
  CHECK(format_chosen(half, {640, 480, 30.0, Channels::rgb}) == "MJPG 640 x 480 at 30");
}

TEST_CASE("a camera that knows of no rates is taken as it is, and rows may have bytes behind them",
          "[camera][stream]") {
  Settings settings;
  settings.has_rates = false;
  settings.padding = 5;
  Desk desk(settings);
  const Result<Mode> mode = desk.stream.open(desk.wish);
  REQUIRE(mode);
  CHECK_FALSE(mode->rate);
  CHECK(mode->layout.step == 16 * 3 + 5);
}

TEST_CASE("a camera whose formats cannot be read: those that it has and those that are read",
          "[camera][stream]") {
  Desk desk(with_formats({{V4L2_PIX_FMT_H264, {kSmall}}, {V4L2_PIX_FMT_Z16, {kSmall}}}));
  const Error error = desk.error_of_opening();
  CHECK(error.code == Code::invalid_argument);
  CHECK_THAT(error.message, Contains("the camera gives H264, Z16, and this driver reads GREY, NV12, YUYV"));
  Desk empty(with_formats({}));
  CHECK_THAT(empty.error_of_opening().message, Contains("the camera gives nothing"));
}

TEST_CASE("a device that is not there, or is no camera, says so and which cameras there are",
          "[camera][stream]") {
  Desk desk;
  desk.camera.unplug();
  CHECK(desk.error_of_opening().code == Code::not_found);
  CHECK_THAT(desk.error_of_opening().message, Contains("there is no /dev/video7; is the camera plugged in?"));
  desk.camera.plug_in();
  desk.camera.refuse(ENODEV);
  CHECK_THAT(desk.error_of_opening().message, Contains("/dev/video7 exists, but no camera is behind it"));
  desk.camera.refuse(ENOTTY);
  CHECK_THAT(desk.error_of_opening().message, Contains("/dev/video7 is no camera"));
  desk.camera.refuse(ELOOP);
  CHECK_THAT(desk.error_of_opening().message, Contains("cannot open /dev/video7: Too many"));
  desk.camera.refuse(0);
  desk.camera.set([](Settings& settings) { settings.refusals[VIDIOC_QUERYCAP] = ENOTTY; });
  CHECK_THAT(desk.error_of_opening().message, Contains("/dev/video7 is no camera"));
}

TEST_CASE("a file that gives no pictures as they are read here says what it is", "[camera][stream]") {
  const auto refusal = [](std::uint32_t can) {
    Settings settings;
    settings.can = can;
    return Desk(settings).error_of_opening().message;
  };
  CHECK_THAT(refusal(V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING),
             Contains("(Fake Camera) gives no pictures: it is another file of a camera"));
  CHECK_THAT(refusal(V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING), Contains("several planes"));
  CHECK_THAT(refusal(V4L2_CAP_VIDEO_CAPTURE), Contains("has no streaming"));
}

TEST_CASE("a camera that this user may not open: the group that may, and the command to join it",
          "[camera][stream]") {
  const TempFolder folder;
  const std::string file = folder.write("video0", "");
  REQUIRE(chmod(file.c_str(), 0660) == 0);
  Desk desk;
  desk.camera.refuse(EACCES);
  Stream stream(*desk.calls, file);
  const Result<Mode> opened = stream.open(desk.wish);
  REQUIRE_FALSE(opened);
  CHECK(opened.error().code == Code::failed_precondition);
  CHECK_THAT(opened.error().message, Contains("may not open " + file) && Contains("sudo usermod -aG ") &&
                                         Contains("log out and in again"));
}

TEST_CASE("a camera that another program uses says so, whenever the kernel notices it", "[camera][stream]") {
  Desk desk;
  desk.camera.lend(true);
  CHECK(desk.error_of_opening().code == Code::unavailable);
  CHECK_THAT(desk.error_of_opening().message,
             Contains("/dev/video7 is in use by another program") && Contains("sudo fuser '/dev/video7'"));
  desk.camera.lend(false);
  REQUIRE(desk.stream.open(desk.wish));
  desk.camera.lend(true);
  const Status started = desk.stream.start();
  REQUIRE_FALSE(started.ok());
  CHECK_THAT(started.error().message, Contains("/dev/video7 is in use by another program"));
}

TEST_CASE("a program that has the camera open is named", "[camera][stream]") {
  const TempFolder folder;
  const std::string file = folder.write("video0", "");
  const Descriptor held(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  Desk desk;
  desk.camera.lend(true);
  Stream stream(*desk.calls, file);
  CHECK_THAT(stream.open(desk.wish).error().message, Contains("in use by this program itself"));
}

TEST_CASE("what cannot be started says why, and leaves nothing behind", "[camera][stream]") {
  const auto refusal = [](const std::function<void(Settings&)>& change) {
    Desk desk;
    REQUIRE(desk.stream.open(desk.wish));
    desk.camera.set(change);
    const Status started = desk.stream.start();
    REQUIRE_FALSE(started.ok());
    CHECK_FALSE(desk.stream.is_started());
    desk.camera.set([](Settings& settings) { settings = {}; });
    REQUIRE(desk.stream.open(desk.wish));
    CHECK(desk.stream.start().ok());
    return started.error();
  };
  CHECK_THAT(refusal([](Settings& all) { all.refusals[VIDIOC_STREAMON] = ENOSPC; }).message,
             Contains("the bus has no room") && Contains("another USB port"));
  CHECK_THAT(refusal([](Settings& all) { all.refusals[VIDIOC_STREAMON] = EIO; }).message,
             Contains("/dev/video7 sends no pictures: Input/output error"));
  CHECK(refusal([](Settings& all) { all.refusals[VIDIOC_STREAMON] = ENODEV; }).code == Code::not_found);
  CHECK_THAT(refusal([](Settings& all) { all.most_buffers = 1; }).message, Contains("gives 1 buffers"));
  CHECK_THAT(refusal([](Settings& all) { all.can_map = false; }).message, Contains("cannot be mapped"));
  CHECK_THAT(refusal([](Settings& all) { all.refusals[VIDIOC_REQBUFS] = EINVAL; }).message,
             Contains("no buffers"));
  CHECK_THAT(refusal([](Settings& all) { all.refusals[VIDIOC_QUERYBUF] = EINVAL; }).message,
             Contains("no buffers"));
  CHECK_THAT(refusal([](Settings& all) { all.refusals[VIDIOC_QBUF] = EINVAL; }).message,
             Contains("takes no buffer"));
}

TEST_CASE("pictures that did not come are counted by their numbers, also those that were too old",
          "[camera][stream]") {
  Desk desk;
  desk.start();
  const auto expose = [&](std::uint8_t value) { desk.camera.expose(Bytes(16 * 16 * 3, value)); };
  expose(1);
  CHECK(desk.look().lost == 0);
  expose(2);
  expose(3);
  expose(4);
  const Desk::Seen late = desk.look();
  CHECK(late.bytes[0] == 4);
  CHECK(late.lost == 2);
  for (std::uint8_t i = 5; i < 15; ++i) expose(i);  // four of them find a buffer
  const Desk::Seen fourth = desk.look();
  CHECK(fourth.bytes[0] == 8);
  CHECK(fourth.lost == 3);
  expose(15);
  CHECK(desk.look().lost == 6);
  expose(16);
  CHECK(desk.look().lost == 0);
}

TEST_CASE("a picture is as old as the driver's stamp and the exposure say", "[camera][stream]") {
  const auto age = [](const Settings& settings, const Exposure& exposure = {}) {
    Desk desk(settings);
    desk.start();
    desk.camera.expose(Bytes(16 * 16 * 3, 1), exposure);
    desk.now += 40ms;
    return desk.look().age;
  };
  Settings settings;
  CHECK(age(settings) == 40ms);
  settings.controls = {{V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL}, {V4L2_CID_EXPOSURE_ABSOLUTE, 200}};
  CHECK(age(settings) == 30ms);  // the stamp is that of the beginning of an exposure of 20 ms
  settings.stamps = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_EOF;
  CHECK(age(settings) == 50ms);
  settings.controls[V4L2_CID_EXPOSURE_AUTO] = V4L2_EXPOSURE_AUTO;
  CHECK(age(settings) == 40ms);  // how long it exposes is not known
  settings.stamps = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  CHECK(age(settings) == 0ms);
  settings.stamps = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  CHECK(age(settings, {.stamp = 0s}) == 0ms);                             // no clock at all
  CHECK(age(settings, {.stamp = FakeCamera::kEpoch + 6s}) == 0ms);        // in the future
  CHECK(age(settings, {.stamp = FakeCamera::kEpoch + 4s}) == 1s + 40ms);  // late
}

TEST_CASE("a picture that the driver calls broken, or whose length cannot be, has no bytes",
          "[camera][stream]") {
  Desk desk;
  desk.start();
  const Bytes picture(16 * 16 * 3, 1);
  desk.camera.expose(picture, {.flags = V4L2_BUF_FLAG_ERROR});
  CHECK(desk.look().bytes.empty());
  desk.camera.expose(picture, {.bytesused = 4'000'000'000U});
  CHECK(desk.look().bytes.empty());
  desk.camera.expose(picture, {.bytesused = 5});
  CHECK(desk.look().bytes.size() == 5);
  desk.camera.expose(picture);
  CHECK(desk.look().bytes == picture);
}

TEST_CASE("a camera that goes while it streams is an error, and one that comes back can be opened again",
          "[camera][stream]") {
  Desk desk;
  desk.start();
  CHECK(desk.stream.check_present().ok());
  desk.camera.unplug();
  const Result<bool> taken = desk.stream.take([](const Frame&) { FAIL("a picture"); });
  REQUIRE_FALSE(taken);
  CHECK(taken.error().code == Code::not_found);
  CHECK_THAT(taken.error().message, Contains("the camera has gone: was /dev/video7 unplugged?"));
  CHECK(desk.stream.check_present().error().code == Code::not_found);
  desk.stream.close();
  desk.camera.plug_in();
  desk.start();
  desk.camera.expose(Bytes(16 * 16 * 3, 9));
  CHECK(desk.look().bytes[0] == 9);
}

TEST_CASE("a driver that fails, or gives a buffer that it does not have, is an error", "[camera][stream]") {
  Desk desk;
  desk.start();
  desk.camera.set([](Settings& settings) { settings.refusals[VIDIOC_DQBUF] = EIO; });
  const auto take = [&] { return desk.stream.take([](const Frame&) { FAIL("a picture"); }); };
  CHECK_THAT(take().error().message, Contains("gives no more pictures: Input/output error"));
  desk.camera.set([](Settings& settings) { settings.refusals.clear(); });
  desk.camera.expose(Bytes(16 * 16 * 3, 9), {.index = 4});
  CHECK_THAT(take().error().message, Contains("a buffer that it does not have"));
}

TEST_CASE("the kernel's own answers: a file and a device of another kind are no cameras and are not opened",
          "[camera][stream]") {
  const TempFolder folder;
  const std::unique_ptr<VideoCalls> kernel = make_system_video();
  const auto refusal = [&](const std::string& path) {
    return Stream(*kernel, path).open({}).error().message;
  };
  CHECK_THAT(refusal(folder.file("nothing")), Contains("there is no " + folder.file("nothing")));
  CHECK_THAT(refusal(folder.write("text", "")), Contains("is no camera"));
  CHECK_THAT(refusal("/dev/null"), Contains("/dev/null is no camera"));
}

// The kernel's module vivid makes cameras that draw test pictures: sudo modprobe vivid.
TEST_CASE("a camera of the kernel that is none gives pictures of the size that it announces",
          "[camera][tool]") {
  const std::unique_ptr<VideoCalls> kernel = make_system_video();
  for (const std::string& path : hw::link::cameras()) {
    Stream stream(*kernel, path);
    const Result<Mode> mode = stream.open({});
    if (!mode || stream.card().find("vivid") == std::string::npos) continue;
    REQUIRE(stream.start().ok());
    std::size_t bytes = 0;
    Duration age = -1s;
    for (int i = 0; i < 300 && bytes == 0; ++i) {
      std::this_thread::sleep_for(10ms);
      const Result<bool> taken = stream.take([&](const Frame& frame) {
        bytes = frame.bytes.size();
        age = frame.age;
      });
      REQUIRE(taken);
    }
    CHECK(bytes >= std::max<std::size_t>(bytes_of_picture(mode->layout), 1));
    CHECK(age >= 0s);
    CHECK(age < 1s);
    return;
  }
  std::cout << "SKIPPED: no camera of the kernel's module vivid is here (sudo modprobe vivid)\n";
}
