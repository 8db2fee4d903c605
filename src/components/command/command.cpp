// SPDX-License-Identifier: LGPL-3.0-or-later
#include <poll.h>
#include <unistd.h>

#include <deque>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "goal_list.hpp"
#include "orca/base/input_file.hpp"
#include "orca/base/live_line.hpp"
#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"

namespace {

using orca::command::Route;

constexpr std::size_t kMaxBytes = 1'000'000;  // of a file of goals

/// A component that sends the robot to one goal after the other, taken from a parameter, a file or a prompt
/// (thesis 11.1). For each goal it subscribes to the arrivals, sends the coordinates to Goto and the list of
/// behaviours to the fuser, and waits. After the arrival it unsubscribes and clears the list. It is done when
/// there are no more goals.
class Command final : public orca::Component {
 public:
  explicit Command(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    stay_active(true);
    for (const std::string& text : *goals_)
      if (orca::Status added = add(text); !added.ok()) return added;
    return goals_file_->empty() ? orca::ok() : read_file();
  }

  orca::Outcome work() override {
    const std::optional<Route> route = next();
    if (!route) return orca::done();
    return drive(*route);
  }

  orca::Outcome drive(const Route& route) {
    arrived_.subscribe();
    for (const orca::command::Place& via : route.via)
      if (orca::Status sent = send_point(route, via, true); !sent.ok()) return give_up(sent);
    if (orca::Status sent = send_point(route, route.goal, false); !sent.ok()) return give_up(sent);
    if (orca::Status sent = send_clients(*behaviours_); !sent.ok()) return give_up(sent);
    const auto arrived = arrived_.get_update_wait_max(orca::from_seconds(*goal_timeout_));
    if (!arrived)
      return orca::failed("goal \"" + route.name + "\" was not reached within " +
                          std::to_string(*goal_timeout_) + " s");
    arrived_.unsubscribe();
    if (orca::Status sent = send_clients({}); !sent.ok()) return give_up(sent);
    return orca::again();
  }

  void stop() override {
    if (const orca::Status sent = send_clients({}); !sent.ok()) log_debug(sent.error().text());
  }

  orca::Status send_point(const Route& route, const orca::command::Place& place, bool via) {
    auto point = goto_.loan();
    point->name() = route.name;
    point->coordinate().point().x(place.x);
    point->coordinate().point().y(place.y);
    point->coordinate().point().z(place.z);
    point->via(via);
    point->reach_radius(via ? *via_radius_ : *reach_radius_);
    point->use_orientation(!via && route.use_orientation);
    point->orientation(route.orientation);
    point->reach_angle(*reach_angle_);
    return goto_.send(std::move(point));
  }

  orca::Status send_clients(const std::vector<std::string>& names) {
    auto list = clients_.loan();
    list->clients() = names;
    return clients_.send(std::move(list));
  }

  static orca::Outcome give_up(const orca::Status& status) { return orca::failed(status.error().text()); }

  std::optional<Route> next() {
    while (waiting_.empty() && asks())
      if (!ask()) return std::nullopt;
    if (waiting_.empty()) return std::nullopt;
    Route route = std::move(waiting_.front());
    waiting_.pop_front();
    return route;
  }

  // Returns whether to ask the user: there are goals from nowhere else.
  [[nodiscard]] bool asks() const { return goals_->empty() && goals_file_->empty(); }

  // Asks the user for one goal; false when there will be no more.
  bool ask() {
    constexpr std::string_view kPrompt = "goal (name: x y > x y, empty line to end)? ";
    const orca::LiveLine::Pause room;  // the user sees what he types
    if (write(STDERR_FILENO, kPrompt.data(), kPrompt.size()) < 0) return false;
    std::string line;
    if (!read_line(line) || line.empty()) return false;
    if (const orca::Status added = add(line); !added.ok()) log_error(added.error().text());
    return true;
  }

  // Reads a line from stdin without blocking the strand in the system, so that the component can be stopped
  // meanwhile.
  bool read_line(std::string& line) {
    for (;;) {
      pollfd input{STDIN_FILENO, POLLIN, 0};
      if (poll(&input, 1, 0) == 0) {
        sleep(std::chrono::milliseconds(50));
        continue;
      }
      char c = 0;
      if (read(STDIN_FILENO, &c, 1) != 1) return !line.empty();
      if (c == '\n') return true;
      line += c;
    }
  }

  orca::Status read_file() {
    const orca::Result<std::string> text = orca::read_input_file(*goals_file_, kMaxBytes);
    if (!text)
      return orca::fail(text.error().code, "cannot read the file of goals: " + text.error().message,
                        *goals_file_);
    if (text->size() == kMaxBytes)
      return orca::fail(orca::Code::invalid_argument,
                        "the file of goals has more than 1 MB, which is the limit", *goals_file_);
    std::istringstream file(*text);
    int number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      if (line.find_first_not_of(" \t\r") == std::string::npos || line.front() == '#') continue;
      const orca::Status added = add(line);
      if (!added.ok())
        return orca::fail(added.error().code, added.error().message,
                          *goals_file_ + ":" + std::to_string(number) + ":1");
    }
    return orca::ok();
  }

  orca::Status add(const std::string& text) {
    orca::Result<Route> route = orca::command::parse_route(text);
    if (!route) return route.error();
    waiting_.push_back(std::move(route).value());
    return orca::ok();
  }

  orca::SendProxy<orca::idl::GoalPoint> goto_{
      *this, "goto", {.text = "Receiver of the coordinates: a Goto."}};
  orca::SendProxy<orca::idl::ClientList> clients_{
      *this, "clients", {.text = "Receiver of the list of behaviours: a fuser."}};
  orca::PushProxy<orca::idl::Arrived> arrived_{
      *this, "arrived", {.text = "Reports that a goal is reached.", .manual = true, .depth = 16}};

  orca::Param<std::vector<std::string>> goals_{
      *this,
      "goals",
      {},
      {.fixed = true, .text = "Goals, each \"name: x y > x y\" in metres: any via points, then the goal."}};
  orca::Param<std::string> goals_file_{
      *this,
      "goals_file",
      "",
      {.file = true, .fixed = true, .text = "File of goals, one per line; # starts a comment line."}};
  orca::Param<std::vector<std::string>> behaviours_{
      *this, "behaviours", {"goto", "avoid"}, {.text = "Behaviours that the fuser uses on the way."}};
  orca::Param<double> reach_radius_{
      *this,
      "reach_radius",
      0.2,
      {.unit = "m", .min = 0.01, .text = "Distance at which a goal counts as reached."}};
  orca::Param<double> via_radius_{
      *this,
      "via_radius",
      0.3,
      {.unit = "m", .min = 0.01, .text = "Distance at which a via point counts as passed."}};
  orca::Param<double> reach_angle_{
      *this,
      "reach_angle",
      0.1,
      {.unit = "rad", .min = 0.01, .text = "Accepted deviation from the direction at the goal."}};
  orca::Param<double> goal_timeout_{
      *this,
      "goal_timeout",
      300.0,
      {.unit = "s", .min = 1.0, .text = "Longest time for one goal; after it the goal has failed."}};

  std::deque<Route> waiting_;
};

}  // namespace

ORCA_COMPONENT(Command, "orca.Command")
ORCA_ALLOW_IN_VIRTUAL_TIME("poll", "with a timeout of zero: it asks for input and never waits for it")
