// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace orca::host {

/// Copies that the process keeps of its descriptors get numbers from here on, beyond the reach of a plugin that closes
/// every number it can count to.
constexpr int kFirstCopy = 900;

/// The file behind an open descriptor.
struct OpenFile {
  dev_t device = 0;
  ino_t inode = 0;

  friend bool operator==(const OpenFile&, const OpenFile&) = default;
};

/// Open files by descriptor number.
using Descriptors = std::map<int, OpenFile>;

/// Returns the open descriptors of this process; nothing if no descriptor is left to read them with.
[[nodiscard]] std::optional<Descriptors> open_descriptors();

/// Returns a text for people, in the system's words: "7 (/dev/ttyS0), 8 (socket:[4711])"; only the first ones if there are
/// many. @pre  they are still open.
[[nodiscard]] std::string names_of(const Descriptors& descriptors);

/// The descriptors that the process itself needs, kept so that a plugin that closes or redirects them is noticed.
///
/// Thread contract: one thread at a time.
class OwnDescriptors {
 public:
  ~OwnDescriptors() { release(); }
  /// Remembers stdin, stdout and stderr if they are open, and one more descriptor.
  void remember();
  void release();
  [[nodiscard]] bool all_open() const;
  /// Restores those of stdin, stdout and stderr that lead to another file than before.
  /// @return for people: "stdout to /tmp/log"; empty: there were none.
  [[nodiscard]] std::string restore_redirected();
  /// Returns the number that the next descriptor would get; -1 if the process may open no more.
  [[nodiscard]] int lowest_free() const;

 private:
  // One of stdin, stdout and stderr.
  struct Stream {
    int fd;
    int copy;  // out of the reach of a plugin that closes every number it can count to; -1: there is none
    OpenFile file;
  };

  std::vector<int> own_;
  std::vector<Stream> streams_;
  int extra_ = -1;
};

}  // namespace orca::host
