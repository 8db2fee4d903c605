// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/component/sender_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace orca {
namespace {

constexpr Duration kSilence = 10s;  // between two lines about the same

}  // namespace

Status check_age(double age, double most) {
  if (std::abs(age) <= most) return ok();
  char text[160];
  std::snprintf(text, sizeof text,
                "it was measured %.3g s %s now; expected at most %.3g s, by the same clock", std::abs(age),
                age > 0.0 ? "before" : "after", most);
  return fail(Code::invalid_argument, text);
}

bool SenderWatch::accepts(const Status& checked, std::string_view what, const std::string& sender) {
  if (checked.ok()) return true;
  const std::string about = "the " + std::string(what) + " of \"" + sender + "\"";
  const TimePoint now = host_.now();
  auto known = std::ranges::find(complaints_, about, &Complaint::about);
  if (known == complaints_.end()) {
    complaints_.push_back({about, now});
  } else if (now - known->said < kSilence) {
    return false;
  } else {
    known->said = now;
  }
  host_.write_log(log::Level::warning, about + " counts as none: " + checked.error().message);
  return false;
}

}  // namespace orca
