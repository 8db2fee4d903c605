// SPDX-License-Identifier: LGPL-3.0-or-later
#include "keys.hpp"

namespace orca::teleop {
namespace {

constexpr char kEscape = '\x1b';

// Returns the key that an arrow stands for. Terminals send ESC [ A or ESC O A for the arrow up, depending on
// their mode.
char key_of_arrow(char last) {
  switch (last) {
    case 'A': return 'w';
    case 'B': return 's';
    case 'C': return 'd';
    case 'D': return 'a';
    default: return '\0';
  }
}

}  // namespace

double Keys::Press::at(double now, double dead_man) const {
  return direction != 0.0 && now - time <= dead_man ? direction : 0.0;
}

void Keys::take(std::string_view bytes, double time) {
  for (const char byte : bytes) {
    if (byte == kEscape) {
      escape_ = Escape::begun;
    } else if (escape_ == Escape::begun && (byte == '[' || byte == 'O')) {
      escape_ = Escape::bracket;
    } else {
      press(escape_ == Escape::bracket ? key_of_arrow(byte) : byte, time);
      escape_ = Escape::none;
    }
  }
}

void Keys::press(char key, double time) {
  switch (key) {
    case 'w':
    case 'W': forward_ = {1.0, time}; break;
    case 's':
    case 'S': forward_ = {-1.0, time}; break;
    case 'a':
    case 'A': left_ = {1.0, time}; break;
    case 'd':
    case 'D': left_ = {-1.0, time}; break;
    case ' ': forward_ = left_ = {}; break;
    case 'p':
    case 'P': asked_ = true; break;
    case 'q':
    case 'Q': quit_ = true; break;
    default: break;
  }
}

Stick Keys::stick(double time, double dead_man) const {
  return {forward_.at(time, dead_man), left_.at(time, dead_man)};
}

}  // namespace orca::teleop
