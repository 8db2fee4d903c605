// SPDX-License-Identifier: GPL-3.0-or-later
// What every driver on a line must stand, with the emulation of its device at the other end of a pseudo terminal.
#include <catch2/catch.hpp>

#include <fcntl.h>
#include <termios.h>

#include <charconv>
#include <csignal>
#include <filesystem>
#include <list>
#include <string>
#include <thread>
#include <vector>

#include "bad_line.hpp"
#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/emulators/create2_firmware.hpp"
#include "orca/emulators/nomad_scout_firmware.hpp"
#include "orca/emulators/p2os_firmware.hpp"
#include "orca/emulators/player_firmware.hpp"
#include "orca/emulators/rplidar_firmware.hpp"
#include "orca/emulators/sick_lms_firmware.hpp"
#include "orca/emulators/xr4000_firmware.hpp"
#include "orca/hw/create2/stream.hpp"
#include "orca/hw/nomad_scout/packet.hpp"
#include "orca/hw/p2os/packet.hpp"
#include "orca/hw/rplidar/capsule.hpp"
#include "orca/hw/sick_lms/telegram.hpp"
#include "orca/hw/xr4000/frame.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::framing::Protocol;

namespace {

using Bytes = std::vector<std::uint8_t>;

// A base drives along a straight line, to a goal that it does not reach.
template <class Of>
struct Base {
  using Firmware = Of;
  using Surroundings = PlainBody;
  static constexpr const char* server = "base";
  static constexpr bool moves = true;
};

struct Pioneer : Base<emulators::P2osFirmware> {
  static emulators::P2osSettings settings() { return {}; }
  static constexpr const char* graph = "p2os.xml";
  static constexpr Protocol protocol = hw::p2os::kProtocol;
  static constexpr bool has_watchdog = true;
};
struct Scout : Base<emulators::NomadScoutFirmware> {
  static emulators::NomadScoutSettings settings() { return {}; }
  static constexpr const char* graph = "nomad_scout.xml";
  static constexpr Protocol protocol = hw::nomad_scout::kProtocol;
  static constexpr bool has_watchdog = true;
};
struct Create : Base<emulators::Create2Firmware> {
  static emulators::Create2Settings settings() { return {}; }
  static constexpr const char* graph = "create2.xml";
  static constexpr Protocol protocol = hw::create2::kProtocol;
  static constexpr bool has_watchdog = false;
};
struct Nomad : Base<emulators::Xr4000Firmware> {
  static emulators::Xr4000Settings settings() { return {}; }
  static constexpr const char* graph = "xr4000.xml";
  static constexpr Protocol protocol = hw::xr4000::kProtocol;
  static constexpr bool has_watchdog = true;
};
// Its messages have no checksum and nothing that marks them, so it need not stand bytes that TCP would not bring. A line that the test
// has open, too, would be a connection that does not end.
struct PlayerRobot : Base<emulators::PlayerFirmware> {
  static emulators::PlayerSettings settings() { return {}; }
  static constexpr const char* graph = "player.xml";
  static constexpr bool has_watchdog = false;
};
struct Laser {
  using Firmware = emulators::SickLmsFirmware;
  using Surroundings = MirrorOnDesk;
  static emulators::SickLmsSettings settings() {
    emulators::SickLmsSettings settings;
    settings.power_up = 0s;
    return settings;
  }
  static constexpr const char* graph = "sick_lms.xml";
  static constexpr Protocol protocol = hw::sick_lms::kFromLaser;
  static constexpr const char* server = "laser";
  static constexpr bool moves = false;
};

struct Lidar {
  using Firmware = emulators::RplidarFirmware;
  using Surroundings = MirrorOnDesk;
  static emulators::RplidarSettings settings() {
    emulators::RplidarSettings settings;
    settings.boot = 0s;
    settings.spin_up = 0s;
    return settings;
  }
  static constexpr const char* graph = "rplidar.xml";
  static constexpr Protocol protocol = hw::rplidar::kCapsuleProtocol;
  static constexpr const char* server = "laser";
  static constexpr bool moves = false;
};

// A driver at work, and its device.
template <class Kind>
class AtWork {
 public:
  using Line = BadLine<typename Kind::Firmware>;

  AtWork() : desk_(DeskLine(path_), Kind::settings()) {
    if constexpr (!Kind::moves)
      desk_.with([](Line&, MirrorOnDesk& mirror) { mirror.show(-1.5708, 0.0174533, std::vector(181, 2.0)); });
    Words words{system_graph(Kind::graph), "--set", "device=" + path_};
    if constexpr (Kind::moves) words = words + Words{"--set", "goals=far: 100 0"};
    program_.emplace(deployer(words));
    // A laser's first frames are answers to questions; then it scans.
    REQUIRE(eventually([this] { return Kind::moves ? works() : done() > 50.0; }));
  }

  // Returns whether it does what it is for: the base moves, scans arrive.
  bool works() {
    if constexpr (Kind::moves)
      return desk_.with([](Line&, PlainBody& body) { return body.velocity().forward > 0.1; });
    else
      return frames_since_last_time() > 0;
  }
  // Returns what it has done so far: the way of the base [m], or the number of its frames.
  double done() {
    if constexpr (Kind::moves)
      return desk_.with([](Line&, PlainBody& body) { return body.odometry().x; });
    else
      return static_cast<double>(counted("frames"));
  }
  bool stands() {
    if constexpr (Kind::moves)
      return desk_.with([](Line&, PlainBody& body) { return body.velocity() == Twist2{}; });
    else
      return true;
  }

  long frames_since_last_time() {
    const long frames = counted("frames");
    return frames - std::exchange(last_, frames);
  }

  // Returns what the driver has counted.
  long counted(const std::string& what) {
    const Run run = run_orcactl({"query", std::string(Kind::server) + ".DeviceStatisticsQuery", "<Ask/>"});
    const std::size_t at = run.out.find(" " + what + "=\"");
    long number = 0;
    if (at == std::string::npos) return number;
    const char* const begin = run.out.data() + at + what.size() + 3;
    std::from_chars(begin, run.out.data() + run.out.size(), number);
    return number;
  }

  void spoil(const std::function<void(Bytes&)>& change) {
    desk_.with([&](Line& line, auto&) { line.spoil(change); });
  }
  void echo(bool on) {
    desk_.with([&](Line& line, auto&) { line.echo(on); });
  }
  DeviceOnDesk<Line, typename Kind::Surroundings>& desk() { return desk_; }
  [[nodiscard]] const std::string& path() const { return path_; }
  bool says(const std::string& text, Duration limit) {
    return program_->wait_for_output(text, Seconds(to_seconds(limit) * kSlowdown));
  }
  [[nodiscard]] std::string err() const { return program_->err(); }

  // Comes back by itself. A base then stands until an operator lets it go.
  void check_comes_back() {
    const bool back = says("it works again", 30s);
    INFO(err());
    REQUIRE(back);
    if constexpr (Kind::moves) {
      REQUIRE(eventually([this] { return stands(); }));  // one that drove on by itself is told to stop first
      for (int i = 0; i < 50; ++i, std::this_thread::sleep_for(10ms)) REQUIRE(stands());
      CHECK(run_orcactl({"estop", "--release"}).exit_code() == 0);
    }
    CHECK(eventually([this] { return works(); }));
  }

 private:
  const TempFolder folder_;
  const std::string path_ = folder_.file("line");
  DeviceOnDesk<Line, typename Kind::Surroundings> desk_;
  std::optional<Subprocess> program_;
  long last_ = 0;  // frames
};

// A terminal, opened as by another program: through it the test holds the line back.
Descriptor terminal_at(const std::string& path) {
  Descriptor terminal(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  REQUIRE(terminal);
  return terminal;
}

}  // namespace

TEMPLATE_TEST_CASE("a driver works on over a bad line", "[system][hardware]", Pioneer, Scout, Create, Nomad,
                   Laser, Lidar) {
  AtWork<TestType> driver;
  const auto check_works_on = [&](const char* fault) {
    INFO(fault << ": " << driver.err());
    const double before = driver.done();
    std::this_thread::sleep_for(2s);
    CHECK(driver.done() >
          before + (TestType::moves ? 0.4 : 10.0));  // at 0.5 m/s; a scan takes less than 50 ms
    driver.spoil(nullptr);
  };
  driver.spoil(garbage_after(TestType::moves ? 701 : 1501, {0x13, 0xFA, 0x02, 0x00}));
  check_works_on("garbage between and within frames");
  driver.spoil(glued(60));
  check_works_on("frames that come together");
  driver.spoil(one_frame_spoiled_in(100, TestType::protocol));
  check_works_on("one frame in a hundred spoiled");
  driver.echo(true);
  check_works_on("what is sent comes back");
  CHECK(driver.counted("connections") == 1);
  CHECK(driver.counted("resynchronisations") > 0);
}

TEMPLATE_TEST_CASE("a driver whose frames are all spoiled stops its base, and comes back with a good line",
                   "[system][hardware]", Pioneer, Scout, Create, Nomad, Laser, Lidar) {
  AtWork<TestType> driver;
  driver.spoil(one_frame_spoiled_in(1, TestType::protocol));
  const bool says = driver.says("is it still connected and switched on?", 20s);
  INFO(driver.err());
  REQUIRE(says);
  CHECK(eventually([&] { return driver.stands(); }));
  driver.spoil(nullptr);
  driver.check_comes_back();
}

TEMPLATE_TEST_CASE("a base whose line is held back stops where it can, and is told nothing late",
                   "[system][hardware]", Pioneer, Scout, Create, Nomad) {
  AtWork<TestType> driver;
  const Descriptor terminal = terminal_at(driver.path());
  REQUIRE(tcflow(terminal.number(), TCOOFF) == 0);
  REQUIRE(driver.says("the device takes nothing any more", 20s));
  if constexpr (TestType::has_watchdog) CHECK(eventually([&] { return driver.stands(); }));
  REQUIRE(tcflow(terminal.number(), TCOON) == 0);
  driver.check_comes_back();
}

TEMPLATE_TEST_CASE("a laser whose line is held back goes on to send scans", "[system][hardware]", Laser,
                   Lidar) {
  AtWork<TestType> driver;
  const Descriptor terminal = terminal_at(driver.path());
  REQUIRE(tcflow(terminal.number(), TCOOFF) == 0);
  for (int i = 0; i < 4; ++i) {
    std::this_thread::sleep_for(500ms);
    CHECK(driver.works());
  }
  REQUIRE(tcflow(terminal.number(), TCOON) == 0);
}

TEMPLATE_TEST_CASE("a device that is unplugged and comes back under another name is found again",
                   "[system][hardware]", Pioneer, Scout, Create, Nomad, PlayerRobot, Laser, Lidar) {
  AtWork<TestType> driver;
  const std::string before = std::filesystem::canonical(driver.path());
  driver.desk().unplug();
  REQUIRE(driver.says("the device has gone: was it unplugged or switched off?", 20s));
  // Until its number is taken: the driver gives it back a moment later, and lower ones may be free, since other programs end.
  std::list<hw::link::PtyLink> others;
  REQUIRE(eventually([&] {
    REQUIRE(others.emplace_back().open());
    std::this_thread::sleep_for(50ms);
    return std::filesystem::exists(before);
  }));
  driver.desk().plug_in();
  CHECK(std::filesystem::canonical(driver.path()) != before);
  driver.check_comes_back();
}
