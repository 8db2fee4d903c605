// SPDX-License-Identifier: LGPL-3.0-or-later
#include "walker_track.hpp"

#include <algorithm>

#include "orca/base/random.hpp"

namespace orca::sim::detail {
namespace {

// Returns the corners of a whole round; the first is not repeated.
std::vector<Vec2> round_of(const Walker& walker) {
  std::vector<Vec2> corners = walker.track;
  if (!walker.round)
    for (std::size_t i = walker.track.size() - 1; i-- > 1;) corners.push_back(walker.track[i]);
  return corners;
}

}  // namespace

WalkerTrack::WalkerTrack(const Walker& walker, std::uint64_t run_seed) {
  RandomStream random(walker.seed.value_or(run_seed), walker.name, "walker");
  const std::vector<Vec2> corners = round_of(walker);
  for (std::size_t i = 0; i < corners.size(); ++i)
    add_leg(walker, corners[i], corners[(i + 1) % corners.size()],
            Duration(static_cast<Duration::rep>(random.uniform(0.0, 1.0) *
                                                static_cast<double>(walker.pause.count()))));
  const double share = random.uniform(0.0, 1.0);
  phase_ = walker.start.value_or(
      Duration(static_cast<Duration::rep>(share * static_cast<double>(period_.count()))));
}

void WalkerTrack::add_leg(const Walker& walker, Vec2 from, Vec2 to, Duration rest) {
  const Duration walk(std::llround(norm(to - from) / walker.speed * 1e9));
  if (walk.count() <= 0) return;
  legs_.push_back({from, to, period_, walk});
  period_ += walk + rest;
}

WalkerTrack::Place WalkerTrack::at(Duration walked) const {
  const Duration time = (phase_ + walked) % period_;
  const auto leg = std::prev(std::ranges::upper_bound(legs_, time, {}, &Leg::begin));
  const Duration gone = std::min(time - leg->begin, leg->walk);
  const double share = static_cast<double>(gone.count()) / static_cast<double>(leg->walk.count());
  const Vec2 way = leg->to - leg->from;
  return {leg->from + share * way, 1.0 / norm(way) * way};
}

}  // namespace orca::sim::detail
