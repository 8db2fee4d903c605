// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/supervisor/host_process.hpp"

#include <fcntl.h>
#include <linux/capability.h>
#include <poll.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include <csignal>
#include <cstdint>
#include <string>

#include "open_descriptors.hpp"
#include "orca/supervisor/vocabulary.hpp"

using namespace orca;
using namespace orca::supervisor;

namespace {

constexpr Duration kLongWait = 30s;  // for what must happen, on a busy machine, too

Moment now() { return std::chrono::steady_clock::now(); }

HostStart start_of(const std::string& what, const std::string& number = "0") {
  const std::string program = std::string(ORCA_BINARY_DIR) + "/tests/hosted_child";
  return {"base", program, {program, what, number}, {}, {}, 0};
}

std::unique_ptr<HostProcess> started(const HostStart& start) {
  auto process = HostProcess::start(start);
  REQUIRE(process);
  return std::move(*process);
}

bool is_readable(int descriptor, Duration limit) {
  pollfd ready[] = {{descriptor, POLLIN, 0}};
  return poll(ready, 1, static_cast<int>(limit / 1ms)) > 0;
}

ExitReason end_of(HostProcess& process) {
  REQUIRE(is_readable(process.end_descriptor(), kLongWait));
  REQUIRE(process.exit());
  return *process.exit();
}

std::string last_words_of(HostProcess& process) {
  auto message = process.channel().wait_for_message(kLongWait);
  REQUIRE(message);
  const auto report = decode_report(std::move(*message));
  REQUIRE(report);
  return std::get<LastWordsReport>(*report).text;
}

// Waits until the program has set its signals.
std::unique_ptr<HostProcess> ready(const std::string& what) {
  auto process = started(start_of(what));
  CHECK(last_words_of(*process) == "ready");
  return process;
}

// Does what is due until the process ends.
ExitReason looked_after(HostProcess& process) {
  while (!is_readable(process.end_descriptor(), 5ms)) process.look(now());
  return end_of(process);
}

// A process that this one has not started, which sleeps.
struct Stranger {
  pid_t pid = -1;
  Descriptor pidfd;
};

Stranger make_stranger() {
  int ends[2] = {-1, -1};
  REQUIRE(pipe2(ends, O_CLOEXEC) == 0);
  const Descriptor reading(ends[0]);
  const Descriptor writing(ends[1]);
  const pid_t middle = fork();
  if (middle == 0) {
    signal(SIGTERM, SIG_DFL);
    const pid_t stranger = fork();
    if (stranger == 0) sleep(60);
    _exit(stranger == 0 || write(ends[1], &stranger, sizeof stranger) < 0 ? 1 : 0);
  }
  Stranger made;
  REQUIRE(read(ends[0], &made.pid, sizeof made.pid) == sizeof made.pid);
  REQUIRE(waitpid(middle, nullptr, 0) == middle);
  made.pidfd = Descriptor(static_cast<int>(syscall(SYS_pidfd_open, made.pid, 0)));
  REQUIRE(made.pidfd);
  return made;
}

std::unique_ptr<HostProcess> adopted(Stranger stranger) {
  Result<SocketPair> sockets = make_socket_pair();
  REQUIRE(sockets);
  return HostProcess::adopt(
      {"base", stranger.pid, std::move(stranger.pidfd), {}, std::move(sockets->supervisor)});
}

std::string line_of(const std::string& text, const std::string& start) {
  const auto at = text.find(start);
  return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

}  // namespace

TEST_CASE("A host process begins with nothing of the supervisor's but what it needs",
          "[supervisor][processes]") {
  const Descriptor open_here(fcntl(0, F_DUPFD, 20));  // without close-on-exec
  signal(SIGUSR1, SIG_IGN);
  sigset_t usr2;
  sigemptyset(&usr2);
  sigaddset(&usr2, SIGUSR2);
  pthread_sigmask(SIG_BLOCK, &usr2, nullptr);
  const auto process = started(start_of("describe"));
  pthread_sigmask(SIG_UNBLOCK, &usr2, nullptr);
  signal(SIGUSR1, SIG_DFL);

  const std::string text = last_words_of(*process);
  CHECK(line_of(text, "descriptors") == "descriptors 0 1 2 3");
  CHECK(line_of(text, "stdin") == "stdin /dev/null");
  CHECK(line_of(text, "Name:") == "Name:\tbase");
  CHECK(line_of(text, "SigBlk:") == "SigBlk:\t0000000000000000");
  CHECK(line_of(text, "SigIgn:") == "SigIgn:\t0000000000000007");    // SIGHUP, SIGINT, SIGQUIT
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they catch some themselves
  CHECK(line_of(text, "SigCgt:").ends_with("0000000000000000"));
#endif
  CHECK(line_of(text, "NoNewPrivs:") == "NoNewPrivs:\t1");
  const std::uint64_t powers = std::stoull("0x" + line_of(text, "CapEff:").substr(8), nullptr, 16);
  CHECK(line_of(text, "Seccomp:") == "Seccomp:\t2");
  for (const int power : {CAP_SYS_MODULE, CAP_SYS_PTRACE, CAP_SYS_BOOT, CAP_MKNOD, CAP_SYS_TIME, CAP_SETPCAP})
    CHECK((powers >> power & 1) == 0);
  CHECK(line_of(text, "group") == "group " + std::to_string(getpgrp()));
  CHECK(line_of(text, "data") == "data " + std::to_string(RLIM_INFINITY));
  CHECK(process->warnings().empty());
  CHECK_FALSE(process->exit());
}

TEST_CASE("A host process gets the descriptors of its supervisor that the start names",
          "[supervisor][processes]") {
  HostStart start = start_of("describe");
  start.kept = {STDOUT_FILENO, STDERR_FILENO};
  const auto process = started(start);
  CHECK(line_of(last_words_of(*process), "descriptors") == "descriptors 0 1 2 3 4 5");
}

TEST_CASE("A host process sees that its supervisor is gone", "[supervisor][processes]") {
  auto process = started(start_of("describe"));
  (void)last_words_of(*process);
  const pid_t pid = process->pid();
  CHECK(kill(pid, 0) == 0);
  shutdown(process->channel().descriptor(), SHUT_RDWR);
  CHECK(end_of(*process).is_normal());
  process.reset();
  CHECK(kill(pid, 0) != 0);
}

TEST_CASE("The destructor leaves no process and no descriptor", "[supervisor][processes]") {
  const std::size_t before = test::open_descriptors();
  auto process = ready("stubborn");
  const pid_t pid = process->pid();
  process.reset();
  CHECK(kill(pid, 0) != 0);
  CHECK(test::open_descriptors() == before);
}

TEST_CASE("The exit reason is what happened", "[supervisor][processes]") {
  signal(SIGCHLD, SIG_IGN);  // a parent may have set this
  CHECK(end_of(*started(start_of("exit", "0"))).is_normal());
  CHECK(end_of(*started(start_of("exit", "3"))).text() == "exited with status 3");
  CHECK(end_of(*started(start_of("signal", std::to_string(SIGABRT)))).text() == "was ended by SIGABRT");
  const ExitReason killed = end_of(*started(start_of("signal", std::to_string(SIGKILL))));
  CHECK(killed.signal == SIGKILL);
  CHECK_FALSE(killed.out_of_memory);
}

TEST_CASE("A program that cannot be executed is an error, and nothing is left of the attempt",
          "[supervisor][processes]") {
  const std::size_t before = test::open_descriptors();
  const auto process = HostProcess::start({"base", "/no/such/program", {"x"}, {}, {}, 0});
  REQUIRE_FALSE(process);
  CHECK(process.error().code == Code::not_found);
  CHECK(process.error().text() == "base: cannot run /no/such/program: No such file or directory");
  CHECK(test::open_descriptors() == before);
  CHECK(waitpid(-1, nullptr, WNOHANG) < 0);  // no child
}

TEST_CASE("What a host process prints comes as lines", "[supervisor][processes]") {
  const auto process = started(start_of("print"));
  std::vector<std::string> lines;
  while (process->output_descriptor() >= 0) {
    REQUIRE(is_readable(process->output_descriptor(), kLongWait));
    for (auto& line : process->take_output()) lines.push_back(line);
  }
  CHECK(lines == std::vector<std::string>{"one", "two\\x1b[1m", "no end"});
  CHECK(process->take_output().empty());
}

TEST_CASE("A host process never waits for somebody to read what it prints", "[supervisor][processes]") {
  const auto process = started(start_of("flood"));
  CHECK(last_words_of(*process) == "flooded");
  CHECK(end_of(*process).is_normal());
  std::size_t lines = 0;
  while (process->output_descriptor() >= 0) lines += process->take_output().size();
  CHECK(lines > 10);
  CHECK(lines < 10'000);
}

TEST_CASE("A host process that obeys ends by itself", "[supervisor][processes]") {
  const auto process = started(start_of("obey"));
  REQUIRE(process->channel().post(encode(Build{}, 1)).ok());
  CHECK(process->channel().wait_for_message(kLongWait)->request == 1);
  process->end(now(), {.when_asked = kLongWait, .when_terminated = kLongWait}, 2);
  CHECK(process->due());
  CHECK(process->channel().wait_for_message(kLongWait)->request == 2);
  CHECK(end_of(*process).is_normal());
  CHECK_FALSE(process->due());
}

TEST_CASE("A host process that does not obey is terminated, and killed at last", "[supervisor][processes]") {
  const auto [what, signal] = GENERATE(table<std::string, int>({{"sleep", SIGTERM}, {"stubborn", SIGKILL}}));
  const auto process = ready(what);
  const Moment begun = now();
  process->end(begun, {.when_asked = 50ms, .when_terminated = 100ms});
  const ExitReason end = looked_after(*process);
  CHECK(end.signal == signal);
  CHECK(end.text() == "did not end when asked to and was killed");
  CHECK(now() - begun >= (signal == SIGTERM ? 50ms : 150ms));
}

TEST_CASE("Who is in a hurry shortens the time that a host process was given to end, and cannot lengthen it",
          "[supervisor][processes]") {
  const auto process = ready("stubborn");
  const Moment begun = now();
  process->end(begun, {.when_asked = kLongWait, .when_terminated = 50ms});
  process->end(begun, {.when_asked = 50ms, .when_terminated = 50ms});
  process->end(begun, {.when_asked = kLongWait, .when_terminated = kLongWait});
  CHECK(looked_after(*process).signal == SIGKILL);
  CHECK(now() - begun >= 100ms);
}

TEST_CASE("A question that waits for an answer on the same line can be taken", "[supervisor][processes]") {
  const auto process = started(start_of("print"));
  CHECK(end_of(*process).is_normal());
  std::vector<std::string> lines;
  while (lines.size() < 2)
    for (auto& line : process->take_output()) lines.push_back(line);
  CHECK(process->take_unfinished_line() == "no end");
  CHECK(process->take_unfinished_line().empty());
}

TEST_CASE("A host process that shares the input has that of the supervisor", "[supervisor][processes]") {
  HostStart start = start_of("describe");
  start.shares_input = true;
  const auto process = started(start);
  CHECK(line_of(last_words_of(*process), "stdin") ==
        "stdin " + std::filesystem::read_symlink("/proc/self/fd/0").string());
}

TEST_CASE("A stopped host process is killed, and the reason is kept", "[supervisor][processes]") {
  const auto process = ready("sleep");
  kill(process->pid(), SIGSTOP);
  process->end_by_force(Force::hang, now(), 20ms);
  process->end_by_force(Force::memory, now() + kLongWait, 20ms);  // changes nothing any more
  CHECK(looked_after(*process).text() == "hung and was killed");
}

TEST_CASE("A host process that no order reaches is terminated at once", "[supervisor][processes]") {
  const auto process = ready("sleep");
  shutdown(process->channel().descriptor(), SHUT_RDWR);
  process->end(now(), {.when_asked = kLongWait, .when_terminated = kLongWait});
  CHECK(end_of(*process).signal == SIGTERM);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they need more memory than the limit
TEST_CASE("A host process gets its memory limit and its processors", "[supervisor][processes]") {
  HostStart start = start_of("describe");
  start.data_limit = 300'000'000;
  start.processors = {0};
  const auto process = started(start);
  const std::string text = last_words_of(*process);
  CHECK(line_of(text, "data") == "data 300000000");
  CHECK(line_of(text, "Cpus_allowed_list") == "Cpus_allowed_list:\t0");
  CHECK(process->memory().value_or(0) > 0);
  CHECK(process->memory().value_or(0) < 300'000'000);

  start = start_of("eat");
  start.data_limit = 300'000'000;
  CHECK(end_of(*started(start)).status == 3);
}
#endif

TEST_CASE("What the system refuses is a warning, and the process starts", "[supervisor][processes]") {
  HostStart start = start_of("describe");
  start.processors = {1000};  // there is none
  start.priority = 100;       // beyond the highest
  const auto process = started(start);
  CHECK(line_of(last_words_of(*process), "policy") == "policy " + std::to_string(SCHED_OTHER));
  CHECK(process->warnings() ==
        std::vector<std::string>{"the processors are not those of the graph: Invalid argument",
                                 "the priority is not that of the graph: Invalid argument"});
}

TEST_CASE("A host process gets its priority, or a warning says why not", "[supervisor][processes]") {
  HostStart start = start_of("describe");
  start.priority = 1;
  const auto process = started(start);
  const std::string policy = line_of(last_words_of(*process), "policy");
  if (process->warnings().empty()) {
    CHECK(policy == "policy " + std::to_string(SCHED_FIFO));
  } else {
    CHECK(process->warnings()[0] == "the priority is not that of the graph: Operation not permitted");
  }
}

TEST_CASE("of a process that another one has started only the end is known", "[supervisor][processes]") {
  const auto process = adopted(make_stranger());
  CHECK_FALSE(process->exit());
  CHECK(process->memory());
  const bool says = GENERATE(true, false);
  if (says) process->note_leaving();
  kill(process->pid(), SIGKILL);
  const ExitReason reason = end_of(*process);
  CHECK(reason.is_guess);
  CHECK(reason.is_normal() == says);
}

TEST_CASE("an adopted process is ended by force as any other", "[supervisor][processes]") {
  const auto process = adopted(make_stranger());
  process->end_by_force(Force::hang, now(), 10s);
  const ExitReason reason = end_of(*process);
  CHECK(reason.force == Force::hang);
  CHECK(reason.is_guess);
}

TEST_CASE("an adopted process does not outlive its object", "[supervisor][processes]") {
  Stranger stranger = make_stranger();
  const Descriptor end(fcntl(stranger.pidfd.number(), F_DUPFD_CLOEXEC, 0));
  adopted(std::move(stranger)).reset();
  CHECK(is_readable(end.number(), 0ms));
}
