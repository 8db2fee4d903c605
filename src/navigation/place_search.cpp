// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/place_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "orca/base/portable_math.hpp"

namespace orca::nav {
namespace {

constexpr int kTop = ScanSearch::kLevels - 1;
constexpr double kSide = ScanSearch::kSide;

// Returns into how many directions the circle is divided, so that a point 30 m away, or the farthest one if that is nearer, moves by a cell
// and a half from one to the next. More of them take more time, and a score forgives some cells.
int turns_of(std::span<const SurfacePoint> scan) {
  constexpr double kFar =
      30.0;  // [m] With 12 m a robot in a long corridor of the ACES building is found later.
  double farthest = 1.0;
  for (const SurfacePoint& point : scan) farthest = std::max(farthest, norm(point.at));
  farthest = std::min(farthest, kFar);
  return static_cast<int>(std::ceil(2.0 * std::numbers::pi * farthest / (1.5 * kSide)));
}

// Whether two poses are one and the same place of a scan.
bool is_one_place(const Pose2& one, const Pose2& other) {
  constexpr double kApart = 0.1;  // [m], [rad]
  const Pose2 away = seen_from(one, other);
  return norm(away.position()) < kApart && std::fabs(away.yaw) < kApart;
}

// Returns where a scan lies in a wide prior, a place for each neighbourhood.
std::vector<ScanMatch> laid_within(const PoseSpread& prior, std::span<const SurfacePoint> scan,
                                   const KnownMap& map, const MatchOptions& options) {
  constexpr double kUsual = 9.0;  // squared distance
  const double side = 0.9 * deviation_of(prior);
  MatchOptions close = options;
  close.reach = std::min(close.reach, 0.5 * side + options.inlier);
  std::vector<ScanMatch> places;
  for (const double x : {-side, 0.0, side})
    for (const double y : {-side, 0.0, side}) {
      const Pose2 from{prior.mean.x + x, prior.mean.y + y, prior.mean.yaw};
      const auto laid = refine(scan, map.surface(), from, close);
      if (!laid || squared_distance(prior, laid->X_MR) > kUsual) continue;
      if (std::ranges::none_of(places,
                               [&](const ScanMatch& it) { return is_one_place(it.X_MR, laid->X_MR); }))
        places.push_back(*laid);
    }
  return places;
}

}  // namespace

PlaceSearch::PlaceSearch(const KnownMap& map, std::vector<SurfacePoint> scan,
                         const PlaceSearchOptions& options)
    : map_(map),
      scan_(std::move(scan)),
      options_(options),
      turns_(turns_of(scan_)),
      full_(ScanSearch::kFull * static_cast<double>(std::max<std::size_t>(1, scan_.size()))),
      tops_(map.free_blocks()) {}

std::vector<Cell> PlaceSearch::turned_by(int turn) const {
  const Lattice& lattice = map_.search().lattice();
  const Vec2 ahead = direction(turn * 2.0 * std::numbers::pi / turns_);
  std::vector<Cell> cells;
  cells.reserve(scan_.size());
  for (const SurfacePoint& point : scan_)
    cells.push_back(lattice.cell_at(lattice.middle_of({0, 0}) + rotated(point.at, ahead)));
  return cells;
}

bool PlaceSearch::step(std::size_t looks) {
  if (scan_.empty() || tops_.empty()) return true;
  looked_ = 0;
  for (; !sorted_ && looked_ < looks; ++next_) {
    if (next_ == static_cast<std::size_t>(turns_)) {
      sort_blocks();
      break;
    }
    look_in_direction(static_cast<int>(next_));
  }
  if (!sorted_) return false;
  for (; next_ < blocks_.size() && looked_ < looks; ++next_) look_into(blocks_[next_], kTop);
  return next_ == blocks_.size();
}

void PlaceSearch::look_in_direction(int turn) {
  const std::vector<Cell>& cells = turned_.emplace_back(turned_by(turn));
  const double least = options_.least_score * full_;
  for (const Cell& corner : tops_) {
    const int sum = map_.search().bound(cells, corner, kTop);
    if (sum >= least) blocks_.push_back({turn, corner, sum});
  }
  looked_ += tops_.size() * scan_.size();
}

void PlaceSearch::sort_blocks() {
  std::ranges::stable_sort(blocks_, std::ranges::greater(), &Block::sum);
  sorted_ = true;
  next_ = 0;
}

Pose2 PlaceSearch::pose_of(const Block& place) const {
  const Vec2 at = map_.search().lattice().middle_of(place.corner);
  return {at.x, at.y, wrapped(place.turn * 2.0 * std::numbers::pi / turns_)};
}

// Whether a block can hold a place that is taken. A small one beside a place that was found must be better than that.
bool PlaceSearch::is_better(const Block& block, int level) const {
  if (found_.empty()) return true;
  const double score = block.sum / full_;
  if (score <= found_.front().score - options_.margin) return false;
  if (found_.size() == options_.most && score <= found_.back().score) return false;
  constexpr int kSmall = 2;
  if (level > kSmall) return true;
  const Pose2 pose = pose_of(block);
  return std::ranges::none_of(found_, [&](const Found& place) {
    return score <= place.score && norm(place.X_MR.position() - pose.position()) < options_.apart &&
           std::fabs(wrapped(place.X_MR.yaw - pose.yaw)) < options_.apart_turn;
  });
}

void PlaceSearch::look_into(const Block& block, int level) {
  if (!is_better(block, level)) return;
  if (level == 0) return keep(block);
  const int half = 1 << (level - 1);
  std::array<Block, 4> parts{};
  std::size_t count = 0;
  const double least = options_.least_score * full_;
  for (const int dx : {0, half})
    for (const int dy : {0, half}) {
      const Cell corner{block.corner.column + dx, block.corner.row + dy};
      const int sum = map_.search().bound(turned_[static_cast<std::size_t>(block.turn)], corner, level - 1);
      if (sum >= least) parts[count++] = {block.turn, corner, sum};
    }
  looked_ += 4 * scan_.size();
  const std::span<Block> some(parts.data(), count);
  std::ranges::stable_sort(some, std::ranges::greater(), &Block::sum);
  for (const Block& part : some) look_into(part, level - 1);
}

void PlaceSearch::keep(const Block& place) {
  const Found found{pose_of(place), place.sum / full_};
  if (!map_.free(found.X_MR.position())) return;
  std::erase_if(found_, [&](const Found& other) {
    return norm(other.X_MR.position() - found.X_MR.position()) < options_.apart &&
           std::fabs(wrapped(other.X_MR.yaw - found.X_MR.yaw)) < options_.apart_turn;
  });
  found_.insert(std::ranges::upper_bound(found_, found.score, std::ranges::greater(), &Found::score), found);
  while (found_.size() > options_.most || found_.back().score <= found_.front().score - options_.margin)
    found_.pop_back();
}

void SeenThrough::note(const Explanation& seen) {
  constexpr double kForgotten = 0.03;  // with each scan
  behind += seen.longs - kForgotten * behind;
  at_walls += seen.hits + seen.longs - kForgotten * at_walls;
}

void SeenThrough::add(const SeenThrough& other) {
  behind += other.behind;
  at_walls += other.at_walls;
}

void Rivals::contradict(const PoseSpread& by_wheels) {
  way_ = 0.0;
  if (!rivals_.empty()) return;
  believed_ = {};
  rivals_.push_back({by_wheels, 1.0, {}});
}

void Rivals::look_about(const PoseSpread& prior, const ScanMatch& laid, const RobotScan& scan,
                        const KnownMap& map, const LocalizerOptions& options) {
  constexpr double kUnlikely = 0.01;
  way_ = 0.0;
  believed_ = {};
  rivals_.clear();
  for (const ScanMatch& other : laid_within(prior, scan.echoes, map, options.match)) {
    if (is_one_place(other.X_MR, laid.X_MR)) continue;
    const double lack = std::max(0.0, laid.fit - other.fit - options.margin.apart);
    const double odds = portable::exp(-options.margin.evidence * lack);
    if (odds >= kUnlikely) rivals_.push_back({spread_of(other), odds, {}});
  }
}

void Rivals::move(const Pose2& step, const std::array<double, 3>& deviations) {
  way_ += norm(step.position());
  for (Rival& rival : rivals_) rival.where = after(rival.where, step, deviations);
}

void Rivals::judge(const RobotScan& scan, const KnownMap& map, const Explanation& believed,
                   const LocalizerOptions& options) {
  constexpr double kOtherViews = 5.0;  // [m] Furniture that was moved is out of sight by then, as a rule.
  constexpr double kClearly = 3.0;     // The wheels know a place less and less.
  constexpr double kLost = 0.5;        // [m]
  if (rivals_.empty()) return;
  if (way_ > kOtherViews) return clear();
  believed_.note(believed);
  const bool is_sound = !believed_.is_more_than(options.most_behind);
  for (Rival& rival : rivals_) rival.there.note(map.explain(scan.echoes, scan.from, rival.where.mean));
  std::erase_if(rivals_, [&](const Rival& rival) {
    return (is_sound && rival.there.is_more_than(kClearly * options.most_behind)) ||
           deviation_of(rival.where) > kLost;
  });
}

PoseSpread Rivals::with(PoseSpread believed) const {
  double all = 1.0;
  for (const Rival& rival : rivals_) {
    all += rival.odds;
    believed = mixed(believed, rival.where, rival.odds / all);
  }
  return believed;
}

}  // namespace orca::nav
