// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

#include "orca/base/executive.hpp"

namespace orca::bench {

constexpr ExecutiveOptions kThreads{ClockKind::steady, Backend::thread};
constexpr ExecutiveOptions kFibers{ClockKind::steady, Backend::fiber};

/// Runs `body` as the main task of a new executive.
inline void run_on(const ExecutiveOptions& options, const std::function<void(Executive&)>& body) {
  const std::unique_ptr<Executive> executive = make_executive(options).value();
  executive->run([&] { body(*executive); });
}

}  // namespace orca::bench
