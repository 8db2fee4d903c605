// SPDX-License-Identifier: GPL-3.0-or-later
// The driver of cameras as a hardware container, with a camera that tests make.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../fake_scout.hpp"
#include "../patient_executives.hpp"
#include "camera_driver.hpp"
#include "fake_camera.hpp"
#include "jpeg_picture.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::HardwareState;
using Settings = FakeCameraSettings;
using Params = std::map<std::string, ParamValue>;

namespace {

constexpr Duration kPeriod = 40ms;

Settings camera_of(std::uint32_t format, std::uint32_t width, std::uint32_t height, double rate = 25.0) {
  Settings settings;
  settings.formats = {{format, {{width, height, rate}}}};
  return settings;
}

Settings small_camera() { return camera_of(V4L2_PIX_FMT_RGB24, 16, 16); }
Bytes small_picture(std::uint8_t value) { return Bytes(std::size_t{16 * 16 * 3}, value); }

Params small(Params more = {}) {
  more.insert({{"width", std::int64_t{16}}, {"height", std::int64_t{16}}, {"rate", 25.0}});
  return more;
}

// A driver whose strand runs as long as this lives, and the pictures that it publishes.
struct RunningCamera {
  RunningCamera(Executive& used, const Settings& settings, const Params& params)
      : executive(used),
        camera(settings, [&used] { return used.now(); }),
        host(used, diary),
        driver(host, camera.calls()) {
    for (const auto& [name, value] : params) host.set(name, value);
    REQUIRE(driver.prepare().empty());
    driver.sensors().at(0)->set_sink(this, [this](ObjectLoan reading) {
      ObjectRef sealed = std::move(reading).seal();
      const std::lock_guard lock(mutex);
      pictures.push_back(object_cast<idl::Image>(sealed));
      return sealed;
    });
    driver.run();
  }
  ~RunningCamera() {
    driver.shut_down();
    CHECK(driver.join_until(executive.now() + 5s));
    driver.sensors().at(0)->set_sink(this, nullptr);
    CHECK(camera.complaints().empty());
    CHECK_FALSE(camera.is_open());
  }

  void start() {
    driver.acquire();
    REQUIRE(gets(HardwareState::active));
  }
  [[nodiscard]] bool gets(HardwareState state) {
    return eventually(executive, [&] { return driver.state() == state; });
  }
  [[nodiscard]] std::size_t count() {
    const std::lock_guard lock(mutex);
    return pictures.size();
  }
  [[nodiscard]] ObjectPtr<idl::Image> last() {
    const std::lock_guard lock(mutex);
    return pictures.back();
  }
  // Takes a picture; returns whether it is published.
  bool shows(const Bytes& bytes, const Exposure& exposure = {}) {
    const std::size_t before = count();
    camera.expose(bytes, exposure);
    sleep(executive, kPeriod);
    return count() == before + 1;
  }
  [[nodiscard]] bool says(const std::string& text) {
    return eventually(executive, [&] { return times_said(text) > 0; });
  }
  [[nodiscard]] std::ptrdiff_t times_said(const std::string& text) const {
    return std::ranges::count_if(
        diary.lines(), [&](const std::string& line) { return line.find(text) != std::string::npos; });
  }

  Executive& executive;
  Diary diary;
  FakeCamera camera;
  FakeHardwareHost host;
  hw::camera::CameraDriver driver;
  std::mutex mutex;
  std::vector<ObjectPtr<idl::Image>> pictures;
};

// Waits with pictures that go on coming.
void pass(RunningCamera& running, Duration time, const Bytes& picture) {
  const TimePoint end = running.executive.now() + time;
  while (running.executive.now() < end) (void)running.shows(picture);
}

}  // namespace

EXECUTIVE_CASE("pictures come as the camera took them, while somebody uses it", "[camera][driver]") {
  RunningCamera running(executive, small_camera(), small());
  REQUIRE(running.gets(HardwareState::ready));
  CHECK_FALSE(running.camera.streams());
  running.start();
  CHECK(running.camera.streams());
  for (std::uint8_t i = 0; i < 10; ++i) {
    REQUIRE(running.shows(small_picture(i)));
    const auto image = running.last();
    CHECK(image->encoding() == idl::RGB8);
    CHECK(image->width() == 16);
    CHECK(image->height() == 16);
    CHECK(image->step() == 48);
    CHECK(std::ranges::equal(image->data(), small_picture(i)));
  }
  running.driver.release();
  REQUIRE(running.gets(HardwareState::ready));
  CHECK_FALSE(running.camera.streams());
}

EXECUTIVE_CASE("each format becomes the encoding that is asked for", "[camera][driver]") {
  struct Case {
    std::uint32_t format;
    Bytes bytes;
    Bytes rgb;  // of the first pixel
    Bytes grey;
  };
  // Red after BT.601, and grey of half brightness.
  Bytes red(std::size_t{16 * 16 * 2});
  for (std::size_t i = 0; i < red.size(); ++i) red[i] = std::array<std::uint8_t, 4>{81, 90, 81, 240}[i % 4];
  Bytes nv12(std::size_t{16 * 24}, 90);
  std::fill_n(nv12.begin(), 256, std::uint8_t{81});
  for (std::size_t i = 257; i < nv12.size(); i += 2) nv12[i] = 240;
  Bytes bgr(std::size_t{16 * 16 * 3});
  for (std::size_t i = 0; i < bgr.size(); ++i) bgr[i] = std::array<std::uint8_t, 3>{0, 0, 255}[i % 3];
  const Bytes half(256, 128);
  const auto jpeg = without_tables(jpeg_of(Bytes(std::size_t{16 * 16 * 3}, 128), 16, 16));
  for (const Case& each :
       {Case{V4L2_PIX_FMT_YUYV, red, {255, 0, 0}, {76}}, Case{V4L2_PIX_FMT_NV12, nv12, {255, 0, 0}, {76}},
        Case{V4L2_PIX_FMT_BGR24, bgr, {255, 0, 0}, {76}},
        Case{V4L2_PIX_FMT_GREY, half, {128, 128, 128}, {128}},
        Case{V4L2_PIX_FMT_MJPEG, jpeg, {128, 128, 128}, {128}}})
    for (const bool is_grey : {false, true}) {
      RunningCamera running(executive, camera_of(each.format, 16, 16),
                            small({{"encoding", std::string(is_grey ? "MONO8" : "RGB8")}}));
      running.start();
      CAPTURE(each.format, is_grey);
      REQUIRE(running.shows(each.bytes));
      const auto image = running.last();
      CHECK(image->encoding() == (is_grey ? idl::MONO8 : idl::RGB8));
      CHECK(image->step() == (is_grey ? 16U : 48U));
      const Bytes& expected = is_grey ? each.grey : each.rgb;
      REQUIRE(image->data().size() == 256 * expected.size());
      for (std::size_t i = 0; i < image->data().size(); ++i)
        if (std::abs(image->data()[i] - expected[i % expected.size()]) > 1) FAIL("value " << i);
    }
}

PATIENT_CASE("a picture says when it was taken on the clock of the run, where from and with which lens",
             "[camera][driver]") {
  RunningCamera running(executive, small_camera(),
                        small({{"field_of_view", std::numbers::pi / 2},
                               {"x", 0.2},
                               {"y", -0.1},
                               {"z", 0.9},
                               {"yaw", 0.5},
                               {"pitch", 0.25},
                               {"roll", -0.125}}));
  running.start();
  const TimePoint taken = executive.now();
  running.camera.expose(small_picture(1));
  sleep(executive, kPeriod);
  const auto image = running.last();
  const Duration late =
      to_time_point(image->pose().stamp()) - taken;  // the kernel's stamps are in microseconds
  CHECK(late >= -1us);
  CHECK(late <= (executive.is_virtual() ? Duration(0) : kPeriod));
  CHECK(image->focal_length() == Approx(8.0));
  CHECK(image->pose().position().x() == 0.2);
  CHECK(image->pose().position().y() == -0.1);
  CHECK(image->pose().position().z() == 0.9);
  CHECK(image->pose().rotation().yaw() == 0.5);
  CHECK(image->pose().rotation().pitch() == 0.25);
  CHECK(image->pose().rotation().roll() == -0.125);
}

PATIENT_CASE("without an angle of view the focal length is not known", "[camera][driver]") {
  RunningCamera running(executive, small_camera(), small());
  running.start();
  REQUIRE(running.shows(small_picture(1)));
  CHECK(running.last()->focal_length() == 0.0);
}

PATIENT_CASE("a spoiled picture costs that picture only, is counted and said once", "[camera][driver]") {
  RunningCamera running(executive, camera_of(V4L2_PIX_FMT_MJPEG, 32, 32),
                        {{"width", std::int64_t{32}}, {"height", std::int64_t{32}}, {"rate", 25.0}});
  running.start();
  const Bytes whole = jpeg_of(squares(32, 32), 32, 32);
  const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(whole.size() / 2));
  CHECK(running.shows(whole));
  CHECK_FALSE(running.shows(cut));
  CHECK_FALSE(running.shows(whole, {.flags = V4L2_BUF_FLAG_ERROR}));
  CHECK_FALSE(running.shows({}));
  CHECK(running.shows(whole));
  CHECK(running.times_said("a picture is spoiled") == 1);
  const idl::DeviceStatistics counted = running.driver.statistics();
  CHECK(counted.line() == "/dev/video0");
  CHECK(counted.frames() == 2);
  CHECK(counted.bad_checksums() == 3);
  CHECK(counted.skipped_bytes() == cut.size());
  CHECK(counted.resynchronisations() == 1);
}

PATIENT_CASE("a picture of too few bytes is spoiled, and pictures that did not come are counted",
             "[camera][driver]") {
  RunningCamera running(executive, small_camera(), small());
  running.start();
  CHECK(running.shows(small_picture(1)));
  CHECK_FALSE(running.shows(small_picture(2), {.bytesused = 767}));
  CHECK(running.says("it has 767 bytes instead of 768"));
  if (!executive.is_virtual()) return;  // pictures that come at once are told apart in virtual time only
  for (std::uint8_t i = 3; i < 6; ++i) running.camera.expose(small_picture(i));
  sleep(executive, kPeriod);
  CHECK(running.last()->data()[0] == 5);
  CHECK(running.driver.statistics().bad_checksums() == 3);
  CHECK(running.driver.statistics().frames() == 2);
}

PATIENT_CASE("a size and a rate other than those asked for are used, and said once, also when it comes back",
             "[camera][driver]") {
  RunningCamera running(
      executive, camera_of(V4L2_PIX_FMT_RGB24, 16, 16, 10.0),
      {{"width", std::int64_t{640}}, {"height", std::int64_t{480}}, {"field_of_view", 1.0}});
  running.start();
  CHECK(running.says("connected to Fake Camera: 16 x 16, RGB3 at 10 Hz"));
  REQUIRE(running.shows(small_picture(1)));
  CHECK(running.last()->width() == 16);
  CHECK(running.last()->focal_length() == Approx(8.0 / std::tan(0.5)));
  running.camera.unplug();
  REQUIRE(running.gets(HardwareState::backoff));
  running.camera.plug_in();
  REQUIRE(running.gets(HardwareState::active));
  CHECK(running.times_said("the camera gives pictures of 16 x 16, not 640 x 480 as its parameters ask") == 1);
  CHECK(running.times_said("the camera gives pictures at 10 Hz, not at 30 Hz") == 1);
  CHECK(running.times_said("connected to") == 1);
}

EXECUTIVE_CASE("a camera that is unplugged while it streams fails at once, and goes on when it is back",
               "[camera][driver]") {
  RunningCamera running(executive, small_camera(), small());
  running.start();
  REQUIRE(running.shows(small_picture(1)));
  running.camera.unplug();
  REQUIRE(running.gets(HardwareState::backoff));
  CHECK_THAT(running.driver.fault(), Contains("the camera has gone: was /dev/video0 unplugged?"));
  CHECK_FALSE(running.driver.is_lost());
  running.camera.plug_in();
  REQUIRE(running.gets(HardwareState::active));
  CHECK(running.says("it works again"));
  CHECK(running.shows(small_picture(2)));
  CHECK(running.driver.statistics().frames() == 2);
  CHECK(running.driver.statistics().connections() == 2);
}

PATIENT_CASE("a camera that is unplugged while nobody uses it is noticed within two seconds",
             "[camera][driver]") {
  RunningCamera running(executive, small_camera(), small());
  REQUIRE(running.gets(HardwareState::ready));
  sleep(executive, 10s);
  CHECK(running.driver.state() == HardwareState::ready);
  running.camera.unplug();
  sleep(executive, 2s);
  CHECK(running.driver.state() == HardwareState::backoff);
}

PATIENT_CASE(
    "a camera that sends no picture has failed after three seconds, or five pictures if these take longer",
    "[camera][driver]") {
  for (const double rate : {25.0, 1.0}) {
    RunningCamera running(executive, camera_of(V4L2_PIX_FMT_RGB24, 16, 16, rate), small({{"rate", rate}}));
    running.start();
    const Duration limit = rate > 1.0 ? 3s : 5s;
    sleep(executive, limit - 500ms);
    REQUIRE(running.shows(small_picture(1)));
    sleep(executive, limit - 500ms);
    CHECK(running.driver.state() == HardwareState::active);
    sleep(executive, 600ms);
    CHECK(running.driver.state() != HardwareState::active);
    CHECK_THAT(running.driver.fault(),
               Contains("nothing has come from it for " + std::string(rate > 1.0 ? "3" : "5") + " s"));
  }
}

PATIENT_CASE("a camera none of whose pictures is whole has failed, with what is wrong with them",
             "[camera][driver]") {
  RunningCamera running(executive, small_camera(), small());
  running.start();
  pass(running, 3100ms, Bytes(5));
  CHECK_THAT(running.driver.fault(),
             Contains("pictures come, but no whole one for 3 s: it has 5 bytes instead of 768"));
  CHECK(running.driver.statistics().frames() == 0);
}

PATIENT_CASE("a camera works on as long as some of its pictures are whole", "[camera][driver]") {
  RunningCamera running(executive, small_camera(), small());
  running.start();
  for (int second = 0; second < 5; ++second) {
    pass(running, 1s, Bytes(5));
    CHECK(running.shows(small_picture(1)));
    CHECK(running.driver.state() == HardwareState::active);
  }
  CHECK(running.driver.statistics().frames() == 5);
  CHECK(running.driver.statistics().resynchronisations() == 5);
  CHECK(running.times_said("a picture is spoiled") == 1);
}

PATIENT_CASE("a camera that is not there at first is a fault for good, with what to do", "[camera][driver]") {
  Settings settings = small_camera();
  settings.is_plugged_in = false;
  RunningCamera running(executive, settings, small({{"device", std::string("/dev/video5")}}));
  REQUIRE(running.gets(HardwareState::fault));
  CHECK_THAT(running.driver.fault(), Contains("there is no /dev/video5; is the camera plugged in?"));
  sleep(executive, 10s);
  CHECK(running.driver.is_lost());
  CHECK(running.times_said("there is no /dev/video5") == 1);
}

PATIENT_CASE("a camera that another program has taken meanwhile is tried again", "[camera][driver]") {
  RunningCamera running(executive, small_camera(), small());
  running.start();
  running.camera.unplug();
  REQUIRE(running.gets(HardwareState::backoff));
  running.camera.plug_in();
  running.camera.lend(true);
  sleep(executive, 4s);
  CHECK(running.driver.state() == HardwareState::backoff);
  CHECK(running.times_said("in use by another program") == 1);
  running.camera.lend(false);
  CHECK(running.gets(HardwareState::active));
}

TEST_CASE("a device that is no path is refused when the graph is checked", "[camera][driver]") {
  on_patient_executives([](Executive& executive) {
    Diary diary;
    FakeCamera camera(small_camera(), [&] { return executive.now(); });
    FakeHardwareHost host(executive, diary);
    hw::camera::CameraDriver driver(host, camera.calls());
    host.set("device", std::string("tcp:camera:80"));
    const std::vector<HardwareFault> faults = driver.prepare();
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].param == "device");
    CHECK_THAT(faults[0].text, Contains("\"tcp:camera:80\" is no path; write /dev/video0"));
  });
}

TEST_CASE("the robot's description lists the camera among the sensors", "[camera][driver]") {
  on_patient_executives([](Executive& executive) {
    Diary diary;
    FakeCamera camera(small_camera(), [&] { return executive.now(); });
    FakeHardwareHost host(executive, diary);
    hw::camera::CameraDriver driver(host, camera.calls());
    host.set("name", std::string("front"));
    host.set("rate", 20.0);
    REQUIRE(driver.prepare().empty());
    const idl::Robot robot = driver.description();
    REQUIRE(robot.sensors().size() == 1);
    CHECK(robot.sensors()[0].name() == "front");
    CHECK(robot.sensors()[0].type() == "Image");
    CHECK(robot.sensors()[0].port() == "/dev/video0");
    CHECK(robot.sensors()[0].update_interval() == 0.05);
  });
}
