// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <vector>

#include "figures.hpp"
#include "orca/base/live_line.hpp"
#include "orca/base/text.hpp"

namespace orca::deployer {
namespace {

constexpr auto kPeriod = std::chrono::milliseconds(200);
constexpr std::size_t kMostNames = 5;
constexpr std::size_t kMostBytes = 300;  // of one part of the line

std::string unwell_text(const host::RunGlance& glance) {
  std::vector<std::string> names;
  for (const auto& [name, state] : glance.unwell) names.push_back(name + " " + state);
  if (!names.empty()) return listed(names, kMostNames);
  return glance.working == 0 ? "no component works" : "";
}

std::string goals_text(const host::RunGlance& glance) {
  std::vector<std::string> goals;
  for (const auto& [name, distance] : glance.goals)
    goals.push_back(shortened(name, 60) + " " + fixed(distance, 1) + " m");
  return goals.empty() ? "" : listed(goals, kMostNames);
}

std::size_t columns_of_terminal() {
  constexpr std::size_t kUsual = 80;
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kUsual;
}

// A job in the background leaves the terminal to the one in the foreground.
bool in_background() {
  const pid_t foreground = tcgetpgrp(STDERR_FILENO);
  return foreground > 0 && foreground != getpgrp();
}

}  // namespace

std::string progress_text(const host::RunGlance& glance, Duration wall) {
  std::string text = time_text(glance.time, glance.is_virtual, wall);
  const std::string alarm = glance.last_alarm.empty() ? "" : "alarm: " + glance.last_alarm;
  for (const std::string& part : {unwell_text(glance), goals_text(glance), alarm})
    if (!part.empty()) text += " | " + shortened(part, kMostBytes);
  return printable(text);
}

bool stderr_can_live() {
  const char* const kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && kind != nullptr && *kind != '\0' && std::string_view(kind) != "dumb";
}

// Without a thread to draw it there is no line; the run goes on.
Progress::Progress(const host::RunView& view) : view_(view) {
  try {
    drawer_ = std::thread([this] { draw_again_and_again(); });
  } catch (const std::system_error&) {
    return;
  }
}

Progress::~Progress() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  ended_.notify_one();
  if (drawer_.joinable()) drawer_.join();
  LiveLine::erase();
}

void Progress::draw_again_and_again() {
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, kPeriod, [this] { return ending_; })) {
    try {
      draw();
    } catch (const std::bad_alloc&) {
      continue;  // others need the memory more than this line
    }
  }
}

void Progress::draw() const {
  if (in_background()) return;
  const Duration wall = std::chrono::steady_clock::now() - start_;
  // A character in the last column would move some terminals to the next line.
  LiveLine::show(STDERR_FILENO, fitting(progress_text(view_.look(), wall), columns_of_terminal() - 1));
}

}  // namespace orca::deployer
