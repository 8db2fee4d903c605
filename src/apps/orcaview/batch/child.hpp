// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "wire.hpp"

// after wire.hpp, which includes what Boost.Asio lacks
#include <sys/types.h>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <memory>
#include <string>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::view {

/// A program that this one has started. It ends when this object does, and when this process does.
///
/// Thread contract: the loop's thread.
class Child {
 public:
  /// Starts a program in a folder. What it prints on either stream is for read_some().
  /// @param words  its name and arguments; the program is looked for as a shell does, but first beside this one.
  /// @errors  unavailable.
  static Result<std::unique_ptr<Child>> start(const boost::asio::any_io_executor& loop,
                                              const std::vector<std::string>& words,
                                              const std::string& folder);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Returns what it has printed next; empty: it has closed its output.
  boost::asio::awaitable<std::string> read_some();
  /// Waits until it has ended, which one that has closed its output does soon.
  /// @return its exit status; 128 and the signal if one has ended it.
  int wait();

 private:
  Child(const boost::asio::any_io_executor& loop, pid_t process, int output);

  const pid_t process_;
  boost::asio::posix::stream_descriptor output_;
  bool is_over_ = false;
};

}  // namespace orca::view
