// SPDX-License-Identifier: GPL-3.0-or-later
// Another user of the machine, who was there first: he may make a start fail, with a reason, and nothing else.
#include <grp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>

#include "hosted_system.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/control.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
namespace fs = std::filesystem;
namespace supervisor = orca::supervisor;

namespace {

constexpr uid_t kNeighbour = 65534;
constexpr const char* kName = "robot";
constexpr const char* kGraph = R"(<graph name="robot" version="1">
  <component name="base" type="orca.RobotBaseServer" hardware="scout"/>
  <hardware name="scout" type="orca.hw.Sim">
    <param name="world" value="WORLD"/>
    <param name="robot" value="ROBOT"/>
    <param name="place" value="start"/>
  </hardware>
</graph>
)";

bool can_be_two_users() {
  if (geteuid() == 0) return true;
  std::cout << "SKIPPED: only root can act as another user, too\n";
  return false;
}

// Goes on as another user. Ends with the test.
void become_neighbour() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  umask(0);
  if (setgroups(0, nullptr) != 0 || setgid(kNeighbour) != 0 || setuid(kNeighbour) != 0) _exit(2);
}

// Does something as another user, and returns whether it worked.
bool as_neighbour(const std::function<bool()>& act) {
  const pid_t pid = fork();
  if (pid == 0) {
    become_neighbour();
    _exit(act() ? 0 : 1);
  }
  int status = 0;
  REQUIRE(waitpid(pid, &status, 0) == pid);
  REQUIRE(WIFEXITED(status));
  REQUIRE(WEXITSTATUS(status) != 2);
  return WEXITSTATUS(status) == 0;
}

int listen_at(const fs::path& path) {
  const int made = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  const bool listens =
      bind(made, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 && listen(made, 16) == 0;
  return listens ? made : -1;
}

// Answers everything with "done", as a deployer would.
void pretend(int socket) {
  for (;;) {
    supervisor::Channel client{orca::Descriptor(accept(socket, nullptr, nullptr))};
    while (auto message = client.wait_for_message(orca::Duration(std::chrono::seconds(2)))) {
      const std::uint64_t request = message->request;
      (void)client.post(supervisor::encode(supervisor::ControlAnswer(supervisor::EndAnswer{}), request));
    }
  }
}

// A process of the other user that pretends to be a deployer at a socket.
class Impostor {
 public:
  explicit Impostor(const fs::path& path) : pid_(fork()) {
    if (pid_ != 0) {
      REQUIRE(comes_true([&] { return fs::exists(fs::symlink_status(path)); }, Seconds(2)));
      return;
    }
    become_neighbour();
    const int socket = listen_at(path);
    if (socket >= 0) pretend(socket);
    _exit(1);
  }
  ~Impostor() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Impostor(const Impostor&) = delete;
  Impostor& operator=(const Impostor&) = delete;

 private:
  const pid_t pid_;
};

// A folder that everybody may write to, as /tmp is, beside one of this user and one of the other, each with a file.
class Land {
 public:
  Land() {
    fs::permissions(root_.path(), fs::perms(0755));
    REQUIRE(mkdir(shared().c_str(), 0) == 0);
    REQUIRE(chmod(shared().c_str(), 01777) == 0);
    for (const fs::path& folder : {own(), his()}) {
      REQUIRE(mkdir(folder.c_str(), 0700) == 0);
      std::ofstream(folder / "diary") << "dear diary";
    }
    chmod((his() / "diary").c_str(), 0666);
    chmod(his().c_str(), 0777);
    if (geteuid() != 0) return;
    REQUIRE(chown(his().c_str(), kNeighbour, kNeighbour) == 0);
    REQUIRE(chown((his() / "diary").c_str(), kNeighbour, kNeighbour) == 0);
  }

  [[nodiscard]] fs::path shared() const { return root_.path() / "shared"; }
  [[nodiscard]] fs::path own() const { return root_.path() / "own"; }
  [[nodiscard]] fs::path his() const { return root_.path() / "his"; }
  [[nodiscard]] fs::path folder() const { return shared() / "orca"; }
  [[nodiscard]] fs::path socket() const { return folder() / (std::string(kName) + ".sock"); }
  [[nodiscard]] const std::string& graph_file() const { return graph_; }

  [[nodiscard]] Words env() const { return {"/usr/bin/env", "XDG_RUNTIME_DIR=" + shared().string()}; }
  // Runs orcactl or the deployer to its end.
  [[nodiscard]] Run run(const Words& command, Seconds limit = Seconds(20)) const {
    Subprocess program(env() + command);
    return finish(program, limit);
  }

  // Checks that nothing was written or made in what is not in the shared folder.
  void check_untouched() const {
    for (const fs::path& folder : {own(), his()}) {
      CHECK(read_text(folder / "diary") == "dear diary");
      CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 1);
    }
  }

 private:
  static std::string graph() {
    std::string text = kGraph;
    text.replace(text.find("WORLD"), 5, source_file("sim/worlds/office.xml"));
    text.replace(text.find("ROBOT"), 5, source_file("sim/robots/nomad_scout.urdf"));
    return text;
  }

  TempFolder root_;
  const std::string graph_ = root_.write("robot.xml", graph());
};

// What somebody has put at a place before.
struct Trap {
  const char* what;
  std::function<bool(const Land& land, const fs::path& place)> make;
};

bool make_open_folder(const fs::path& place) { return mkdir(place.c_str(), 0777) == 0; }

const std::vector<Trap>& traps() {
  static const std::vector<Trap> all{
      {"a folder of his own", [](const Land&, const fs::path& p) { return mkdir(p.c_str(), 0700) == 0; }},
      {"a folder for everybody", [](const Land&, const fs::path& p) { return make_open_folder(p); }},
      {"a link to a folder of his",
       [](const Land& l, const fs::path& p) { return symlink(l.his().c_str(), p.c_str()) == 0; }},
      {"a link to a folder of ours",
       [](const Land& l, const fs::path& p) { return symlink(l.own().c_str(), p.c_str()) == 0; }},
      {"a link to a file of ours",
       [](const Land& l, const fs::path& p) { return symlink((l.own() / "diary").c_str(), p.c_str()) == 0; }},
      {"a link to a file of his",
       [](const Land& l, const fs::path& p) { return symlink((l.his() / "diary").c_str(), p.c_str()) == 0; }},
      {"a link to a new name in a folder of ours",
       [](const Land& l, const fs::path& p) { return symlink((l.own() / "new").c_str(), p.c_str()) == 0; }},
      {"a link to a new name in a folder of his",
       [](const Land& l, const fs::path& p) { return symlink((l.his() / "new").c_str(), p.c_str()) == 0; }},
      {"a second name of a file of his",
       [](const Land& l, const fs::path& p) { return link((l.his() / "diary").c_str(), p.c_str()) == 0; }},
      {"a file", [](const Land&, const fs::path& p) { return std::ofstream(p).put('x').good(); }},
      {"a pipe", [](const Land&, const fs::path& p) { return mkfifo(p.c_str(), 0666) == 0; }},
      {"a socket", [](const Land&, const fs::path& p) { return listen_at(p) >= 0; }},
  };
  return all;
}

// The same for what he may put into a folder of his that has the name of ours.
std::vector<Trap> inner_traps() {
  std::vector<Trap> inner;
  for (const Trap& trap : traps())
    inner.push_back({trap.what, [make = trap.make](const Land& land, const fs::path&) {
                       return make_open_folder(land.folder()) && make(land, land.socket());
                     }});
  return inner;
}

const std::vector<Words>& orders() {
  static const std::vector<Words> all{
      {"estop"}, {"estop", "--release"},       {"ps"},
      {"stop"},  {"--system", kName, "estop"}, {"--system", kName, "get", "base"}};
  return all;
}

void check_refused(const Land& land, const Words& order) {
  const Run run = land.run(orcactl(order));
  INFO(run.err);
  CHECK(run.exit_code() == 3);
  CHECK(run.says(land.folder().string()));
}

void check_start_refused(const Land& land) {
  const Run run = land.run(deployer({land.graph_file(), "--until", "1 s"}));
  INFO(run.err);
  CHECK(run.exit_code() == 3);
  CHECK(run.says("nothing is started, because no emergency stop"));
  CHECK(run.says(land.folder().string()));
}

// Each trap, set before anything runs, and each command.
void spring_all(const std::vector<Trap>& all) {
  for (const Trap& trap : all) {
    const Land land;
    CAPTURE(trap.what);
    REQUIRE(as_neighbour([&] { return trap.make(land, land.folder()); }));
    for (const Words& order : orders()) {
      CAPTURE(order);
      check_refused(land, order);
    }
    check_start_refused(land);
    land.check_untouched();
  }
}

// A system that runs in a land.
class Running {
 public:
  explicit Running(const Land& land) : land_(land), program_(land.env() + deployer({land.graph_file()})) {
    REQUIRE(comes_true([&] { return land.run(orcactl({"ps"})).exit_code() == 0; }, Seconds(20)));
  }
  Subprocess& operator*() { return program_; }
  Subprocess* operator->() { return &program_; }
  [[nodiscard]] int order(const Words& words) const { return land_.run(orcactl(words)).exit_code(); }
  [[nodiscard]] bool obeys(const Words& words, Seconds limit = Seconds(5)) const {
    return comes_true([&] { return order(words) == 0; }, limit);
  }
  void end() {
    program_.send(SIGTERM);
    CHECK(finish(program_, Seconds(5)).exit_code() == 0);
  }

 private:
  const Land& land_;
  Subprocess program_;
};

}  // namespace

TEST_CASE(
    "whatever another user has put in the place of our folder, nothing starts and nobody says that the robot "
    "is stopped",
    "[system][hostile][tool]") {
  if (!can_be_two_users()) return;
  spring_all(traps());
}

TEST_CASE(
    "whatever another user has put in a folder with the name of ours, nothing starts and nobody says that "
    "the robot is stopped",
    "[system][hostile][tool]") {
  if (!can_be_two_users()) return;
  spring_all(inner_traps());
}

TEST_CASE("a deployer that another user pretends to run stops nothing, and orcactl says so",
          "[system][hostile][tool]") {
  if (!can_be_two_users()) return;
  const Land land;
  REQUIRE(as_neighbour([&] { return make_open_folder(land.folder()); }));
  const Impostor impostor(land.socket());
  for (const Words& order : orders()) {
    CAPTURE(order);
    check_refused(land, order);
  }
  check_start_refused(land);
  SECTION("not even if the folder is ours by now") {
    REQUIRE(chown(land.folder().c_str(), 0, 0) == 0);
    REQUIRE(chmod(land.folder().c_str(), 0700) == 0);
    for (const Words& order : orders()) {
      CAPTURE(order);
      const Run run = land.run(orcactl(order));
      INFO(run.err);
      CHECK(run.exit_code() == 3);
      CHECK(run.says("user 65534"));
    }
  }
  land.check_untouched();
}

TEST_CASE("a system that runs is out of another user's reach", "[system][hostile][tool]") {
  if (!can_be_two_users()) return;
  const Land land;
  Running system(land);
  for (const auto& all : {traps(), inner_traps()}) {
    for (const Trap& trap : all) {
      CAPTURE(trap.what);
      CHECK_FALSE(as_neighbour([&] { return trap.make(land, land.folder()); }));
      CHECK_FALSE(as_neighbour([&] { return trap.make(land, land.socket()); }));
      CHECK(system.order({"estop"}) == 0);
    }
  }
  CHECK_FALSE(
      as_neighbour([&] { return rename(land.folder().c_str(), (land.his() / "taken").c_str()) == 0; }));
  CHECK_FALSE(as_neighbour([&] { return unlink(land.socket().c_str()) == 0; }));
  CHECK(system.order({"estop", "--release"}) == 0);
  system.end();
  land.check_untouched();
}

TEST_CASE("what another user has put in the place of an output is neither written nor followed",
          "[system][hostile][tool]") {
  if (!can_be_two_users()) return;
  const std::vector<Words> outputs{{"--trace", ""}, {"--picture", ".png"}, {"--record", ".csv"}};
  for (const Trap& trap : traps()) {
    const Land land;
    CAPTURE(trap.what);
    for (const Words& output : outputs) {
      CAPTURE(output);
      const fs::path place = land.shared() / ("out" + output[1]);
      REQUIRE(as_neighbour([&] { return trap.make(land, place); }));
      const std::string ports = output[0] == "--record" ? "=base.OdometryPush" : "";
      const Run run =
          land.run(deployer({land.graph_file(), "--until", "100 ms", output[0], place.string() + ports}) +
                   virtual_clock());
      INFO(run.err);
      CHECK((run.exit_code() == 2 || run.exit_code() == 3));
      CHECK(run.says(place.string()));
      land.check_untouched();
    }
  }
}

TEST_CASE("a socket that was removed is made again, and no second system of the name is let in meanwhile",
          "[system][hostile]") {
  const Land land;
  Running system(land);
  SECTION("the file alone") { fs::remove(land.socket()); }
  SECTION("the whole folder") { fs::remove_all(land.folder()); }
  const Run second = land.run(deployer({land.graph_file(), "--until", "1 s"}));
  CHECK(second.exit_code() == 3);
  CHECK(second.says("a system named \"robot\" runs already"));
  CHECK(system.obeys({"estop"}));
  CHECK(system->err().find("somebody has removed the socket of this system; it is made again") !=
        std::string::npos);
  system.end();
}

TEST_CASE("an emergency stop that can no longer reach the system is an alarm until it can",
          "[system][hostile]") {
  const Land land;
  Running system(land);
  fs::remove_all(land.folder());
  std::ofstream(land.folder()) << "in the way";
  CHECK(system->wait_for_output("alarm CONTROL_LOST", Seconds(5) * kSlowdown));
  CHECK(system.order({"estop"}) == 3);
  fs::remove(land.folder());
  CHECK(system.obeys({"estop"}));
  CHECK_THAT(land.run(orcactl({"alarms"})).out,
             Contains("CONTROL_LOST") && Contains("reaches this system again"));
  system.end();
}

TEST_CASE("an emergency stop gets through a storm of connections", "[system][hostile]") {
  constexpr int kStormy = 8;
  constexpr int kStops = 15;
  const Land land;
  Running system(land);
  std::vector<pid_t> storm;
  for (int i = 0; i < kStormy; ++i) {
    storm.push_back(fork());
    if (storm.back() != 0) continue;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, land.socket().c_str(), sizeof address.sun_path - 1);
    for (std::vector<int> open;; open.push_back(socket(AF_UNIX, SOCK_SEQPACKET, 0))) {
      if (open.empty()) continue;
      (void)connect(open.back(), reinterpret_cast<sockaddr*>(&address), sizeof address);
      if (open.size() < 100) continue;
      for (const int one : open) close(one);
      open.clear();
    }
  }
  for (int i = 0; i < kStops; ++i) {
    const Run run = land.run(orcactl({"estop"}));
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK(run.ending.signal == 0);
  }
  for (const pid_t one : storm) {
    kill(one, SIGKILL);
    waitpid(one, nullptr, 0);
  }
  CHECK(system.obeys({"estop", "--release"}));
  system.end();
}

TEST_CASE("no program loads libraries that lie in the folder where it is started", "[system][hostile]") {
  const TempFolder folder;
  folder.write("libstdc++.so.6", "no library");
  folder.write("libspdlog.so.1.10", "no library");
  for (const Words& words : {deployer({"--version"}), orcactl({"--version"}), hwprobe({"--version"})}) {
    CAPTURE(words);
    Subprocess program(words, {.folder = folder.path()});
    const std::optional<Ending> ending = program.wait(Seconds(60));
    INFO(program.err());
    REQUIRE(ending);
    CHECK(ending->exit_code == 0);
  }
}
