// SPDX-License-Identifier: LGPL-3.0-or-later
#include "outbox.hpp"

#include <algorithm>

namespace orca::command {

void Outbox::note_restarts(Restarts of_goto, Restarts of_fuser) {
  if (of_goto != of_goto_) next_ = ahead_;
  if (of_fuser != of_fuser_) list_is_due_ = true;
  of_goto_ = of_goto;
  of_fuser_ = of_fuser;
}

void Outbox::note_left(std::size_t points) { ahead_ = points_ - std::clamp<std::size_t>(points, 1, points_); }

std::optional<std::size_t> Outbox::next_point() const {
  if (next_ == points_) return std::nullopt;
  return next_;
}

}  // namespace orca::command
