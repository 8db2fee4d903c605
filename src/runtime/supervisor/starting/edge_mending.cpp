// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edge_mending.hpp"

#include "orca/base/log.hpp"
#include "orca/base/text.hpp"

namespace orca::supervisor {
namespace {

using namespace std::chrono_literals;

// Both ends may report the same damage.
constexpr std::size_t kMost = 6;
constexpr auto kSpan = 60s;

}  // namespace

void EdgeMending::mend(const std::string& edge, Moment now) {
  std::deque<Moment>& last = renewals_[edge];
  while (!last.empty() && now - last.front() > kSpan) last.pop_front();
  if (last.size() >= kMost)
    return log::error(log_name_, "the connection " + in_quotes(edge) +
                                     " stays cut: its memory was damaged too often; orcactl restart one of "
                                     "its two processes");
  last.push_back(now);
  const Status renewed = starter_.renew_edges({edge});
  if (!renewed.ok())
    log::error(log_name_, "the connection " + in_quotes(edge) + " stays cut: " + renewed.error().text());
}

}  // namespace orca::supervisor
