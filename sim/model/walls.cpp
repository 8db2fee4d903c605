// SPDX-License-Identifier: LGPL-3.0-or-later
#include "walls.hpp"

#include <algorithm>

#include "orca/base/portable_math.hpp"
#include "orca/xml/number.hpp"

namespace orca::sim::detail {
namespace {

Obstacle piece(const WallPlan& plan, double begin, double end) {
  const Vec2 along = plan.to - plan.from;
  const Vec2 middle = plan.from + 0.5 * (begin + end) / norm(along) * along;
  const Box box{{middle.x, middle.y, portable::atan2(along.y, along.x)},
                {0.5 * (end - begin), 0.5 * plan.thickness}};
  return {plan.name, box, plan.height};
}

std::string span_text(const Opening& o) {
  return "the door at " + xml::number_text(o.at) + " m, " + xml::number_text(o.width) + " m wide,";
}

}  // namespace

Result<std::vector<Obstacle>> pieces_of(WallPlan plan) {
  const double length = norm(plan.to - plan.from);
  if (length == 0.0) return fail(Code::invalid_argument, "the wall begins and ends in the same point");
  std::ranges::sort(plan.openings, {}, &Opening::at);
  std::vector<Obstacle> pieces;
  double begin = -0.5 * plan.thickness;
  double free_from = 0.0;
  for (const Opening& o : plan.openings) {
    const double left = o.at - 0.5 * o.width;
    const double right = o.at + 0.5 * o.width;
    if (left < 0.0 || right > length)
      return fail(Code::invalid_argument, span_text(o) + " reaches over the end of its wall, which is " +
                                              xml::number_text(length) + " m long");
    if (left < free_from)
      return fail(Code::invalid_argument, span_text(o) + " reaches into the door before it");
    if (left > begin) pieces.push_back(piece(plan, begin, left));
    begin = free_from = right;
  }
  pieces.push_back(piece(plan, begin, length + 0.5 * plan.thickness));
  return pieces;
}

}  // namespace orca::sim::detail
