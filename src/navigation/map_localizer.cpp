// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/map_localizer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "orca/base/portable_math.hpp"

namespace orca::nav {
namespace {

constexpr std::size_t kLeastEchoes = 20;
constexpr double kSurely = 0.8;      // [1] share of a scan on the map for which no better place is looked for
constexpr double kWide = 0.3;        // [m] beyond which particles are weighed before a scan is laid
constexpr double kWideTurn = 0.15;   // [rad]
constexpr double kLongWay = 0.5;     // [m], [rad]
constexpr double kBody = 0.1;        // [m] that the middle of a robot is at least from what is occupied
constexpr double kMostSpread = 0.5;  // [m] up to which a place is known

double square(double x) { return x * x; }

// How far the place itself may be off.
double deviation_of(const PoseSpread& spread) {
  return std::sqrt(spread.covariance[0] + spread.covariance[4]);
}

PoseSpread spread_of(const ScanMatch& match) {
  // A direction that nothing holds is known to some metres.
  PoseInformation known = match.information;
  known.xx += 0.01;
  known.yy += 0.01;
  known.tt += 0.1;
  return {match.X_MR, covariance_of(known, match.X_MR.yaw)};
}

/// Takes one point of those that lie within `apart` of each other, and then at most `most`.
std::vector<SurfacePoint> thinned(std::span<const SurfacePoint> points, double apart, std::size_t most) {
  std::vector<SurfacePoint> some;
  for (const SurfacePoint& point : points)
    if (some.empty() || norm(point.at - some.back().at) >= apart) some.push_back(point);
  if (some.size() <= most) return some;
  std::vector<SurfacePoint> fewer;
  for (std::size_t i = 0; i < most; ++i) fewer.push_back(some[i * some.size() / most]);
  return fewer;
}

PoseSpread widened(const PoseSpread& spread, double factor) {
  PoseSpread result = spread;
  for (double& entry : result.covariance) entry *= factor;
  return result;
}

}  // namespace

/// A search that goes on while the robot does.
struct MapLocalizer::Search {
  std::shared_ptr<const KnownMap> map;  // in which it searches; it outlives the search
  RobotScan scan;
  Reckoned taken;
  PlaceSearch places;
};

std::array<double, 3> deviations_of(const Reckoned& before, const Reckoned& now) {
  const Pose2 step = seen_from(before.X_OR, now.X_OR);
  const double way = norm(step.position());
  const double turn = std::fabs(step.yaw);
  // What the errors so far make of the step is taken off; what is left is its own.
  const Vec2 chord = now.X_OR.position() - before.X_OR.position();
  const auto& a = before.covariance;
  const auto& b = now.covariance;
  const double xx = b[0] - (a[0] - 2.0 * chord.y * a[2] + square(chord.y) * a[8]);
  const double yy = b[4] - (a[4] + 2.0 * chord.x * a[5] + square(chord.x) * a[8]);
  const double place = std::sqrt(std::max(0.0, 0.5 * (xx + yy)));
  const double turned = std::sqrt(std::max(0.0, b[8] - a[8]));
  const double least = 0.002 + 0.02 * way + 0.01 * turn;
  const double least_turn = 0.003 + 0.05 * turn + 0.03 * way;
  const double most = least + 0.2 * way;
  const double most_turn = least_turn + 0.2 * turn + 0.1 * way;
  const double of_place = std::clamp(place, least, most);
  return {of_place, of_place, std::clamp(turned, least_turn, most_turn)};
}

MapLocalizer::MapLocalizer(std::shared_ptr<const KnownMap> map, const RandomStream& random,
                           const LocalizerOptions& options)
    : map_(std::move(map)), random_(random), options_(options) {}

MapLocalizer::~MapLocalizer() = default;

void MapLocalizer::change_map(std::shared_ptr<const KnownMap> map) {
  map_ = std::move(map);
  search_.reset();
  doubt_all();
}

MapLocalizer::Place MapLocalizer::place_at(const PoseSpread& where, std::size_t count) {
  Place place{Particles(options_.particles)};
  place.particles.scatter(where, count, random_);
  place.particles.shape(where);
  return place;
}

void MapLocalizer::suggest(const PoseSpread& where, const Reckoned& now) {
  move(now);
  settle();
  search_.reset();
  places_.clear();
  places_.push_back(place_at(where, 500));
  counted_.clear();
  seen_way_ = way_;
  seen_time_ = now.time;
}

void MapLocalizer::place(const PoseSpread& where, const Reckoned& now) {
  suggest(where, now);
  places_.front().believed = true;
  was_known_ = true;
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
  for (Place& place : places_) place.particles.move(step, deviations, random_);
  settled_ = now_;
  unsettled_ = 0.0;
}

void MapLocalizer::reckon_anew(const Reckoned& now) {
  settle();
  search_.reset();
  counted_.clear();
  now_ = settled_ = now;
  seen_time_ = searched_time_ = now.time;
  moved_ = true;
  doubt_all();
}

void MapLocalizer::doubt_all() {
  for (Place& place : places_) {
    place.quick = place.slow = -1.0;
    place.believed = false;
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
  if (counted_.size() <= sensor) counted_.resize(sensor + 1, {-1e9, {}, {}});
  counted_[sensor] = now_;
  settle();
  return true;
}

void MapLocalizer::see(const RobotScan& scan) {
  if (!begin_update(scan.sensor)) return;
  if (scan.echoes.size() < kLeastEchoes || scan.echoes.size() * 10 < scan.beams) return;
  seen_way_ = way_;
  std::vector<double> fits;
  for (Place& place : places_) {
    lay(place, scan);
    const Explanation explained = map_->explain(scan.echoes, scan.from, place.particles.spread().mean);
    fits.push_back(explained.fit);
    note(place, explained.fit);
  }
  compare(fits);
  believe();
  if (!search_ && (places_.empty() || doubts(places_.front()))) begin_search(scan);
}

void MapLocalizer::weigh(Place& place, const RobotScan& scan) const {
  constexpr double kSoft = 0.15;  // [m]
  constexpr double kElse = 0.1;   // by chance
  constexpr double kShare = 0.3;  // of the evidence of a beam, as neighbours tell the same
  const std::vector<SurfacePoint> some = thinned(scan.echoes, 0.1, 60);
  place.particles.weigh([&](const Pose2& X_MR) {
    const Vec2 turned = direction(X_MR.yaw);
    double sum = 0.0;
    for (const SurfacePoint& point : some) {
      const double off = map_->distance(X_MR.position() + rotated(point.at, turned));
      sum += portable::log(portable::exp(-0.5 * square(off / kSoft)) + kElse);
    }
    return std::max(1e-100, portable::exp(kShare * sum));
  });
}

std::optional<ScanMatch> MapLocalizer::match(const RobotScan& scan, const PoseSpread& prior) const {
  std::optional<ScanMatch> best = refine(scan.echoes, map_->surface(), prior.mean, options_.match);
  if (best && best->share >= kSurely) return best;
  const double way = std::clamp(3.0 * deviation_of(prior), 0.3, 1.0);
  const double turn = std::clamp(3.0 * std::sqrt(prior.covariance[8]), 0.2, 0.5);
  const std::vector<SurfacePoint> some = thinned(scan.echoes, 0.1, 90);
  const auto found = map_->search().best(some, {prior.mean, way, turn}, 0.0);
  if (!found) return best;
  std::optional<ScanMatch> other = refine(scan.echoes, map_->surface(), found->X_MR, options_.match);
  return other && (!best || other->fit > best->fit + 0.02) ? other : best;
}

void MapLocalizer::lay(Place& place, const RobotScan& scan) {
  PoseSpread prior = place.particles.spread();
  if (deviation_of(prior) > kWide || std::sqrt(prior.covariance[8]) > kWideTurn) {
    weigh(place, scan);
    place.particles.resample(random_);
    prior = place.particles.spread();
  }
  for (const std::size_t i : {0U, 4U, 8U}) prior.covariance[i] += 1e-6;
  const std::optional<ScanMatch> found = match(scan, prior);
  if (!found || found->share < 0.25) return;
  const PoseSpread seen = spread_of(*found);
  PoseSpread both = prior;
  for (std::size_t i = 0; i < 9; ++i) both.covariance[i] += seen.covariance[i];
  // Odometry may be more wrong than it knows: a bump, a slip.
  constexpr double kMost = 9.0;
  const double misfit = squared_distance(both, seen.mean);
  if (misfit > kMost) prior = widened(prior, misfit / kMost);
  place.particles.shape(fused(prior, seen));
}

void MapLocalizer::note(Place& place, double share) const {
  constexpr double kQuick = 0.3;
  constexpr double kSlow = 0.03;
  place.quick = place.quick < 0.0 ? share : place.quick + kQuick * (share - place.quick);
  place.slow = place.slow < 0.0 ? share : place.slow + kSlow * (share - place.slow);
}

bool MapLocalizer::doubts(const Place& place) const {
  return place.quick >= 0.0 &&
         (place.quick < options_.doubted_below || place.quick < options_.fallen * place.slow);
}

// A place that explains less of what is seen than another becomes unlikely; a little less says nothing, else one of two equal rooms would win.
void MapLocalizer::compare(std::span<const double> fits) {
  constexpr double kOtherView = 0.3;  // [m] The same view again says nothing new.
  if (places_.empty() || changed_ < kOtherView) return;
  changed_ = 0.0;
  const double best = std::ranges::max(fits);
  for (std::size_t i = 0; i < places_.size(); ++i)
    places_[i].odds -= options_.evidence * std::max(0.0, best - fits[i] - options_.apart);
  drop_unlikely();
}

void MapLocalizer::drop_unlikely() {
  constexpr double kUnlikely = -5.3;  // 1 in 200
  std::ranges::stable_sort(places_, std::ranges::greater(), &Place::odds);
  const double best = places_.front().odds;
  for (Place& place : places_) place.odds -= best;
  std::erase_if(places_, [](const Place& place) { return place.odds < kUnlikely; });
  // Two that have come together are one.
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Pose2 here = places_[i].particles.spread().mean;
    for (std::size_t j = places_.size(); --j > i;) {
      const Pose2 away = seen_from(here, places_[j].particles.spread().mean);
      if (norm(away.position()) >= 0.3 || std::fabs(away.yaw) >= 0.2) continue;
      places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(j));
    }
  }
}

void MapLocalizer::believe() {
  if (places_.size() != 1) return;
  Place& place = places_.front();
  if (place.quick >= options_.believed_from) place.believed = true;
  was_known_ |= known(now_) == Known::localized;
}

void MapLocalizer::begin_search(const RobotScan& scan) {
  constexpr double kAnew = 0.5;      // [m]
  constexpr double kAnewTime = 1.0;  // [s]
  const bool is_time =
      now_.time < searched_time_ || now_.time - searched_time_ >= kAnewTime || way_ - searched_way_ >= kAnew;
  if (!is_time) return;
  searched_time_ = now_.time;
  searched_way_ = way_;
  search_ =
      std::make_unique<Search>(Search{map_, scan, now_, PlaceSearch(*map_, thinned(scan.echoes, 0.1, 90))});
  go_on_searching();
}

void MapLocalizer::go_on_searching() {
  if (!search_->places.step(options_.looks)) return;
  take_found();
  search_.reset();
}

// Puts particles where the scan of the search fits, moved by the way since. A place that is known already keeps what it knows.
void MapLocalizer::take_found() {
  const RobotScan& scan = search_->scan;
  const Pose2 since = seen_from(search_->taken.X_OR, settled_.X_OR);
  for (const Found& found : search_->places.found()) {
    const std::optional<ScanMatch> laid = refine(scan.echoes, map_->surface(), found.X_MR, options_.match);
    if (!laid) continue;
    const Explanation explained = map_->explain(scan.echoes, scan.from, laid->X_MR);
    if (explained.fit < options_.doubted_below || map_->distance(laid->X_MR.position()) < kBody) continue;
    Place place = place_at({laid->X_MR * since, {0.01, 0.0, 0.0, 0.0, 0.01, 0.0, 0.0, 0.0, 0.005}}, 100);
    place.quick = place.slow = explained.fit;
    place.odds = options_.evidence * explained.fit;
    places_.push_back(std::move(place));
  }
  if (places_.empty()) return;
  std::ranges::stable_sort(places_, std::ranges::greater(), &Place::odds);
  const double best = places_.front().odds;
  for (Place& place : places_)
    place.odds = std::min(0.0, place.odds - best + options_.evidence * options_.apart);
  for (Place& place : places_) place.slow = place.quick;
  drop_unlikely();
  believe();
}

Known MapLocalizer::known(const Reckoned& now) const {
  const Known none = was_known_ ? Known::lost : Known::unknown;
  if (places_.empty()) return none;
  const double way = way_ + norm(now.X_OR.position() - now_.X_OR.position());
  if (way - seen_way_ > options_.blind_way || now.time - seen_time_ > options_.blind_time) return none;
  if (places_.size() > 1) return Known::ambiguous;
  const Place& place = places_.front();
  if (!place.believed || doubts(place)) return none;
  return deviation_of(place.particles.spread()) <= kMostSpread ? Known::localized : Known::ambiguous;
}

std::vector<PoseSpread> MapLocalizer::all_places(const Reckoned& now) const {
  const Pose2 step = seen_from(settled_.X_OR, now.X_OR);
  const std::array<double, 3> deviations = deviations_of(settled_, now);
  std::vector<PoseSpread> result;
  for (const Place& place : places_) result.push_back(after(place.particles.spread(), step, deviations));
  return result;
}

std::optional<PoseSpread> MapLocalizer::where(const Reckoned& now) const {
  if (places_.empty()) return std::nullopt;
  return after(places_.front().particles.spread(), seen_from(settled_.X_OR, now.X_OR),
               deviations_of(settled_, now));
}

void MapLocalizer::scatter_everywhere() {
  std::vector<Pose2> poses;
  const Lattice& lattice = map_->grid().lattice;
  std::vector<Cell> free;
  for (std::size_t i = 0; i < lattice.size(); ++i)
    if (map_->grid().free(lattice.cell_of(i))) free.push_back(lattice.cell_of(i));
  if (free.empty()) return;
  for (std::size_t i = 0; i < options_.particles.most; ++i) {
    const auto chosen = static_cast<std::size_t>(random_.uniform(0.0, static_cast<double>(free.size())));
    const Vec2 at = lattice.middle_of(free[std::min(chosen, free.size() - 1)]);
    poses.push_back({at.x, at.y, random_.uniform(-std::numbers::pi, std::numbers::pi)});
  }
  places_.clear();
  places_.push_back(Place{Particles(options_.particles)});
  places_.front().particles.put(poses);
}

namespace {

/// Returns how far a sonar would hear something of the map at the nearest.
double nearest_echo(const KnownMap& map, const SonarEcho& echo, const Pose2& X_MR) {
  const Pose2 X_MS = X_MR * echo.X_RS;
  double nearest = echo.max_range;
  for (const double share : {-0.7, 0.0, 0.7}) {
    const Sight sight =
        map.look(X_MS.position(), direction(X_MS.yaw + share * echo.half_lobe), echo.max_range);
    if (sight.end == Sight::End::wall) nearest = std::min(nearest, sight.range);
  }
  return nearest;
}

constexpr double kSonarError = 0.1;  // [m]

}  // namespace

// A smooth wall may give no echo at a slant, or the second one; a person may stand in front. Both are much more likely than that it is 1 m off.
double MapLocalizer::likelihood(const SonarEcho& echo, const Pose2& X_MR) const {
  const double expected = nearest_echo(*map_, echo, X_MR);
  const bool silent = echo.range >= echo.max_range;
  if (silent) return expected >= echo.max_range ? 0.9 : 0.4;
  const double off = echo.range - expected;
  return 0.8 * portable::exp(-0.5 * square(off / kSonarError)) + (off < 0.0 ? 0.1 : 0.2);
}

double MapLocalizer::heard_share(std::span<const SonarEcho> echoes, const Pose2& X_MR) const {
  Explanation explained;
  for (const SonarEcho& echo : echoes) {
    if (echo.range >= echo.max_range) continue;
    const double off = echo.range - nearest_echo(*map_, echo, X_MR);
    (std::fabs(off) <= 2.0 * kSonarError ? explained.hits
     : off < 0.0                         ? explained.shorts
                                         : explained.longs) += 1.0;
  }
  return explained.share();
}

void MapLocalizer::hear(std::span<const SonarEcho> echoes) {
  if (!begin_update(kSonars)) return;
  const auto heard =
      std::ranges::count_if(echoes, [](const SonarEcho& echo) { return echo.range < echo.max_range; });
  if (heard == 0) return;
  seen_way_ = way_;
  if (places_.empty()) scatter_everywhere();
  constexpr double kShare = 0.5;  // of the evidence of an echo, as neighbours hear the same
  for (Place& place : places_) {
    place.particles.weigh([&](const Pose2& X_MR) {
      double sum = 0.0;
      for (const SonarEcho& echo : echoes) sum += portable::log(likelihood(echo, X_MR));
      return portable::exp(kShare * sum);
    });
    place.particles.resample(random_);
    note(place, heard_share(echoes, place.particles.spread().mean));
  }
  believe();
}

}  // namespace orca::nav
