// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/map_localizer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orca/navigation/place_search.hpp"
#include "orca/navigation/sonar_model.hpp"

namespace orca::nav {
namespace {

constexpr std::size_t kLeastEchoes = 20;
constexpr std::size_t kParticles = 200;  // of a place that is known roughly
constexpr double kWide = 0.3;            // [m] beyond which particles are weighed before a scan is laid
constexpr double kWideTurn = 0.15;       // [rad]
constexpr double kLongWay = 0.5;         // [m], [rad]
constexpr double kBody = 0.1;            // [m] that the middle of a robot is at least from what is occupied
constexpr double kMostSpread = 0.5;      // [m] up to which a place is known

double square(double x) { return x * x; }

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

}  // namespace

/// A place where the robot may be.
struct MapLocalizer::Candidate {
  Particles particles;
  PlaceBelief belief;  // but for where
  SeenThrough through{};
  bool stayed = false;  // The robot is there by its wheels since it was known last.
  Rivals rivals{};

  // Returns how well the place is known.
  [[nodiscard]] PoseSpread spread() const { return rivals.with(particles.spread()); }
  void move(const Pose2& step, const std::array<double, 3>& deviations, RandomStream& random) {
    particles.move(step, deviations, random);
    rivals.move(step, deviations);
  }
  /// @param weight  1: a whole scan.
  void note(double fit, double weight = 1.0) {
    constexpr double kQuick = 0.3;
    constexpr double kSlow = 0.03;
    belief.quick = belief.quick < 0.0 ? fit : belief.quick + kQuick * weight * (fit - belief.quick);
    belief.slow = belief.slow < 0.0 ? fit : belief.slow + kSlow * weight * (fit - belief.slow);
  }
  // Furniture that was moved, and people, speak in each view against the place where the robot is: a tenth of that counts.
  [[nodiscard]] double share_of_lack() const { return stayed ? 0.1 : 1.0; }
  // People explain echoes in front of a wall, nobody explains those behind it.
  [[nodiscard]] bool sees_through_walls(const LocalizerOptions& options) const {
    return through.is_more_than(options.most_behind);
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
  left_.reset();
  if (map_) doubt_all();
  for (Candidate& place : places_) place.through = {};  // those were other walls
  map_ = std::move(map);
}

void MapLocalizer::add_place(const PlaceBelief& belief, std::size_t count) {
  Candidate& place = places_.emplace_back(Candidate{Particles(options_.particles), belief});
  place.particles.scatter(belief.where, count, random_);
  place.particles.shape(belief.where, random_);
}

void MapLocalizer::resume(std::span<const PlaceBelief> places, bool was_known, const Reckoned& now,
                          const std::vector<SurfaceOffset>& offsets) {
  if (!offsets.empty()) offsets_ = offsets;
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
  for (Candidate& place : places_) place.move(step, deviations, random_);
  settled_ = now_;
  unsettled_ = 0.0;
}

void MapLocalizer::reckon_anew(const Reckoned& now) {
  if (moved_) settle();
  search_.reset();
  left_.reset();
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
    place.rivals.clear();
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
    place.through.note(explained);
    place.rivals.judge(scan, *map_, explained, options_);
  }
  compare(fits);
  believe(suggested_ ? options_.believed_at_once : options_.believed_from);
  if (known(now_) == Known::localized) {
    left_ = {places_.front().particles.spread(), settled_};
    places_.front().stayed = false;
  }
  if (options_.searches && !search_) begin_search(scan);
}

void MapLocalizer::lay(Candidate& place, const RobotScan& scan) {
  PoseSpread prior = place.particles.spread();
  const PoseSpread expected = prior;
  const bool is_wide = deviation_of(prior) > kWide || std::sqrt(prior.covariance[8]) > kWideTurn;
  if (is_wide) {
    const std::vector<SurfacePoint> some = thinned(scan.echoes, 0.1, 60);
    place.particles.weigh([&](const Pose2& X_MR) { return likelihood(some, *map_, X_MR); });
    place.particles.resample(random_);
    prior = place.particles.spread();
  }
  for (const std::size_t i : {0U, 4U, 8U}) prior.covariance[i] += 1e-6;
  const std::optional<ScanMatch> found = lay_near(scan.echoes, *map_, prior, options_.match, options_.margin);
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
  constexpr double kContradiction = 25.0;  // Wheels that slip are off by up to five of their deviations.
  const double misfit = squared_distance(both, seen.mean);
  if (is_wide && place.belief.believed) place.rivals.look_about(expected, *found, scan, *map_, options_);
  if (misfit > kMost) {
    if (place.belief.believed && misfit > kContradiction) place.rivals.contradict(prior);
    prior = widened(prior, misfit / kMost);
  }
  place.particles.shape(fused(prior, seen), random_);
}

// A place that explains less of what is seen than another becomes unlikely; a little less says nothing, else one of two equal rooms would win.
void MapLocalizer::compare(std::span<const double> fits) {
  constexpr double kOtherView = 0.3;  // [m] The same view again says nothing new.
  if (places_.empty() || changed_ < kOtherView) return;
  changed_ = 0.0;
  const double best = std::ranges::max(fits);
  for (std::size_t i = 0; i < places_.size(); ++i)
    places_[i].belief.odds -= places_[i].share_of_lack() * options_.margin.evidence *
                              std::max(0.0, best - fits[i] - options_.margin.apart);
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

// Nobody has carried the robot, as a rule: where it is by its wheels is likelier than another place that shows the same, and is one of the places
// even if the scan by which it was doubted did not fit there.
void MapLocalizer::count_stayed() {
  constexpr double kOff = 0.4;      // [m] by which the place may have been wrong already
  constexpr double kOffTurn = 0.2;  // [rad]
  if (!left_ || suggested_) return;
  const auto& [map, scan, taken, places] = *search_;
  PoseSpread stayed =
      after(left_->where, seen_from(left_->at.X_OR, taken.X_OR), deviations_of(left_->at, taken));
  if (deviation_of(stayed) > kMostSpread) return left_.reset();
  const Pose2 since = seen_from(taken.X_OR, settled_.X_OR);
  const auto is_there = [&](const Pose2& X_MR) {
    const Pose2 away = seen_from(stayed.mean * since, X_MR);
    return norm(away.position()) < kOff && std::fabs(away.yaw) < kOffTurn;
  };
  bool is_known = false;
  for (Candidate& place : places_) {
    if (!is_there(place.particles.spread().mean)) continue;
    if (!std::exchange(place.stayed, true)) place.belief.odds += options_.suggested;
    is_known = true;
  }
  if (is_known) return;
  for (const std::size_t i : {0U, 4U}) stayed.covariance[i] += square(kOff / 3.0);
  const auto laid = lay_near(scan.echoes, *map_, stayed, options_.match, options_.margin);
  if (!laid || !is_there(laid->X_MR * since)) return;
  const Explanation explained = map_->explain(scan.echoes, scan.from, laid->X_MR);
  if (explained.fit < options_.doubted_below) return;
  const double odds = options_.margin.evidence * explained.fit + options_.suggested;
  const PoseSpread where = after(spread_of(*laid), since, deviations_of(taken, settled_));
  add_place({where, odds, explained.fit, explained.fit, false}, kParticles);
  places_.back().through.note(explained);
  places_.back().stayed = true;
}

// Puts particles where the scan of the search fits, moved by the way since. A place that is known already keeps the evidence of other scans.
void MapLocalizer::take_found() {
  left_some_out_ = search_->places.left_some_out();
  const RobotScan& scan = search_->scan;
  const Pose2 since = seen_from(search_->taken.X_OR, settled_.X_OR);
  const std::array<double, 3> deviations = deviations_of(search_->taken, settled_);
  MatchOptions close = options_.match;
  close.reach = kCloseReach;
  const std::size_t known = places_.size();
  std::vector<double> evidence;
  for (Candidate& place : places_) {
    const Pose2 X_MR = place.particles.spread().mean * inverse(since);
    evidence.push_back(place.belief.odds);
    place.belief.odds += options_.margin.evidence * map_->explain(scan.echoes, scan.from, X_MR).fit;
    if (suggested_) place.belief.odds += options_.suggested;
  }
  for (const Found& found : search_->places.found()) {
    const std::optional<ScanMatch> laid = refine(scan.echoes, map_->surface(), found.X_MR, close);
    if (!laid) continue;
    const Explanation explained = map_->explain(scan.echoes, scan.from, laid->X_MR);
    if (explained.fit < options_.doubted_below || map_->distance(laid->X_MR.position()) < kBody) continue;
    const PoseSpread where = after(spread_of(*laid), since, deviations);
    add_place({where, options_.margin.evidence * explained.fit, explained.fit, explained.fit, false},
              kParticles);
    Candidate& added = places_.back();
    added.through.note(explained);
    for (std::size_t i = 0; i < known; ++i) {
      if (!is_same(places_[i].particles.spread().mean, where.mean)) continue;
      added.belief.odds += evidence[i];
      added.through.add(places_[i].through);
    }
  }
  count_stayed();
  if (places_.empty()) return;
  double best = places_.front().belief.odds;
  for (const Candidate& place : places_) best = std::max(best, place.belief.odds);
  for (Candidate& place : places_) {
    const double lack = best - place.belief.odds - options_.margin.evidence * options_.margin.apart;
    place.belief.odds = -place.share_of_lack() * std::max(0.0, lack);
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
    result.back().where = after(place.spread(), step, deviations);
  }
  return result;
}

std::optional<PoseSpread> MapLocalizer::where(const Reckoned& now) const {
  if (places_.empty()) return std::nullopt;
  return after(places_.front().spread(), seen_from(settled_.X_OR, now.X_OR), deviations_of(settled_, now));
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
