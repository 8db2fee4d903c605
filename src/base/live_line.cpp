// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/live_line.hpp"

#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <mutex>
#include <string>
#include <utility>

namespace orca {
namespace {

constexpr std::string_view kErase = "\r\x1b[K";
constexpr std::string_view kEraseRest = "\x1b[K";

struct State {
  std::mutex mutex;
  int pauses = 0;
  std::function<void(bool begins)> pause_changed;
};

// Never destroyed: threads may write while the process ends.
State& state() {
  static State* const instance = new State;
  return *instance;
}

// Read and changed in signal handlers, too.
std::atomic<int> g_shown_on{-1};  // the terminal on which the line is now; -1: nowhere
std::atomic<bool> g_over{false};

bool takes_output(int terminal) {
  pollfd output{terminal, POLLOUT, 0};
  return poll(&output, 1, 0) == 1 && (output.revents & POLLOUT) != 0;
}

void write_to(int terminal, std::string_view text) noexcept {
  // If it fails, the next line may get through.
  [[maybe_unused]] const ssize_t written = write(terminal, text.data(), text.size());
}

void erase_shown() noexcept {
  if (const int terminal = g_shown_on.exchange(-1); terminal >= 0) write_to(terminal, kErase);
}

}  // namespace

LiveLine::Pause::Pause() {
  const std::lock_guard lock(state().mutex);
  if (++state().pauses == 1 && state().pause_changed) state().pause_changed(true);
  erase_shown();
}

LiveLine::Pause::~Pause() {
  const std::lock_guard lock(state().mutex);
  if (--state().pauses == 0 && state().pause_changed) state().pause_changed(false);
}

void LiveLine::on_pause(std::function<void(bool begins)> changed) {
  const std::lock_guard lock(state().mutex);
  state().pause_changed = std::move(changed);
}

void LiveLine::show(int terminal, std::string_view text) {
  const std::lock_guard lock(state().mutex);
  if (state().pauses > 0 || g_over.load() || !takes_output(terminal)) return;
  g_shown_on.store(terminal);
  write_to(terminal, "\r" + std::string(text) + std::string(kEraseRest));
  if (g_over.load()) erase_shown();  // the end may have come in between
}

void LiveLine::erase() {
  const std::lock_guard lock(state().mutex);
  erase_shown();
}

void LiveLine::erase_for_good() noexcept {
  const int kept = errno;
  g_over.store(true);
  erase_shown();
  errno = kept;
}

}  // namespace orca
