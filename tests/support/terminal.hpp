// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <string>
#include <thread>

namespace orca::test {

/// A terminal whose keys the test presses.
class Terminal {
 public:
  Terminal() : keys_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    REQUIRE(keys_ >= 0);
    REQUIRE(grantpt(keys_) == 0);
    REQUIRE(unlockpt(keys_) == 0);
    char name[64];
    REQUIRE(ptsname_r(keys_, name, sizeof name) == 0);
    name_ = name;
    // The line is held open, so that its settings can be read at any time.
    line_ = open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE(line_ >= 0);
  }
  ~Terminal() {
    close(line_);
    close(keys_);
  }

  [[nodiscard]] const std::string& name() const { return name_; }
  void press(const std::string& bytes) const {
    REQUIRE(write(keys_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
  }
  [[nodiscard]] bool echoes() const {
    termios settings{};
    REQUIRE(tcgetattr(line_, &settings) == 0);
    return (settings.c_lflag & (ICANON | ECHO)) == (ICANON | ECHO);
  }
  // Waits, for at most 5 s, because nothing announces a change of a terminal's settings.
  [[nodiscard]] bool comes_to_echo(bool wanted) const {
    for (int i = 0; i < 500 && echoes() != wanted; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return echoes() == wanted;
  }

 private:
  int keys_;
  int line_ = -1;
  std::string name_;
};

}  // namespace orca::test
