// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/last_words.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <string_view>

#include "containment/descriptors.hpp"
#include "containment/environment.hpp"
#include "orca/base/activity.hpp"
#include "orca/base/exception_text.hpp"
#include "orca/base/exhaustion.hpp"
#include "orca/base/live_line.hpp"
#include "orca/host/stop_signal.hpp"
#include "orca/plugin/code_limit.hpp"
#include "orca/plugin/loaded_plugins.hpp"

namespace orca::host {
namespace {

constexpr std::array kSignals{SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGSYS, SIGTRAP};
constexpr std::uintptr_t kNearStack = 64 * 1024;
constexpr long kHungLimitNs = 200'000'000;
constexpr Duration kCodeLimit = 10s;

std::atomic<bool> g_armed{false};
std::atomic<bool> g_said{false};
std::atomic<bool> g_dying{false};
int g_stderr = STDERR_FILENO;
int g_status = EXIT_FAILURE;
int g_exhausted_status = EXIT_FAILURE;
std::array<struct sigaction, kSignals.size()> g_before;
std::terminate_handler g_terminate_before = nullptr;

// A line of text, built without anything that a signal handler must not use.
class Line {
 public:
  Line& operator<<(std::string_view text) {
    const std::size_t count = std::min(text.size(), text_.size() - size_);
    std::copy_n(text.begin(), count, text_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += count;
    return *this;
  }
  Line& operator<<(std::uintptr_t number) {
    std::array<char, 16> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, 16).ptr;
    return *this << "0x" << std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
  }
  void write() {
    *this << "\n";
    LiveLine::erase_for_good();
    // If it fails, there is nothing left to do about it.
    [[maybe_unused]] const ssize_t written = ::write(g_stderr, text_.data(), size_);
  }

 private:
  std::array<char, 2048> text_;
  std::size_t size_ = 0;
};

// Fast DDS does not name its threads, so they have the name of the one that has made them (patterns/dds/backend).
bool is_of_network() {
  std::array<char, 16> name{};
  return prctl(PR_GET_NAME, name.data()) == 0 && std::string_view(name.data()).starts_with("dds");
}

// Adds "error: avoid: work() ".
void start_line(Line& line, const Activity* activity) {
  line << "error: ";
  if (activity == nullptr) {
    line << (is_of_network() ? kNetworkCode : "a thread that runs no component ");
  } else {
    line << activity->who() << ": ";
    if (activity->hook() == Hook::handler) {
      line << activity->port() << "() ";
    } else {
      line << to_string(activity->hook()) << " ";
    }
  }
}

// Adds "; the plugin is avoid.so".
void add_plugin(Line& line, const Activity* activity, const void* code) {
  const char* plugin = plugin::plugin_at(code);
  if (plugin == nullptr && activity != nullptr) plugin = plugin::plugin_at(activity->code());
  if (plugin != nullptr) line << "; the plugin is " << plugin;
}

#if defined(__x86_64__)
const void* code_at(const ucontext_t& c) {
  return reinterpret_cast<const void*>(c.uc_mcontext.gregs[REG_RIP]);
}
std::uintptr_t stack_at(const ucontext_t& c) {
  return static_cast<std::uintptr_t>(c.uc_mcontext.gregs[REG_RSP]);
}
#else
const void* code_at(const ucontext_t& c) { return reinterpret_cast<const void*>(c.uc_mcontext.pc); }
std::uintptr_t stack_at(const ucontext_t& c) { return c.uc_mcontext.sp; }
#endif

void add_cause(Line& line, int signal, const siginfo_t& info, const ucontext_t& context) {
  const auto address = reinterpret_cast<std::uintptr_t>(info.si_addr);
  const std::uintptr_t stack = stack_at(context);
  line << "SIG" << sigabbrev_np(signal);
  if (info.si_code <= 0) {
    line << (signal == SIGABRT ? " (it called abort(), or the C++ library did)" : " (somebody sent it)");
  } else if (signal == SIGFPE) {
    line << " (it divided an integer by zero, or the like)";
  } else if ((signal == SIGSEGV || signal == SIGBUS) && address - stack + kNearStack < 2 * kNearStack) {
    line << " (its stack has overflowed)";
  } else if (signal == SIGSEGV || signal == SIGBUS) {
    line << " (it used memory that is not there, at " << address << ")";
  }
}

// Returns whether the system gives no more memory. Libraries of C crash without it, and C++ cannot even throw.
bool lacks_memory() {
  constexpr std::size_t kLittle = 1024 * 1024;
  void* const memory = mmap(nullptr, kLittle, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return true;
  munmap(memory, kLittle);
  return false;
}

// The component that asked last is named; that another one has taken all is possible.
[[noreturn]] void end_exhausted(const char* text) {
  Line line;
  line << "error: " << text;
  if (const Activity* const activity = Activity::current())
    line << "; " << activity->who() << " asked for it in " << to_string(activity->hook());
  if (!g_said.exchange(true)) line.write();
  StopSignal::stop_motors();
  _exit(g_exhausted_status);
}

void on_signal(int signal, siginfo_t* info, void* context) {
  if (lacks_memory()) end_exhausted(kNoMemoryText);
  g_dying.store(true);  // before the handler changes, which others would report
  const auto place =
      static_cast<std::size_t>(std::find(kSignals.begin(), kSignals.end(), signal) - kSignals.begin());
  sigaction(signal, &g_before[place], nullptr);
  if (!g_said.exchange(true)) {
    const auto& where = *static_cast<const ucontext_t*>(context);
    const Activity* const activity = Activity::current();
    Line line;
    start_line(line, activity);
    line << "ended the process with the signal ";
    add_cause(line, signal, *info, where);
    add_plugin(line, activity, code_at(where));
    line.write();
  }
  StopSignal::stop_motors();
  // A fault happens again on return and meets the old action. A signal that was sent must be sent again.
  if (info->si_code <= 0) raise(signal);
}

// What is said of a thread that hangs: at the limit of a plugin::CodeLimit, or by end_hung(). Only its own signal reads it.
const char* g_hung_said = "has not returned within 10 s; the process is ended without it";
int g_hung_status = EXIT_FAILURE;

// Runs on the thread that hangs, because only that thread knows what it is doing.
void on_hung(int /*signal*/, siginfo_t* info, void* context) {
  if (info->si_code == SI_TIMER && !static_cast<plugin::CodeLimit*>(info->si_value.sival_ptr)->is_over())
    return;
  const Activity* const activity = Activity::current();
  Line line;
  if (activity != nullptr) {
    start_line(line, activity);
  } else {
    line << "error: the main thread ";
  }
  line << g_hung_said;
  add_plugin(line, activity, code_at(*static_cast<const ucontext_t*>(context)));
  line.write();
  _exit(g_hung_status);
}

void on_terminate() {
  if (const char* const text = exhaustion_text(std::current_exception())) end_exhausted(text);
  if (lacks_memory()) end_exhausted(kNoMemoryText);
  Line line;
  const Activity* const activity = Activity::current();
  start_line(line, activity);
  if (std::current_exception() != nullptr) {
    std::string text;
    try {
      throw;
    } catch (...) {
      text = describe_current_exception();
    }
    line << text << " where nothing can catch it (noexcept, a destructor, a thread of its own)";
  } else {
    line << "called std::terminate()";
  }
  add_plugin(line, activity, nullptr);
  if (!g_said.exchange(true)) line.write();
  std::abort();
}

// Ends the process on exit() while plugins run: a normal exit would destroy what the other components
// still use.
void end_instead_of_exit(std::string_view call) {
  if (!g_armed.load()) return;
  const Activity* const activity = Activity::current();
  Line line;
  start_line(line, activity);
  line << "called " << call << "; a plugin must not end the process";
  add_plugin(line, activity, nullptr);
  line.write();
  StopSignal::stop_motors();
  std::fflush(nullptr);
  _exit(g_status);
}

void on_exit_called(int status, void* /*unused*/) {
  end_instead_of_exit("exit(" + std::to_string(status) + ")");
}
void on_quick_exit() { end_instead_of_exit("quick_exit()"); }

using Fork = Environment::Fork;

void before_fork() { Environment::of_process().at_fork(Fork::begins, nullptr); }
void after_fork_here() {
  Environment::of_process().at_fork(Fork::is_over, g_armed.load() ? Activity::current() : nullptr);
}
void after_fork_in_copy() {
  Environment::of_process().at_fork(Fork::is_over_in_copy, nullptr);
  if (g_armed.exchange(false) && Activity::current() != nullptr)
    _exit(1);  // otherwise it is a copy made by Orca itself
}

void handle_hung() {
  struct sigaction action {};
  action.sa_sigaction = on_hung;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  sigaction(SIGRTMAX, &action, nullptr);
}

void register_once() {
  static const bool registered = [] {
    LastWords::catch_exit();
    std::at_quick_exit(on_quick_exit);
    pthread_atfork(before_fork, after_fork_here, after_fork_in_copy);
    return true;
  }();
  (void)registered;
}

// The stack of a thread for signal handlers, unless the thread has one already, as under AddressSanitizer.
// A thread_local object would need memory for its destructor, and the system ends a process that has none left.
constexpr std::size_t kSignalStack = 64 * 1024;

void free_signal_stack(void* memory) {
  const stack_t none{nullptr, SS_DISABLE, 0};
  sigaltstack(&none, nullptr);
  munmap(memory, kSignalStack);
}

pthread_key_t signal_stack_key() {
  static const pthread_key_t key = [] {
    pthread_key_t made{};
    pthread_key_create(&made, free_signal_stack);
    return made;
  }();
  return key;
}

void make_signal_stack() {
  stack_t present{};
  if (sigaltstack(nullptr, &present) != 0 || (present.ss_flags & SS_DISABLE) == 0) return;
  void* const memory =
      mmap(nullptr, kSignalStack, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return;
  const stack_t mine{memory, 0, kSignalStack};
  sigaltstack(&mine, nullptr);
  pthread_setspecific(signal_stack_key(), memory);
}

}  // namespace

LastWords::LastWords(int exit_status, int exhausted_status) {
  g_status = exit_status;
  g_exhausted_status = exhausted_status;
  const int copy = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, kFirstCopy);
  if (copy >= 0) g_stderr = copy;
  register_once();
  prepare_thread();
  struct sigaction action {};
  action.sa_sigaction = on_signal;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &action, &g_before[i]);
  handle_hung();
  g_hung_status = exit_status;
  plugin::CodeLimit::enforce(SIGRTMAX, kCodeLimit);
  g_terminate_before = std::set_terminate(on_terminate);
  g_armed.store(true);
}

LastWords::~LastWords() {
  g_armed.store(false);
  std::set_terminate(g_terminate_before);
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &g_before[i], nullptr);
  if (g_stderr != STDERR_FILENO) close(g_stderr);
  g_stderr = STDERR_FILENO;
}

bool LastWords::is_dying() noexcept { return g_dying.load(); }

std::terminate_handler LastWords::terminate_handler() noexcept {
  return g_armed.load() ? on_terminate : std::get_terminate();
}

void LastWords::leave_copy() noexcept { g_armed.store(false); }

// exit() calls first what was registered last, and in between it destroys static variables, which the other threads
// still use.
void LastWords::catch_exit() { on_exit(on_exit_called, nullptr); }

void LastWords::prepare_thread() {
  if (pthread_getspecific(signal_stack_key()) == nullptr) make_signal_stack();
}

void LastWords::say_and_end(const std::string& line) {
  Line words;
  words << line;
  words.write();
  StopSignal::stop_motors();
  std::fflush(nullptr);
  _exit(g_status);
}

void LastWords::end_hung(pthread_t thread, const char* said, int exit_status) {
  g_hung_said = said;
  g_hung_status = exit_status;
  handle_hung();
  pthread_kill(thread, SIGRTMAX);
  const timespec moment{0, kHungLimitNs};
  nanosleep(&moment, nullptr);
  // It has blocked the signal.
  Line line;
  line << "error: the main thread " << said;
  line.write();
  _exit(exit_status);
}

}  // namespace orca::host
