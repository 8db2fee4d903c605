// SPDX-License-Identifier: GPL-3.0-or-later
#include "subprocess.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "temp_folder.hpp"

namespace orca::test {
namespace {

using Clock = std::chrono::steady_clock;

int checked(int result, const char* what) {
  if (result < 0) throw std::runtime_error(std::string(what) + ": " + std::strerror(errno));
  return result;
}

Seconds seconds(const timeval& time) {
  return Seconds(static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec));
}

Ending ending_from(int status, const rusage& usage, Clock::duration wall) {
  Ending ending;
  if (WIFEXITED(status)) ending.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ending.signal = WTERMSIG(status);
  ending.wall = wall;
  ending.cpu = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  ending.peak = static_cast<double>(usage.ru_maxrss) / 1024.0;
  return ending;
}

// Gives the programs a folder for their sockets and their recordings that no other test program has. Systems of one name would refuse to run
// beside each other.
void prepare_runtime_folder() {
  static const TempFolder folder;
  static const int set = setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1) |
                         setenv("XDG_STATE_HOME", (folder.path() / "state").c_str(), 1);
  checked(set, "setenv");
}

}  // namespace

// Output goes to memory files, not to pipes: a program that writes a lot never waits for the test to read.
Subprocess::Subprocess(const std::vector<std::string>& command, const Options& options)
    : out_fd_(checked(memfd_create("stdout", MFD_CLOEXEC), "memfd_create")),
      err_fd_(checked(memfd_create("stderr", MFD_CLOEXEC), "memfd_create")),
      start_(Clock::now()) {
  prepare_runtime_folder();
  std::array<int, 2> input{};
  checked(pipe2(input.data(), O_CLOEXEC), "pipe2");
  // A signal that is sent at once must not reach the test program's own handlers in the child. It is blocked
  // until just before exec.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  pid_ = checked(fork(), "fork");
  if (pid_ == 0) {
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    become(command, options.folder, input[0]);
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  // Both sides set the group, so that it exists whichever comes first. The child may have called exec by now.
  if (setpgid(pid_, pid_) != 0 && errno != EACCES) throw std::runtime_error("setpgid");
  close(input[0]);
  input_fd_ = input[1];
  // glibc 2.36 declares pidfd_open() for C only.
  exit_fd_ = checked(static_cast<int>(syscall(SYS_pidfd_open, pid_, 0)), "pidfd_open");
  write_input(options.input);
  if (!options.keep_input_open) close_input();
}

// Runs in the child, between fork and exec.
void Subprocess::become(const std::vector<std::string>& command, const std::string& folder, int input) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  dup2(input, STDIN_FILENO);
  dup2(out_fd_, STDOUT_FILENO);
  dup2(err_fd_, STDERR_FILENO);
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  if (folder.empty() || chdir(folder.c_str()) == 0) execv(words[0], words.data());
  dprintf(STDERR_FILENO, "cannot start %s: %s\n", words[0], std::strerror(errno));
  _exit(127);
}

Subprocess::~Subprocess() {
  send_to_group(SIGKILL);
  if (!ending_) waitpid(pid_, nullptr, 0);
  close_input();
  for (const int fd : {exit_fd_, out_fd_, err_fd_}) close(fd);
}

std::optional<Ending> Subprocess::wait(Seconds limit) {
  if (ending_) return ending_;
  pollfd ended{exit_fd_, POLLIN, 0};
  const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(limit).count();
  if (checked(poll(&ended, 1, static_cast<int>(milliseconds)), "poll") == 0) return std::nullopt;
  const Clock::duration wall = Clock::now() - start_;
  int status = 0;
  rusage usage{};
  checked(wait4(pid_, &status, 0, &usage), "wait4");
  ending_ = ending_from(status, usage, wall);
  return ending_;
}

bool Subprocess::wait_for_output(const std::string& text, Seconds limit) {
  const Clock::time_point deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
  while (Clock::now() < deadline) {
    const bool ended = wait(Seconds(0)).has_value();
    if (out().find(text) != std::string::npos || err().find(text) != std::string::npos) return true;
    if (ended) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

void Subprocess::send(int signal) const {
  if (!ending_) kill(pid_, signal);
}

void Subprocess::send_to_group(int signal) const { kill(-pid_, signal); }

void Subprocess::write_input(const std::string& text) const {
  if (!text.empty()) checked(static_cast<int>(write(input_fd_, text.data(), text.size())), "write");
}

void Subprocess::close_input() {
  if (input_fd_ >= 0) close(input_fd_);
  input_fd_ = -1;
}

bool Subprocess::group_lives() const { return kill(-pid_, 0) == 0; }

std::string Subprocess::captured(int fd) {
  std::string text;
  std::array<char, 16384> part{};
  ssize_t size = 0;
  while ((size = pread(fd, part.data(), part.size(), static_cast<off_t>(text.size()))) > 0)
    text.append(part.data(), static_cast<std::size_t>(size));
  return text;
}

}  // namespace orca::test
