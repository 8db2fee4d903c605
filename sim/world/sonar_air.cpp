// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sonar_air.hpp"

#include <algorithm>
#include <numbers>

namespace orca::sim::detail {
namespace {

constexpr double kSoundSpeed = 343.0;  // [m/s] In air of 20 degrees Celsius.
// Older sound is too weak to be heard, or beyond the range of any ring.
constexpr double kFadesAfter = 0.040;  // [s]
// [m] A transducer sits in its robot's body, whose boundary is what a ray meets.
constexpr double kInBody = 0.1;

// Off what the sound of others may come to a listener.
class Ear {
 public:
  // Scatters sound to all sides.
  struct Point {
    Vec2 at;
    double length;  // [m] To the listener.
    double loss;    // [Np] Of what it sends there.
    enum class Sight { unknown, free, blocked } sight = Sight::unknown;
  };

  // A surface that mirrors, with what does not depend on where the sound comes from.
  struct Wall {
    Vec2 begin;
    Vec2 along;     // To its end.
    double square;  // [m^2] Of its length.
    double side;    // Of the listener: positive on the left of it [m^2];
    double at;      // and how far along the wall it is [m^2].
  };

  Ear(const Caster& caster, std::uint64_t own, const Beam& beam, const Echo& echo, double now)
      : caster_(caster), view_(echo.view), cone(own, beam, echo.reach, now) {
    for (const Surface& surface : echo.surfaces) {
      if (const auto* circle = std::get_if<Circle>(&surface)) posts.push_back(*circle);
      if (const auto* edge = std::get_if<Segment>(&surface)) {
        add(*edge);
        add(edge->a);
        add(edge->b);
      }
    }
  }

  // Asked once: it takes a cast.
  bool sees(Point& point) const {
    if (point.sight == Point::Sight::unknown)
      point.sight =
          sees(view_, cone.beam, point.at, point.length) ? Point::Sight::free : Point::Sight::blocked;
    return point.sight == Point::Sight::free;
  }
  // The same of another's beam.
  [[nodiscard]] bool is_seen(const Beam& beam, Vec2 point, double length) const {
    return sees(caster_, beam, point, length);
  }
  // True if nothing but the robot that carries the other transducer is on the way there.
  [[nodiscard]] bool sees_transducer(Vec2 way, double length) const {
    return view_.cast(cone.beam.ray((1.0 / length) * way)).range >=
           std::fmin(length - kInBody, cone.beam.max_range);
  }

 private:
  template <class Eye>
  static bool sees(const Eye& eye, const Beam& beam, Vec2 point, double length) {
    if (length > beam.max_range) return false;
    const Vec2 towards = (1.0 / length) * (point - beam.sensor.position());
    return eye.cast(beam.ray(towards)).range >= length - kSeen;
  }
  void add(const Segment& edge) {
    const Vec2 along = edge.b - edge.a;
    const Vec2 to = cone.beam.sensor.position() - edge.a;
    walls.push_back({edge.a, along, dot(along, along), cross(along, to), dot(along, to)});
  }
  // Walls that meet have their ends in common.
  void add(Vec2 end) {
    const Vec2 to = end - cone.beam.sensor.position();
    const auto is_end = [end](const Point& known) { return known.at == end; };
    if (!cone.holds(to) || std::ranges::any_of(points, is_end)) return;
    const double loss = kEdgeLoss + cone.loss(to);
    if (loss <= kMostLoss) points.push_back({end, norm(to), loss});
  }

  const Caster& caster_;
  const Caster::View& view_;

 public:
  SonarAir::Cone cone;
  std::vector<Wall> walls;
  std::vector<Circle> posts;
  std::vector<Point> points;
};

// Follows the ways from one transducer to another and keeps the shortest that arrives in the window.
class Ways {
 public:
  Ways(Ear& ear, const SonarAir::Cone& from, double head_start, std::optional<double> nearest)
      : ear_(ear), from_(from), head_start_(head_start), nearest_(nearest) {}

  // False if even the straight way is longer than what is heard already.
  [[nodiscard]] bool may_be_heard() const {
    if (!nearest_) return true;
    const Vec2 way = sender() - listener();
    const double longest = 2.0 * *nearest_ + head_start_;
    return dot(way, way) < longest * longest;
  }

  void follow() {
    straight();
    for (const Ear::Wall& wall : ear_.walls) off_mirror(wall);
    for (const Circle& post : ear_.posts) off_circle(post);
    for (Ear::Point& point : ear_.points) off_point(point);
  }

  [[nodiscard]] std::optional<double> nearest() const { return nearest_; }

 private:
  void straight() {
    const Vec2 way = sender() - listener();
    const double length = norm(way);
    if (length <= kInBody || !ear_.cone.holds(way) || !from_.holds(-1.0 * way) || !in_window(length)) return;
    if (ear_.cone.loss(way) + from_.loss(-1.0 * way) > kMostLoss) return;
    if (ear_.sees_transducer(way, length)) keep(length);
  }

  // Sound comes off a wall where it makes equal angles with it: there the distances of the two from the wall
  // divide what lies between them along it.
  void off_mirror(const Ear::Wall& wall) {
    const Vec2 to = sender() - wall.begin;
    const double side = cross(wall.along, to);
    if (side * wall.side <= 0.0) return;
    const double weight = std::fabs(side) + std::fabs(wall.side);
    const double place = std::fabs(side) * wall.at + std::fabs(wall.side) * dot(wall.along, to);
    if (place > 0.0 && place < weight * wall.square)
      off_spot(wall.begin + place / (weight * wall.square) * wall.along);
  }
  // Near enough where the two directions to its centre meet halfway.
  void off_circle(const Circle& circle) {
    if (!from_.may_hold(circle)) return;
    const Vec2 one = sender() - circle.center;
    const Vec2 other = listener() - circle.center;
    const Vec2 half = (1.0 / norm(one)) * one + (1.0 / norm(other)) * other;
    if (norm(half) > 0.0) off_spot(circle.center + (circle.radius / norm(half)) * half);
  }
  void off_point(Ear::Point& point) {
    const Vec2 way = point.at - sender();
    if (!from_.holds(way)) return;
    const double length = norm(way);
    if (!in_window(length + point.length) || point.loss + from_.loss(way) > kMostLoss) return;
    if (ear_.sees(point) && ear_.is_seen(from_.beam, point.at, length)) keep(length + point.length);
  }

  // A point of a surface that turns there from the one to the other.
  void off_spot(Vec2 spot) {
    const Vec2 to = spot - listener();
    if (!ear_.cone.holds(to) || !from_.holds(spot - sender())) return;
    Ear::Point point{spot, norm(to), ear_.cone.loss(to)};
    off_point(point);
  }
  [[nodiscard]] const Beam& beam() const { return ear_.cone.beam; }
  [[nodiscard]] Vec2 listener() const { return beam().sensor.position(); }
  [[nodiscard]] Vec2 sender() const { return from_.beam.sensor.position(); }
  [[nodiscard]] double taken_for(double length) const { return 0.5 * (length - head_start_); }
  [[nodiscard]] bool in_window(double length) const {
    const double range = taken_for(length);
    return 0.5 * length <= beam().max_range && range >= beam().min_range && (!nearest_ || range < *nearest_);
  }
  void keep(double length) { nearest_ = taken_for(length); }

  Ear& ear_;
  const SonarAir::Cone& from_;
  double head_start_;  // [m] How far the sound had gone already when the listener sent its own.
  std::optional<double> nearest_;
};

// The smallest circle around the sector, if that is narrow.
Circle circle_around(Vec2 tip, Vec2 axis, double half_angle, double reach) {
  if (half_angle > 0.25 * std::numbers::pi) return {tip, reach + kInBody};
  const double radius = 0.5 * reach / std::cos(half_angle);
  return {tip + radius * axis, radius + kInBody};
}

bool overlap(const Circle& one, const Circle& other) {
  const Vec2 apart = one.center - other.center;
  const double reach = one.radius + other.radius;
  return dot(apart, apart) <= reach * reach;
}

double seconds_of(TimePoint time) { return to_seconds(time.time_since_epoch()); }

}  // namespace

SonarAir::Cone::Cone(std::uint64_t chirp, const Beam& from, double goes, double sent_at)
    : number(chirp),
      beam(from),
      reach(goes),
      axis(direction(from.sensor.yaw)),
      tan_lobe(std::tan(from.half_lobe)),
      sector{from.sensor.position(),
             rotated(axis, from.half_lobe),
             rotated(axis, -from.half_lobe),
             circle_around(from.sensor.position(), axis, from.half_lobe, goes),
             sent_at,
             sent_at + std::fmin(kFadesAfter, (goes + 2.0 * kInBody) / kSoundSpeed)} {}

double SonarAir::Cone::loss(Vec2 towards) const {
  return lobe_loss(std::atan2(cross(axis, towards), dot(axis, towards)), beam.half_lobe);
}

std::uint64_t SonarAir::send(TimePoint time, const Beam& beam, double reach) {
  sectors_.add(cones_.emplace_back(sent_, beam, reach, seconds_of(time)).sector);
  farthest_ = std::fmax(farthest_, beam.max_range);
  return sent_++;
}

void SonarAir::settle(TimePoint now) {
  const double heard_from = seconds_of(now) - farthest_ / kSoundSpeed;
  std::erase_if(cones_, [heard_from](const Cone& cone) { return cone.sector.silent < heard_from; });
  sectors_.clear(seconds_of(now));
  for (const Cone& cone : cones_) sectors_.add(cone.sector);
}

std::optional<double> SonarAir::first_heard(const Caster& caster, const Beam& listener, std::uint64_t own,
                                            TimePoint since, const Echo& echo) const {
  const double now = seconds_of(since);
  Ear ear(caster, own, listener, echo, now);
  std::optional<double> nearest = echo.range;
  // A way is no longer than both cones. Single precision only rules out: what it leaves is judged exactly.
  const double silent_from = now - (ear.cone.reach - 2.0 * listener.min_range) / kSoundSpeed;
  for (const std::uint32_t i : sectors_.near(ear.cone.sector, silent_from, now)) {
    const Cone& cone = cones_[i];
    const double head_start = now - cone.sector.sent;
    const bool in_time = head_start >= 0.0 && head_start <= kFadesAfter && cone.sector.silent >= silent_from;
    if (cone.number == own || !in_time || !overlap(cone.sector.around, ear.cone.sector.around)) continue;
    Ways ways(ear, cone, kSoundSpeed * head_start, nearest);
    if (ways.may_be_heard()) ways.follow();
    nearest = ways.nearest();
  }
  return nearest;
}

}  // namespace orca::sim::detail
