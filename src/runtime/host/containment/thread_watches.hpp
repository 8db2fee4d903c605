// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <signal.h>

#include <cstdint>

#include "watch.hpp"

namespace orca::host {

/// How the thread rounds, and which results it traps. A look costs a few nanoseconds.
class FloatingPointWatch final : public Watch {
 public:
  void keep() override;
  std::optional<Finding> look() override;

 private:
  std::uint32_t reference_ = 0;
};

/// That the thread has no locale of its own. A look costs a few nanoseconds.
class ThreadLocaleWatch final : public Watch {
 public:
  void keep() override {}
  std::optional<Finding> look() override;
};

/// Which signals the thread blocks.
class SignalMaskWatch final : public Watch {
 public:
  void keep() override;
  std::optional<Finding> look() override;

 private:
  sigset_t reference_{};
};

}  // namespace orca::host
