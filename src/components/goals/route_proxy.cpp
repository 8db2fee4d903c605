// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/goals/route_proxy.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/text.hpp"

namespace orca::go {

RouteProxy::RouteProxy(Component& owner)
    : routes_(owner, "routes",
              {.text = "Asked for the places on the way to a goal that is given without any: a RouteServer.",
               .optional = true}),
      doors_(owner, "doors",
             {.text = "Reports doors that are found shut, or open again: a RouteServer.",
              .optional = true,
              .manual = true,
              .depth = 16}),
      blocked_(owner, "blocked",
               {.text = "Receiver of legs that are blocked: a RouteServer.", .optional = true}) {}

void RouteProxy::begin() {
  names_.clear();
  is_blocked_ = false;
  if (connected()) doors_.subscribe();
}

void RouteProxy::end() { doors_.unsubscribe(); }

Result<bool> RouteProxy::lay(Trip& trip) {
  const auto answer = routes_.query(point_of(trip, trip.goal, {}));
  if (!answer) return answer.error();
  const idl::Route& route = **answer;
  if (!route.known()) return fail(Code::unavailable, "the world or the robot's pose is not known yet");
  std::vector<std::string> names;
  for (const idl::RouteLeg& leg : route.legs()) names.push_back(leg.name());
  const bool is_no_other = names == names_ || route.blocked();
  if (std::exchange(is_blocked_, false) ? is_no_other : is_rest_of(names_, names)) return false;
  names_ = std::move(names);
  trip.via = places_of(route);
  return true;
}

std::string RouteProxy::text() const { return names_.empty() ? "straight on" : "by " + listed(names_); }

Status RouteProxy::report_blocked(const Trip& trip, std::size_t left) {
  if (!blocked_.connected()) return fail(Code::failed_precondition, "nobody hears of blocked legs");
  const std::size_t at = names_.size() + 1 - std::min(left, names_.size() + 1);
  auto route = blocked_.loan();
  if (at > 0) route->name() = names_[at - 1];
  idl::RouteLeg& leg = route->legs().emplace_back();
  const bool is_last = at >= names_.size();
  if (!is_last) leg.name() = names_[at];
  const Place& place = is_last ? trip.goal : trip.via[at];
  leg.x(place.x);
  leg.y(place.y);
  names_.erase(names_.begin(), names_.begin() + static_cast<std::ptrdiff_t>(at));
  is_blocked_ = true;
  return blocked_.send(std::move(route));
}

std::vector<Place> places_of(const idl::Route& route) {
  std::vector<Place> places;
  for (const idl::RouteLeg& leg : route.legs()) {
    Place& place = places.emplace_back(Place{.x = leg.x(), .y = leg.y()});
    if (leg.door()) place.door = Doorway{leg.direction(), leg.width()};
  }
  return places;
}

bool is_rest_of(const std::vector<std::string>& before, const std::vector<std::string>& later) {
  return later.size() <= before.size() && std::equal(later.rbegin(), later.rend(), before.rbegin());
}

}  // namespace orca::go
