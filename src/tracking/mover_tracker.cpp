// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/tracking/mover_tracker.hpp"

#include <algorithm>
#include <utility>

namespace orca::tracking {
namespace {

constexpr double kGap = 0.4;            // [m] between readings of one person: the legs in a stride
constexpr double kWidest = 0.8;         // [m] across a new mover
constexpr double kBeside = 0.3;         // [m]
constexpr double kOwn = 0.5;            // [m] around a mover in which readings are its own
constexpr double kReadingError = 0.07;  // [m] of the middle of a person from readings of the legs
constexpr int kSure =
    4;  // A sighting on floor that was seen free is worth as many on floor that was only open.
constexpr int kSightings = 5 * kSure;  // before it is reported
constexpr double kClear = 2.0;         // standard deviations by which its speed must differ from 0
constexpr double kLongestStep = 1.0;   // [s] between scans; after a longer silence all begins anew

Vec2 mean_of(std::span<const Vec2> points) {
  Vec2 sum;
  for (const Vec2 point : points) sum = sum + point;
  return (1.0 / static_cast<double>(points.size())) * sum;
}

double half_width_of(std::span<const Vec2> points) {
  double widest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = i + 1; k < points.size(); ++k)
      widest = std::max(widest, norm(points[k] - points[i]));
  return 0.5 * widest;
}

// Takes out of `points` all that hang together with the last one.
std::vector<Vec2> take_group(std::vector<Vec2>& points) {
  std::vector<Vec2> group{points.back()};
  points.pop_back();
  for (std::size_t i = 0; i < group.size(); ++i) {
    const auto near = [&](Vec2 point) { return norm(point - group[i]) <= kGap; };
    const auto rest = std::stable_partition(points.begin(), points.end(), [&](Vec2 p) { return !near(p); });
    group.insert(group.end(), rest, points.end());
    points.erase(rest, points.end());
  }
  return group;
}

}  // namespace

void MoverTracker::clear() { *this = {}; }

void MoverTracker::see(std::span<const nav::Beam> scan, double time) {
  if (begun_ && (time <= time_ || time - time_ > kLongestStep)) clear();
  const double elapsed = begun_ ? time - time_ : 0.0;
  begun_ = true;
  time_ = time;
  find_fresh(scan, time);
  floor_.see(scan, time);
  predict(elapsed);
  update(time, elapsed);
  begin_new(time);
}

void MoverTracker::find_fresh(std::span<const nav::Beam> scan, double time) {
  fresh_.clear();
  still_.clear();
  for (const nav::Beam& beam : scan) {
    if (!beam.echo || norm(beam.to - beam.from) > kRange) continue;
    const bool is_fresh = floor_.was_free(beam.to, time) || floor_.was_open(beam.to, time);
    (is_fresh ? fresh_ : still_).push_back(beam.to);
  }
}

void MoverTracker::predict(double elapsed) {
  for (Track& track : tracks_) track.walk.predict(elapsed);
}

// Gives each fresh reading to the nearest mover, and leaves in fresh_ those that nobody has.
void MoverTracker::update(double time, double elapsed) {
  std::vector<std::vector<Vec2>> own(tracks_.size());
  std::vector<Vec2> others;
  for (const Vec2 point : fresh_) {
    double least = kOwn;
    std::size_t owner = tracks_.size();
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const double apart = norm(point - tracks_[i].walk.place);
      if (apart >= least) continue;
      least = apart;
      owner = i;
    }
    (owner < tracks_.size() ? own[owner] : others).push_back(point);
  }
  fresh_ = std::move(others);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    Track& track = tracks_[i];
    if (!own[i].empty()) {
      correct(track, own[i], time);
    } else if (floor_.is_seen_free(track.walk.place)) {
      track.missed_for += elapsed;
    }
  }
  std::erase_if(tracks_, [&](const Track& track) {
    const double longest = track.number == 0 ? kMissed : kUnseen;
    return track.missed_for > kMissed || time - track.seen_at > longest;
  });
}

void MoverTracker::correct(Track& track, std::span<const Vec2> own, double time) {
  track.walk.correct(mean_of(own), kReadingError);
  track.half_width = half_width_of(own);
  track.seen_at = time;
  track.missed_for = 0.0;
  const auto sure = std::ranges::count_if(own, [&](Vec2 point) { return floor_.was_free(point, time); });
  track.sightings += 2 * static_cast<std::size_t>(sure) >= own.size() ? kSure : 1;
  const double speed = norm(track.walk.velocity);
  const bool moves = track.sightings >= kSightings && norm(track.walk.place - track.born) >= kWay &&
                     speed >= kSlowest && speed >= kClear * track.walk.velocity_error();
  if (moves && track.number == 0) track.number = ++last_number_;
}

// A wall that odometry has shifted sticks out in a few places only.
bool MoverTracker::is_part_of_furniture(std::span<const Vec2> group) const {
  const auto beside = std::ranges::count_if(still_, [&](Vec2 point) {
    return std::ranges::any_of(group, [&](Vec2 own) { return norm(point - own) <= kBeside; });
  });
  return static_cast<std::size_t>(beside) > group.size();
}

void MoverTracker::begin_new(double time) {
  while (!fresh_.empty()) {
    const std::vector<Vec2> group = take_group(fresh_);
    const double half_width = half_width_of(group);
    if (group.size() < 2 || 2.0 * half_width > kWidest || is_part_of_furniture(group)) continue;
    Track track;
    track.born = mean_of(group);
    track.walk = WalkEstimate::at(track.born, kReadingError);
    track.seen_at = time;
    track.sightings = 1;
    track.half_width = half_width;
    tracks_.push_back(track);
  }
}

std::vector<Mover> MoverTracker::movers() const {
  std::vector<Mover> found;
  for (const Track& track : tracks_)
    if (track.number != 0)
      found.push_back({track.number, track.walk.place, track.walk.velocity, std::max(kBody, track.half_width),
                       track.walk.place_error(), track.walk.velocity_error(), time_ - track.seen_at});
  return found;
}

}  // namespace orca::tracking
