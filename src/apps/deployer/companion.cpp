// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "companion.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "orca/base/log.hpp"

namespace orca::deployer {
namespace {

constexpr int kPatienceMs = 10'000;            // until the first line
constexpr std::chrono::milliseconds kLook{5};  // between two looks whether it has ended
constexpr std::chrono::seconds kEndLimit{5};   // then it is killed

// Returns the words as execv() wants them.
std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

// The child: only system calls.
[[noreturn]] void become(const char* program, char* const* words, int output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);  // it was killed before
  for (int number = 1; number < NSIG; ++number) signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  setpgid(0, 0);  // Ctrl-C in the terminal ends the system, which ends this in the end
  if (output >= 0) dup2(output, STDOUT_FILENO);
  execv(program, words);
  _exit(1);
}

}  // namespace

Result<Companion> Companion::start(const std::string& name, const std::vector<std::string>& words,
                                   bool tells) {
  const std::string program = (std::filesystem::read_symlink("/proc/self/exe").parent_path() / name).string();
  std::vector<std::string> all{name};
  all.insert(all.end(), words.begin(), words.end());
  const std::vector<char*> pointers = pointers_to(all);
  Descriptor input;
  Descriptor output;
  if (int ends[2]; tells) {
    if (pipe2(ends, O_CLOEXEC) != 0) return fail(Code::unavailable, "there is no pipe for it", name);
    input = Descriptor(ends[0]);
    output = Descriptor(ends[1]);
  }
  const pid_t self = getpid();
  const pid_t process = fork();
  if (process == 0) become(program.c_str(), pointers.data(), output ? output.number() : -1, self);
  if (process < 0) return fail(Code::unavailable, "it cannot be started", name);
  return Companion(process, std::move(input));
}

std::string Companion::first_line() const {
  std::string line;
  for (pollfd waits{output_.number(), POLLIN, 0}; poll(&waits, 1, kPatienceMs) == 1;) {
    char letter = '\0';
    if (read(output_.number(), &letter, 1) != 1 || letter == '\n') return line;
    line += letter;
  }
  return {};
}

bool Companion::end() {
  const pid_t process = std::exchange(process_, 0);
  if (process == 0) return true;
  kill(process, SIGTERM);
  const auto limit = std::chrono::steady_clock::now() + kEndLimit;
  int status = -1;
  while (waitpid(process, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() >= limit) kill(process, SIGKILL);
    std::this_thread::sleep_for(kLook);
  }
  return status != -1 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::optional<Companion> start_viewer(const std::string& system) {
  Result<Companion> viewer = Companion::start("orcaview", {system}, true);
  const std::string address = viewer ? viewer->first_line() : "";
  if (address.empty()) {
    log::warning("deployer", "--view: there is no page" + (viewer ? "" : ": " + viewer.error().text()));
    return std::nullopt;
  }
  std::fprintf(stderr, "look at it in a browser: %s\n", address.c_str());
  return std::move(viewer).value();
}

Status Recorders::start(const std::string& system, const std::vector<host::RecordingOptions>& recordings) {
  for (const host::RecordingOptions& recording : recordings) {
    if (!host::is_bag_file(recording.file)) continue;
    if (std::filesystem::exists(recording.file))
      return fail(Code::already_exists,
                  "there is something of this name already, and recordings overwrite nothing; "
                  "choose another name",
                  recording.file);
    std::vector<std::string> words{"--system", system, "record", recording.file};
    words.insert(words.end(), recording.ports.begin(), recording.ports.end());
    words.insert(words.end(), {"--wait", "30s"});
    Result<Companion> recorder = Companion::start("orcactl", words, false);
    if (!recorder) return recorder.error();
    running_.emplace_back(std::move(recorder).value(), recording.file);
  }
  return ok();
}

// A system that did not start has no recording, so its recorder waits in vain.
Status Recorders::finish() {
  Status outcome = ok();
  for (auto& [recorder, file] : running_)
    if (!recorder.end()) outcome = fail(Code::data_loss, "the recording is not complete", file);
  return outcome;
}

}  // namespace orca::deployer
