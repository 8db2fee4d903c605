// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/place_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

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

}  // namespace orca::nav
