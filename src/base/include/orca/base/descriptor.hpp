// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <unistd.h>

#include <utility>

namespace orca {

/// A file descriptor that has one owner. The destructor closes it.
///
/// Thread contract: not synchronised; it may move between threads.
class Descriptor {
 public:
  /// Makes an empty one.
  Descriptor() = default;
  /// Takes over an open descriptor; a negative number makes an empty one.
  explicit Descriptor(int number) : number_(number < 0 ? -1 : number) {}
  ~Descriptor() { reset(); }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    if (this != &other) {
      reset();
      number_ = std::exchange(other.number_, -1);
    }
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  /// Returns its number; -1 if it is empty.
  [[nodiscard]] int number() const { return number_; }
  /// Returns whether it holds an open descriptor.
  explicit operator bool() const { return number_ >= 0; }

  /// Closes it; then it is empty.
  void reset() {
    if (number_ >= 0) close(std::exchange(number_, -1));
  }
  /// Gives the descriptor away without closing it; then it is empty.
  [[nodiscard]] int release() { return std::exchange(number_, -1); }

 private:
  int number_ = -1;
};

}  // namespace orca
