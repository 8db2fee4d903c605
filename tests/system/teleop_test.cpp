// SPDX-License-Identifier: GPL-3.0-or-later
// A person drives: the keys come through a pseudo-terminal, the joystick's events through a pipe.
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <memory>
#include <regex>
#include <thread>

#include "deployer.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"
#include "terminal.hpp"

using namespace orca::test;

namespace {

Words teleop(const Words& more) {
  return deployer(Words{system_graph("teleop.xml")} + with_test_plugins() + more);
}

constexpr Seconds kLimit{20.0 * kSlowdown};
// A key that is held comes as often as this from a keyboard.
constexpr Seconds kRepeat{0.03};

std::string event(std::int16_t value, unsigned char type, unsigned char number) {
  std::string bytes(8, '\0');
  std::memcpy(&bytes[4], &value, sizeof value);
  bytes[6] = static_cast<char>(type);
  bytes[7] = static_cast<char>(number);
  return bytes;
}

// Holds a key until the robot does something: on a busy machine one press may be over before anybody looks.
bool holds_until(const Terminal& terminal, const std::string& key, Subprocess& program,
                 const std::string& text) {
  const auto end = std::chrono::steady_clock::now() + kLimit;
  while (std::chrono::steady_clock::now() < end) {
    terminal.press(key);
    if (program.wait_for_output(text, kRepeat)) return true;
  }
  return false;
}

// The sink reports changes only, so a second stop comes after the driving.
bool comes_to_stop_after_driving(const Subprocess& program) {
  const auto stops = [&] {
    const std::string err = program.err();
    const std::size_t driven = err.rfind("FUSED by teleop");
    return driven != std::string::npos && err.find("TOLD_TO_STOP", driven) != std::string::npos;
  };
  for (int i = 0; i < 500 && !stops(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return stops();
}

}  // namespace

TEST_CASE("a key drives the robot, letting go stops it, Q ends the run and the terminal is as before",
          "[system][teleop]") {
  const Terminal terminal;
  Subprocess program(teleop({"--set", "keyboard=" + terminal.name()}));
  REQUIRE(program.wait_for_output("TOLD_TO_STOP by teleop", kLimit));
  CHECK(terminal.comes_to_echo(false));
  CHECK(holds_until(terminal, "w", program, "FUSED by teleop speed 0.30 turn 0.00"));
  CHECK(holds_until(terminal, "\x1b[D", program, "turn 0.80"));
  terminal.press("q");
  const Run run = finish(program, kLimit);
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(terminal.comes_to_echo(true));
}

TEST_CASE("the base says how fast it can be, and a person drives no faster", "[system][teleop]") {
  const Terminal terminal;
  Subprocess program(teleop({"--set", "keyboard=" + terminal.name(), "--set", "speed=9 m/s"}));
  REQUIRE(program.wait_for_output("TOLD_TO_STOP by teleop", kLimit));
  CHECK_THAT(program.err(), Catch::Contains("the base can do less") && Catch::Contains("at most 1 m/s"));
  CHECK(holds_until(terminal, "w", program, "FUSED by teleop speed 1.00 turn 0.00"));
  terminal.press("q");
  CHECK(finish(program, kLimit).exit_code() == 0);
}

TEST_CASE("nobody drives a robot whose base describes one that cannot be", "[system][teleop]") {
  const TempFolder folder;
  std::string text = read_text(system_graph("teleop.xml"));
  const std::string base = R"(to="base.RobotQuery"/>)";
  REQUIRE(text.find(base) != std::string::npos);
  text.replace(text.find(base), base.size(), R"(to="describer.RobotQuery"/>
  <component name="describer" type="test.Describer"><param name="radius" value="-0.3 m"/></component>)");
  text =
      std::regex_replace(text, std::regex("\"(\\.\\./)+worlds/"), "\"" + source_file("tests/data/worlds/"));
  text = std::regex_replace(text, std::regex("\"(\\.\\./)+sim/"), "\"" + source_file("sim/"));
  const Run run =
      run_deployer(Words{folder.write("graph.xml", text), "--until", "3 s"} + with_test_plugins());
  INFO(run.err);
  CHECK(run.says("the base describes no robot that there can be: its radius is -0.3 m"));
  CHECK_FALSE(run.says("FUSED by teleop"));
}

TEST_CASE("P asks where the robot is, and the driving goes on meanwhile", "[system][teleop]") {
  const Terminal terminal;
  Subprocess program(teleop({"--set", "keyboard=" + terminal.name()}));
  REQUIRE(program.wait_for_output("TOLD_TO_STOP by teleop", kLimit));
  terminal.press("p");
  CHECK(program.wait_for_output("position 0.00 m, 0.00 m, heading 0 deg by odometry", kLimit));
  CHECK(holds_until(terminal, "wp", program, "FUSED by teleop speed 0.30"));
  terminal.press("q");
  CHECK(finish(program, kLimit).exit_code() == 0);
}

TEST_CASE("the robot stops when no more keys come", "[system][teleop]") {
  const Terminal terminal;
  Subprocess program(teleop({"--set", "keyboard=" + terminal.name(), "--set", "joystick="}));
  REQUIRE(program.wait_for_output("TOLD_TO_STOP by teleop", kLimit));
  REQUIRE(holds_until(terminal, "w", program, "FUSED by teleop speed 0.30"));
  CHECK(comes_to_stop_after_driving(program));
  program.send(SIGINT);
  CHECK(finish(program, kLimit).exit_code() == 0);
  CHECK(terminal.comes_to_echo(true));
}

TEST_CASE("the terminal is restored even when the deployer is killed", "[system][teleop]") {
  for (const int signal : {SIGKILL, SIGABRT, SIGTERM}) {
    const Terminal terminal;
    Subprocess program(teleop({"--set", "keyboard=" + terminal.name()}));
    REQUIRE(terminal.comes_to_echo(false));
    program.send(signal);
    REQUIRE(program.wait(kLimit).has_value());
    CAPTURE(signal);
    CHECK(terminal.comes_to_echo(true));
  }
}

TEST_CASE("a terminal that goes away stops the robot and not the system", "[system][teleop]") {
  auto terminal = std::make_unique<Terminal>();
  Subprocess program(teleop({"--set", "keyboard=" + terminal->name()}));
  REQUIRE(program.wait_for_output("TOLD_TO_STOP by teleop", kLimit));
  terminal.reset();
  CHECK(program.wait_for_output("the keyboard has gone", kLimit));
  program.send(SIGINT);
  CHECK(finish(program, kLimit).exit_code() == 0);
}

TEST_CASE("a joystick drives while its dead-man button is held, and stops the robot when it is unplugged",
          "[system][teleop]") {
  const TempFolder folder;
  const std::string device = folder.file("js0");
  REQUIRE(mkfifo(device.c_str(), 0600) == 0);
  const int stick = open(device.c_str(), O_RDWR | O_CLOEXEC);
  REQUIRE(stick >= 0);
  const auto tell = [&](const std::string& bytes) {
    REQUIRE(write(stick, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
  };
  Subprocess program(teleop({"--set", "joystick=" + device}));
  REQUIRE(program.wait_for_output("TOLD_TO_STOP by teleop", kLimit));
  tell(event(-32767, 2, 1) + event(1, 1, 0));
  CHECK(program.wait_for_output("FUSED by teleop speed 0.30 turn 0.00", kLimit));
  tell(event(-16384, 2, 0));
  CHECK(program.wait_for_output("turn 0.40", kLimit));
  close(stick);
  CHECK(program.wait_for_output("the joystick has gone", kLimit));
  CHECK(comes_to_stop_after_driving(program));
  program.send(SIGINT);
  const Run run = finish(program, kLimit);
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.err.find("alarm") == std::string::npos);  // what start() opened may be closed by a lap
}

TEST_CASE("a command from afar drives the robot for the dead-man time, and without another one it stops",
          "[system][teleop]") {
  Subprocess program(teleop({"--set", "keyboard="}));
  REQUIRE(program.wait_for_output("TOLD_TO_STOP by teleop", kLimit));
  const auto send = [](const std::string& command) {
    return run_orcactl({"--system", "teleop", "send", "teleop.MotionSend", command});
  };
  const Run refused = send(R"(<MotionCommand speed="0.2" direction="1"/>)");
  CHECK(refused.exit_code() == 1);
  CHECK(refused.says("a person's command has steering BY_TURN_RATE"));
  const Run taken = send(R"(<MotionCommand steering="BY_TURN_RATE" speed="0.2" turn_rate="0.1"/>)");
  INFO(taken.err);
  CHECK(taken.exit_code() == 0);
  CHECK(program.wait_for_output("FUSED by teleop speed 0.20 turn 0.10", kLimit));
  CHECK(comes_to_stop_after_driving(program));
  program.send(SIGINT);
  CHECK(finish(program, kLimit).exit_code() == 0);
}

TEST_CASE("in virtual time teleop refuses to start, and says what to do", "[system][teleop]") {
  const Run run = run_deployer(Words{system_graph("teleop.xml"), "--set", "keyboard=stdin"} +
                               with_test_plugins() + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.says("runs with the steady clock only (--clock steady): a person cannot drive in virtual time"));
}

TEST_CASE("a device that is not there is named, and describing teleop opens none", "[system][teleop]") {
  Subprocess program(teleop({"--set", "keyboard=/dev/no_such_tty"}));
  CHECK(program.wait_for_output("/dev/no_such_tty", kLimit));
  const Run described = run_deployer({"--describe", ORCA_BINARY_DIR "/plugins/teleop.so"});
  CHECK(described.exit_code() == 0);
  CHECK(described.out.find("dead_man = 0.3 s") != std::string::npos);
}

TEST_CASE("the shipped graph for teleop is sound", "[system][teleop]") {
  const Run run = run_deployer({source_file("graphs/scout_teleop.xml"), "--check"});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
}

namespace {

// Drives with a key that is held until the robot touches something, or for some time at most.
const Words kBeforeTrolley{"--set", "scout.place=", "--set", "scout.x=3.5 m", "--set", "scout.y=6 m"};

Run drive_by_key(const std::string& graph, Seconds most) {
  const Terminal terminal;
  Subprocess program(deployer(
      Words{graph, "--until", std::to_string(most.count()) + " s", "--set", "keyboard=" + terminal.name()} +
      kBeforeTrolley));
  while (!program.wait(kRepeat) && program.out().find("contact") == std::string::npos) terminal.press("w");
  program.send(SIGINT);
  return finish(program, kLimit);
}

}  // namespace

TEST_CASE("without avoid a person who holds the key drives into the trolley, with it not",
          "[system][teleop][ablation]") {
  const TempFolder folder;
  ShippedGraph graph("scout_teleop");
  const std::string whole = folder.write("whole.xml", graph.text());
  graph.remove("avoid");
  // A quiet machine takes 8 s; a busy one lets the robot stop on its way.
  const Run without = drive_by_key(folder.write("without.xml", graph.text()), Seconds(60.0 * kSlowdown));
  INFO(without.out << without.err);
  CHECK(without.exit_code() == 0);
  REQUIRE_FALSE(without.contacts().empty());
  const std::string touched = without.contacts().front();  // with the time at its end [s]
  const Run with = drive_by_key(whole, Seconds(std::stod(touched.substr(touched.rfind(' '))) + 2.0));
  INFO(with.out << with.err);
  CHECK(with.exit_code() == 0);
  CHECK(with.contacts().empty());
}

TEST_CASE("without any other component of the teleop graph the robot stands", "[system][teleop][ablation]") {
  for (const char* component : {"teleop", "fuser", "base"}) {
    const TempFolder folder;
    ShippedGraph graph("scout_teleop");
    graph.watch_motion("base");
    const Terminal terminal;
    Subprocess program(
        deployer({folder.write("graph.xml", graph.text()), "--until", "3 s", "--set",
                  "keyboard=" + terminal.name(), "--fail", std::string(component) + "=silent@0s"}));
    while (!program.wait(kRepeat)) terminal.press("w");
    CAPTURE(component);
    INFO(program.err());
    CHECK(program.err().find("watch: moves") == std::string::npos);
  }
}
