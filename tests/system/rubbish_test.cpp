// SPDX-License-Identifier: GPL-3.0-or-later
// Malformed packets for a process that has DDS: it may die of them, and nobody else. Rubbish in the memory that processes share.
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>

#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "hosted_system.hpp"
#include "internet_sockets.hpp"
#include "key_home.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

using Packet = std::vector<std::uint8_t>;

constexpr std::size_t kHeader = 20;             // [bytes] of an RTPS message: DDSI-RTPS 2.3, section 8.3.3.1
constexpr std::uint16_t kDiscoveryPort = 7400;  // of domain 0, section 9.6.1.1

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

// A UDP socket on the loopback interface.
class Socket {
 public:
  Socket() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) { REQUIRE(fd_ >= 0); }
  ~Socket() { close(fd_); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  // Listens to what participants announce to all.
  void join_discovery() const {
    const int yes = 1;
    setsockopt(fd_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    const timeval limit{2, 0};
    setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    sockaddr_in all = loopback(kDiscoveryPort);
    all.sin_addr.s_addr = htonl(INADDR_ANY);
    REQUIRE(bind(fd_, reinterpret_cast<const sockaddr*>(&all), sizeof all) == 0);
    ip_mreq group{};
    REQUIRE(inet_pton(AF_INET, "239.255.0.1", &group.imr_multiaddr) == 1);
    group.imr_interface.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(setsockopt(fd_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group) == 0);
  }
  [[nodiscard]] Packet receive() const {
    Packet packet(65536);
    const ssize_t size = recv(fd_, packet.data(), packet.size(), 0);
    REQUIRE(size > static_cast<ssize_t>(kHeader));
    packet.resize(static_cast<std::size_t>(size));
    return packet;
  }
  void send(const Packet& packet, std::uint16_t port) const {
    const sockaddr_in to = loopback(port);
    (void)sendto(fd_, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }

 private:
  const int fd_;
};

// Makes bad packets of good ones.
class Spoiler {
 public:
  Spoiler(unsigned seed, std::vector<Packet> good) : random_(seed), good_(std::move(good)) {}

  // An announcement with some bytes changed, cut off or put in; or a header, and then anything.
  Packet next() {
    Packet packet = good_[below(good_.size())];
    if (below(4) == 0) {
      packet.resize(kHeader);
      for (std::size_t i = below(400); i > 0; --i) packet.push_back(byte());
    }
    for (std::size_t i = 1 + below(8); i > 0 && packet.size() > kHeader; --i)
      packet[kHeader + below(packet.size() - kHeader)] = byte();
    if (below(4) == 0) packet.resize(kHeader + below(packet.size() - kHeader + 1));
    return packet;
  }

 private:
  std::size_t below(std::size_t limit) { return random_() % limit; }
  std::uint8_t byte() {
    constexpr std::uint8_t kExtreme[] = {0x00, 0x01, 0x7f, 0x80, 0xff};
    return below(2) == 0 ? kExtreme[below(std::size(kExtreme))] : static_cast<std::uint8_t>(random_());
  }

  std::mt19937 random_;
  const std::vector<Packet> good_;
};

// The memory that all processes of a system share, mapped by one that has no business there.
class RunMemory {
 public:
  explicit RunMemory(pid_t process) {
    for (const auto& entry :
         std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/fd")) {
      std::error_code none;
      if (!std::filesystem::read_symlink(entry.path(), none).string().starts_with("/memfd:orca-run"))
        continue;
      const int file = open(entry.path().c_str(), O_RDWR | O_CLOEXEC);
      REQUIRE(file >= 0);
      const auto size = static_cast<std::size_t>(lseek(file, 0, SEEK_END));
      void* const place = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
      close(file);
      REQUIRE(place != MAP_FAILED);
      all_.push_back({static_cast<std::uint32_t*>(place), size / sizeof(std::uint32_t)});
    }
    REQUIRE_FALSE(all_.empty());
  }
  ~RunMemory() {
    for (const auto words : all_) munmap(words.data(), words.size_bytes());
  }
  RunMemory(const RunMemory&) = delete;
  RunMemory& operator=(const RunMemory&) = delete;

  // Writes something into each word, or into some.
  void scribble(std::mt19937& random) const {
    constexpr std::uint32_t kValues[] = {0, 1, 2, 3, 0x7fffffff, 0x80000000, 0xffffffff};
    const auto share = 1 + random() % 8;
    for (const auto words : all_)
      for (std::uint32_t& word : words) {
        const auto any = static_cast<std::uint32_t>(random());
        if (any % share == 0) word = random() % 2 == 0 ? kValues[random() % std::size(kValues)] : any;
      }
  }

 private:
  std::vector<std::span<std::uint32_t>> all_;
};

// Writes ones over the counters of the memory that a process shares with another one for an edge. Returns whether it was there.
bool damage(pid_t process, const std::string& edge) {
  const std::string folder = "/proc/" + std::to_string(process);
  std::ifstream maps(folder + "/maps");
  std::string line;
  while (std::getline(maps, line) && line.find("/memfd:orca " + edge) == std::string::npos) continue;
  if (!maps) return false;
  const std::string ones(64, '\xff');
  const int memory = open((folder + "/mem").c_str(), O_RDWR | O_CLOEXEC);
  const auto place = static_cast<off_t>(std::strtoull(line.c_str(), nullptr, 16));
  const auto written = pwrite(memory, ones.data(), ones.size(), place);
  close(memory);
  return written == static_cast<ssize_t>(ones.size());  // not if it has just got other memory
}

// Returns a thread of Fast DDS in a process; 0 if it has none.
pid_t network_thread_of(pid_t process) {
  std::error_code none;
  for (const auto& task :
       std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task", none)) {
    std::string name;
    std::ifstream(task.path() / "comm") >> name;
    if (name == "dds") return static_cast<pid_t>(std::stoi(task.path().filename()));
  }
  return 0;
}

// Throws bad packets at a process of a flow, and checks that the others live and that objects come again.
void bombard(int rounds, int packets, const Words& more = {}) {
  constexpr unsigned kSeed = 20041112;
  Socket discovery;
  discovery.join_discovery();
  System system(flow("dds") + more);
  system.when("flow ", 0, Seconds(10));
  std::vector<Packet> good;
  for (int i = 0; i < 20; ++i) good.push_back(discovery.receive());
  Spoiler spoiler(kSeed, good);
  const pid_t source = system.process("source");
  const pid_t sink = system.process("sink");
  std::vector<double> outages;
  for (int round = 0; round < rounds; ++round) {
    CAPTURE(kSeed, round);
    const pid_t relay = system.process("relay");
    const std::vector<std::uint16_t> ports = ports_of(relay, "udp");
    REQUIRE_FALSE(ports.empty());
    const std::size_t mark = system.mark();
    for (int i = 0; i < packets; ++i)
      discovery.send(spoiler.next(), ports[static_cast<std::size_t>(i) % ports.size()]);
    const Seconds thrown = since_boot();
    std::this_thread::sleep_for(Seconds(0.1));
    if (const auto children = system.children(); children.contains("relay") && children.at("relay") == relay)
      continue;
    outages.push_back((system.flows_without(relay, mark) - thrown).count());
  }
  CHECK(system.process("source") == source);
  CHECK(system.process("sink") == sink);
  kill_one(system, "sink");  // the others still find each other
  const Run run = stop(system);
  CHECK_FALSE(run.says("GAVE_UP"));
  std::printf("%d rounds of %d bad packets: %zu deaths\n", rounds, packets, outages.size());
  if (!outages.empty()) print("packets to objects again", outages);
}

// A flow beside which a component in a process of its own writes into the memory that all share, all the time.
std::string flow_beside_scribbler() {
  std::string text = read_text(system_graph("flow.xml"));
  text.insert(text.find("<component"), "<process name=\"bad\"/>");
  const std::string bad =
      "<component name=\"bad\" type=\"test.Hooligan\" process=\"bad\" autonomous=\"true\">"
      "<param name=\"where\" value=\"work\"/><param name=\"deed\" value=\"scribble\"/></component>";
  text.insert(text.rfind("<connect from=\"source"), bad);
  return text;
}

}  // namespace

TEST_CASE("bad packets for one process of DDS harm no other", "[system][dds]") { bombard(3, 300); }

TEST_CASE(
    "whatever is written into the memory that processes share, objects flow, a lost process comes back, and "
    "all ends well",
    "[system]") {
  constexpr unsigned kSeed = 20261127;
  std::mt19937 random(kSeed);
  System system(flow());
  system.when("flow ", 0, Seconds(10));
  const RunMemory memory(system.program().pid());
  for (int round = 0; round < 20; ++round) {
    CAPTURE(kSeed, round);
    memory.scribble(random);
    CHECK(run_orcactl({"echo", "sink.in", "--count", "3"}, Seconds(2)).exit_code() == 0);
    if (round % 10 != 9) continue;
    const std::size_t mark = system.mark();
    const pid_t relay = system.process("relay");
    REQUIRE(kill(relay, SIGKILL) == 0);
    memory.scribble(random);
    system.flows_without(relay, mark);
  }
  const Run run = stop(system);
  CHECK_FALSE(run.says("SIGSEGV"));
  CHECK_FALSE(run.says("GAVE_UP"));
}

TEST_CASE(
    "a connection whose memory is damaged is cut, with an alarm, and gets new memory; at last it stays cut",
    "[system]") {
  const std::string edge = "relay.out to sink.in";
  System system(flow());
  system.when("flow ", 0, Seconds(10));
  for (int round = 0; round < 3; ++round) {
    CAPTURE(round);
    const std::size_t mark = system.mark();
    REQUIRE(comes_true([&] { return damage(system.process("sink"), edge); }, Seconds(5)));
    system.when("LINK_CUT", mark, Seconds(10));
    system.when("its damaged connections have new memory", mark, Seconds(10));
    CHECK(run_orcactl({"echo", "sink.in", "--count", "3"}, Seconds(5)).exit_code() == 0);
  }
  const auto stays_cut = [&] {
    return system.program().err().find("stays cut: its memory was damaged too often") != std::string::npos;
  };
  for (int round = 0; round < 8 && !comes_true(stays_cut, Seconds(1)); ++round)
    (void)damage(system.process("sink"), edge);
  CHECK(comes_true(stays_cut, Seconds(10)));
  CHECK(stop(system).exit_code() == 0);
}

TEST_CASE(
    "a component that writes into the memory that processes share hides no hang of another one, and can be "
    "started again",
    "[system]") {
  const TempFolder folder;
  System system(Words{folder.write("flow.xml", flow_beside_scribbler())} + with_test_plugins());
  system.when("flow ", 0, Seconds(10));
  for (const std::string lost : {"sink", "relay"}) {
    const pid_t process = system.process(lost);
    const std::size_t mark = system.mark();
    REQUIRE(kill(process, SIGSTOP) == 0);
    system.when("process " + lost + " hung and was killed", mark);
    system.flows_without(process, mark);
  }
  const pid_t bad = system.process("bad");
  const std::size_t mark = system.mark();
  CHECK(run_orcactl({"restart", "bad"}, Seconds(10)).exit_code() == 0);
  CHECK(system.process("bad", bad) != bad);
  CHECK(run_orcactl({"echo", "sink.in", "--count", "100"}, Seconds(5)).exit_code() == 0);
  const Run run = stop(system);
  CHECK(run.err.find("hung and was killed", mark) == std::string::npos);
  CHECK_FALSE(run.says("GAVE_UP"));
  CHECK_FALSE(run.says("SIGSEGV"));
}

TEST_CASE("a system does not give up because its network code is made to crash again and again",
          "[system][dds]") {
  constexpr int kDeaths = 6;
  const TempFolder folder;
  std::string text = read_text(system_graph("flow.xml"));
  const std::string rule = R"(restarts="1000" within="100 ms")";
  REQUIRE(text.find(rule) != std::string::npos);
  text.replace(text.find(rule), rule.size(), R"(restarts="3" within="60 s")");
  System system(Words{folder.write("flow.xml", text), "--set", "link=dds"} + with_test_plugins());
  system.when("flow ", 0, Seconds(10));
  const pid_t source = system.process("source");
  const pid_t sink = system.process("sink");
  for (int i = 0; i < kDeaths; ++i) {
    const pid_t relay = system.process("relay");
    const std::size_t mark = system.mark();
    REQUIRE(comes_true([&] { return network_thread_of(relay) != 0; }, Seconds(5)));
    REQUIRE(syscall(SYS_tgkill, relay, network_thread_of(relay), SIGABRT) == 0);
    system.when("the network code (Fast DDS) ended the process", mark);
    system.flows_without(relay, mark, Seconds(10));
  }
  CHECK(system.process("source") == source);
  CHECK(system.process("sink") == sink);
  CHECK_FALSE(stop(system).says("GAVE_UP"));
}

TEST_CASE("a million bad packets for one process with keys harm no other", "[.][slow][dds]") {
  const KeyHome keys;
  keys.make(flow("dds"));
  bombard(1000, 1000, {"--set", "security=on"});
}

TEST_CASE("a million bad packets for one process of DDS harm no other", "[.][slow][dds]") {
  bombard(1000, 1000);
}
