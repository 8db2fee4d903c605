// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/map_localizer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orca/base/portable_math.hpp"
#include "orca/navigation/place_search.hpp"
#include "orca/navigation/sonar_model.hpp"

namespace orca::nav {
namespace {

constexpr std::size_t kLeastEchoes = 20;
constexpr double kSurely = 0.8;  // [1] share of a scan on the map for which no better place is looked for
constexpr std::size_t kParticles = 200;  // of a place that is known roughly
constexpr double kWide = 0.3;            // [m] beyond which particles are weighed before a scan is laid
constexpr double kWideTurn = 0.15;       // [rad]
constexpr double kLongWay = 0.5;         // [m], [rad]
constexpr double kClose = 0.2;  // [m] in which echoes look for their walls about a place that is known well
constexpr double kBody = 0.1;   // [m] that the middle of a robot is at least from what is occupied
constexpr double kMostSpread = 0.5;  // [m] up to which a place is known

double square(double x) { return x * x; }

// How far the place itself may be off.
double deviation_of(const PoseSpread& spread) {
  return std::sqrt(spread.covariance[0] + spread.covariance[4]);
}

PoseSpread widened(const PoseSpread& spread, double factor) {
  PoseSpread result = spread;
  for (double& entry : result.covariance) entry *= factor;
  return result;
}

// Whether a pose is farther from where a robot should be than wheels can be wrong.
// @param gone [m], [rad]  by how much it has moved since the scan before.
bool is_elsewhere(const PoseSpread& prior, const Pose2& pose, double gone) {
  constexpr double kPerWay = 0.3;
  const double bump = 0.3 + kPerWay * gone;  // [m], [rad]
  const Pose2 away = seen_from(prior.mean, pose);
  return norm(away.position()) > std::max(bump, 3.0 * deviation_of(prior)) ||
         std::fabs(away.yaw) > std::max(bump, 3.0 * std::sqrt(prior.covariance[8]));
}

// Whether two places are one.
bool is_same(const Pose2& one, const Pose2& other) {
  const Pose2 away = seen_from(one, other);
  return norm(away.position()) < 0.3 && std::fabs(away.yaw) < 0.2;
}

// Weighs particles by how near the echoes of a scan are to what is occupied.
void weigh(Particles& particles, const RobotScan& scan, const KnownMap& map) {
  constexpr double kSoft = 0.15;  // [m]
  constexpr double kElse = 0.1;   // by chance
  constexpr double kShare = 0.3;  // of the evidence of a beam, as neighbours show the same
  const std::vector<SurfacePoint> some = thinned(scan.echoes, 0.1, 60);
  particles.weigh([&](const Pose2& X_MR) {
    const Vec2 turned = direction(X_MR.yaw);
    double sum = 0.0;
    for (const SurfacePoint& point : some) {
      const double off = map.distance(X_MR.position() + rotated(point.at, turned));
      sum += portable::log(portable::exp(-0.5 * square(off / kSoft)) + kElse);
    }
    return std::max(1e-100, portable::exp(kShare * sum));
  });
}

// Lays a scan on the map, near where the robot should be. A place away from there must explain clearly more of the scan, and the more the
// farther it is: a piece of furniture that was moved explains a little more where it stood.
std::optional<ScanMatch> match(const RobotScan& scan, const KnownMap& map, const PoseSpread& prior,
                               const LocalizerOptions& options) {
  constexpr double kMostMargin = 0.15;  // [1] A slip of the wheels shows by it.
  MatchOptions close = options.match;
  close.reach = std::min(close.reach, kClose + 3.0 * deviation_of(prior));
  std::optional<ScanMatch> best =
      refine(scan.echoes, map.surface(), prior.mean, close, information_of(prior));
  // The prior decides what is looked at, but counts only once.
  close.reach = close.inlier;
  if (best) best = refine(scan.echoes, map.surface(), best->X_MR, close);
  if (best && best->share >= kSurely) return best;
  const double way = std::clamp(3.0 * deviation_of(prior), 0.3, 1.0);
  const double turn = std::clamp(3.0 * std::sqrt(prior.covariance[8]), 0.2, 0.5);
  const std::vector<SurfacePoint> some = thinned(scan.echoes, 0.1, 90);
  const auto found = map.search().best(some, {prior.mean, way, turn}, 0.0);
  if (!found) return best;
  close.reach = kClose;
  std::optional<ScanMatch> other = refine(scan.echoes, map.surface(), found->X_MR, close);
  if (!other || !best) return other ? other : best;
  const double margin = 0.5 * squared_distance(prior, other->X_MR) / options.evidence;
  return other->fit > best->fit + std::clamp(margin, options.apart, kMostMargin) ? other : best;
}

// Returns where a scan lies that was found by a search: by 10 cm and 4 degrees at worst, as the search looks more closely.
PoseSpread spread_of(const ScanMatch& laid) {
  PoseInformation known = laid.information;
  known.xx += 100.0;
  known.yy += 100.0;
  known.tt += 200.0;
  return {laid.X_MR, covariance_of(known, laid.X_MR.yaw)};
}

}  // namespace

/// A place where the robot may be.
struct MapLocalizer::Candidate {
  Particles particles;
  PlaceBelief belief;     // but for where
  double behind = 0.0;    // echoes behind the map's walls, those of long ago counting less
  double at_walls = 0.0;  // the same, with those on the walls

  /// @param weight  1: a whole scan.
  void note(double fit, double weight = 1.0) {
    constexpr double kQuick = 0.3;
    constexpr double kSlow = 0.03;
    belief.quick = belief.quick < 0.0 ? fit : belief.quick + kQuick * weight * (fit - belief.quick);
    belief.slow = belief.slow < 0.0 ? fit : belief.slow + kSlow * weight * (fit - belief.slow);
  }
  void note(const Explanation& seen) {
    constexpr double kForgotten = 0.03;  // with each scan
    behind += seen.longs - kForgotten * behind;
    at_walls += seen.hits + seen.longs - kForgotten * at_walls;
  }
  // People explain echoes in front of a wall, nobody explains those behind it.
  [[nodiscard]] bool sees_through_walls(const LocalizerOptions& options) const {
    return behind > options.most_behind * at_walls;
  }
  [[nodiscard]] bool is_doubtful(const LocalizerOptions& options) const {
    return belief.quick >= 0.0 &&
           (belief.quick < options.doubted_below || belief.quick < options.fallen * belief.slow);
  }
};

/// A search that goes on while the robot does.
struct MapLocalizer::GlobalSearch {
  std::shared_ptr<const KnownMap> map;  // in which it searches; it outlives the search
  RobotScan scan;
  Reckoned taken;
  PlaceSearch places;
};

MapLocalizer::MapLocalizer(std::shared_ptr<const KnownMap> map, const RandomStream& random,
                           const LocalizerOptions& options)
    : map_(std::move(map)), random_(random), options_(options) {}

MapLocalizer::~MapLocalizer() = default;

void MapLocalizer::change_map(std::shared_ptr<const KnownMap> map) {
  search_.reset();
  if (map_) doubt_all();
  for (Candidate& place : places_) place.behind = place.at_walls = 0.0;  // those were other walls
  map_ = std::move(map);
}

void MapLocalizer::add_place(const PlaceBelief& belief, std::size_t count) {
  Candidate& place = places_.emplace_back(Candidate{Particles(options_.particles), belief});
  place.particles.scatter(belief.where, count, random_);
  place.particles.shape(belief.where, random_);
}

void MapLocalizer::resume(std::span<const PlaceBelief> places, bool was_known, const Reckoned& now) {
  reckon_anew(now);
  left_some_out_ = suggested_ = false;
  places_.clear();
  for (const PlaceBelief& belief : places) add_place(belief, kParticles);
  was_known_ = was_known;
  seen_way_ = way_;
}

void MapLocalizer::suggest(const PoseSpread& where, const Reckoned& now) {
  resume(std::array{PlaceBelief{where}}, was_known_, now);
  suggested_ = true;
}

void MapLocalizer::place(const PoseSpread& where, const Reckoned& now) {
  resume(std::array{PlaceBelief{.where = where, .believed = true}}, true, now);
}

void MapLocalizer::move(const Reckoned& now) {
  if (!moved_) {
    settled_ = now_ = now;
    seen_time_ = now.time;
    moved_ = true;
    return;
  }
  // The clock was set back.
  if (now.time < now_.time) seen_time_ = searched_time_ = now.time;
  const Pose2 step = seen_from(now_.X_OR, now.X_OR);
  const double way = norm(step.position());
  way_ += way;
  changed_ += way + 0.5 * std::fabs(step.yaw);
  unsettled_ += way + std::fabs(step.yaw);
  now_ = now;
  // On a longer way the errors of its parts add up.
  if (unsettled_ > kLongWay) settle();
}

// Moves the particles to where odometry is.
void MapLocalizer::settle() {
  const std::array<double, 3> deviations = deviations_of(settled_, now_);
  const Pose2 step = seen_from(settled_.X_OR, now_.X_OR);
  for (Candidate& place : places_) place.particles.move(step, deviations, random_);
  settled_ = now_;
  unsettled_ = 0.0;
}

void MapLocalizer::reckon_anew(const Reckoned& now) {
  if (moved_) settle();
  search_.reset();
  counted_.clear();
  now_ = settled_ = now;
  seen_time_ = searched_time_ = now.time;
  moved_ = true;
  doubt_all();
}

void MapLocalizer::doubt_all() {
  for (Candidate& place : places_) {
    place.belief.quick = place.belief.slow = -1.0;
    place.belief.believed = false;
  }
}

bool MapLocalizer::is_time_for(std::size_t sensor, const Reckoned& now) const {
  if (counted_.size() <= sensor) return true;
  const Reckoned& last = counted_[sensor];
  const Pose2 step = seen_from(last.X_OR, now.X_OR);
  return now.time < last.time || now.time - last.time >= options_.check_time ||
         norm(step.position()) >= options_.update_way || std::fabs(step.yaw) >= options_.update_turn;
}

bool MapLocalizer::begin_update(std::size_t sensor) {
  seen_time_ = now_.time;
  if (!map_ || !moved_) return false;
  if (search_) go_on_searching();
  if (!is_time_for(sensor, now_)) return false;
  if (counted_.size() <= sensor) counted_.resize(sensor + 1, {-1e9, now_.X_OR, {}});
  const Pose2 step = seen_from(counted_[sensor].X_OR, now_.X_OR);
  gone_ = norm(step.position()) + std::fabs(step.yaw);
  counted_[sensor] = now_;
  settle();
  return true;
}

void MapLocalizer::see(const RobotScan& seen) {
  if (!begin_update(seen.sensor)) return;
  if (seen.echoes.size() < kLeastEchoes || seen.echoes.size() * 10 < seen.beams) return;
  seen_way_ = way_;
  if (offsets_.size() <= seen.sensor) offsets_.resize(seen.sensor + 1);
  const RobotScan scan{seen.sensor, seen.from, offsets_[seen.sensor].corrected(seen.echoes), seen.beams};
  std::vector<double> fits;
  for (Candidate& place : places_) {
    lay(place, scan);
    const Explanation explained = map_->explain(scan.echoes, scan.from, place.particles.spread().mean);
    fits.push_back(explained.fit);
    place.note(place.belief.believed ? explained.fit_of_room : explained.fit);
    place.note(explained);
  }
  compare(fits);
  believe(suggested_ ? options_.believed_at_once : options_.believed_from);
  if (options_.searches && !search_) begin_search(scan);
}

void MapLocalizer::lay(Candidate& place, const RobotScan& scan) {
  PoseSpread prior = place.particles.spread();
  if (deviation_of(prior) > kWide || std::sqrt(prior.covariance[8]) > kWideTurn) {
    weigh(place.particles, scan, *map_);
    place.particles.resample(random_);
    prior = place.particles.spread();
  }
  for (const std::size_t i : {0U, 4U, 8U}) prior.covariance[i] += 1e-6;
  const std::optional<ScanMatch> found = match(scan, *map_, prior, options_);
  if (!found || found->share < 0.25) return;
  // Only one place that is believed teaches how the map is off.
  SurfaceOffset offset = offsets_[scan.sensor];
  const PoseSpread seen = offset.learn(scan.echoes, map_->surface(), found->X_MR, options_.match);
  PoseSpread both = prior;
  for (std::size_t i = 0; i < 9; ++i) both.covariance[i] += seen.covariance[i];
  // Odometry may be more wrong than it knows: a bump, a slip. More than that is another place, of which the search decides.
  if (is_elsewhere(prior, seen.mean, gone_)) return;
  if (places_.size() == 1 && place.belief.believed) offsets_[scan.sensor] = offset;
  constexpr double kMost = 9.0;
  const double misfit = squared_distance(both, seen.mean);
  if (misfit > kMost) prior = widened(prior, misfit / kMost);
  place.particles.shape(fused(prior, seen), random_);
}

// A place that explains less of what is seen than another becomes unlikely; a little less says nothing, else one of two equal rooms would win.
void MapLocalizer::compare(std::span<const double> fits) {
  constexpr double kOtherView = 0.3;  // [m] The same view again says nothing new.
  if (places_.empty() || changed_ < kOtherView) return;
  changed_ = 0.0;
  const double best = std::ranges::max(fits);
  for (std::size_t i = 0; i < places_.size(); ++i)
    places_[i].belief.odds -= options_.evidence * std::max(0.0, best - fits[i] - options_.apart);
  drop_unlikely();
}

void MapLocalizer::drop_unlikely() {
  constexpr double kUnlikely = -5.3;  // 1 in 200
  std::ranges::stable_sort(places_, std::ranges::greater(),
                           [](const Candidate& place) { return place.belief.odds; });
  const double best = places_.front().belief.odds;
  for (Candidate& place : places_) place.belief.odds -= best;
  std::erase_if(places_, [](const Candidate& place) { return place.belief.odds < kUnlikely; });
  // Two that have come together are one.
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Pose2 here = places_[i].particles.spread().mean;
    for (std::size_t j = places_.size(); --j > i;) {
      if (is_same(here, places_[j].particles.spread().mean))
        places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(j));
    }
  }
}

void MapLocalizer::believe(double least) {
  // A search that found more places than it keeps may have left out the right one.
  constexpr double kAlone = 3.0;  // [m] on which it alone has fitted
  if (places_.size() != 1) alone_since_ = way_;
  if (places_.size() != 1 || (left_some_out_ && way_ - alone_since_ < kAlone)) return;
  Candidate& place = places_.front();
  if (place.belief.quick >= least && !place.sees_through_walls(options_)) place.belief.believed = true;
  was_known_ |= known(now_) == Known::localized;
}

// As long as no place is believed the right one need not be among them: along a bare corridor there are more than are kept.
void MapLocalizer::begin_search(const RobotScan& scan) {
  constexpr double kOtherPlace = 1.0;  // [m]
  const bool doubts = places_.empty() || places_.front().is_doubtful(options_);
  const bool is_due = way_ - searched_way_ >= kOtherPlace || (places_.size() == 1 && left_some_out_);
  const bool seeks = !doubts && !places_.front().belief.believed && is_due;
  if (!doubts && !seeks && !suggested_) return;
  constexpr double kAnew = 0.5;      // [m]
  constexpr double kAnewTime = 1.0;  // [s]
  const bool is_time =
      now_.time < searched_time_ || now_.time - searched_time_ >= kAnewTime || way_ - searched_way_ >= kAnew;
  if (!is_time) return;
  searched_time_ = now_.time;
  searched_way_ = way_;
  search_ = std::make_unique<GlobalSearch>(
      GlobalSearch{map_, scan, now_, PlaceSearch(*map_, thinned(scan.echoes, 0.1, 90))});
  go_on_searching();
}

void MapLocalizer::go_on_searching() {
  if (!search_->places.step(options_.looks)) return;
  const bool is_certain =
      known(now_) == Known::localized && places_.front().belief.quick >= options_.believed_from;
  // A place that all scans fit by now is not given up for what fitted one scan, some way ago.
  if (suggested_ || !is_certain) take_found();
  search_.reset();
}

// Puts particles where the scan of the search fits, moved by the way since. A place that is known already keeps the evidence of other scans.
void MapLocalizer::take_found() {
  left_some_out_ = search_->places.left_some_out();
  const RobotScan& scan = search_->scan;
  const Pose2 since = seen_from(search_->taken.X_OR, settled_.X_OR);
  const std::array<double, 3> deviations = deviations_of(search_->taken, settled_);
  MatchOptions close = options_.match;
  close.reach = kClose;
  const std::size_t known = places_.size();
  std::vector<double> evidence;
  for (Candidate& place : places_) {
    const Pose2 X_MR = place.particles.spread().mean * inverse(since);
    evidence.push_back(place.belief.odds);
    place.belief.odds += options_.evidence * map_->explain(scan.echoes, scan.from, X_MR).fit;
    if (suggested_) place.belief.odds += options_.suggested;
  }
  for (const Found& found : search_->places.found()) {
    const std::optional<ScanMatch> laid = refine(scan.echoes, map_->surface(), found.X_MR, close);
    if (!laid) continue;
    const Explanation explained = map_->explain(scan.echoes, scan.from, laid->X_MR);
    if (explained.fit < options_.doubted_below || map_->distance(laid->X_MR.position()) < kBody) continue;
    const PoseSpread where = after(spread_of(*laid), since, deviations);
    add_place({where, options_.evidence * explained.fit, explained.fit, explained.fit, false}, kParticles);
    Candidate& added = places_.back();
    added.note(explained);
    for (std::size_t i = 0; i < known; ++i) {
      if (!is_same(places_[i].particles.spread().mean, where.mean)) continue;
      added.belief.odds += evidence[i];
      added.behind += places_[i].behind;
      added.at_walls += places_[i].at_walls;
    }
  }
  if (places_.empty()) return;
  double best = places_.front().belief.odds;
  for (const Candidate& place : places_) best = std::max(best, place.belief.odds);
  for (Candidate& place : places_) {
    place.belief.odds = std::min(0.0, place.belief.odds - best + options_.evidence * options_.apart);
    place.belief.slow = place.belief.quick;
  }
  drop_unlikely();
  // Then the places that were left out are as unlikely as those that were dropped.
  if (std::exchange(suggested_, false) && places_.size() == 1) left_some_out_ = false;
  believe(options_.believed_from);
}

Known MapLocalizer::known(const Reckoned& now) const {
  const Known none = was_known_ ? Known::lost : Known::unknown;
  if (places_.empty()) return none;
  const double way = way_ + norm(now.X_OR.position() - now_.X_OR.position());
  if (way - seen_way_ > options_.blind_way || now.time - seen_time_ > options_.blind_time) return none;
  if (places_.size() > 1) return Known::ambiguous;
  const Candidate& place = places_.front();
  if (!place.belief.believed || place.is_doubtful(options_)) return none;
  return deviation_of(place.particles.spread()) <= kMostSpread ? Known::localized : Known::ambiguous;
}

std::vector<PlaceBelief> MapLocalizer::places(const Reckoned& now) const {
  const Pose2 step = seen_from(settled_.X_OR, now.X_OR);
  const std::array<double, 3> deviations = deviations_of(settled_, now);
  std::vector<PlaceBelief> result;
  for (const Candidate& place : places_) {
    result.push_back(place.belief);
    result.back().where = after(place.particles.spread(), step, deviations);
  }
  return result;
}

std::optional<PoseSpread> MapLocalizer::where(const Reckoned& now) const {
  if (places_.empty()) return std::nullopt;
  return after(places_.front().particles.spread(), seen_from(settled_.X_OR, now.X_OR),
               deviations_of(settled_, now));
}

// They show too little for a search: many places sound alike.
void MapLocalizer::hear(std::span<const SonarEcho> echoes) {
  if (!begin_update(kSonars)) return;
  const auto is_echo = [](const SonarEcho& echo) { return echo.range < echo.max_range; };
  if (std::ranges::none_of(echoes, is_echo)) return;
  seen_way_ = way_;
  constexpr double kOfScan = 0.2;  // A round says that much as a scan.
  for (Candidate& place : places_) {
    place.particles.weigh([&](const Pose2& X_MR) { return likelihood(echoes, *map_, X_MR); });
    place.particles.resample(random_);
    place.note(share_heard(echoes, *map_, place.particles.spread().mean), kOfScan);
  }
  believe(options_.believed_from);
}

}  // namespace orca::nav
