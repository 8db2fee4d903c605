// SPDX-License-Identifier: LGPL-3.0-or-later
#include "backlog.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string>
#include <utility>
#include <variant>

#include "orca/base/text.hpp"
#include "orca/supervisor/log_name.hpp"

namespace orca::supervisor {
namespace {

bool is_line(const Report& report) { return std::holds_alternative<Logged>(report); }

bool lasts(const Report& report) {
  return is_line(report) || std::holds_alternative<AlarmReport>(report) ||
         std::holds_alternative<ArrivedReport>(report) || std::holds_alternative<GoalFailedReport>(report) ||
         std::holds_alternative<ContactReport>(report) || std::holds_alternative<MissionStep>(report) ||
         std::holds_alternative<OutputFailed>(report);
}

}  // namespace

void Backlog::keep(Report report, Duration time) {
  if (!lasts(report)) return;
  if (auto* const line = std::get_if<Logged>(&report)) {
    char when[64];
    std::snprintf(when, sizeof when, " (said at %.3f s, while no deployer ran)", to_seconds(time));
    line->text = shortened(line->text, kLongestLine) + when;
  }
  if (kept_.size() == kMost) give_up_one();
  kept_.push_back(std::move(report));
}

void Backlog::give_up_one() {
  const auto line = std::ranges::find_if(kept_, is_line);
  kept_.erase(line == kept_.end() ? kept_.begin() : line);
  ++given_up_;
}

std::vector<Report> Backlog::take() {
  std::vector<Report> all(std::make_move_iterator(kept_.begin()), std::make_move_iterator(kept_.end()));
  kept_.clear();
  if (given_up_ > 0)
    all.emplace_back(Logged{log::Level::warning, kLogName,
                            std::to_string(std::exchange(given_up_, 0)) +
                                " more lines were said while no deployer ran, and are lost"});
  return all;
}

}  // namespace orca::supervisor
