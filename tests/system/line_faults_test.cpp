// SPDX-License-Identifier: GPL-3.0-or-later
// What every driver on a line must stand, with the emulation of its device at the other end: of a line in memory, in virtual time; and
// where terminals are the subject of a pseudo terminal, in real time.
#include <catch2/catch.hpp>

#include <fcntl.h>
#include <termios.h>

#include <filesystem>
#include <list>
#include <string>
#include <thread>
#include <vector>

#include "bad_line.hpp"
#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/emulators/create2_firmware.hpp"
#include "orca/emulators/nomad_scout_firmware.hpp"
#include "orca/emulators/p2os_firmware.hpp"
#include "orca/emulators/player_firmware.hpp"
#include "orca/emulators/rplidar_firmware.hpp"
#include "orca/emulators/sick_lms_firmware.hpp"
#include "orca/emulators/xr4000_firmware.hpp"
#include "orca/hw/create2/sensors.hpp"
#include "orca/hw/nomad_scout/packet.hpp"
#include "orca/hw/p2os/packet.hpp"
#include "orca/hw/rplidar/capsule.hpp"
#include "orca/hw/sick_lms/telegram.hpp"
#include "orca/hw/xr4000/frame.hpp"
#include "temp_folder.hpp"
#include "virtual_desk.hpp"

using namespace orca;
using namespace orca::test;
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

// A line in memory, in virtual time; only during run_virtual().
struct InMemory {
  template <class Line, class Surroundings>
  using Desk = VirtualDevice<Line, Surroundings>;
  static bool until(const std::function<bool()>& condition) { return bench().until(condition); }
  static bool says(const std::string& text) { return bench().until_log(text, 30s); }
  static void sleep(Duration time) { bench().sleep(time); }
  static std::uint64_t frames() { return bench().seat().statistics().frames(); }
  static bool let_go() { return bench().seat().let_go(); }
  static std::string log() { return bench().log(); }
};

// A pseudo terminal, in real time.
struct OnTerminal {
  template <class Line, class Surroundings>
  using Desk = DeviceOnDesk<Line, Surroundings>;
  static bool until(const std::function<bool()>& condition) { return eventually(condition); }
  [[nodiscard]] bool says(const std::string& text) const {
    return program->wait_for_output(text, Seconds(30 * kSlowdown));
  }
  static void sleep(Duration time) { std::this_thread::sleep_for(time); }
  [[nodiscard]] std::uint64_t frames() const {
    const Run run = run_orcactl({"query", server + ".DeviceStatisticsQuery", "<Ask/>"});
    const std::string before = " frames=\"";
    const std::size_t at = run.out.find(before);
    return at == std::string::npos ? 0 : std::stoull(run.out.substr(at + before.size()));
  }
  static bool let_go() { return run_orcactl({"estop", "--release"}).exit_code() == 0; }
  [[nodiscard]] std::string log() const { return program->err(); }
  Subprocess* program;
  std::string server;
};

// A driver at work, and its device.
template <class Kind, class World>
class AtWork {
 public:
  using Line = BadLine<typename Kind::Firmware>;
  using Desk = typename World::template Desk<Line, typename Kind::Surroundings>;

  AtWork(const World& world, Desk& desk) : world_(world), desk_(desk) {
    // A laser's first frames are answers to questions; then it scans.
    const bool is_at_work = World::until([this] { return Kind::moves ? works() : done() > 50.0; });
    INFO(world_.log());
    REQUIRE(is_at_work);
  }

  // Returns whether it does what it is for: the base moves, scans arrive.
  bool works() {
    if constexpr (Kind::moves)
      return desk_.with([](Line&, PlainBody& body) { return body.velocity().forward > 0.1; });
    else
      return world_.frames() > std::exchange(last_, world_.frames());
  }
  // Returns what it has done so far: the way of the base [m], or the number of its frames.
  double done() {
    if constexpr (Kind::moves)
      return desk_.with([](Line&, PlainBody& body) { return body.odometry().x; });
    else
      return static_cast<double>(world_.frames());
  }
  bool stands() {
    if constexpr (Kind::moves)
      return desk_.with([](Line&, PlainBody& body) { return body.velocity() == Twist2{}; });
    else
      return true;
  }
  void spoil(const std::function<void(Bytes&)>& change) {
    desk_.with([&](Line& line, auto&) { line.spoil(change); });
  }
  Desk& desk() { return desk_; }
  void check_says(const std::string& text) {
    const bool says = world_.says(text);
    INFO(world_.log());
    REQUIRE(says);
  }

  // Comes back by itself. A base then stands until an operator lets it go.
  void check_comes_back() {
    check_says("it works again");
    if constexpr (Kind::moves) {
      REQUIRE(
          World::until([this] { return stands(); }));  // one that drove on by itself is told to stop first
      for (int i = 0; i < 50; ++i, World::sleep(10ms)) REQUIRE(stands());
      CHECK(World::let_go());
    }
    const bool works_again = World::until([this] { return works(); });
    INFO(world_.log());
    CHECK(works_again);
  }

 private:
  const World world_;
  Desk& desk_;
  std::uint64_t last_ = 0;  // frames
};

// Makes a device, and returns the words for its system.
template <class Kind, class Desk>
Words set_up(Desk& desk, const std::string& line) {
  if constexpr (!Kind::moves)
    desk.with([](auto&, MirrorOnDesk& mirror) { mirror.show(-1.5708, 0.0174533, std::vector(181, 2.0)); });
  Words words{system_graph(Kind::graph), "--set", "device=" + line};
  return Kind::moves ? words + Words{"--set", "goals=far: 100 0"} : words;
}

// Calls a script with a driver at work in virtual time.
template <class Kind>
void in_memory(const std::function<void(AtWork<Kind, InMemory>&)>& script) {
  typename AtWork<Kind, InMemory>::Desk desk(DeskLine("line"), Kind::settings());
  (void)run_virtual(set_up<Kind>(desk, "memory:line"), [&] {
    AtWork<Kind, InMemory> driver({}, desk);
    script(driver);
  });
}

// A driver at work in real time.
template <class Kind>
struct TerminalAtWork {
  using Driver = AtWork<Kind, OnTerminal>;
  const TempFolder folder;
  const std::string path = folder.file("line");
  typename Driver::Desk desk{DeskLine(path), Kind::settings()};
  Subprocess program{deployer(set_up<Kind>(desk, path))};
  Driver driver{OnTerminal{&program, Kind::server}, desk};
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
  in_memory<TestType>([](auto& driver) {
    const auto check_works_on = [&](const char* fault) {
      INFO(fault << ": " << bench().log());
      const double before = driver.done();
      bench().sleep(2s);
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
    driver.desk().echo(true);
    check_works_on("what is sent comes back");
    const idl::DeviceStatistics counts = bench().seat().statistics();
    CHECK(counts.connections() == 1);
    CHECK(counts.resynchronisations() > 0);
  });
}

TEMPLATE_TEST_CASE("a driver whose frames are all spoiled stops its base, and comes back with a good line",
                   "[system][hardware]", Pioneer, Scout, Create, Nomad, Laser, Lidar) {
  in_memory<TestType>([](auto& driver) {
    driver.spoil(one_frame_spoiled_in(1, TestType::protocol));
    driver.check_says("is it still connected and switched on?");
    CHECK(bench().until([&] { return driver.stands(); }));
    driver.spoil(nullptr);
    driver.check_comes_back();
  });
}

TEMPLATE_TEST_CASE("a base whose line is held back stops where it can, and is told nothing late",
                   "[system][hardware]", Pioneer, Scout, Create, Nomad) {
  TerminalAtWork<TestType> at_work;
  const Descriptor terminal = terminal_at(at_work.path);
  REQUIRE(tcflow(terminal.number(), TCOOFF) == 0);
  at_work.driver.check_says("the device takes nothing any more");
  if constexpr (TestType::has_watchdog) CHECK(eventually([&] { return at_work.driver.stands(); }));
  REQUIRE(tcflow(terminal.number(), TCOON) == 0);
  at_work.driver.check_comes_back();
}

TEMPLATE_TEST_CASE("a laser whose line is held back goes on to send scans", "[system][hardware]", Laser,
                   Lidar) {
  TerminalAtWork<TestType> at_work;
  const Descriptor terminal = terminal_at(at_work.path);
  REQUIRE(tcflow(terminal.number(), TCOOFF) == 0);
  for (int i = 0; i < 4; ++i) {
    std::this_thread::sleep_for(500ms);
    CHECK(eventually([&] { return at_work.driver.works(); }));  // a busy machine may keep it waiting
  }
  REQUIRE(tcflow(terminal.number(), TCOON) == 0);
}

TEMPLATE_TEST_CASE("a device that is unplugged and comes back under another name is found again",
                   "[system][hardware]", Pioneer, Scout, Create, Nomad, PlayerRobot, Laser, Lidar) {
  TerminalAtWork<TestType> at_work;
  const std::string before = std::filesystem::canonical(at_work.path);
  at_work.desk.unplug();
  at_work.driver.check_says("the device has gone: was it unplugged or switched off?");
  // Until its number is taken: the driver gives it back a moment later, and lower ones may be free, since other programs end.
  std::list<hw::link::PtyLink> others;
  REQUIRE(eventually([&] {
    REQUIRE(others.emplace_back().open());
    std::this_thread::sleep_for(50ms);
    return std::filesystem::exists(before);
  }));
  at_work.desk.plug_in();
  CHECK(std::filesystem::canonical(at_work.path) != before);
  at_work.driver.check_comes_back();
}
