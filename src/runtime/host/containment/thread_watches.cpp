// SPDX-License-Identifier: LGPL-3.0-or-later
#include "thread_watches.hpp"

#include <locale.h>
#include <pthread.h>

#include "floating_point.hpp"
#include "orca/base/system/signal_name.hpp"

namespace orca::host {
namespace {

std::string difference(const sigset_t& now, const sigset_t& before) {
  std::string changes;
  for (int signal = 1; signal < SIGRTMIN; ++signal) {
    const bool blocked = sigismember(&now, signal) == 1;
    if (blocked == (sigismember(&before, signal) == 1)) continue;
    changes += std::string(changes.empty() ? "" : ", ") + (blocked ? "blocked SIG" : "unblocked SIG") +
               signal_name(signal);
  }
  return changes;
}

}  // namespace

void FloatingPointWatch::keep() { reference_ = floating_point_control(); }

std::optional<Finding> FloatingPointWatch::look() {
  if (floating_point_control() == reference_) return std::nullopt;
  set_floating_point_control(reference_);
  return Finding{idl::FLOATING_POINT, "changed how numbers are rounded or which results are trapped"};
}

std::optional<Finding> ThreadLocaleWatch::look() {
  if (uselocale(nullptr) == LC_GLOBAL_LOCALE) return std::nullopt;
  uselocale(LC_GLOBAL_LOCALE);
  return Finding{idl::LOCALE, "given its thread a locale of its own"};
}

void SignalMaskWatch::keep() { pthread_sigmask(SIG_BLOCK, nullptr, &reference_); }

std::optional<Finding> SignalMaskWatch::look() {
  sigset_t now;
  pthread_sigmask(SIG_SETMASK, &reference_, &now);
  const std::string changes = difference(now, reference_);
  if (changes.empty()) return std::nullopt;
  return Finding{idl::SIGNAL_MASK, changes};
}

}  // namespace orca::host
