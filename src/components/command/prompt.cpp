// SPDX-License-Identifier: LGPL-3.0-or-later
#include "prompt.hpp"

#include <poll.h>
#include <unistd.h>

#include <string_view>
#include <utility>

namespace orca::command {

bool Prompt::show() {
  constexpr std::string_view kPrompt = "goal (name: x y > x y, empty line to end)? ";
  if (!shown_) shown_ = write(STDERR_FILENO, kPrompt.data(), kPrompt.size()) >= 0;
  return shown_;
}

bool Prompt::read() {
  for (;;) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, 0) == 0) return false;
    char c = 0;
    if (::read(STDIN_FILENO, &c, 1) != 1 || c == '\n') return true;
    typed_ += c;
  }
}

std::string Prompt::take_line() {
  shown_ = false;
  return std::exchange(typed_, {});
}

}  // namespace orca::command
