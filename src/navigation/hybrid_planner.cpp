// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/hybrid_planner.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/navigation/floor_rules.hpp"

namespace orca::nav {
namespace {

constexpr int kHeadings = 72;
constexpr double kHeadingStep = 2.0 * std::numbers::pi / kHeadings;
constexpr double kTryEvery = 0.04;   // [m] at which the outline is tried along a way
constexpr double kBackwards = 1.5;   // cost of driving backwards, relative to forwards
constexpr double kCusp = 0.3;        // [m] that a change of direction costs
constexpr double kBend = 1.02;       // cost of a bend, relative to a straight line
constexpr double kNearGoal = 2.0;    // [radii] within which the shortest way without obstacles is looked at
constexpr double kTryPerLeft = 4.0;  // [1/m] states between two tries to end, per what is left
constexpr double kGoodEnough =
    1.03;  // A whole way that costs so much more than the best one can cost is taken,
constexpr std::size_t kAfterFound = 400;  // or the best after so many more states.
constexpr std::size_t kMostStates = 1U << 17;
constexpr std::size_t kTable = 4 * kMostStates;
constexpr double kSaves = 0.02;  // [m] that a shorter way must save
constexpr double kUnit = 1.0 / (kShortest.straight * kPlainCost);

double multiple(const WayPiece& piece) {
  return (piece.length < 0.0 ? kBackwards : 1.0) * (piece.curvature != 0.0 ? kBend : 1.0);
}

// Puts pieces of the same arc together.
void append(std::vector<WayPiece>& way, const WayPiece& piece) {
  const bool goes_on = !way.empty() && way.back().curvature == piece.curvature &&
                       std::signbit(way.back().length) == std::signbit(piece.length);
  if (goes_on) {
    way.back().length += piece.length;
  } else {
    way.push_back(piece);
  }
}

}  // namespace

void HybridPlanner::look_at(const OccupancyMap& map, const Footprint& footprint,
                            std::span<const std::uint16_t> costs, std::span<const std::uint8_t> forbidden,
                            double radius, double margin) {
  outline_.look_at(map, footprint, margin);
  costs_.assign(costs.begin(), costs.end());
  forbidden_.assign(forbidden.begin(), forbidden.end());
  radius_ = radius;
  // Each leads out of its cell, and turns by whole headings.
  const double one = radius * kHeadingStep;
  const int turns = std::max(1, static_cast<int>(std::ceil(std::numbers::sqrt2 * map.lattice().side / one)));
  primitives_.clear();
  for (const double way : {turns * one, -turns * one})
    for (const double curvature : {0.0, 1.0 / radius, -1.0 / radius}) {
      const int steps = std::max(1, static_cast<int>(std::ceil(std::fabs(way) / kTryEvery)));
      Primitive& primitive = primitives_.emplace_back(Primitive{{way, curvature}, {}});
      for (int i = 1; i <= steps; ++i)
        primitive.steps.push_back(driven({}, primitive.piece, way * static_cast<double>(i) / steps));
    }
}

SteeredPlan HybridPlanner::plan(const Pose2& start, const SteeredGoal& goal) {
  begin(start, goal);
  search();
  std::vector<WayPiece> way = way_to(best_ ? best_->node : nearest_.second);
  if (best_)
    for (const WayPiece& piece : best_->end) append(way, piece);
  return {shortened(start, way), best_.has_value()};
}

void HybridPlanner::begin(const Pose2& start, const SteeredGoal& goal) {
  constexpr double kBeyond = 4.0;  // [m] farther from the goal than the robot
  const Lattice& lattice = outline_.lattice();
  goal_ = goal;
  nodes_.clear();
  waiting_.clear();
  table_.assign(kTable, 0);
  best_.reset();
  visited_ = since_try_ = since_found_ = 0;
  nearest_ = {INFINITY, 0};
  const Cell place = lattice.cell_at(goal.place);
  const Cell here = lattice.cell_at(start.position());
  if (!lattice.holds(place) || !lattice.holds(here)) return;
  const auto beyond = static_cast<std::uint32_t>(kBeyond / lattice.side / kUnit);
  search_.flood(lattice, costs_, place, here, beyond);
  nodes_.reserve(kMostStates);
  Node first{start, 0.0, 0, static_cast<std::uint32_t>(lattice.index(here)) * kHeadings, {}, 0};
  first.touched = outline_.touched(start);
  add(first, left_from(first).value_or(0.0));
}

void HybridPlanner::search() {
  while (!waiting_.empty() && nodes_.size() + primitives_.size() < kMostStates) {
    std::ranges::pop_heap(waiting_, std::greater<>{});
    const auto [whole, number] = waiting_.back();
    waiting_.pop_back();
    if (best_ && (best_->cost <= kGoodEnough * whole || ++since_found_ > kAfterFound)) return;
    if (*slot(nodes_[number].key) != number + 1) continue;  // a cheaper one came to its state
    ++visited_;
    const double left = whole - nodes_[number].cost;
    if (left < nearest_.first) nearest_ = {left, number};
    if (static_cast<double>(++since_try_) >= kTryPerLeft * left) {
      since_try_ = 0;
      try_end(number);
    }
    expand(number);
  }
}

void HybridPlanner::expand(std::uint32_t number) {
  const Vec2 axis = direction(nodes_[number].pose.yaw);
  for (const Primitive& primitive : primitives_) {
    const Node& parent = nodes_[number];
    const WayPiece& piece = primitive.piece;
    Node node{parent.pose, 0.0, number, 0, piece, parent.touched};
    if (!drive(node, primitive, axis)) continue;
    const Lattice& lattice = outline_.lattice();
    const double turned = wrapped(node.pose.yaw - nodes_.front().pose.yaw) / kHeadingStep;
    const int heading = (static_cast<int>(std::lround(turned)) + kHeadings) % kHeadings;
    node.key = static_cast<std::uint32_t>(lattice.index(lattice.cell_at(node.pose.position()))) * kHeadings +
               static_cast<std::uint32_t>(heading);
    const bool cusp = number != 0 && (parent.piece.length < 0.0) != (piece.length < 0.0);
    node.cost = parent.cost + cost_of(node.pose, piece) + (cusp ? kCusp : 0.0);
    if (const auto left = left_from(node)) add(node, *left);
  }
}

// Drives a piece from where the node is, whose x axis is given. Returns whether the outline may go there.
bool HybridPlanner::drive(Node& node, const Primitive& primitive, Vec2 axis) const {
  const Pose2 from = node.pose;
  for (const Pose2& step : primitive.steps) {
    node.pose = {from.x + axis.x * step.x - axis.y * step.y, from.y + axis.y * step.x + axis.x * step.y,
                 from.yaw + step.yaw};
    const int now = outline_.touched(node.pose);
    if (now > node.touched) return false;
    node.touched = now;
  }
  if (!obeys(node.pose, primitive.piece.length, node.touched)) return false;
  node.pose.yaw = wrapped(node.pose.yaw);
  return true;
}

// Returns whether a robot whose outline touches nothing may be there, and go that way. Closed cells are those of a rule: where the outline's
// own circle closes them it touches something.
bool HybridPlanner::obeys(const Pose2& pose, double way, int touched) const {
  const Lattice& lattice = outline_.lattice();
  const Cell cell = lattice.cell_at(pose.position());
  if (!lattice.holds(cell)) return false;
  const std::size_t index = lattice.index(cell);
  if (costs_[index] == 0 && touched == 0) return false;
  return forbidden_.empty() || forbidden_[index] == 0 ||
         (forbidden_[index] & direction_bit((way < 0.0 ? -1.0 : 1.0) * direction(pose.yaw))) == 0;
}

// Returns whether a way that begins at a pose is free and obeys the rules.
bool HybridPlanner::may_drive(Pose2 pose, std::span<const WayPiece> way) const {
  if (!outline_.may_drive(pose, way, kTryEvery)) return false;
  for (const WayPiece& piece : way) {
    const int parts = std::max(1, static_cast<int>(std::fabs(piece.length) / outline_.lattice().side));
    for (int i = 0; i < parts; ++i) {
      pose = driven(pose, piece, piece.length / parts);
      if (!obeys(pose, piece.length, outline_.touched(pose))) return false;
    }
  }
  return true;
}

// Returns the cost of a piece that ends there, or begins.
double HybridPlanner::cost_of(const Pose2& there, const WayPiece& piece) const {
  const Lattice& lattice = outline_.lattice();
  const std::uint16_t cell = costs_[lattice.index(lattice.cell_at(there.position()))];
  return std::fabs(piece.length) * multiple(piece) * std::max(cell, kPlainCost) / kPlainCost;
}

// Returns what the way from a node to the goal costs at least, about; nothing if there is none.
std::optional<double> HybridPlanner::left_from(const Node& node) const {
  const Lattice& lattice = outline_.lattice();
  const std::uint32_t cost = search_.cost_from(lattice.index(lattice.cell_at(node.pose.position())));
  const double straight = norm(goal_.place - node.pose.position());
  if (cost == UINT32_MAX) return node.touched > 0 ? std::optional(straight) : std::nullopt;
  const double left = std::max(straight, cost * kUnit * lattice.side);
  if (!goal_.yaw || left > kNearGoal * radius_) return left;
  return std::max(left, length_of(end_from(node.pose)));
}

void HybridPlanner::add(Node node, double left) {
  std::uint32_t* const number = slot(node.key);
  if (*number != 0 && nodes_[*number - 1].cost <= node.cost) return;
  nodes_.push_back(node);
  *number = static_cast<std::uint32_t>(nodes_.size());
  waiting_.emplace_back(node.cost + left, *number - 1);
  std::ranges::push_heap(waiting_, std::greater<>{});
}

// Returns the place in the table that belongs to a state.
std::uint32_t* HybridPlanner::slot(std::uint32_t key) {
  constexpr std::uint32_t kSpread = 2654435769;  // Knuth's: 2^32 by the golden ratio
  std::size_t at = key * kSpread >> (32 - std::bit_width(kTable - 1));
  while (table_[at] != 0 && nodes_[table_[at] - 1].key != key) at = (at + 1) % kTable;
  return &table_[at];
}

// Returns the shortest way to the goal without obstacles. One that needs no direction there ends in that in which it lies, or in the robot's.
std::vector<WayPiece> HybridPlanner::end_from(const Pose2& pose) const {
  if (goal_.yaw) return shortest_way(pose, {goal_.place.x, goal_.place.y, *goal_.yaw}, radius_);
  const Vec2 off = goal_.place - pose.position();
  const double bearing = portable::atan2(off.y, off.x);
  std::vector<WayPiece> facing = shortest_way(pose, {goal_.place.x, goal_.place.y, bearing}, radius_);
  std::vector<WayPiece> level = shortest_way(pose, {goal_.place.x, goal_.place.y, pose.yaw}, radius_);
  return length_of(facing) <= length_of(level) ? facing : level;
}

void HybridPlanner::try_end(std::uint32_t number) {
  const Node& node = nodes_[number];
  const std::vector<WayPiece> end = end_from(node.pose);
  Pose2 pose = node.pose;
  double cost = node.cost;
  double last = number == 0 ? 0.0 : node.piece.length;
  for (const WayPiece& piece : end) {
    const int parts = std::max(1, static_cast<int>(std::fabs(piece.length) / 0.25));
    for (int i = 0; i < parts; ++i) {
      pose = driven(pose, piece, piece.length / parts);
      if (!outline_.lattice().holds(outline_.lattice().cell_at(pose.position()))) return;
      cost += cost_of(pose, {piece.length / parts, piece.curvature});
    }
    if (last * piece.length < 0.0) cost += kCusp;
    last = piece.length;
  }
  if (best_ && best_->cost <= cost) return;
  if (outline_.touched(pose) > 0 || !may_drive(node.pose, end)) return;
  best_ = Candidate{number, end, cost};
}

std::vector<WayPiece> HybridPlanner::way_to(std::uint32_t number) const {
  std::vector<std::uint32_t> numbers;
  for (; number != 0 && number < nodes_.size(); number = nodes_[number].parent) numbers.push_back(number);
  std::vector<WayPiece> way;
  for (auto at = numbers.rbegin(); at != numbers.rend(); ++at) way.push_back(nodes_[*at].piece);
  return way;
}

// Replaces stretches of a way, the longest that is found by doubling, by shortest ways.
std::vector<WayPiece> HybridPlanner::shortened(const Pose2& start, const std::vector<WayPiece>& way) const {
  std::vector<Pose2> poses{start};
  std::vector<double> so_far{0.0};
  for (const WayPiece& piece : way) {
    poses.push_back(driven(poses.back(), piece, piece.length));
    so_far.push_back(so_far.back() + std::fabs(piece.length));
  }
  std::vector<WayPiece> result;
  for (std::size_t i = 0; i < way.size();) {
    std::size_t next = i + 1;
    std::vector<WayPiece> taken{way[i]};
    for (std::size_t step = 2; i + step <= way.size(); step *= 2) {
      const std::size_t end = std::min(i + step, way.size());
      std::vector<WayPiece> direct = shortest_way(poses[i], poses[end], radius_);
      const bool shorter = length_of(direct) < so_far[end] - so_far[i] - kSaves;
      if (shorter && may_drive(poses[i], direct)) {
        taken = std::move(direct);
        next = end;
      }
      if (end == way.size()) break;
    }
    for (const WayPiece& piece : taken) append(result, piece);
    i = next;
  }
  return result;
}

}  // namespace orca::nav
