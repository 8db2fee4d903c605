// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sonar_air.hpp"

#include <algorithm>
#include <array>

namespace orca::sim::detail {
namespace {

constexpr double kSoundSpeed = 343.0;  // [m/s] In air of 20 degrees Celsius.
// Sound older than this is too weak to be heard, or beyond the range of any ring.
constexpr double kFadesAfter = 0.040;  // [s]
// [m] Largest depth of a transducer in its robot's body, whose boundary the rays meet.
constexpr double kInBody = 0.1;
// About this many elements that no chirp in the air meets are kept.
constexpr std::size_t kMostForgotten = 1000;

double seconds_of(TimePoint time) { return to_seconds(time.time_since_epoch()); }

}  // namespace

// The points and walls off which the sound of other sonars can reach one listener.
class SonarAir::Ear {
 public:
  // A point that scatters sound to all sides.
  struct Point {
    Vec2 at;
    double length;  // [m] Distance to the listener.
    double loss;    // [Np] Loss between the point and the listener.
    enum class Sight { unknown, free, blocked } sight = Sight::unknown;
  };
  // A surface that mirrors, with the values that do not depend on where the sound comes from.
  struct Wall {
    Vec2 begin;
    Vec2 along;     // [m] From its beginning to its end.
    double square;  // [m^2] Square of its length.
    double side;  // [m^2] Cross product of `along` and the listener seen from `begin`: positive on the left.
    double at;    // [m^2] Dot product of the same two.
    std::array<std::optional<Point>, 2> ends;  // The ends that are heard.
  };

  Ear(const Caster& caster, const Cone& own, const Panorama& view)
      : cone(own), caster_(caster), view_(view) {}

  [[nodiscard]] Wall wall(const Segment& edge) const {
    const Vec2 along = edge.b - edge.a;
    const Vec2 to = cone.beam.sensor.position() - edge.a;
    return {edge.a,           along,          dot(along, along),
            cross(along, to), dot(along, to), {scattering(edge.a), scattering(edge.b)}};
  }
  // Returns true if the listener sees the point. The answer is kept, because it is needed often.
  bool sees(Point& point) const {
    if (point.sight == Point::Sight::unknown)
      point.sight = point.length <= cone.beam.max_range && view_.shows(point.at, kSeen)
                        ? Point::Sight::free
                        : Point::Sight::blocked;
    return point.sight == Point::Sight::free;
  }
  // Returns true if the transducer of another beam sees the point.
  [[nodiscard]] bool is_seen(const Beam& beam, Vec2 point, double length) const {
    if (length > beam.max_range) return false;
    const Vec2 towards = (1.0 / length) * (point - beam.sensor.position());
    return caster_.cast(beam.ray(towards)).range >= length - kSeen;
  }
  // Returns true if nothing but the robot that carries the other transducer is on the way there.
  [[nodiscard]] bool sees_transducer(Vec2 place) const { return view_.shows(place, kInBody); }

  const Cone& cone;

 private:
  [[nodiscard]] std::optional<Point> scattering(Vec2 end) const {
    const Vec2 to = end - cone.beam.sensor.position();
    if (!cone.holds(to)) return std::nullopt;
    const Lobe& lobe = cone.beam.lobe;
    const double loss = lobe.edge_loss + cone.loss(to);
    if (loss > lobe.most_loss) return std::nullopt;
    return Point{end, norm(to), loss};
  }

  const Caster& caster_;
  const Panorama& view_;
};

// Follows the ways from one transducer to another and keeps the shortest that arrives in the window.
class SonarAir::Ways {
 public:
  // @param nearest  range [m] of what is heard already; shorter ways replace it.
  Ways(const Ear& ear, const Cone& from, std::optional<double>& nearest)
      : ear_(ear),
        from_(from),
        head_start_(kSoundSpeed * (ear.cone.sector.sent - from.sector.sent)),
        nearest_(nearest) {}

  // Returns false if even the straight way is longer than what is heard already.
  [[nodiscard]] bool may_be_heard() const {
    if (!nearest_) return true;
    const Vec2 way = sender() - listener();
    const double longest = 2.0 * *nearest_ + head_start_;
    return dot(way, way) < longest * longest;
  }

  void straight() {
    const Vec2 way = sender() - listener();
    const double length = norm(way);
    if (length <= kInBody || !ear_.cone.holds(way) || !from_.holds(-1.0 * way) || !in_window(length)) return;
    if (ear_.cone.loss(way) + from_.loss(-1.0 * way) > most_loss()) return;
    if (ear_.sees_transducer(sender())) keep(length);
  }

  // Tries the ways off a wall's flat side and off its ends.
  void off_wall(Ear::Wall& wall) {
    off_mirror(wall);
    for (auto& end : wall.ends)
      if (end) off_point(*end);
  }

  // Tries the way off a circle. The point halfway between the directions to both transducers is near enough.
  void off_circle(const Circle& circle) {
    const Vec2 one = sender() - circle.center;
    const Vec2 other = listener() - circle.center;
    const Vec2 half = (1.0 / norm(one)) * one + (1.0 / norm(other)) * other;
    if (norm(half) > 0.0) off_spot(circle.center + (circle.radius / norm(half)) * half);
  }

 private:
  // Tries the way that a wall mirrors. Both parts of it make equal angles with the wall, so the reflection
  // point divides the distance along the wall in the ratio of the two distances from the wall.
  void off_mirror(const Ear::Wall& wall) {
    const Vec2 to = sender() - wall.begin;
    const double side = cross(wall.along, to);
    if (side * wall.side <= 0.0) return;
    const double weight = std::fabs(side) + std::fabs(wall.side);
    const double place = std::fabs(side) * wall.at + std::fabs(wall.side) * dot(wall.along, to);
    if (place > 0.0 && place < weight * wall.square)
      off_spot(wall.begin + place / (weight * wall.square) * wall.along);
  }
  void off_point(Ear::Point& point) {
    const Vec2 way = point.at - sender();
    if (!from_.holds(way)) return;
    const double length = norm(way);
    if (!in_window(length + point.length) || point.loss + from_.loss(way) > most_loss()) return;
    if (ear_.sees(point) && ear_.is_seen(from_.beam, point.at, length)) keep(length + point.length);
  }

  // Tries the way off a point at which a surface turns the sound towards the listener.
  void off_spot(Vec2 spot) {
    const Vec2 to = spot - listener();
    if (!ear_.cone.holds(to) || !from_.holds(spot - sender())) return;
    Ear::Point point{spot, norm(to), ear_.cone.loss(to)};
    off_point(point);
  }
  [[nodiscard]] const Beam& beam() const { return ear_.cone.beam; }
  [[nodiscard]] double most_loss() const { return beam().lobe.most_loss; }
  [[nodiscard]] Vec2 listener() const { return beam().sensor.position(); }
  [[nodiscard]] Vec2 sender() const { return from_.beam.sensor.position(); }
  [[nodiscard]] double taken_for(double length) const { return 0.5 * (length - head_start_); }
  [[nodiscard]] bool in_window(double length) const {
    const double range = taken_for(length);
    return 0.5 * length <= beam().max_range && range >= beam().min_range && (!nearest_ || range < *nearest_);
  }
  void keep(double length) { nearest_ = taken_for(length); }

  const Ear& ear_;
  const Cone& from_;
  double head_start_;  // [m] Distance that the sound had gone when the listener sent its own.
  std::optional<double>& nearest_;
};

SonarAir::Cone::Cone(std::uint64_t chirp, const Beam& from, double goes, double sent_at)
    : number(chirp),
      beam(from),
      reach(goes),
      sector(from, sent_at, sent_at + std::fmin(kFadesAfter, (goes + 2.0 * kInBody) / kSoundSpeed)) {}

std::uint64_t SonarAir::send(TimePoint time, const Beam& beam, const Echo& echo) {
  sectors_.add(cones_.emplace_back(sent_, beam, echo.reach, seconds_of(time)).sector, sent_);
  farthest_ = std::fmax(farthest_, beam.max_range);
  for (const Echo::Met& met : echo.met) {
    std::vector<std::uint64_t>& numbers = met_[met.element];
    numbers.erase(numbers.begin(), std::ranges::lower_bound(numbers, cones_.front().number));
    if (numbers.empty() || numbers.back() != sent_) numbers.push_back(sent_);
  }
  return sent_++;
}

void SonarAir::settle(TimePoint now) {
  const double heard_from = seconds_of(now) - farthest_ / kSoundSpeed;
  while (!cones_.empty() && cones_.front().sector.silent < heard_from) cones_.pop_front();
  forget_elements();
  sectors_.clear(seconds_of(now));
  for (const Cone& cone : cones_)
    if (cone.sector.silent >= heard_from) sectors_.add(cone.sector, cone.number);
}

// Discards elements that no chirp in the air meets, once there are many. Elements come and go with bodies.
void SonarAir::forget_elements() {
  if (met_.size() < forget_at_) return;
  const std::uint64_t oldest = cones_.empty() ? sent_ : cones_.front().number;
  std::erase_if(met_, [oldest](const auto& element) { return element.second.back() < oldest; });
  forget_at_ = kMostForgotten + 2 * met_.size();
}

bool SonarAir::is_in(const Window& window, const Cone& cone) const {
  const double age = window.now - cone.sector.sent;
  return cone.number != window.own && age >= 0.0 && age <= kFadesAfter &&
         cone.sector.silent >= window.silent_from;
}

// Calls visit(cone) for all cones that meet the element and can be heard.
template <class Visit>
void SonarAir::for_all_off(std::uint64_t element, const Window& window, const Visit& visit) const {
  const auto found = met_.find(element);
  if (found == met_.end()) return;
  const std::uint64_t oldest = cones_.front().number;
  for (const std::uint64_t number : found->second) {
    if (number < oldest) continue;
    const Cone& cone = cones_[number - oldest];
    if (is_in(window, cone)) visit(cone);
  }
}

std::optional<double> SonarAir::first_heard(const Caster& caster, std::uint64_t own, const Echo& echo,
                                            Sectors::Search& search) const {
  const Ear ear(caster, cone(own), echo.seen);
  const double now = ear.cone.sector.sent;
  std::optional<double> nearest = echo.range;
  // A way between two transducers is no longer than their two cones together.
  const Window window{own, now, now - (ear.cone.reach - 2.0 * ear.cone.beam.min_range) / kSoundSpeed};
  for (const std::uint64_t number : sectors_.facing(ear.cone.sector, window.silent_from, now, search))
    if (is_in(window, cone(number))) Ways(ear, cone(number), nearest).straight();
  for (const Echo::Met& met : echo.met) {
    const auto hear = [&](const auto& follow) {
      for_all_off(met.element, window, [&](const Cone& from) {
        Ways ways(ear, from, nearest);
        if (ways.may_be_heard()) follow(ways);
      });
    };
    if (const auto* circle = std::get_if<Circle>(&met.surface))
      hear([&](Ways& ways) { ways.off_circle(*circle); });
    if (const auto* edge = std::get_if<Segment>(&met.surface)) {
      Ear::Wall wall = ear.wall(*edge);
      hear([&](Ways& ways) { ways.off_wall(wall); });
    }
  }
  return nearest;
}

}  // namespace orca::sim::detail
