// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>

#include "orca/host/run_listener.hpp"
#include "run/recording/trace.hpp"
#include "run/reporting/reporter.hpp"
#include "run/reporting/run_context.hpp"

namespace orca::host {

/// The surroundings of instances that are no part of a system: what they do is in no trace, and nobody is told of it but the
/// log.
///
/// Thread contract: as RunContext.
class QuietRun {
 public:
  /// @param name      in the log, for what concerns no single component.
  /// @param changed   called whenever an instance has changed its state, on any strand.
  /// @param missions  number of missions begun so far.
  QuietRun(Executive& executive, const std::string& name, std::uint64_t seed, std::function<void()> changed,
           std::atomic<std::uint64_t>& missions)
      : trace_(executive),
        reporter_(executive, trace_, nobody_, name),
        context_{executive, trace_, reporter_, seed, std::move(changed), missions} {}

  [[nodiscard]] RunContext& context() { return context_; }

 private:
  class Nobody final : public RunListener {
   public:
    [[noreturn]] void abandon(const RunResult& /*result*/) override { std::abort(); }
  };

  Nobody nobody_;
  Trace trace_;
  Reporter reporter_;
  RunContext context_;
};

}  // namespace orca::host
