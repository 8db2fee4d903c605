// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <deque>
#include <map>
#include <string>

#include "members/member.hpp"
#include "starter.hpp"

namespace orca::supervisor {

/// Gives edges new memory that a process has damaged. One that is damaged again and again stays cut, since whoever
/// writes there would go on; then a person is to begin one of its processes anew.
///
/// Thread contract: the supervisor's thread.
class EdgeMending {
 public:
  /// @param log_name  of lines that concern no single component.
  EdgeMending(Starter& starter, std::string log_name) : starter_(starter), log_name_(std::move(log_name)) {}

  /// Renews an edge, unless it was renewed too often of late.
  void mend(const std::string& edge, Moment now);

 private:
  Starter& starter_;
  const std::string log_name_;
  std::map<std::string, std::deque<Moment>> renewals_;  // by edge: the last ones
};

}  // namespace orca::supervisor
