// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "going.hpp"

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <variant>

#include "asking.hpp"
#include "client.hpp"
#include "offering.hpp"
#include "orca/base/json.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/tasks.hpp"
#include "orca/xml/quantity.hpp"
#include "table.hpp"

namespace orca::orcactl {
namespace {

constexpr std::string_view kTrips = ".TripQuery";
constexpr std::string_view kDrives = ".ProgressQuery";
constexpr Duration kLookEvery = std::chrono::milliseconds(500);

// Returns the value of "3.2" or "3.2m" [m]; nothing for other words.
std::optional<double> metres(const std::string& word) {
  const Result<double> read = xml::parse_quantity(word, "m");
  return read ? std::optional(*read) : std::nullopt;
}

std::string point_text(const std::string& name, double x, double y) {
  char text[96];
  std::snprintf(text, sizeof text, "%s: %.9g %.9g", name.c_str(), x, y);
  return text;
}

// Asks a port for a T.
template <class T>
Result<ObjectPtr<T>> fetch(Client& client, const std::string& port, const ObjectLoan& question,
                           Duration limit) {
  Result<ObjectLoan> reply = ask_port(client, port, question, limit);
  if (!reply) return reply.error();
  ObjectPtr<T> object = object_cast<T>(std::move(*reply).seal());
  if (!object)
    return fail(Code::invalid_argument, port + " answers with something else than is expected of it");
  return object;
}

// Gives an order, which may be TRIP_SHOW.
Result<ObjectPtr<idl::TripState>> fetch_trips(Client& client, const std::string& component,
                                              Loan<idl::TripOrder> order, Duration limit) {
  return fetch<idl::TripState>(client, component + std::string(kTrips), std::move(order), limit);
}

// Returns how far whoever drives to that goal is; null if nobody says so.
ObjectPtr<idl::Progress> progress_to(Client& client, const std::string& goal, Duration limit) {
  for (const std::string& driver : components_with(client, kDrives)) {
    const auto progress = fetch<idl::Progress>(client, driver + std::string(kDrives),
                                               make_object(object_type<idl::Ask>()), limit);
    if (progress && (*progress)->name() == goal) return *progress;
  }
  return {};
}

// Returns "4.2 m left" or why the robot waits.
std::string progress_text(const ObjectPtr<idl::Progress>& progress) {
  if (!progress) return {};
  char text[48];
  std::snprintf(text, sizeof text, ", %.1f m left", progress->left());
  return text + (progress->waits().empty() ? "" : "; it waits: " + printable(progress->waits()));
}

std::string trip_text(const idl::TripState& trip, const ObjectPtr<idl::Progress>& progress) {
  std::string text = trip.going_to().empty()
                         ? "no goal"
                         : "on the way to " + printable(trip.going_to()) + progress_text(progress);
  if (!trip.next().empty()) text += "; then " + listed(trip.next());
  if (!trip.result().empty()) text += "; the last one: " + printable(trip.result());
  return text;
}

void write_trip(const std::string& component, const idl::TripState& trip,
                const ObjectPtr<idl::Progress>& progress, JsonWriter& json) {
  std::vector<std::string> next;
  for (const std::string& goal : trip.next()) next.push_back(printable(goal));
  json.begin_object();
  json.member("component", component);
  json.member("going_to", printable(trip.going_to()));
  json.member("left", progress ? progress->left() : std::numeric_limits<double>::quiet_NaN());  // null
  json.member("waits", progress ? printable(progress->waits()) : std::string());
  json.member("next", next);
  json.member("reached", trip.reached());
  json.member("missed", trip.missed());
  json.member("result", printable(trip.result()));
  json.end();
}

Status show_goals(Client& client, const std::vector<std::string>& components, Duration limit, bool as_json) {
  JsonWriter json;
  json.begin_array();
  for (const std::string& component : components) {
    const auto state = fetch_trips(client, component, make_object<idl::TripOrder>(), limit);
    if (!state) return state.error();
    const idl::TripState& trip = **state;
    const ObjectPtr<idl::Progress> progress =
        trip.going_to().empty() ? nullptr : progress_to(client, trip.going_to(), limit);
    if (as_json)
      write_trip(component, trip, progress, json);
    else
      print(component + ": " + trip_text(trip, progress) + "\n");
  }
  json.end();
  if (as_json) print(json.text());
  return ok();
}

// Shows what becomes of the goals until there is none any more.
// @errors  not_found: a goal was missed.
Status wait_for(Client& client, const std::string& component, const idl::TripState& begin, Duration limit) {
  std::uint32_t over = begin.reached() + begin.missed();
  for (;; std::this_thread::sleep_for(kLookEvery)) {
    const auto state = fetch_trips(client, component, make_object<idl::TripOrder>(), limit);
    if (!state) return state.error();
    const std::uint32_t over_now = (*state)->reached() + (*state)->missed();
    if (over_now < over)
      return fail(Code::unavailable, component + " has begun anew, and knows its goals no more");
    if (over_now > over) print(printable((*state)->result()) + "\n");
    over = over_now;
    if (!(*state)->going_to().empty() || !(*state)->next().empty()) continue;
    const std::uint32_t missed = (*state)->missed() - begin.missed();
    if (missed == 0) return ok();
    return fail(Code::not_found,
                std::to_string(missed) + (missed == 1 ? " goal was" : " goals were") + " not reached");
  }
}

Result<Loan<idl::TripOrder>> trip_order(const apps::Call& call) {
  Result<std::vector<std::string>> goals = goals_in(call.words);
  if (!goals) return goals.error();
  if (call.has("--cancel") && !goals->empty())
    return fail(Code::invalid_argument, "--cancel takes all goals away; it goes with none");
  auto order = make_object<idl::TripOrder>();
  order->kind(idl::TRIP_GO);
  if (call.has("--queue")) order->kind(idl::TRIP_QUEUE);
  if (call.has("--cancel")) order->kind(idl::TRIP_CANCEL);
  order->goals() = *std::move(goals);
  order->rounds(call.has("--repeat") ? 0 : 1);
  return order;
}

Status carry_out_trip(Client& client, const std::vector<std::string>& components, const apps::Call& call) {
  const Duration limit = call.duration("--timeout").value_or(kAnswerLimit);
  const bool shows = call.words.empty() && !call.has("--cancel");
  if (shows && (call.has("--queue") || call.has("--repeat") || call.has("--wait")))
    return fail(Code::invalid_argument, "name a goal: orcactl go kitchen");
  if (call.has("--queue") && call.has("--repeat"))
    return fail(Code::invalid_argument,
                "--queue adds to the goals that there are, --repeat takes their place");
  if (shows) return show_goals(client, components, limit, call.has("--json"));
  const std::optional<std::string> named = call.text("--component");
  if (!named && components.size() > 1)
    return fail(Code::invalid_argument, "several components send robots to goals: " + listed(components) +
                                            "; name one by --component");
  const std::string component = named.value_or(components.front());
  Result<Loan<idl::TripOrder>> order = trip_order(call);
  if (!order) return order.error();
  const auto taken = fetch_trips(client, component, *std::move(order), limit);
  if (!taken) return taken.error();
  return call.has("--wait") ? wait_for(client, component, **taken, limit) : ok();
}

}  // namespace

Result<std::vector<std::string>> goals_in(const std::vector<std::string>& words) {
  std::vector<std::string> goals;
  std::optional<double> x;
  for (const std::string& word : words) {
    if (word == "m") continue;  // "3.2 m 4 m"
    const std::optional<double> number = metres(word);
    if (number && x) {
      goals.push_back(point_text("point_" + std::to_string(goals.size() + 1), *x, *number));
      x.reset();
    } else if (number) {
      x = number;
    } else if (x) {
      break;
    } else {
      goals.push_back(word);
    }
  }
  if (x) return fail(Code::invalid_argument, "a place by coordinates needs two of them: orcactl go 3.2 4");
  return goals;
}

ExitCode handle_go(const apps::Call& call) {
  std::variant<Client, Failure> connected = Client::connect(call);
  if (auto* const failure = std::get_if<Failure>(&connected)) return report(*failure);
  Client& client = std::get<Client>(connected);
  const std::vector<std::string> components = components_with(client, kTrips);
  if (components.empty())
    return report({fail(
        Code::not_found,
        "no component here takes orders to go; orca.Command does. A task is changed by orcactl tasks")});
  const Status done = carry_out_trip(client, components, call);
  return done.ok() ? ExitCode::done : report({done.error()});
}

}  // namespace orca::orcactl
