// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "companions.hpp"

#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "orca/base/descriptor.hpp"
#include "orca/base/files/own_folder.hpp"
#include "orca/base/log.hpp"

namespace orca::deployer {
namespace {

using apps::ChildProgram;

constexpr std::chrono::seconds kProof{2};  // a recorder that runs for so long is well
constexpr std::chrono::seconds kFirstPatience{1};
constexpr std::chrono::seconds kLongestPatience{60};

}  // namespace

std::optional<ChildProgram> start_viewer(const std::string& system) {
  Result<ChildProgram> viewer =
      ChildProgram::start({"orcaview", system}, ChildProgram::Reads::standard_output);
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
    std::vector<std::string> words{"orcactl", "--system", graph.name, "record", recording.file};
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
                      {"orcactl", "--system", graph.name, "record", folder, "--ring",
                       std::to_string(graph.record_space) + " B", "--wait", "30s"},
                      true});
  log::info("deployer", "what happens is kept in " + folder);
}

Status Recorders::start(Recorder& recorder) {
  recorder.begun = std::chrono::steady_clock::now();
  Result<ChildProgram> program = ChildProgram::start(recorder.words, ChildProgram::Reads::nothing);
  if (!program) return program.error();
  recorder.program.emplace(std::move(program).value());
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
  const std::optional<int> end = recorder.program ? recorder.program->ended() : std::nullopt;
  if (recorder.program && !end) {
    if (now - recorder.begun < kProof) return;
    recorder.fault.clear();
    if (now - recorder.begun >= kLongestPatience) recorder.patience = kFirstPatience;
    return;
  }
  if (!recorder.ended) recorder.ended = now;
  recorder.fault = "nothing is recorded into " + recorder.target +
                   " any more, since its recorder has ended (" +
                   (end ? apps::ending_text(*end) : "not started") + "); " +
                   (recorder.is_renewed ? "it is started again; its own words are on stderr"
                                        : "what it wrote is whole; go on with: orcactl record OTHER.mcap");
  if (!recorder.is_renewed || now - *recorder.ended < recorder.patience) return;
  recorder.ended.reset();
  recorder.patience = std::min(2 * recorder.patience, kLongestPatience);
  recorder.program.reset();
  (void)start(recorder);  // the next look sees whether it runs
}

// A system that did not start has no recording, so its recorder waits in vain.
Status Recorders::finish() {
  Status outcome = ok();
  for (Recorder& recorder : running_) {
    const bool is_complete = recorder.program && !recorder.ended && recorder.program->end() == 0;
    if (!is_complete && !recorder.is_renewed)
      outcome = fail(Code::data_loss, "the recording is not complete", recorder.target);
  }
  return outcome;
}

void notify_service(const std::string& notice) {
  const char* const place = std::getenv("NOTIFY_SOCKET");
  sockaddr_un name{};
  const std::string path = place == nullptr ? "" : place;
  if (path.empty() || path.size() >= sizeof name.sun_path) return;
  name.sun_family = AF_UNIX;
  path.copy(name.sun_path, path.size());
  if (path.front() == '@') name.sun_path[0] = '\0';  // an address that is no file
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + path.size());
  const Descriptor socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  (void)::sendto(socket.number(), notice.data(), notice.size(), MSG_NOSIGNAL,
                 reinterpret_cast<const sockaddr*>(&name), length);
}

}  // namespace orca::deployer
