// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "companion.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "orca/base/files/own_folder.hpp"
#include "orca/base/log.hpp"

namespace orca::deployer {
namespace {

constexpr int kPatienceMs = 10'000;            // until the first line
constexpr std::chrono::milliseconds kLook{5};  // between two looks whether it has ended
constexpr std::chrono::seconds kEndLimit{5};   // then it is killed
constexpr std::chrono::seconds kProof{2};      // a recorder that runs for so long is well
constexpr std::chrono::seconds kFirstPatience{1};
constexpr std::chrono::seconds kLongestPatience{60};

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

std::optional<std::string> Companion::end_by_itself() {
  int status = 0;
  if (process_ != 0 && waitpid(process_, &status, WNOHANG) == process_) {
    process_ = 0;
    status_ = status;
  }
  if (!status_) return std::nullopt;
  if (WIFSIGNALED(*status_)) return "signal " + std::to_string(WTERMSIG(*status_));
  return "exit status " + std::to_string(WEXITSTATUS(*status_));
}

bool Companion::end() {
  const pid_t process = std::exchange(process_, 0);
  if (process == 0) return !status_;
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

Status Recorders::start(const graph::Graph& graph, const std::string& machine,
                        const std::vector<host::RecordingOptions>& recordings) {
  for (const host::RecordingOptions& recording : recordings) {
    if (!host::is_bag_file(recording.file)) continue;
    if (std::filesystem::exists(recording.file))
      return fail(Code::already_exists,
                  "there is something of this name already, and recordings overwrite nothing; "
                  "choose another name",
                  recording.file);
    std::vector<std::string> words{"--system", graph.name, "record", recording.file};
    words.insert(words.end(), recording.ports.begin(), recording.ports.end());
    words.insert(words.end(), {"--wait", "30s"});
    running_.push_back({recording.file, std::move(words), false});
  }
  if (graph.records_always) keep_always(graph, graph.name + (machine.empty() ? "" : "@" + machine));
  for (Recorder& recorder : running_)
    if (Status started = start(recorder); !started.ok()) return started;
  return ok();
}

// A system runs without what it keeps, too.
void Recorders::keep_always(const graph::Graph& graph, const std::string& name) {
  const Result<OwnFolder> state = OwnFolder::make_for_state();
  if (!state) {
    unkept_ = "nothing is recorded, because there is no place for it: " + state.error().message;
    return;
  }
  const std::string folder = state->path() + "/recordings/" + name;
  running_.push_back({folder,
                      {"--system", graph.name, "record", folder, "--ring",
                       std::to_string(graph.record_space) + " B", "--wait", "30s"},
                      true});
  log::info("deployer", "what happens is kept in " + folder);
}

Status Recorders::start(Recorder& recorder) {
  recorder.begun = std::chrono::steady_clock::now();
  Result<Companion> companion = Companion::start("orcactl", recorder.words, false);
  if (!companion) return companion.error();
  recorder.companion.emplace(std::move(companion).value());
  return ok();
}

std::map<std::string, std::string> Recorders::look() {
  std::map<std::string, std::string> wrong;
  if (!unkept_.empty()) wrong["always"] = unkept_;
  for (Recorder& recorder : running_) {
    look_at(recorder);
    if (!recorder.fault.empty()) wrong[recorder.target] = recorder.fault;
  }
  return wrong;
}

void Recorders::look_at(Recorder& recorder) {
  const auto now = std::chrono::steady_clock::now();
  const std::optional<std::string> end =
      recorder.companion ? recorder.companion->end_by_itself() : std::optional<std::string>("not started");
  if (!end) {
    if (now - recorder.begun < kProof) return;
    recorder.fault.clear();
    if (now - recorder.begun >= kLongestPatience) recorder.patience = kFirstPatience;
    return;
  }
  if (!recorder.ended) recorder.ended = now;
  recorder.fault = "nothing is recorded into " + recorder.target +
                   " any more, since its recorder has ended (" + *end + "); " +
                   (recorder.is_renewed ? "it is started again; its own words are on stderr"
                                        : "what it wrote is whole; go on with: orcactl record OTHER.mcap");
  if (!recorder.is_renewed || now - *recorder.ended < recorder.patience) return;
  recorder.ended.reset();
  recorder.patience = std::min(2 * recorder.patience, kLongestPatience);
  recorder.companion.reset();
  (void)start(recorder);  // the next look sees whether it runs
}

// A system that did not start has no recording, so its recorder waits in vain.
Status Recorders::finish() {
  Status outcome = ok();
  for (Recorder& recorder : running_) {
    const bool is_complete = recorder.companion && recorder.companion->end();
    if (!is_complete && !recorder.is_renewed)
      outcome = fail(Code::data_loss, "the recording is not complete", recorder.target);
  }
  return outcome;
}

}  // namespace orca::deployer
