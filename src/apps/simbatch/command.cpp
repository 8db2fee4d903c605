// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "command.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "orca/base/text.hpp"

extern char** environ;

namespace orca::simbatch {
namespace {

std::string read_to_end(int from) {
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t n = 0; (n = ::read(from, part.data(), part.size())) > 0 || (n < 0 && errno == EINTR);)
    if (n > 0) text.append(part.data(), static_cast<std::size_t>(n));
  return text;
}

int status_of(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  return status;
}

// Starts the program with its stdout in a pipe. Returns 0, or the error's number.
int start(const std::vector<std::string>& words, int to, pid_t& process) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, to, STDOUT_FILENO);
  const int error = posix_spawnp(&process, arguments.front(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

Result<std::string> output_of(const std::vector<std::string>& words) {
  std::array<int, 2> pipe{};
  if (pipe2(pipe.data(), O_CLOEXEC) != 0) return fail(Code::unavailable, std::strerror(errno));
  pid_t process = -1;
  const int error = start(words, pipe[1], process);
  close(pipe[1]);
  const std::string text = error == 0 ? read_to_end(pipe[0]) : "";
  close(pipe[0]);
  if (error != 0)
    return fail(Code::not_found, "cannot start " + in_quotes(words.front()) + ": " + std::strerror(error));
  const int status = status_of(process);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return text;
  return fail(Code::failed_precondition, in_quotes(words.front()) + " has failed");
}

}  // namespace orca::simbatch
