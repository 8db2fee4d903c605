// SPDX-License-Identifier: GPL-3.0-or-later
// Hundreds of attempts of other users of the machine to move, stop or starve a system that runs: of a stranger, and of one who may only look.
// Needs root, to be several users. What a hostile component can do: confined_test.cpp.
#include <fcntl.h>
#include <grp.h>
#include <sched.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstring>
#include <functional>

#include "hosted_system.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/control.hpp"
#include "orca/supervisor/control_socket.hpp"

using namespace orca::test;
namespace supervisor = orca::supervisor;

namespace {

constexpr uid_t kObserver = 60001;
constexpr uid_t kStranger = 60003;
constexpr const char* kSystem = "strangers";  // Other tests share systems in the same folder.

// How many attempts there were, and the names of those that were not refused.
struct Tally {
  int count = 0;
  std::string successes;

  void note(const std::string& name, bool is_refused) {
    ++count;
    if (!is_refused) successes += name + "\n";
  }
};

// Does something as another user, in a process of its own, and returns its tally.
Tally as_user(uid_t user, const std::function<void(Tally&)>& act) {
  int ends[2] = {-1, -1};
  REQUIRE(pipe(ends) == 0);
  const pid_t pid = fork();
  if (pid == 0) {
    Tally tally;
    setsid();  // whoever shares a session may send SIGCONT
    if (setgroups(0, nullptr) != 0 || setgid(user) != 0 || setuid(user) != 0) _exit(2);
    act(tally);
    const std::string text = std::to_string(tally.count) + "\n" + tally.successes;
    _exit(write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()) ? 0 : 2);
  }
  close(ends[1]);
  std::string text;
  std::array<char, 4096> room;
  for (ssize_t size = 0; (size = read(ends[0], room.data(), room.size())) > 0;)
    text.append(room.data(), static_cast<std::size_t>(size));
  close(ends[0]);
  int status = 0;
  REQUIRE(waitpid(pid, &status, 0) == pid);
  REQUIRE(status == 0);
  const std::size_t line = text.find('\n');
  return {std::stoi(text.substr(0, line)), text.substr(line + 1)};
}

// All orders that change something, each for all that it could be given to.
std::vector<supervisor::Ask> orders(const Words& components, const Words& ports) {
  std::vector<supervisor::Ask> all;
  const auto add = [&all](const std::string& command, Words words) {
    all.push_back({command, std::move(words), false});
  };
  for (const std::string& component : components) {
    for (const char* const command : {"suspend", "resume", "restart", "fits"}) add(command, {component});
    add("swap", {component, "/tmp/evil.so"});
    add("set", {component + ".max_speed", "3 m/s"});
  }
  for (const std::string& port : ports) {
    add("line", {port});
    add("connect", {port, "base.MotionCommandSend"});
    add("disconnect", {port, "base.MotionCommandSend"});
  }
  for (const char* const command :
       {"stop", "estop", "pause", "step", "apply", "diff", "unknown", "", "adopt"})
    add(command, {});
  add("estop", {"--release"});
  add("pace", {"0"});
  add("pace", {"fast"});
  add("alarms", {"ack"});
  add("apply", {"/etc/passwd"});
  add("diff", {"/etc/passwd"});
  return all;
}

// Gives each order. Whoever has no role is not even let in.
void give_orders(Tally& tally, const std::vector<supervisor::Ask>& orders) {
  using namespace std::chrono_literals;
  for (const supervisor::Ask& order : orders) {
    std::string name = "order " + order.command;
    for (const std::string& word : order.words) name += " " + word;
    auto socket = supervisor::connect_to_shared(kSystem, 0);
    if (!socket) return tally.note("connect for " + name, false);  // nothing would be tried
    supervisor::Channel client(std::move(*socket));
    bool is_refused = !client.send(encode(order, 1), 5s).ok();
    while (auto message = client.wait_for_message(10s)) {
      const auto answer = decode_answer(std::move(*message));
      const auto* const end = answer ? std::get_if<supervisor::EndAnswer>(&*answer) : nullptr;
      if (end == nullptr) break;  // a line, or a record: it was answered
      is_refused = end->outcome.error().message.find("role") != std::string::npos ||
                   end->outcome.error().message.find("has none") != std::string::npos;
      break;
    }
    tally.note(name, is_refused);
  }
}

bool is_refused(long result) { return result == -1 && (errno == EPERM || errno == EACCES); }

// Attacks a process as another user can: by signals, through its memory and by /proc.
void attack_process(Tally& tally, pid_t pid) {
  const std::string which = " " + std::to_string(pid);
  const int pidfd = static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
  for (const int number : {0, SIGKILL, SIGSTOP, SIGTERM, SIGINT, SIGSEGV, SIGUSR1, SIGCONT}) {
    tally.note("kill" + which, is_refused(kill(pid, number)));
    tally.note("tgkill" + which, is_refused(syscall(SYS_tgkill, pid, pid, number)));
    tally.note("pidfd" + which, is_refused(syscall(SYS_pidfd_send_signal, pidfd, number, nullptr, 0)));
  }
  char byte = 0;
  const iovec here{&byte, 1};
  const rlimit none{0, 0};
  const sched_param idle{0};
  tally.note("ptrace" + which, is_refused(ptrace(PTRACE_SEIZE, pid, nullptr, nullptr)));
  tally.note("read" + which, is_refused(process_vm_readv(pid, &here, 1, &here, 1, 0)));
  tally.note("write" + which, is_refused(process_vm_writev(pid, &here, 1, &here, 1, 0)));
  tally.note("descriptor" + which, is_refused(syscall(SYS_pidfd_getfd, pidfd, 3, 0)));
  tally.note("limit" + which, is_refused(prlimit(pid, RLIMIT_NOFILE, &none, nullptr)));
  tally.note("priority" + which, is_refused(setpriority(PRIO_PROCESS, static_cast<id_t>(pid), 19)));
  tally.note("scheduler" + which, is_refused(sched_setscheduler(pid, SCHED_IDLE, &idle)));
  const std::string process = "/proc/" + std::to_string(pid) + "/";
  for (const char* const file : {"mem", "environ", "maps", "fd/0", "fd/3", "oom_score_adj", "clear_refs"})
    tally.note(file + which, is_refused(open((process + file).c_str(), O_RDWR)));
}

// Tries what the folder of sockets and the files of the system allow.
void attack_files(Tally& tally, const std::string& own_folder, const std::string& graph) {
  const std::string shared = "/tmp/orca-shared-0";
  for (const std::string& file :
       {own_folder + "/" + kSystem + ".sock", shared + "/" + kSystem + ".sock", graph}) {
    tally.note("remove " + file, is_refused(unlink(file.c_str())));
    tally.note("rename " + file, is_refused(rename(file.c_str(), (file + ".old").c_str())));
    tally.note("replace " + file, is_refused(symlink("/tmp/orca_mine", file.c_str())) || errno == EEXIST);
    tally.note("mode of " + file, is_refused(chmod(file.c_str(), 0777)));
    tally.note("owner of " + file, is_refused(chown(file.c_str(), kStranger, kStranger)));
    tally.note("empty " + file, is_refused(truncate(file.c_str(), 0)) || errno == EINVAL);
  }
  sockaddr_un address{AF_UNIX, {}};
  std::strncpy(address.sun_path, (own_folder + "/" + kSystem + ".sock").c_str(), sizeof address.sun_path - 1);
  const int socket = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  tally.note("connect to the owner's socket",
             is_refused(connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address)));
  for (const char* const name : {"a.sock", "strangers.sock.new", "x"})
    tally.note(std::string("make ") + name,
               is_refused(open((shared + "/" + name).c_str(), O_CREAT | O_WRONLY, 0600)));
}

Words column(const std::string& name, const Words& words) {
  Words cells;
  const std::string key = "\"" + name + "\":";
  for (const std::string& line : run_orcactl(Words{"--json"} + words).lines()) {
    const std::size_t at = line.find(key);
    const std::size_t begin = at == std::string::npos ? at : line.find('"', at + key.size());
    if (begin != std::string::npos)
      cells.push_back(line.substr(begin + 1, line.find('"', begin + 1) - begin - 1));
  }
  return cells;
}

}  // namespace

TEST_CASE("of hundreds of attempts of other users none moves, stops or starves a system", "[system][roles]") {
  if (geteuid() != 0) {
    WARN("only root can be several users");
    return;
  }
  Subprocess deployer_(deployer({source_file("graphs/scout_goto_processes.xml"), "--name", kSystem, "--hold",
                                 "--allow", "observe=user:" + std::to_string(kObserver)}));
  REQUIRE(comes_true(
      [] {
        return run_orcactl({"hz", "base.OdometryPush", "--for", "50 ms"}).exit_code() == 0;
      },
      Seconds(20)));
  const Words components = column("name", {"ps"});
  const Words ports = column("port", {"ports"});
  REQUIRE(components.size() >= 6);
  REQUIRE(ports.size() >= 12);
  const std::map<std::string, pid_t> processes = children_of(deployer_.pid());
  REQUIRE(processes.size() >= 2);
  const auto all = orders(components, ports);

  Tally tally;
  const auto add = [&tally](const Tally& more) {
    tally.count += more.count;
    tally.successes += more.successes;
  };
  for (const uid_t user : {kObserver, kStranger})
    add(as_user(user, [&all](Tally& t) { give_orders(t, all); }));
  const std::string runtime =
      std::getenv("XDG_RUNTIME_DIR") != nullptr ? std::getenv("XDG_RUNTIME_DIR") : "/tmp";
  for (const uid_t user : {kObserver, kStranger})
    add(as_user(user, [&](Tally& t) {
      attack_process(t, deployer_.pid());
      for (const auto& [name, pid] : processes) attack_process(t, pid);
      attack_files(t, runtime + "/orca", source_file("graphs/scout_goto_processes.xml"));
    }));
  CHECK(tally.successes == "");
  CHECK(tally.count > 400);
  std::printf("%d attempts\n", tally.count);

  // Each process is there, works, and nothing moves that was held.
  CHECK(children_of(deployer_.pid()) == processes);
  CHECK(run_orcactl({"hz", "base.OdometryPush", "--for", "200 ms"}).exit_code() == 0);
  CHECK(deployer_.err().find("estop: done") == std::string::npos);
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
  CHECK(finish(deployer_, Seconds(20)).exit_code() == 0);
}
