// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "batch/child.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

namespace orca::view {
namespace {

constexpr int kEndTicks = 500;
constexpr std::chrono::milliseconds kEndTick{10};

namespace asio = boost::asio;

// Returns the present environment, in which programs are looked for beside this one first.
std::vector<std::string> environment() {
  const std::string own = std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
  const char* const path = std::getenv("PATH");
  std::vector<std::string> all{"PATH=" + own + (path == nullptr ? "" : ":" + std::string(path))};
  for (char** one = environ; *one != nullptr; ++one)
    if (!std::string(*one).starts_with("PATH=")) all.emplace_back(*one);
  return all;
}

// Returns texts as execvpe() wants them.
std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// The child: only system calls.
[[noreturn]] void become(const char* folder, char* const* words, char* const* variables, int output,
                         pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);  // it was killed before
  for (int number = 1; number < NSIG; ++number) signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  setpgid(0, 0);  // Ctrl-C in the terminal ends the parent, which ends this
  const int null = open("/dev/null", O_RDONLY);
  dup2(null, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  environ = const_cast<char**>(variables);
  if (chdir(folder) == 0) execvp(words[0], words);
  _exit(127);
}

}  // namespace

Result<std::unique_ptr<Child>> Child::start(const asio::any_io_executor& loop,
                                            const std::vector<std::string>& words,
                                            const std::string& folder) {
  std::vector<std::string> all = words;
  std::vector<std::string> variables = environment();
  const std::vector<char*> word_pointers = pointers_to(all);
  const std::vector<char*> variable_pointers = pointers_to(variables);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return fail(Code::unavailable, "there is no pipe for it", words.front());
  const pid_t self = getpid();
  const pid_t process = fork();
  if (process == 0) become(folder.c_str(), word_pointers.data(), variable_pointers.data(), ends[1], self);
  ::close(ends[1]);
  if (process < 0) ::close(ends[0]);
  if (process < 0) return fail(Code::unavailable, "it cannot be started", words.front());
  return std::unique_ptr<Child>(new Child(loop, process, ends[0]));
}

Child::Child(const asio::any_io_executor& loop, pid_t process, int output)
    : process_(process), output_(loop, output) {}

Child::~Child() {
  if (is_over_) return;
  kill(process_, SIGTERM);
  // The pages stand meanwhile, so that not for longer than a deployer takes to end.
  for (int i = 0; i < kEndTicks; ++i) {
    if (waitpid(process_, nullptr, WNOHANG) != 0) return;
    std::this_thread::sleep_for(kEndTick);
  }
  kill(process_, SIGKILL);
  wait();
}

asio::awaitable<std::string> Child::read_some() {
  std::array<char, 4096> buffer;
  boost::system::error_code error;
  const std::size_t size = co_await output_.async_read_some(asio::buffer(buffer),
                                                            asio::redirect_error(asio::use_awaitable, error));
  co_return error ? std::string() : std::string(buffer.data(), size);
}

int Child::wait() {
  int status = 0;
  boost::system::error_code ignored;
  (void)output_.close(ignored);  // It may wait for somebody to read what it says.
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  is_over_ = true;
  constexpr int kSignalled = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
}

}  // namespace orca::view
