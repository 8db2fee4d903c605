// SPDX-License-Identifier: GPL-3.0-or-later
// Systems with security="on": what starts, and what strangers in the network achieve.
#include <arpa/inet.h>
#include <netinet/ip.h>
#include <netinet/udp.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <cstring>
#include <ctime>
#include <fstream>
#include <thread>

#include "dds/backend/participant.hpp"
#include "forged_keys.hpp"
#include "hosted_system.hpp"
#include "key_home.hpp"
#include "orca/base/files/own_library.hpp"
#include "orca/idl/machines.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/keys/authority.hpp"
#include "orca/keys/key_ring.hpp"
#include "orca/supervisor/bulletin.hpp"
#include "pair_of_machines.hpp"

using namespace orca;
using namespace orca::test;
using namespace std::chrono_literals;
using Catch::Contains;

namespace {

const std::string kGraph = "scout_goto_processes";
const Words kScout{source_file("graphs/scout_goto_processes.xml"), "--set", "link=dds", "--set",
                   "security=on"};
const Words kFlow =
    Words{system_graph("flow.xml"), "--set", "link=dds", "--set", "security=on"} + with_test_plugins();

keys::Validity for_a(std::chrono::seconds time) {
  const auto now = std::chrono::system_clock::now();
  return {now - 1h, now + time};
}

Result<std::unique_ptr<dds::Participant>> open(const std::string& process, const std::string& keys) {
  DdsOptions options;
  options.graph = kGraph;
  options.process = process;
  options.keys = keys;
  return dds::Participant::open(options);
}

std::string read(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A program in the network that writes to the topics of a robot as long as it lives.
class Stranger {
 public:
  Stranger(const std::string& process, const std::string& keys) {
    auto opened = open(process, keys);
    REQUIRE(opened);
    participant_ = std::move(opened).value();
    for (const std::string& topic :
         {"orca/" + kGraph + "/base/OdometryPush", "orca/" + kGraph + "/base/SonarRangeReadingsPush",
          "orca-lines/" + kGraph + "/run/base"})
      if (auto writer = participant_->make_writer({topic, "orca::dds::Message", 16}))
        writers_.push_back(std::move(writer).value());
  }
  [[nodiscard]] std::size_t writers() const { return writers_.size(); }
  void write() const {
    for (const auto& writer : writers_) writer->write(std::vector<std::byte>(200));
  }

 private:
  std::unique_ptr<dds::Participant> participant_;
  std::vector<std::shared_ptr<dds::TopicWriter>> writers_;
};

// Returns the process that begins when two participants prove themselves to each other, whichever the other is.
std::string who_begins(const std::string& machine) {
  const auto ring = keys::KeyRing::open(machine, "base", std::time(nullptr));
  REQUIRE(ring);
  return ring->known().begin()->second.process;
}

// Hears all UDP packets on the loopback interface for a while and sends each of DDS once more. Returns how many.
int replay(std::chrono::milliseconds time) {
  const int all = socket(AF_PACKET, SOCK_DGRAM | SOCK_CLOEXEC, htons(0x0800));
  const int out = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  REQUIRE(all >= 0);
  const timeval limit{0, 100'000};
  setsockopt(all, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  std::vector<std::pair<sockaddr_in, std::string>> heard;
  std::string bytes(65536, '\0');
  const auto end = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < end) {
    const ssize_t size = recv(all, bytes.data(), bytes.size(), 0);
    iphdr ip{};
    udphdr udp{};
    if (size < static_cast<ssize_t>(sizeof ip + sizeof udp)) continue;
    std::memcpy(&ip, bytes.data(), sizeof ip);
    const std::size_t header = ip.ihl * 4U;
    std::memcpy(&udp, bytes.data() + header, sizeof udp);
    const std::string payload =
        bytes.substr(header + sizeof udp, static_cast<std::size_t>(size) - header - sizeof udp);
    if (ip.protocol != IPPROTO_UDP || !payload.starts_with("RTPS")) continue;
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = udp.dest;
    to.sin_addr.s_addr = ip.daddr;
    heard.emplace_back(to, payload);
  }
  for (const auto& [to, payload] : heard)
    (void)sendto(out, payload.data(), payload.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  close(all);
  close(out);
  return static_cast<int>(heard.size());
}

}  // namespace

TEST_CASE("a robot with keys drives on whatever strangers say, and its log says who was refused",
          "[system][security]") {
  const KeyHome home;
  home.make(kScout);
  const std::string folder = home.of_system(kGraph);
  const std::string machine = folder + "/this-machine";
  const std::string victim = who_begins(machine);
  REQUIRE(keys::renew_keys(folder, {{"", "guest", {"guest/topic"}, {}}}, for_a(1h)).ok());
  const TempFolder spoils;
  forge_keys(machine, victim, spoils.file("forged"));
  std::filesystem::copy(machine, spoils.file("stolen"), std::filesystem::copy_options::recursive);
  std::filesystem::permissions(spoils.file("stolen"), std::filesystem::perms::owner_all);
  System robot(kScout + Words{"--set", kNear});
  (void)robot.process("base");
  std::this_thread::sleep_for(2s);
  const Stranger plain("plain", "");
  const Stranger liar(victim, spoils.file("forged"));
  const Stranger guest("guest", spoils.file("stolen"));
  CHECK(plain.writers() == 3);
  CHECK(guest.writers() == 0);  // it has no permission for any of them
  std::atomic<bool> ends{false};
  std::thread talk([&] {
    while (!ends) plain.write(), liar.write(), std::this_thread::sleep_for(5ms);
  });
  std::this_thread::sleep_for(1s);
  REQUIRE(keys::revoke_keys(folder, "guest", {}, for_a(1h)));
  const int replayed = geteuid() == 0 ? replay(1s) : 0;
  const Run run = finish(robot.program(), Seconds(60));
  ends = true;
  talk.join();
  INFO(run.err);
  CHECK((geteuid() != 0 || replayed > 10));
  CHECK((geteuid() != 0 || run.says("127.0.0.1 repeats what process ")));
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 1);
  CHECK_FALSE(run.says("PROCESS_ENDED"));
  CHECK(run.says("what 127.0.0.1 says over DDS is dropped: it has no certificate of this system"));
  CHECK(run.says("it cannot prove to be process " + victim));
  CHECK(run.says("says over DDS is dropped: the certificate of process guest was revoked"));
}

TEST_CASE("without good keys nothing starts, and the log says what to do", "[system][security]") {
  const KeyHome home;
  Run run = run_deployer(kFlow);
  CHECK(run.exit_code() == 3);
  CHECK(run.says("process source has no key"));
  CHECK(run.says("make keys with orcactl keys"));
  run = home.make(kFlow);
  CHECK_THAT(run.out, Contains("+authority: the authority's private key. Keep it apart") &&
                          Contains("this-machine: for source, relay, sink"));
  const std::string folder = home.of_system("flow");
  const std::string key = folder + "/this-machine/relay.key";
  SECTION("the key is for all to read") {
    REQUIRE(chmod(key.c_str(), 0644) == 0);
    run = run_deployer(kFlow);
    CHECK(run.exit_code() == 3);
    CHECK(run.says("relay.key can be used by others"));
  }
  SECTION("the certificate was revoked for good") {
    REQUIRE(keys::revoke_keys(folder, "relay", {}, for_a(1h)));
    run = run_deployer(kFlow);
    CHECK(run.exit_code() == 3);
    CHECK(run.says("its certificate was revoked"));
  }
  SECTION("a system of its own name needs keys of its own") {
    const Words other = kFlow + Words{"--name", "other"};
    run = run_deployer(other);
    CHECK(run.exit_code() == 3);
    CHECK(run.says("/other/this-machine"));
    home.make(other);
    System system(other);
    system.when("flow ", 0, Seconds(15));
    stop(system);
  }
  SECTION("a second authority is not made over the first") {
    run = run_orcactl(Words{"keys"} + kFlow);
    CHECK(run.exit_code() == 1);
    CHECK(run.says("there is an authority already"));
  }
  SECTION("no log and no list of processes has a key") {
    System system(kFlow);
    system.when("flow ", 0, Seconds(15));
    const std::string secret = split_lines(read(key)).at(1);
    CHECK_FALSE(stop(system).says(secret));
  }
}

TEST_CASE("only processes with keys load OpenSSL", "[system][security]") {
  const KeyHome home;
  home.make(kFlow);
  System system(kFlow);
  system.when("flow ", 0, Seconds(15));
  const auto maps = [](pid_t process) { return read("/proc/" + std::to_string(process) + "/maps"); };
  CHECK_THAT(maps(system.process("relay")), Contains("libcrypto"));
  CHECK_THAT(maps(system.program().pid()), !Contains("libcrypto"));
  stop(system);
}

TEST_CASE("keys are renewed and a process is revoked while the others run", "[system][security]") {
  const KeyHome home;
  home.make(kFlow);
  System system(kFlow);
  system.when("flow ", 0, Seconds(15));
  home.make(kFlow, {"--renew", "--days", "30"});
  system.when("there is a new list of certificates", 0, Seconds(5));
  std::size_t mark = system.mark();
  const pid_t relay = system.process("relay");
  CHECK(run_orcactl({"restart", "relay"}, Seconds(10)).exit_code() == 0);
  system.flows_without(relay, mark);
  mark = system.mark();
  const Run revoked = home.make(kFlow, {"--revoke", "relay"});
  CHECK_THAT(revoked.out, Contains("revoked: the keys of process relay"));
  system.when("this process is cut off from DDS: its certificate was revoked", mark, Seconds(5));
  const pid_t revoked_relay = system.process("relay");
  mark = system.mark();
  CHECK(run_orcactl({"restart", "relay"}, Seconds(10)).exit_code() == 0);  // it has new keys
  system.flows_without(revoked_relay, mark);
  CHECK_FALSE(stop(system).says("GAVE_UP"));
}

TEST_CASE("a machine with keys speaks for itself, and for no other machine", "[system][security]") {
  const KeyHome home;
  home.make({kDrive}, {"--set", "security=on"});
  const auto& open_one =
      late_function<decltype(supervisor::orca_open_bulletin)>("liborca_bulletin.so", "orca_open_bulletin")
          .value()
          .get();
  const auto opened = [&](const std::string& machine, const supervisor::HearState& hear) {
    Error error;
    std::unique_ptr<supervisor::Bulletin> made(open_one({"orca::idl::MachineState",
                                                         "orca/two_machines/machines",
                                                         "127.0.0.1",
                                                         "",
                                                         {},
                                                         0,
                                                         home.of_system("two_machines") + "/" + machine},
                                                        hear, error));
    INFO(error.message);
    REQUIRE(made != nullptr);
    return made;
  };
  const auto state_of = [](const std::string& machine) {
    idl::MachineState state;
    state.origin(machine);
    std::vector<std::byte> bytes;
    object_type<idl::MachineState>().serialize(&state, bytes);
    return bytes;
  };
  std::atomic<int> of_base{0};
  std::atomic<int> of_brain{0};
  const auto brain = opened("brain", [&](std::span<const std::byte> bytes) {
    idl::MachineState state;
    if (!object_type<idl::MachineState>().deserialize(bytes, &state).ok()) return;
    ++(state.origin() == "base" ? of_base : of_brain);
  });
  const auto base = opened("base", [](std::span<const std::byte>) {});
  const auto forged = state_of("brain");
  const auto own = state_of("base");
  REQUIRE(comes_true([&] { return base->say(forged), base->say(own), of_base > 10; }, Seconds(10)));
  CHECK(of_brain == 0);
}

TEST_CASE("a robot whose commands come with keys from another machine drives, until that one is revoked",
          "[system][security][tool]") {
  if (is_skipped()) return;
  const KeyHome home;
  home.make({kDrive}, {"--set", "security=on"});
  Pair pair({"interface=orca0", "security=on"}, kDrive);
  pair.start_both();
  pair.says(1, "machine base is there", 0, Seconds(15));
  std::this_thread::sleep_for(Seconds(5));
  CHECK_FALSE(pair.at(0).err().find("the base stands") != std::string::npos);
  const std::size_t mark = pair.mark(0);
  REQUIRE(keys::revoke_keys(home.of_system("two_machines"), "brain", {}, for_a(1h)));
  pair.says(0, "the base stands: no motion command", mark, Seconds(4));
  pair.says(0, "alarm MACHINE_LOST: machine brain", mark);
  pair.at(0).send(SIGTERM);
  CHECK(pair.finish(0, Seconds(10)).ended);
}
