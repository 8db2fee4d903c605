// SPDX-License-Identifier: GPL-3.0-or-later
#include "screen.hpp"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <stdexcept>

namespace orca::test {
namespace {

constexpr std::string_view kEraseRest = "\x1b[K";

void check(bool good, const char* what) {
  if (!good) throw std::runtime_error(what);
}

}  // namespace

std::vector<std::string> screen_after(std::string_view bytes) {
  std::vector<std::string> lines(1);
  std::size_t column = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string& line = lines.back();
    if (bytes[i] == '\n') {
      lines.emplace_back();
      column = 0;
    } else if (bytes[i] == '\r') {
      column = 0;
    } else if (bytes.substr(i).starts_with(kEraseRest)) {
      line.resize(std::min(line.size(), column));
      i += kEraseRest.size() - 1;
    } else {
      if (line.size() <= column) line.resize(column + 1, ' ');
      const auto c = static_cast<unsigned char>(bytes[i]);
      line[column++] = c < 0x20 || c == 0x7f ? '?' : bytes[i];
    }
  }
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  return lines;
}

Screen::Screen(unsigned short columns) : keys_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
  check(keys_ >= 0 && grantpt(keys_) == 0 && unlockpt(keys_) == 0, "posix_openpt");
  std::array<char, 64> name{};
  check(ptsname_r(keys_, name.data(), name.size()) == 0, "ptsname_r");
  name_ = name.data();
  line_ = open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  const winsize size{24, columns, 0, 0};
  check(line_ >= 0 && ioctl(line_, TIOCSWINSZ, &size) == 0, "TIOCSWINSZ");
  reader_ = std::thread([this] { read_all(); });
}

Screen::~Screen() {
  ending_.store(true);
  reader_.join();
  close(line_);
  close(keys_);
}

void Screen::read_all() {
  std::array<char, 4096> some{};
  while (!ending_.load()) {
    pollfd input{keys_, POLLIN, 0};
    if (poll(&input, 1, 10) <= 0) continue;
    const ssize_t count = read(keys_, some.data(), some.size());
    if (count <= 0) continue;
    const std::lock_guard lock(mutex_);
    bytes_.append(some.data(), static_cast<std::size_t>(count));
  }
}

std::string Screen::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

// A mark that this process writes comes after everything that others have written before.
std::string Screen::all_bytes() {
  const std::string mark = "<the end of all output>";
  if (!marked_) check(write(line_, mark.data(), mark.size()) > 0, "write");
  marked_ = true;
  check(receives(mark), "the terminal gives no output");
  const std::string all = bytes();
  return all.substr(0, all.find(mark));
}

bool Screen::receives(const std::string& text) const {
  for (int i = 0; i < 1000; ++i) {
    if (bytes().find(text) != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace orca::test
