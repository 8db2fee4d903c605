// SPDX-License-Identifier: LGPL-3.0-or-later
#include "panorama.hpp"

#include <algorithm>
#include <limits>

#include "intersect.hpp"

namespace orca::sim::detail {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Narrower patches are rounding errors: where walls touch each other, what is behind may shine through. It is 6.5 nm
// at 6.5 m.
constexpr double kNarrow = 1e-9;

}  // namespace

void Panorama::begin(const Cone& cone, double sensor_height) {
  tip_ = cone.tip;
  axis_ = cone.axis;
  rim_ = {dot(axis_, cone.left), cross(axis_, cone.left)};
  opening_ = {-bearing_of(rim_), bearing_of(rim_)};
  reach_ = cone.reach;
  height_ = sensor_height;
  tangent_ = rim_.y / std::max(rim_.x, 1e-12);
  rise_ = reach_ * tangent_;
  far_ = kInfinite;
  things_.clear();
  apart_.clear();
  patches_.assign(1, {opening_.from, opening_.to, kNothing, kInfinite});
}

// Rules out, without a division, most of what lies outside the rims or behind all that is seen.
bool Panorama::misses(const Segment& edge) const {
  const Vec2 right{rim_.x, -rim_.y};
  const double end = std::min(reach_, far_);
  const auto outside = [](double a, double b) { return (a > kTouch) & (b > kTouch); };
  return outside(cross(rim_, edge.a), cross(rim_, edge.b)) |
         outside(cross(edge.a, right), cross(edge.b, right)) | outside(-edge.a.x, -edge.b.x) |
         outside(edge.a.x - end, edge.b.x - end);
}

bool Panorama::misses(const Circle& circle) const {
  const Vec2 right{rim_.x, -rim_.y};
  const double largest = circle.radius + kTouch;
  return cross(rim_, circle.center) > largest || cross(circle.center, right) > largest ||
         circle.center.x < -largest || circle.center.x - std::min(reach_, far_) > largest;
}

template <class Figure>
void Panorama::add(const Figure& figure, std::uint64_t element, double bottom, double top) {
  if (!may_show(bottom, top)) return;
  const Figure there = local(figure);
  if (misses(there)) return;
  const double rise = bottom > height_ ? bottom - height_ : std::min(0.0, top - height_);
  const bool is_level = bottom <= height_ && height_ < top;
  std::vector<Thing>& things = is_level ? things_ : apart_;
  const Boundary& boundary = things.emplace_back(Boundary(there), figure, element, rise).boundary;
  // The cone meets what is apart from outside only: it does not look through a top.
  const bool may_be_seen = boundary.nearest() <= reach_ && (is_level || !boundary.faces_away());
  if (!may_be_seen || (is_level && !insert(static_cast<std::uint32_t>(things.size() - 1), boundary.seen())))
    things.pop_back();
}

template void Panorama::add(const Segment&, std::uint64_t, double, double);
template void Panorama::add(const Circle&, std::uint64_t, double, double);

void Panorama::finish() {
  drop_narrow_patches();
  level_ = {0.0, 0, static_cast<std::uint32_t>(things_.size())};
  next_apart_ = 0;
  if (apart_.empty()) return;
  first_ = patches_;
  // From the sensor's height downwards, then upwards.
  std::ranges::sort(apart_, [](const Thing& a, const Thing& b) {
    return (a.rise > 0.0) != (b.rise > 0.0) ? b.rise > 0.0 : std::fabs(a.rise) < std::fabs(b.rise);
  });
}

bool Panorama::next_level() {
  if (next_apart_ == apart_.size()) return false;
  const double rise = apart_[next_apart_].rise;
  if (rise > 0.0 && level_.rise <= 0.0) patches_ = first_;
  level_ = {rise, static_cast<std::uint32_t>(things_.size()), 0};
  const double begins = std::fabs(rise) / tangent_;
  for (; next_apart_ < apart_.size() && apart_[next_apart_].rise == rise; ++next_apart_) {
    things_.push_back(apart_[next_apart_]);
    for (const Stretch& part : things_.back().boundary.beyond(begins))
      insert(static_cast<std::uint32_t>(things_.size() - 1), part);
  }
  level_.last = static_cast<std::uint32_t>(things_.size());
  drop_narrow_patches();
  return true;
}

// Gives very narrow patches to their neighbours.
void Panorama::drop_narrow_patches() {
  const auto is_narrow = [](const Patch& patch) { return patch.to - patch.from < kNarrow; };
  if (std::ranges::none_of(patches_, is_narrow)) return;
  changed_.clear();
  double from = patches_.front().from;
  for (Patch patch : patches_) {
    if (is_narrow(patch)) continue;
    patch.from = from;
    append(patch);
    from = patch.to;
  }
  if (changed_.empty()) return;
  changed_.back().to = patches_.back().to;
  patches_.swap(changed_);
}

// Puts a boundary into the view where it is nearer than what is there. Returns false if it is nowhere.
bool Panorama::insert(std::uint32_t what, const Stretch& seen) {
  const double nearest = things_[what].boundary.nearest();
  const auto may_change = [&](const Patch& held) {
    return seen.from < held.to && held.from < seen.to && nearest < held.far;
  };
  if (seen.empty() || std::ranges::none_of(patches_, may_change)) return false;
  changed_.clear();
  bool is_seen = false;
  for (const Patch& held : patches_) {
    if (may_change(held)) {
      is_seen = contest(what, held, seen) || is_seen;
    } else {
      append(held);
    }
  }
  if (!is_seen) return false;
  patches_.swap(changed_);
  far_ = std::ranges::max_element(patches_, {}, &Patch::far)->far;
  return true;
}

// Shares a patch between the boundary that holds it and another one. Returns false if the other gets nothing.
bool Panorama::contest(std::uint32_t what, const Patch& held, const Stretch& seen) {
  double from = std::max(seen.from, held.from);
  const double to = std::min(seen.to, held.to);
  bool gets_some = false;
  double kept_from = held.from;
  const auto give = [&](double end, bool to_other) {
    if (to_other) {
      append(kept_from, from, held.what);
      append(from, end, what);
      kept_from = end;
      gets_some = true;
    }
    from = end;
  };
  const auto is_nearer_at = [&](double bearing) { return is_nearer(what, held.what, bearing); };
  const bool at_begin = held.what == kNothing || is_nearer_at(from);
  if (held.what == kNothing || (cross_once(what, held.what) && is_nearer_at(to) == at_begin)) {
    give(to, at_begin);
  } else {
    for (const double bearing : Crossings(things_[what].boundary, things_[held.what].boundary))
      if (bearing > from && bearing < to) give(bearing, is_nearer_at(0.5 * (from + bearing)));
    give(to, is_nearer_at(0.5 * (from + to)));
  }
  if (!gets_some) {
    append(held);
  } else {
    append(kept_from, held.to, held.what);
  }
  return gets_some;
}

// Returns true if it is nearer at a bearing by more than 1 nm, so that neither wins where both touch.
bool Panorama::is_nearer(std::uint32_t what, std::uint32_t than, double bearing) const {
  const Vec2 u = towards(bearing);
  return things_[what].boundary.depth(u) < things_[than].boundary.depth(u) - kTouch;
}

double Panorama::far_of(double from, double to, std::uint32_t what) const {
  if (what == kNothing) return kInfinite;
  const Boundary& boundary = things_[what].boundary;
  if (!boundary.is_edge() && boundary.faces_away()) return kInfinite;  // From inside its middle is farther.
  return std::max(norm(boundary.at(from)), norm(boundary.at(to)));
}

const Panorama::Patch& Panorama::first_patch_at(double bearing) const {
  const std::vector<Patch>& view = apart_.empty() ? patches_ : first_;
  const auto found = std::ranges::lower_bound(view, bearing, {}, &Patch::to);
  return found == view.end() ? view.back() : *found;
}

bool Panorama::shows(Vec2 point, double slack) const {
  const Vec2 there = local(point);
  const Patch& patch = first_patch_at(bearing_of(there));
  if (patch.what == kNothing) return true;
  // Compares lengths in units of the way to the point.
  const double length = norm(there);
  return boundary(patch).depth(there) * length >= std::min(length - slack, reach_);
}

void Panorama::append(double from, double to, std::uint32_t what) {
  if (from < to) append({from, to, what, far_of(from, to, what)});
}

void Panorama::append(const Patch& patch) {
  if (changed_.empty() || changed_.back().what != patch.what) {
    changed_.push_back(patch);
    return;
  }
  changed_.back().to = patch.to;
  changed_.back().far = std::max(changed_.back().far, patch.far);
}

}  // namespace orca::sim::detail
