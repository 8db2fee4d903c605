// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>

namespace orca {

/// A number that one thread at a time writes and any thread may read. A write costs no more than that of a
/// plain number.
template <class T>
class Published {
 public:
  Published(T value = T{}) : value_(value) {}  // NOLINT(google-explicit-constructor)
  Published& operator=(T value) {
    value_.store(value, std::memory_order_relaxed);
    return *this;
  }
  Published& operator+=(T more) { return *this = *this + more; }
  Published& operator++() { return *this += T{1}; }
  operator T() const {
    return value_.load(std::memory_order_relaxed);
  }  // NOLINT(google-explicit-constructor)

 private:
  std::atomic<T> value_;
};

}  // namespace orca
