// SPDX-License-Identifier: LGPL-3.0-or-later
#include "map_entry.hpp"

#include <limits>
#include <memory>
#include <utility>

#include "orca/navigation/drawn_map.hpp"

namespace orca::slam {
namespace {

std::shared_ptr<const nav::KnownMap> map_of(const nav::Slam& slam) {
  constexpr double kCell = 0.05;  // [m]
  nav::DrawnMap drawn(kCell);
  (void)drawn.draw(slam.nodes(), std::numeric_limits<std::size_t>::max());
  nav::MapPart whole = drawn.whole();
  if (whole.cells.empty()) return nullptr;  // no scan has shown anything
  return std::make_shared<const nav::KnownMap>(nav::FloorGrid{whole.lattice, std::move(whole.cells)});
}

}  // namespace

MapEntry::MapEntry(const nav::Slam& slam, const RandomStream& random, bool last)
    : localizer_(map_of(slam), random) {
  constexpr double kVariance = 0.04;  // [m2], [rad2]
  if (last)
    last_ = nav::PoseSpread{slam.nodes().back().X_MR,
                            {kVariance, 0.0, 0.0, 0.0, kVariance, 0.0, 0.0, 0.0, kVariance}};
}

void MapEntry::move(const nav::Reckoned& now) {
  if (const auto last = std::exchange(last_, std::nullopt)) localizer_.suggest(*last, now);
  if (before_ && localizer_.known(now) == nav::Known::localized)
    known_way_ += norm(now.X_OR.position() - before_->X_OR.position());
  else
    known_way_ = 0.0;
  before_ = now;
  localizer_.move(now);
}

void MapEntry::see(const nav::RobotScan& scan) {
  constexpr double kElsewhere = 0.3;  // [m]
  const auto before = where(*before_);
  localizer_.see(scan);
  const auto after = where(*before_);
  if (!before || !after || norm(before->mean.position() - after->mean.position()) > kElsewhere)
    known_way_ = 0.0;
}

std::optional<nav::PoseSpread> MapEntry::where(const nav::Reckoned& now) const {
  if (localizer_.known(now) != nav::Known::localized) return std::nullopt;
  return localizer_.where(now);
}

}  // namespace orca::slam
