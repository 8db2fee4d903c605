// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "upright_face.hpp"

namespace orca::sim::test {

/// What a sonar hears by the rules of docs/simulated-devices.md, found with a cone of 2,001 rays: the reference for the
/// simulator's own search, with which it shares no code.
///
/// However many rays there are, something can stand between two of them. So further rays pass closely on both sides of
/// each end, of each tangent and of each crossing, and go to each foot of a perpendicular.
class ConeOfRays {
 public:
  /// @param critical  [rad] incidence beyond which a face is a mirror.
  ConeOfRays(std::vector<UprightFace> faces, double half_lobe, double max_range, double critical)
      : faces_(std::move(faces)),
        half_(half_lobe),
        opening_(std::tan(half_lobe)),
        max_range_(max_range),
        critical_(critical) {
    std::erase_if(faces_, [this](const UprightFace& face) { return is_outside(face); });
  }

  /// Returns the nearest echo [m], if there is one. It leaves out the second bounce.
  [[nodiscard]] std::optional<double> nearest() {
    list_levels();
    constexpr int kRays = 2001;
    Vec2 u = direction(-half_);
    const Vec2 turn = direction(2.0 * half_ / (kRays - 1));
    for (int i = 0; i < kRays; ++i, u = rotated(u, turn)) probe_towards(u);
    for (const UprightFace& face : faces_) probe_marks(face);
    for (std::size_t i = 0; i < faces_.size(); ++i)
      for (std::size_t k = i + 1; k < faces_.size(); ++k)
        for_crossings(faces_[i], faces_[k], [this](Vec2 point) { probe_edge_at(point); });
    for (const Vec2 point : edges_) {
      look_for_edge(point, nullptr);
      for (const Level level : levels_) look_for_edge(point, level);
    }
    return best_;
  }

  /// Returns the distance of the nearest thing that a ray met at the sensor's height [m].
  [[nodiscard]] double nearest_seen() const { return nearest_seen_; }

 private:
  static constexpr double kBeside = 1e-9;  // [rad]
  static constexpr double kSame = 1e-9;    // [m] Points that are no farther apart are the same.
  struct Met {
    double range = UprightFace::kNever;
    const UprightFace* face = nullptr;
  };

  // Returns true if the face lies outside a rim of the lobe as a whole.
  [[nodiscard]] bool is_outside(const UprightFace& face) const {
    return std::ranges::any_of(std::array{-1.0, 1.0}, [&](double side) {
      const Vec2 inwards{std::sin(half_), -side * std::cos(half_)};
      const double most = face.is_round() ? dot(inwards, face.a) + face.radius
                                          : std::max(dot(inwards, face.a), dot(inwards, face.b));
      return most < -1e-6;
    });
  }

  // A level: those faces at the sensor's height (null), or those with the same rise as this one.
  using Level = const UprightFace*;
  void list_levels() {
    for (const UprightFace& face : faces_)
      if (!face.at_height() && std::ranges::none_of(levels_, [&](Level l) { return is_of(face, l); }))
        levels_.push_back(&face);
  }
  static bool is_of(const UprightFace& face, Level level) {
    if (level == nullptr) return face.at_height();
    return !face.at_height() && face.is_above() == level->is_above() && face.rise() == level->rise();
  }
  // Returns true if the face stands between the sensor's height and that of the level.
  static bool may_hide(const UprightFace& face, Level level) {
    if (face.at_height() || level == nullptr) return face.at_height();
    return face.is_above() == level->is_above() && std::fabs(face.rise()) <= std::fabs(level->rise());
  }
  // Returns where a ray meets the face within the height of the cone [m].
  [[nodiscard]] double met_at(const UprightFace& face, Vec2 u) const {
    const double range = face.distance(u);
    if (face.at_height()) return range;
    const bool in_cone = face.from_outside() && range * opening_ >= std::fabs(face.rise());
    return in_cone ? range : UprightFace::kNever;
  }
  [[nodiscard]] Met first_met(Vec2 u, Level level) const {
    Met met;
    for (const UprightFace& face : faces_) {
      if (!may_hide(face, level)) continue;
      const double range = met_at(face, u);
      if (range < met.range) met = {range, &face};
    }
    return met;
  }
  static double length_of(double range, Level level) {
    return level == nullptr ? range : std::hypot(range, level->rise());
  }
  void offer(double range, Level level) {
    if (is_nearer(range, level)) best_ = length_of(range, level);
  }
  [[nodiscard]] bool is_nearer(double range, Level level) const {
    return length_of(range, level) <= max_range_ && (!best_ || length_of(range, level) < *best_);
  }

  // A face that is met steeply enough answers.
  void probe(double angle) {
    if (std::fabs(angle) <= half_) probe_towards(direction(angle));
  }
  void probe_towards(Vec2 u) {
    const Met first = first_met(u, nullptr);
    nearest_seen_ = std::min(nearest_seen_, first.range);
    if (std::ranges::find(seen_, first.face) == seen_.end()) seen_.push_back(first.face);
    answer(first, u, nullptr);
    for (const Level level : levels_) answer(first_met(u, level), u, level);
  }
  void answer(const Met& met, Vec2 u, Level level) {
    if (met.face == nullptr || !is_of(*met.face, level) || !is_nearer(met.range, level)) return;
    if (met.face->incidence(u, met.range) <= critical_) best_ = length_of(met.range, level);
  }
  void probe_beside(double angle) {
    for (const double off : {-kBeside, kBeside}) probe(std::remainder(angle + off, 2.0 * kPi));
  }
  void probe_at(Vec2 point) { probe_beside(std::atan2(point.y, point.x)); }
  void probe_edge_at(Vec2 point) {
    probe_at(point);
    edges_.push_back(point);
  }

  // Sends rays to where a face may be nearest, or begin to be seen.
  void probe_marks(const UprightFace& face) {
    if (face.is_round()) {
      const double middle = std::atan2(face.a.y, face.a.x);
      const double share = std::min(1.0, face.radius / norm(face.a));
      for (const double wide : {0.0, std::asin(share), std::asin(std::sin(critical_) * share)})
        for (const double side : {-wide, wide}) probe_beside(middle + side);
    } else {
      const Vec2 d = face.b - face.a;
      const double normal = std::atan2(-d.x, d.y);
      for (const double side : {normal, normal + kPi})
        for (const double off : {-critical_, 0.0, critical_}) probe_beside(side + off);
      probe_edge_at(face.a);
      probe_edge_at(face.b);
    }
    if (face.at_height()) return;
    UprightFace mouth;  // Where the cone has opened as far as to the face.
    mouth.radius = std::fabs(face.rise()) / opening_;
    for_crossings(mouth, face, [this](Vec2 point) { probe_at((1.0 + 1e-9) * point); });
  }

  // An edge: two walls that meet at more than 1 deg, or the end of a wall that no other goes on from.
  void look_for_edge(Vec2 point, Level level) {
    // Edges return 0.3, a tenth is heard, and the lobe takes exp(-2) at its rim.
    const double heard = std::sqrt(0.5 * std::log(0.3 / 0.1));
    const double angle = std::atan2(point.y, point.x);
    if (std::fabs(angle) > heard * half_) return;
    const Met right = first_met(direction(angle - kBeside), level);
    const Met left = first_met(direction(angle + kBeside), level);
    const Met& near = right.range < left.range ? right : left;
    const Met& far = right.range < left.range ? left : right;
    if (!is_straight(near) || near.face == far.face || near.face->away_from(point) > kSame) return;
    // Where faces are met at a grazing angle, the ranges beside the point say little.
    const bool joined =
        is_straight(far) && (far.range - near.range <= 1e-3 || far.face->away_from(point) <= kSame);
    if (!is_of(*near.face, level) && !(joined && is_of(*far.face, level))) return;
    if (joined ? !near.face->in_line(*far.face) : is_free_end(*near.face, point)) offer(norm(point), level);
  }
  static bool is_straight(const Met& met) { return met.face != nullptr && !met.face->is_round(); }
  [[nodiscard]] bool is_free_end(const UprightFace& face, Vec2 point) const {
    return std::min(norm(face.a - point), norm(face.b - point)) <= kSame && !goes_on(face, point);
  }
  [[nodiscard]] bool goes_on(const UprightFace& face, Vec2 point) const {
    return std::ranges::any_of(seen_, [&](const UprightFace* other) {
      if (other == nullptr || other == &face || !face.in_line(*other) || other->away_from(point) > 1e-3)
        return false;
      const Vec2 outwards = point - 0.5 * (face.a + face.b);
      return std::max(dot(other->a - point, outwards), dot(other->b - point, outwards)) >
             1e-3 * norm(outwards);
    });
  }

  std::vector<UprightFace> faces_;
  double half_, opening_, max_range_, critical_;
  std::vector<Level> levels_;
  std::vector<Vec2> edges_;               // Where there may be edges.
  std::vector<const UprightFace*> seen_;  // The faces that rays met at the sensor's height.
  std::optional<double> best_;
  double nearest_seen_ = UprightFace::kNever;
};

}  // namespace orca::sim::test
