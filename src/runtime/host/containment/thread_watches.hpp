// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <signal.h>

#include <cstdint>

#include "watch.hpp"

namespace orca::host {

/// A watch over the thread's rounding and floating-point traps. A look costs a few nanoseconds.
class FloatingPointWatch final : public Watch {
 public:
  void keep() override;
  std::optional<Finding> look() override;

 private:
  std::uint32_t reference_ = 0;
};

/// A watch that the thread has no locale of its own. A look costs a few nanoseconds.
class ThreadLocaleWatch final : public Watch {
 public:
  void keep() override {}
  std::optional<Finding> look() override;
};

/// A watch over the signals that the thread blocks.
class SignalMaskWatch final : public Watch {
 public:
  void keep() override;
  std::optional<Finding> look() override;

 private:
  sigset_t reference_{};
};

}  // namespace orca::host
