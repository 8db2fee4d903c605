// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace orca::test {

/// Returns the lines that a terminal shows after it has received these bytes, without trailing blank ones. It knows
/// line feed, carriage return and "erase to the end of the line"; any other control character becomes '?', so that a
/// test sees it.
[[nodiscard]] std::vector<std::string> screen_after(std::string_view bytes);

/// A terminal whose output this object reads all the time, so that no program waits for it.
///
/// Thread contract: one thread.
class Screen {
 public:
  explicit Screen(unsigned short columns = 100);
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  /// Returns the path that a program opens.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Returns everything that programs have written so far.
  [[nodiscard]] std::string bytes() const;
  /// Returns everything that programs have written, which have all ended. What is written afterwards is not in it.
  [[nodiscard]] std::string all_bytes();
  /// Waits until the terminal has received `text`; false after 10 s without it.
  [[nodiscard]] bool receives(const std::string& text) const;

 private:
  void read_all();

  int keys_ = -1;
  int line_ = -1;  // held open, so that reading does not end between two programs
  std::string name_;
  bool marked_ = false;  // whether the end of all output has been marked
  mutable std::mutex mutex_;
  std::string bytes_;
  std::atomic<bool> ending_{false};
  std::thread reader_;
};

}  // namespace orca::test
