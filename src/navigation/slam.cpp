// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/slam.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace orca::nav {

/// Some nodes that follow each other, as one rigid map in the frame of the first of them.
struct Slam::Submap {
  std::size_t first = 0;
  std::size_t count = 0;
  SurfaceMap map;
  Vec2 middle;       // of the nodes, frame of the first
  double way = 0.0;  // [m] that the robot had driven when its last node came
  bool complete = false;
  std::unique_ptr<ScanSearch> search{};  // of few, as it is large
};

namespace {

// Between two nodes there is no time for more, and the next fit goes on where this one ends.
constexpr int kStepsOnTheWay = 4;
constexpr int kStepsAtTheEnd = 50;

constexpr double kNearWay = 0.5;   // [m] to each side
constexpr double kNearTurn = 0.2;  // [rad]

// The way from one node to the next as odometry has it, in the frame of the first.
PoseInformation information_of(const Pose2& moved, const TravelErrors& errors) {
  const double way = norm(moved.position());
  const double turn = std::fabs(moved.yaw);
  const double place = errors.place + errors.place_per_way * way + errors.place_per_turn * turn;
  const double turned = errors.turn + errors.turn_per_way * way + errors.turn_per_turn * turn;
  return {1.0 / (place * place), 0.0, 1.0 / (place * place), 0.0, 0.0, 1.0 / (turned * turned)};
}

bool is_finite(const Pose2& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.yaw);
}

bool is_finite(const SlamNode& node) {
  const auto is_number = [](const SurfacePoint& point) {
    return std::isfinite(point.at.x + point.at.y + point.normal.x + point.normal.y);
  };
  return is_finite(node.X_OR) && is_finite(node.X_LR) && is_finite(node.X_MR) &&
         std::isfinite(node.sensor.x + node.sensor.y) && std::ranges::all_of(node.scan, is_number);
}

bool is_finite(const PoseInformation& i) { return std::isfinite(i.xx + i.xy + i.yy + i.xt + i.yt + i.tt); }

PoseInformation both(const PoseInformation& a, const PoseInformation& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy, a.xt + b.xt, a.yt + b.yt, a.tt + b.tt};
}

}  // namespace

Status check(const SlamMemory& memory) {
  const std::size_t count = memory.nodes.size();
  const auto is_sound = [&](const PoseRelation& relation) {
    return relation.from < count && relation.to < count && is_finite(relation.measured) &&
           is_finite(relation.information);
  };
  const auto has_its_nodes = [&](const SlamStretch& stretch) {
    return stretch.count > 0 && stretch.first < count && stretch.count <= count - stretch.first &&
           std::isfinite(stretch.way);
  };
  // Scans that are farther apart than this cannot be drawn as one map.
  constexpr double kFarthest = 850.0;  // [m] from the first node
  constexpr double kEcho = 110.0;      // [m]
  const auto is_near = [&](const SlamNode& node) {
    const Vec2 off = node.X_MR.position() - memory.nodes.front().X_MR.position();
    return norm(off) < kFarthest && norm(node.X_MR.position()) < 1e6 && norm(node.sensor) < kEcho &&
           std::ranges::all_of(node.scan,
                               [kEcho](const SurfacePoint& point) { return norm(point.at) < kEcho; });
  };
  if (!std::ranges::all_of(memory.nodes, [](const SlamNode& node) { return is_finite(node); }))
    return fail(Code::data_loss, "a pose or a point of a scan is no number");
  if (!std::ranges::all_of(memory.nodes, is_near))
    return fail(Code::data_loss, "a scan is more than 850 m from the first one, or an echo too far");
  if (!std::ranges::all_of(memory.relations, is_sound))
    return fail(Code::data_loss, "a relation is no number, or names a scan that is not there");
  if (!std::ranges::all_of(memory.submaps, has_its_nodes) || !std::isfinite(memory.way))
    return fail(Code::data_loss, "a part of the map names scans that are not there");
  return ok();
}

Slam::Slam(SlamOptions options) : options_(options), known_(information_of({}, options.travel)) {}

Slam::Slam(SlamMemory memory, SlamOptions options) : Slam(options) {
  nodes_ = std::move(memory.nodes);
  relations_ = std::move(memory.relations);
  loops_ = loops_fitted_ = memory.loops;
  fitted_ = nodes_.size();
  way_ = way_at_loop_ = memory.way;
  for (const SlamStretch& stretch : memory.submaps) {
    Submap& submap = *submaps_.emplace_back(std::make_unique<Submap>());
    submap.first = stretch.first;
    for (std::size_t node = stretch.first; node < stretch.first + stretch.count; ++node) add_to(submap, node);
    submap.map.prepare();
    submap.way = stretch.way;
    submap.complete = true;
  }
}

Slam::~Slam() = default;

SlamMemory Slam::memory() const {
  SlamMemory memory{nodes_, relations_, {}, loops_, way_};
  for (const auto& submap : submaps_) memory.submaps.push_back({submap->first, submap->count, submap->way});
  return memory;
}

// A bond with the nearest node keeps all nodes tied to the first one, even if no submap is found again there.
void Slam::enter(std::span<const SurfacePoint> scan, const Pose2& X_OR, const Pose2& X_MR, Vec2 sensor) {
  const auto distance = [&](const SlamNode& node) { return norm(node.X_MR.position() - X_MR.position()); };
  const auto nearest = std::ranges::min_element(nodes_, {}, distance);
  const auto from = static_cast<std::size_t>(nearest - nodes_.begin());
  const std::size_t node = nodes_.size();
  known_ = information_of({}, options_.travel);
  relations_.push_back({from, node, seen_from(nearest->X_MR, X_MR), known_});
  nodes_.push_back({X_OR, X_MR, X_MR, {scan.begin(), scan.end()}, sensor});
  way_at_loop_ = way_;
  complete_submaps();
  grow_submaps();
  close_loops(node);
}

// The older of the submaps that grow knows more.
std::optional<ScanMatch> Slam::lay(std::span<const SurfacePoint> scan, const Pose2& X_LR) const {
  const Submap& older = submaps_.size() > 1 && !submaps_[submaps_.size() - 2]->complete
                            ? *submaps_[submaps_.size() - 2]
                            : *submaps_.back();
  const PoseInformation travel = information_of(seen_from(nodes_.back().X_LR, X_LR), options_.travel);
  const Pose2& X_LA = nodes_[older.first].X_LR;
  const Pose2 guess = seen_from(X_LA, X_LR);
  const double way = std::clamp(3.0 / std::sqrt(std::min(travel.xx, travel.yy)), 0.1, 1.0);
  const double turn = std::clamp(3.0 / std::sqrt(travel.tt), 0.05, 0.6);
  const ScanSearch search(older.map.points());
  const auto found = search.best(scan, {guess, way, turn}, 0.0);
  std::optional<ScanMatch> match = refine(scan, older.map, guess, options_.match);
  const std::optional<ScanMatch> other =
      found ? refine(scan, older.map, found->X_MR, options_.match) : std::nullopt;
  if (other && (!match || other->fit > match->fit + 0.02)) match = other;
  if (!match || match->share < options_.least_share) return std::nullopt;
  match->X_MR = X_LA * match->X_MR;
  return match;
}

Pose2 Slam::see(std::span<const SurfacePoint> scan, const Pose2& X_OR, Vec2 sensor) {
  if (nodes_.empty()) {
    add_node(scan, X_OR, X_OR, std::nullopt);
    nodes_.back().sensor = sensor;
    return nodes_.back().X_MR;
  }
  const SlamNode& last = nodes_.back();
  const Pose2 X_LR = last.X_LR * seen_from(last.X_OR, X_OR);
  const Pose2 moved = seen_from(last.X_OR, X_OR);
  const Pose2 by_odometry = last.X_MR * moved;
  if (norm(moved.position()) < options_.node_way && std::fabs(moved.yaw) < options_.node_turn)
    return by_odometry;
  const std::optional<ScanMatch> match = lay(scan, X_LR);
  add_node(scan, X_OR, match ? match->X_MR : X_LR, match);
  nodes_.back().sensor = sensor;
  close_loops(nodes_.size() - 1);
  if (loops_ > loops_fitted_ && nodes_.size() >= fitted_ + options_.fit_every) work_in(kStepsOnTheWay);
  return nodes_.back().X_MR;
}

void Slam::add_node(std::span<const SurfacePoint> scan, const Pose2& X_OR, const Pose2& X_LR,
                    const std::optional<ScanMatch>& match) {
  const std::size_t node = nodes_.size();
  if (node == 0) {
    nodes_.push_back({X_OR, X_LR, X_LR, {scan.begin(), scan.end()}, {}});
  } else {
    const SlamNode& last = nodes_.back();
    const Pose2 moved = seen_from(last.X_LR, X_LR);
    way_ += norm(moved.position());
    const Pose2 by_odometry = seen_from(last.X_OR, X_OR);
    const PoseInformation travel = information_of(by_odometry, options_.travel);
    relations_.push_back({node - 1, node, by_odometry, travel});
    known_ = after(known_, by_odometry, travel);
    if (match) known_ = both(known_, match->information);
    nodes_.push_back({X_OR, X_LR, last.X_MR * moved, {scan.begin(), scan.end()}, {}});
    for (const auto& submap : submaps_)
      if (match && !submap->complete)
        relations_.push_back(
            {submap->first, node, seen_from(nodes_[submap->first].X_LR, X_LR), match->information});
  }
  // A scan that fits on no submap must not bend one either.
  if (!match) complete_submaps();
  grow_submaps();
}

void Slam::complete_submaps() {
  for (const auto& submap : submaps_) submap->complete = true;
}

void Slam::grow_submaps() {
  const std::size_t node = nodes_.size() - 1;
  if (submaps_.empty() || submaps_.back()->complete || submaps_.back()->count >= options_.submap / 2) {
    submaps_.push_back(std::make_unique<Submap>());
    submaps_.back()->first = node;
  }
  for (const auto& submap : submaps_) {
    if (submap->complete) continue;
    add_to(*submap, node);
    submap->map.prepare();
    submap->way = way_;
    submap->complete = submap->count >= options_.submap;
  }
}

void Slam::add_to(Submap& submap, std::size_t node) {
  const Pose2 X_AR = seen_from(nodes_[submap.first].X_LR, nodes_[node].X_LR);
  submap.map.add(nodes_[node].scan, X_AR);
  submap.middle =
      submap.middle + 1.0 / static_cast<double>(++submap.count) * (X_AR.position() - submap.middle);
}

PoseInformation Slam::known_at(const Pose2& X_OR) const {
  if (nodes_.empty()) return known_;
  const Pose2 moved = seen_from(nodes_.back().X_OR, X_OR);
  return after(known_, moved, information_of(moved, options_.travel));
}

// Keeps the searches that were used last.
const ScanSearch& Slam::search_of(Submap& submap) {
  constexpr std::size_t kMost = 16;
  std::erase(searched_, &submap);
  if (!submap.search) submap.search = std::make_unique<ScanSearch>(submap.map.points());
  searched_.push_back(&submap);
  if (searched_.size() > kMost) {
    searched_.front()->search.reset();
    searched_.erase(searched_.begin());
  }
  return *submap.search;
}

bool Slam::close_loop(std::size_t node, Submap& submap, double way, double turn) {
  const Pose2 guess = seen_from(nodes_[submap.first].X_MR, nodes_[node].X_MR);
  const auto& scan = nodes_[node].scan;
  // Where it is believed to be is tried first: the best place of a window may be one along the wall.
  std::optional<ScanMatch> match = refine(scan, submap.map, guess, options_.match);
  if (!match || match->share < options_.loop_share) {
    const auto found = search_of(submap).best(scan, {guess, way, turn}, options_.loop_score);
    match = found ? refine(scan, submap.map, found->X_MR, options_.match) : std::nullopt;
  }
  if (!match || match->share < options_.loop_share) return false;
  relations_.push_back({submap.first, node, match->X_MR, match->information, true});
  ++loops_;
  return true;
}

void Slam::close_loops(std::size_t node) {
  const double since = way_ - way_at_loop_;
  const double drift = options_.drift * since;
  struct Near {
    double distance;
    Submap* submap;
  };
  std::vector<Near> near;
  for (const auto& submap : submaps_) {
    if (!submap->complete || submap->first + 2 * options_.submap > node) continue;
    const double distance = norm(nodes_[submap->first].X_MR * submap->middle - nodes_[node].X_MR.position());
    if (distance <= options_.loop_reach + drift) near.push_back({distance, submap.get()});
  }
  std::ranges::stable_sort(near, {}, &Near::distance);
  if (near.size() > options_.loops_per_node) near.resize(options_.loops_per_node);
  bool seen_again = false;
  for (const Near& candidate : near) {
    // Near by first: in a house of equal rooms the best place of a wide window may be the next room.
    const bool fits = close_loop(node, *candidate.submap, kNearWay, kNearTurn);
    // A place that was just left ties the map together, but says nothing of what has drifted on the way round.
    if (way_ - candidate.submap->way < 2.0 * options_.loop_reach) continue;
    const double turn = std::min(kNearTurn + 0.005 * since, 0.8);
    seen_again |= fits || close_loop(node, *candidate.submap, std::min(kNearWay + drift, 7.0), turn);
  }
  if (seen_again) way_at_loop_ = way_;
}

void Slam::work_in(int iterations) {
  PoseGraph graph;
  for (const SlamNode& node : nodes_) graph.poses.push_back(node.X_MR);
  graph.relations = relations_;
  if (fit(graph, {.iterations = iterations}).solved)
    for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i].X_MR = graph.poses[i];
  fitted_ = nodes_.size();
  loops_fitted_ = loops_;
}

void Slam::finish() {
  complete_submaps();
  work_in(kStepsAtTheEnd);
  loops_ = 0;
  std::erase_if(relations_, [](const PoseRelation& relation) { return relation.doubtful; });
  for (const auto& submap : submaps_)
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
      if (node >= submap->first && node < submap->first + submap->count) continue;
      const Vec2 middle = nodes_[submap->first].X_MR * submap->middle;
      if (norm(middle - nodes_[node].X_MR.position()) <= options_.loop_reach)
        (void)close_loop(node, *submap, 0.2, 0.05);
    }
  work_in(kStepsAtTheEnd);
}

}  // namespace orca::nav
