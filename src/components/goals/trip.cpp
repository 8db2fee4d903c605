// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/goals/trip.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <numbers>

namespace orca::go {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

Error bad(std::string_view text, const std::string& why) {
  return fail(
      Code::invalid_argument,
      "cannot read the goal \"" + std::string(text) + "\": " + why +
          "; a goal looks like \"kitchen: 3.1 2 > 5 4.5\" (name: via points > goal, in metres), or \"hall > "
          "kitchen\" (places by name)");
}

bool is_name(std::string_view text) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  return !text.empty() && kLetters.find(text.front()) != std::string_view::npos &&
         text.find_first_not_of(std::string(kLetters) + "0123456789_") == std::string_view::npos;
}

Result<double> parse_number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    return fail(Code::invalid_argument, "\"" + std::string(text) + "\" is not a number");
  return value;
}

// Reads the next number of `rest` and removes it from `rest`.
Result<double> next_number(std::string_view& rest) {
  rest = trim(rest);
  const auto gap = rest.find_first_of(kBlank);
  const std::string_view number = rest.substr(0, gap);
  rest = gap == std::string_view::npos ? std::string_view{} : trim(rest.substr(gap));
  return parse_number(number);
}

// Reads what follows the word "door": x, y, degrees, width.
Result<Place> parse_door(std::string_view text) {
  std::string_view rest = text;
  double numbers[4] = {};
  for (double& number : numbers) {
    const Result<double> parsed = next_number(rest);
    if (!parsed)
      return fail(Code::invalid_argument, parsed.error().message +
                                              "; a door has x, y, the direction through it in degrees, and "
                                              "its width, like \"door 5 2 90 0.9\"");
    number = *parsed;
  }
  if (!rest.empty())
    return fail(Code::invalid_argument,
                "expected nothing after the width of a door, found \"" + std::string(rest) + "\"");
  if (numbers[3] <= 0.0) return fail(Code::invalid_argument, "the width of a door is more than 0");
  return Place{numbers[0], numbers[1], 0.0, Doorway{numbers[2] * std::numbers::pi / 180.0, numbers[3]}};
}

Result<Place> on_earth(const Result<Place>& place) {
  if (place && is_beyond_earth(place->x, place->y))
    return fail(Code::invalid_argument, "it lies farther away than any place on Earth");
  return place;
}

Result<Place> read_place(std::string_view text) {
  constexpr std::string_view kDoor = "door";
  std::string_view rest = trim(text);
  if (is_name(rest)) return Place{.name = std::string(rest)};
  if (rest.starts_with(kDoor)) return parse_door(rest.substr(kDoor.size()));
  if (rest.find_first_of(kBlank) == std::string_view::npos)
    return fail(Code::invalid_argument, "expected \"x y\", found \"" + std::string(rest) + "\"");
  Place place;
  for (double* number : {&place.x, &place.y, &place.z}) {
    if (number == &place.z && rest.empty()) break;
    const Result<double> parsed = next_number(rest);
    if (!parsed) return parsed.error();
    *number = *parsed;
  }
  if (rest.empty()) return place;
  return fail(Code::invalid_argument,
              "expected nothing after x, y and z, found \"" + std::string(rest) + "\"");
}

// A place where nobody could drive is refused here, so that no goal on the way is given up for it.
Result<Place> parse_place(std::string_view text) { return on_earth(read_place(text)); }

// Cuts `text` at the first `mark`: returns the part before it and leaves the part after it in `text`.
std::string_view cut(std::string_view& text, char mark) {
  const auto at = text.find(mark);
  const std::string_view before = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view{} : text.substr(at + 1);
  return before;
}

// Returns the name of a trip: what stands before the ":", or its last place.
std::string name_of(std::string_view trip) {
  const std::size_t colon = trip.find(':');
  if (colon != std::string_view::npos) return std::string(trim(trip.substr(0, colon)));
  std::string_view places = cut(trip, '@');
  return std::string(trim(places.substr(places.rfind('>') + 1)));  // npos + 1 is the beginning
}

}  // namespace

bool is_beyond_earth(double x, double y) {
  constexpr double kFarthest = 1e8;  // [m] more than twice around the Earth
  return !(std::max(std::fabs(x), std::fabs(y)) <= kFarthest);
}

Result<Trip> parse_trip(std::string_view text) {
  std::string_view rest = text;
  Trip trip;
  trip.name = name_of(rest);
  const std::size_t colon = rest.find(':');
  if (colon == std::string_view::npos && !is_name(trip.name))
    return bad(text, "there is no \":\" after a name");
  if (!is_name(trip.name))
    return bad(text, "\"" + trip.name + "\" is no name: a letter, then letters, digits and _");
  rest.remove_prefix(colon + 1);  // npos + 1 is the beginning
  trip.use_orientation = rest.find('@') != std::string_view::npos;
  std::string_view places = cut(rest, '@');
  if (trip.use_orientation) {
    const Result<double> degrees = parse_number(trim(rest));
    if (!degrees) return bad(text, degrees.error().message);
    trip.orientation = *degrees * std::numbers::pi / 180.0;
  }
  for (bool more = true; more;) {
    more = places.find('>') != std::string_view::npos;
    const Result<Place> place = parse_place(cut(places, '>'));
    if (!place) return bad(text, place.error().message);
    trip.via.push_back(*place);
  }
  trip.goal = trip.via.back();
  trip.via.pop_back();
  if (trip.goal.door && trip.use_orientation)
    return bad(text, "a door as the goal has its direction already; remove \"@\" and what follows");
  return trip;
}

namespace {

Loan<idl::GoalPoint> point_at(const Place& place) {
  if (!place.door) return make_object<idl::GoalPoint>();
  auto door = make_object<idl::Door>();
  door->orientation().orientation().yaw(place.door->direction);
  door->door_width().distance(place.door->width);
  door->passable(true);
  return door;
}

}  // namespace

Loan<idl::GoalPoint> point_of(const Trip& trip, const Place& place, const Demands& demands) {
  Loan<idl::GoalPoint> point = point_at(place);
  point->name() = trip.name;
  point->coordinate().point().x(place.x);
  point->coordinate().point().y(place.y);
  point->coordinate().point().z(place.z);
  point->via(demands.via);
  point->reach_radius().distance(demands.radius);
  point->use_orientation(!demands.via && trip.use_orientation);
  if (!place.door) point->orientation().orientation().yaw(trip.orientation);
  point->reach_angle(demands.angle);
  point->time_limit(demands.time_limit);
  return point;
}

}  // namespace orca::go
