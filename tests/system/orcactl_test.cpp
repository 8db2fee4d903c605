// SPDX-License-Identifier: GPL-3.0-or-later
// orcactl against running systems: what it shows, what it orders, what it refuses, and that no client can hurt a system.
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <thread>

#include "deployer.hpp"
#include "process_table.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

using Clock = std::chrono::steady_clock;

const std::string kScout = source_file("graphs/scout_goto_processes.xml");
const std::string kName = "scout_goto_processes";

// A running system that orcactl can reach.
class System {
 public:
  explicit System(const Words& words) : program_(deployer(words)) {}

  Subprocess& program() { return program_; }

  // Waits until the log holds a text.
  void await(const std::string& text, Seconds limit = Seconds(15)) {
    const bool came = program_.wait_for_output(text, limit * kSlowdown);
    INFO(program_.err());
    INFO(text);
    REQUIRE(came);
  }

  // Waits until all components of the scout's graph are at work.
  void await_work() {
    const auto end = Clock::now() + std::chrono::seconds(20);
    for (;;) {
      const Run run = run_orcactl({"ps"});
      const bool works = run.exit_code() == 0 && run.out.find("goto") != std::string::npos &&
                         count_of(run.out, " WORK ") >= 6;
      if (works) return;
      INFO(run.out << run.err << program_.err());
      REQUIRE(Clock::now() < end);
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }

  static std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
  }

  // Ends it by orcactl and checks that it ends well.
  void stop() {
    const Run order = run_orcactl({"stop"});
    INFO(order.err << program_.err());
    CHECK(order.exit_code() == 0);
    const Run run = finish(program_, Seconds(5));
    CHECK(run.exit_code() == 0);
    CHECK(run.says(" deployer: an operator ends the run"));
    CHECK_FALSE(run.says(" supervisor: "));
    CHECK(living_in_group(program_.pid()).empty());
  }

 private:
  Subprocess program_;
};

// Returns the value of an attribute of an object's text form.
double number_in(const std::string& xml, const std::string& name) {
  const std::size_t at = xml.find(" " + name + "=\"");
  INFO(xml << " has no " << name);
  REQUIRE(at != std::string::npos);
  return std::stod(xml.substr(at + name.size() + 3));
}

// Returns the present speed of the robot [m/s].
double speed() {
  const Run run = run_orcactl({"echo", "base.OdometryPush", "--count", "1"});
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  return std::abs(number_in(run.out, "translational_velocity"));
}

bool comes_true(const std::function<bool()>& condition, Seconds limit) {
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit * kSlowdown);
  while (!condition()) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

std::string socket_path() { return std::string(std::getenv("XDG_RUNTIME_DIR")) + "/orca/" + kName + ".sock"; }

// A client that knows nothing of the protocol.
class RawClient {
 public:
  RawClient() : socket_(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string path = socket_path();
    REQUIRE(path.size() < sizeof address.sun_path);
    std::memcpy(address.sun_path, path.data(), path.size());
    REQUIRE(connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
  }
  ~RawClient() { close(socket_); }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  // Returns false if it was cut off, or if the system does not read.
  bool send(const std::string& bytes) const {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT) >= 0;
  }
  // Returns whether the system has cut it off within the limit.
  [[nodiscard]] bool is_cut_off(Seconds limit) const {
    return comes_true(
        [this] {
          char byte = 0;
          const ssize_t size = recv(socket_, &byte, 1, MSG_DONTWAIT);
          return size == 0 || (size < 0 && errno != EAGAIN);
        },
        limit);
  }

 private:
  const int socket_;
};

// A packet of a control channel: tag, number of the request, length, descriptors, kind, and an ask of "ps".
std::string ask_ps() {
  const auto number = [](std::uint64_t value, std::size_t size) {
    return std::string(reinterpret_cast<const char*>(&value), size);
  };
  const std::string body = number(2, 8) + "ps" + number(0, 8) + number(0, 8);
  return "\xC1" + number(1, 8) + number(body.size(), 4) + number(0, 4) + number(201, 2) + body;
}

}  // namespace

TEST_CASE("orcactl shows what runs, and ends it", "[system][orcactl]") {
  System system({kScout});
  system.await_work();
  const Run ps = run_orcactl({"ps", "--json"});
  CHECK(ps.exit_code() == 0);
  for (const char* const part :
       {"\"name\": \"goto\"", "\"type\": \"orca.Goto\"", "\"process\": \"behaviours\"", "\"state\": \"WORK\"",
        "goto.so\"", "\"restarts\": 0"})
    CHECK_THAT(ps.out, Contains(part));
  const std::string described = run_deployer({"--describe", "orca.Goto", "--json"}).out;
  const std::string build = described.substr(described.find("\"build_id\": \"") + 13, 40);
  CHECK(build.find_first_not_of("0123456789abcdef") == std::string::npos);
  CHECK_THAT(ps.out, Contains("\"build_id\": \"" + build + "\""));
  CHECK_THAT(run_orcactl({"ps"}).out, Contains("  " + build.substr(0, 12) + "  "));
  const auto pid = children_of(system.program().pid()).at("behaviours");
  CHECK_THAT(ps.out, Contains("\"pid\": " + std::to_string(pid)));
  CHECK_THAT(run_orcactl({"graph"}).out, Contains("<component name=\"goto\""));
  CHECK_THAT(run_orcactl({"graph", "--json"}).out, Contains("\"name\": \"goto\""));
  CHECK_THAT(run_orcactl({"ports"}).out, Contains("base.OdometryPush"));
  CHECK_THAT(run_orcactl({"plugins"}).out, Contains("orca.hw.Sim"));
  CHECK(run_orcactl({"set", "avoid.margin", "11 cm"}).exit_code() == 0);
  CHECK_THAT(run_orcactl({"log"}).out, Contains("avoid: an operator has set margin to 0.11"));
  CHECK_THAT(run_orcactl({"log", "goto"}).out, !Contains("margin"));
  const Run counters = run_orcactl({"counters"});
  CHECK_THAT(counters.out, Contains("base.OdometryPush") && Contains("fuser.base") && Contains("DELIVERED"));
  system.stop();
  CHECK_FALSE(std::filesystem::exists(socket_path()));
}

TEST_CASE("orcactl's errors teach, and have the exit statuses that scripts rely on", "[system][orcactl]") {
  CHECK(run_orcactl({"ps"}).exit_code() == 3);
  const Run unknown = run_orcactl({"pss"});
  CHECK(unknown.exit_code() == 2);
  CHECK(unknown.says("did you mean \"ps\"?"));
  System system({kScout});
  system.await_work();
  const Run other = run_orcactl({"--system", "scout_goto_proceses", "ps"});
  CHECK(other.exit_code() == 3);
  CHECK(other.says("did you mean \"scout_goto_processes\"?"));
  const Run component = run_orcactl({"suspend", "gto"});
  CHECK(component.exit_code() == 1);
  CHECK(component.says("did you mean \"goto\"?"));
  const Run port = run_orcactl({"echo", "base.Odometry"});
  CHECK(port.exit_code() == 1);
  CHECK(port.says("did you mean \"base.OdometryPush\"?"));
  const Run param = run_orcactl({"get", "avoid.robot_radus"});
  CHECK(param.exit_code() == 1);
  CHECK(param.says("did you mean \"robot_radius\"?"));
  CHECK(run_orcactl({"suspend"}).exit_code() == 2);
  system.stop();
}

TEST_CASE("a second system of the same name is refused, and a socket that a dead one has left is replaced",
          "[system][orcactl]") {
  System system({kScout});
  system.await_work();
  const Run second = run_deployer({kScout});
  CHECK(second.exit_code() == 3);
  CHECK(second.says("a system named \"scout_goto_processes\" runs already"));
  struct stat socket {};
  REQUIRE(stat(socket_path().c_str(), &socket) == 0);
  CHECK((socket.st_mode & 0777) == 0600);
  struct stat folder {};
  REQUIRE(stat(std::filesystem::path(socket_path()).parent_path().c_str(), &folder) == 0);
  CHECK((folder.st_mode & 0777) == 0700);
  system.program().send(SIGKILL);
  REQUIRE(comes_true([&] { return living_in_group(system.program().pid()).empty(); }, Seconds(3)));
  CHECK(std::filesystem::exists(socket_path()));
  CHECK(run_orcactl({"ps"}).exit_code() == 3);
  System next({kScout});
  next.await_work();
  next.stop();
}

TEST_CASE("an emergency stop holds the robot whatever is commanded, until it is released",
          "[system][orcactl]") {
  System system({kScout});
  system.await_work();
  REQUIRE(comes_true([] { return speed() > 0.1; }, Seconds(10)));
  CHECK(run_orcactl({"estop"}).exit_code() == 0);
  CHECK(comes_true([] { return speed() < 0.01; }, Seconds(2)));
  for (int i = 0; i < 10; ++i) {
    CHECK(speed() < 0.01);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  SECTION("a process that is started meanwhile is held, too") {
    REQUIRE(run_orcactl({"restart", "base"}).exit_code() == 0);
    system.await_work();
    for (int i = 0; i < 10; ++i) {
      CHECK(speed() < 0.01);
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  CHECK_THAT(run_orcactl({"alarms"}).out, Contains("ESTOP"));
  CHECK(run_orcactl({"alarms", "ack", "all"}).exit_code() == 1);
  CHECK_THAT(run_orcactl({"alarms"}).out, Contains("ESTOP"));
  CHECK(run_orcactl({"estop", "--release"}).exit_code() == 0);
  CHECK_THAT(run_orcactl({"alarms"}).out, Contains("the emergency stop is released"));
  CHECK(run_orcactl({"alarms", "ack", "all"}).exit_code() == 0);
  CHECK_THAT(run_orcactl({"alarms"}).out, !Contains("ESTOP"));
  CHECK(comes_true([] { return speed() > 0.1; }, Seconds(10)));
  const Run again = run_orcactl({"estop", "--release"});
  CHECK(again.exit_code() == 1);
  CHECK(again.says("no emergency stop"));
  system.stop();
}

TEST_CASE("a goal is not given up because an operator holds the robot, and goes on when it is let go",
          "[system][orcactl]") {
  System system({kScout, "--set", "goto.blocked_after=2"});
  system.await_work();
  REQUIRE(comes_true([] { return speed() > 0.1; }, Seconds(10)));
  REQUIRE(run_orcactl({"estop"}).exit_code() == 0);
  std::this_thread::sleep_for(std::chrono::seconds(5));
  CHECK(speed() < 0.01);
  REQUIRE(run_orcactl({"estop", "--release"}).exit_code() == 0);
  CHECK(comes_true([] { return speed() > 0.1; }, Seconds(10)));
  CHECK_THAT(system.program().out(), !Contains("failed "));
  system.stop();
}

TEST_CASE("an operator pauses a component, changes its parameters, and starts its process again",
          "[system][orcactl]") {
  System system({kScout});
  system.await_work();
  CHECK(run_orcactl({"suspend", "avoid"}).exit_code() == 0);
  CHECK_THAT(run_orcactl({"ps"}).out, Contains("SUSPENDED"));
  CHECK(run_orcactl({"resume", "avoid"}).exit_code() == 0);
  CHECK_THAT(run_orcactl({"ps"}).out, !Contains("SUSPENDED"));
  const Run set = run_orcactl({"set", "avoid.robot_radius", "30 cm"});
  INFO(set.err);
  CHECK(set.exit_code() == 0);
  CHECK_THAT(run_orcactl({"get", "avoid.robot_radius"}).out, Contains("0.3"));
  const Run wrong = run_orcactl({"set", "avoid.robot_radius", "30 kg"});
  CHECK(wrong.exit_code() == 1);
  CHECK_THAT(wrong.err, Contains("robot_radius"));
  const auto before = children_of(system.program().pid()).at("behaviours");
  const Run restart = run_orcactl({"restart", "goto"});
  INFO(restart.err);
  CHECK(restart.exit_code() == 0);
  CHECK_THAT(restart.out, Contains("behaviours"));
  CHECK(children_of(system.program().pid()).at("behaviours") != before);
  CHECK_THAT(run_orcactl({"ps", "--json"}).out, Contains("\"restarts\": 1"));
  CHECK(run_orcactl({"alarms"}).out.find("PROCESS_ENDED") == std::string::npos);
  CHECK(run_orcactl({"restart", "command"}).exit_code() == 0);  // the end of the run waits for it; it goes on
  CHECK(run_orcactl({"ps"}).exit_code() == 0);
  system.stop();
}

TEST_CASE("alarms stay until they are acknowledged, even if their source has been started again",
          "[system][orcactl]") {
  System system({kScout});
  system.await_work();
  const auto lost = children_of(system.program().pid()).at("behaviours");
  REQUIRE(kill(lost, SIGKILL) == 0);
  system.await("process behaviours is back");
  const Run alarms = run_orcactl({"alarms"});
  CHECK_THAT(alarms.out, Contains("PROCESS_ENDED") && Contains("behaviours"));
  CHECK_THAT(run_orcactl({"alarms", "--json"}).out, Contains("\"number\": 1"));
  CHECK(run_orcactl({"alarms", "ack", "77"}).exit_code() == 1);
  CHECK(run_orcactl({"alarms", "ack", "all"}).exit_code() == 0);
  CHECK_THAT(run_orcactl({"alarms"}).out, !Contains("PROCESS_ENDED"));
  system.stop();
}

TEST_CASE("the objects that pass a port can be seen, counted and timed", "[system][orcactl]") {
  System system({kScout});
  system.await_work();
  const Run echo = run_orcactl({"echo", "base.OdometryPush", "--count", "3"});
  CHECK(echo.exit_code() == 0);
  CHECK(System::count_of(echo.out, "<Odometry ") == 3);
  CHECK_THAT(echo.out, Contains("origin=\"base\""));
  const Run arriving = run_orcactl({"echo", "avoid.sonar", "--count", "2", "--json"});
  CHECK(System::count_of(arriving.out, "\"type\": \"SonarRangeReadings\"") == 2);
  const Run field = run_orcactl({"echo", "base.OdometryPush", "--for", "1 s", "--field", "x"});
  CHECK(field.exit_code() == 0);
  CHECK(field.lines().size() > 3);
  for (const std::string& line : field.lines())
    CHECK(line.find_first_not_of("-.e0123456789") == std::string::npos);
  const Run wrong = run_orcactl({"echo", "base.OdometryPush", "--field", "steer_angel"});
  CHECK(wrong.exit_code() == 1);
  CHECK(wrong.says("Odometry has no field \"steer_angel\"; did you mean \"steer_angle\"?"));
  const Run reason = run_orcactl({"echo", "fuser.FusionReasonPush", "--for", "20 s", "--count", "2"});
  CHECK(System::count_of(reason.out, "<FusionReason ") == 2);  // which it makes only for who takes it
  const Run hz = run_orcactl({"hz", "base.OdometryPush", "--for", "2 s", "--json"});
  CHECK(hz.exit_code() == 0);
  const std::size_t at = hz.out.find("\"per_second\": ");
  REQUIRE(at != std::string::npos);
  CHECK(std::stod(hz.out.substr(at + 14)) > 5.0);
  const Run latency = run_orcactl({"latency", "avoid.odometry", "--for", "1 s"});
  CHECK(latency.exit_code() == 0);
  CHECK_THAT(latency.out, Contains("MEDIAN MS"));
  system.stop();
}

TEST_CASE("of a robot with two lasers each is described by its name", "[system][orcactl]") {
  System system({source_file("graphs/courier_depot.xml")});
  system.await_work();
  const auto ask = [](const std::string& about) {
    return run_orcactl({"query", "lasers.LaserSensorQuery", "<Ask about=\"" + about + "\"/>"});
  };
  const Run low = ask("low");
  INFO(low.err);
  CHECK(low.exit_code() == 0);
  CHECK_THAT(low.out, Contains("name=\"low\"") && Contains("max_range=\"4\""));
  CHECK_THAT(ask("").out, Contains("name=\"high\""));
  CHECK(ask("middle").says("its hardware has no laser \"middle\"; lasers: high, low"));
  system.stop();
}

TEST_CASE("the time from a sensor to the wheels is measured along the causes of commands",
          "[system][orcactl]") {
  // Its poses are summed up from odometry, so all that it does begins with odometry, whichever behaviour decides.
  System system({source_file("graphs/scout_goto_two_localizers.xml")});
  system.await_work();
  const Run told = run_orcactl(
      {"latency", "--from", "base.odometry", "--to", "wheels", "--for", "3 s", "--json"}, Seconds(20));
  INFO(told.out << told.err);
  CHECK(told.exit_code() == 0);
  const std::size_t at = told.out.find("\"way\": \"base.OdometryPush > ");
  REQUIRE(at != std::string::npos);
  const std::string line = told.out.substr(at, told.out.find('\n', at) - at);
  CHECK_THAT(line, Contains(" > fuser.base\""));
  const std::size_t median = line.find("\"median_ms\": ");
  REQUIRE(median != std::string::npos);
  CHECK(std::stod(line.substr(median + 13)) > 0.0);
  CHECK(std::stod(line.substr(median + 13)) < 100.0 * kSlowdown);
  CHECK(run_orcactl({"latency", "--from", "base.odometry"}).exit_code() == 2);
  CHECK(run_orcactl({"latency", "--from", "base.odometri", "--to", "wheels"}).says("base.OdometryPush"));
  system.stop();
}

TEST_CASE("an operator sends objects and asks questions", "[system][orcactl]") {
  System system({kScout});
  system.await_work();
  const Run query = run_orcactl({"query", "base.RobotQuery", "<Ask/>"});
  INFO(query.err);
  CHECK(query.exit_code() == 0);
  CHECK_THAT(query.out, Contains("<Robot ") && Contains("Dewey"));
  CHECK_THAT(query.out, Contains("mission=\"0\"") && Contains("<cause origin=\"orcactl\" port=\"\" seq="));
  const Run command = run_orcactl({"send", "base.MotionCommandSend", "<MotionCommand speed=\"0.1 m/s\"/>"});
  INFO(command.err);
  CHECK(command.exit_code() == 0);
  const Run wrong = run_orcactl({"send", "base.MotionCommandSend", "<MotionCommand sped=\"0.1\"/>"});
  CHECK(wrong.exit_code() == 1);
  CHECK(wrong.says("did you mean \"speed\"?"));
  CHECK(run_orcactl({"send", "base.RobotQuery", "<Ask/>"}).says("use orcactl query"));
  CHECK(run_orcactl({"query", "base.MotionCommandSend", "<MotionCommand/>"}).says("use orcactl send"));
  system.stop();
}

TEST_CASE(
    "no client can hurt a system: rubbish and floods are cut off, and one that never reads costs nothing",
    "[system][orcactl]") {
  System system({kScout});
  system.await_work();
  const Seconds cpu_before = cpu_time_of(system.program().pid());
  SECTION("rubbish") {
    const RawClient client;
    REQUIRE(client.send("rubbish"));
    CHECK(client.is_cut_off(Seconds(1)));
  }
  SECTION("a message that announces more than a client may send") {
    const RawClient client;
    REQUIRE(client.send(std::string("\xC1") + std::string(8, '\1') + std::string(10, '\x7F')));
    CHECK(client.is_cut_off(Seconds(1)));
  }
  SECTION("a flood") {
    const RawClient client;
    for (int i = 0; i < 10'000 && client.send(ask_ps()); ++i) {
    }
    for (int i = 0; i < 1000; ++i) client.send(ask_ps());
    CHECK(comes_true([&] { return !client.send(ask_ps()) && errno != EAGAIN; }, Seconds(2)));
  }
  SECTION("one that asks and never reads") {
    const RawClient client;
    for (int i = 0; i < 100; ++i) client.send(ask_ps());
    CHECK(run_orcactl({"ps"}).exit_code() == 0);
  }
  SECTION("one that follows the log and never reads, and one that is stopped while it looks at a port") {
    Subprocess log(orcactl({"log", "--follow", "--level", "debug"}));
    Subprocess echo(orcactl({"echo", "base.OdometryPush"}));
    REQUIRE(echo.wait_for_output("<Odometry ", Seconds(5)));
    log.send(SIGSTOP);
    echo.send(SIGSTOP);
    const Run hz = run_orcactl({"hz", "avoid.odometry", "--for", "2 s", "--json"});
    CHECK(hz.exit_code() == 0);
    CHECK_THAT(hz.out, !Contains("\"objects\": 0"));
  }
  SECTION("a hundred at once") {
    std::vector<std::unique_ptr<RawClient>> crowd;
    for (int i = 0; i < 100; ++i) crowd.push_back(std::make_unique<RawClient>());
    CHECK(run_orcactl({"ps"}).exit_code() == 0);
  }
  CHECK(run_orcactl({"ps"}).exit_code() == 0);
  CHECK(cpu_time_of(system.program().pid()) - cpu_before < Seconds(1.0) * kSlowCode);
  system.stop();
}
