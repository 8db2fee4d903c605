// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "goal_list.hpp"
#include "orca/base/live_line.hpp"
#include "orca/base/text.hpp"
#include "orca/component.hpp"
#include "orca/goals/mission_proxy.hpp"
#include "orca/idl/tasks.hpp"
#include "orca/idl/time.hpp"
#include "prompt.hpp"

namespace {

using orca::command::Agenda;
using orca::go::MissionProxy;
using orca::go::Trip;

constexpr orca::Duration kLongestLap = std::chrono::hours(1);
constexpr orca::Duration kRest = std::chrono::seconds(1);  // in rounds, after a goal that was not reached

/// A component that sends the robot to one goal after the other, taken from a parameter, a file or a prompt
/// (thesis 11.1). For each goal it begins a mission, subscribes to its results, sends the coordinates to Goto
/// and the list of behaviours to the fuser, and waits. After the result it unsubscribes and clears the list.
/// If Goto or the fuser is in another process that is started again meanwhile, it gets what it needs once more.
/// While the robot drives, other goals may be set. When there are no more goals it is done, or has failed if one was not reached.
class Command final : public orca::Component {
 public:
  explicit Command(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    stay_active(true);
    std::vector<Trip> trips;
    for (const std::string& text : *goals_)
      if (const orca::Status added = add(text, trips); !added.ok()) return goals_.refuse(added.error());
    if (!goals_file_->empty())
      if (const orca::Status read = read_file(trips); !read.ok()) return goals_file_.refuse(read.error());
    listed_ = *goals_;
    asks_ = listed_.empty() && goals_file_->empty();
    agenda_.set(std::move(trips));
    return mission_.configure();
  }

  // A lap begins a goal, or waits for something to happen to it. While it waits, orders and objects that are sent are taken.
  orca::Outcome work() override {
    if (mission_.active()) {
      if (const auto ending = mission_.wait(kLongestLap)) note(ending->reached, ending->reason);
      return orca::again();
    }
    if (agenda_.next(rounds()) == nullptr) return asks_ && ask() ? orca::again() : conclude();
    if (std::exchange(rests_, false)) sleep(kRest);
    begin(*agenda_.next(rounds()));
    return orca::again();
  }

  [[nodiscard]] std::size_t rounds() const {
    return ordered_rounds_.value_or(static_cast<std::size_t>(*rounds_));
  }

  orca::Outcome conclude() {
    if (stays_) wait_until([] { return false; }, std::chrono::hours(1));  // an order ends the lap
    if (stays_) return orca::again();
    if (missed_ == 0) return orca::done();
    return orca::failed("not reached: " + orca::listed(unreached_) + " (" + std::to_string(missed_) + " of " +
                        std::to_string(tried_) + " goals)");
  }

  // Sends the robot to a goal.
  void begin(const Trip& trip) {
    agenda_.begin();
    prompt_.hide();
    ++tried_;
    going_to_ = trip.name;
    if (const auto ending = mission_.begin(trip, *goal_timeout_)) note(ending->reached, ending->reason);
  }

  // Takes note of how the drive has ended.
  void note(bool reached, const std::string& reason) {
    result_ = going_to_ + ": " + (reached ? "reached" : reason);
    if (reached) ++reached_;
    if (reached) return;
    ++missed_;
    rests_ = rounds() != 1;
    if (std::ranges::find(unreached_, going_to_) == unreached_.end()) unreached_.push_back(going_to_);
  }

  // Another list takes the place of the one that is driven; the goal on the way is given up.
  orca::Status params_changed() override {
    if (orca::Status known = mission_.check_behaviours(); !known.ok()) return known;
    if (*goals_ == listed_) return orca::ok();
    std::vector<Trip> trips;
    for (const std::string& text : *goals_)
      if (const orca::Status added = add(text, trips); !added.ok()) return added;
    listed_ = *goals_;
    stays_ = trips.empty() && !asks_;
    ordered_.clear();
    ordered_rounds_.reset();
    drive_to(std::move(trips), "there are other goals");
    return orca::ok();
  }

  void drive_to(std::vector<Trip> trips, const std::string& why) {
    if (mission_.active()) {
      mission_.cancel(why);
      note(false, "cancelled: " + why);
    }
    rests_ = false;
    agenda_.set(std::move(trips));
  }

  orca::Result<orca::Loan<orca::idl::TripState>> on_order(
      const orca::ObjectPtr<orca::idl::TripOrder>& order) {
    if (const orca::Status obeyed = obey(*order); !obeyed.ok()) return obeyed.error();
    auto state = orca::make_object<orca::idl::TripState>();
    if (mission_.active()) state->going_to() = going_to_;
    state->next() = agenda_.rest(rounds());
    state->reached(static_cast<std::uint32_t>(reached_));
    state->missed(static_cast<std::uint32_t>(missed_));
    state->result() = result_;
    state->stamp(orca::to_time_value(now()));
    return state;
  }

  // Who was given an order waits for others when it is carried out.
  orca::Status obey(const orca::idl::TripOrder& order) {
    const orca::idl::TripOrderKind kind = order.kind();
    std::vector<Trip> trips;
    for (const std::string& text : order.goals())
      if (orca::Status added = add(text, trips); !added.ok()) return added;
    const bool needs_goals = kind == orca::idl::TRIP_GO || kind == orca::idl::TRIP_QUEUE;
    if (needs_goals == trips.empty())
      return orca::fail(orca::Code::invalid_argument,
                        "an order to go names a goal at least, and no other order names one");
    if (kind == orca::idl::TRIP_SHOW) return orca::ok();
    stays_ = true;
    const bool is_over = !mission_.active() && agenda_.next(rounds()) == nullptr;
    const bool adds = kind == orca::idl::TRIP_QUEUE && !is_over;
    if (!adds) ordered_.clear();
    ordered_.insert(ordered_.end(), order.goals().begin(), order.goals().end());
    if (adds) {
      agenda_.add(std::move(trips));
      return orca::ok();
    }
    ordered_rounds_ = order.rounds();
    drive_to(std::move(trips), needs_goals ? "there are other goals" : "by \"" + order.origin() + "\"");
    return orca::ok();
  }

  void stop() override { mission_.stop(); }

  // A goal that the robot is on its way to is driven to again.
  void save_state(orca::StateWriter& state) const override {
    const std::size_t on_the_way = mission_.active() ? 1 : 0;
    state.write(tried_ - on_the_way, unreached_, missed_, agenda_.begun() - on_the_way, listed_, stays_,
                ordered_, ordered_rounds_, reached_);
  }

  orca::Status load_state(orca::StateReader& state) override {
    if (state.tag().version == 1) {
      if (orca::Status read = state.read(tried_, unreached_); !read.ok()) return read;
      missed_ = unreached_.size();
      agenda_.go_on_after(tried_);
      return orca::ok();
    }
    std::size_t begun = 0;
    std::vector<std::string> listed;
    bool stays = false;
    if (orca::Status read = state.read(tried_, unreached_, missed_, begun, listed, stays); !read.ok())
      return read;
    if (state.tag().version > 2)
      if (orca::Status read = state.read(ordered_, ordered_rounds_, reached_); !read.ok()) return read;
    if (listed != listed_) return forget_orders();  // that was another list
    if (orca::Status again = take_orders_again(); !again.ok()) return again;
    agenda_.go_on_after(begun);
    stays_ = stays;
    asks_ = asks_ && !stays;
    return orca::ok();
  }

  orca::Status forget_orders() {
    ordered_.clear();
    ordered_rounds_.reset();
    return orca::ok();
  }

  // Orders took the place of the list of before, or were added to it.
  orca::Status take_orders_again() {
    std::vector<Trip> trips;
    for (const std::string& text : ordered_)
      if (orca::Status added = add(text, trips); !added.ok()) return added;
    if (ordered_rounds_) agenda_.set({});
    agenda_.add(std::move(trips));
    return orca::ok();
  }

  [[nodiscard]] std::uint32_t state_version() const override { return 3; }
  [[nodiscard]] std::vector<orca::StateTag> accepted_states() const override {
    return {{"orca.Command", 1}, {"orca.Command", 2}};
  }

  // Asks the user for one goal; false when there will be no more. Typed letters stay when the lap is given up for an order.
  bool ask() {
    const orca::LiveLine::Pause room;  // the user sees what he types
    if (!prompt_.show()) return false;
    // To sleep would be an act of this lap, which could not be given up then.
    while (!wait_until([this] { return prompt_.read(); }, std::chrono::milliseconds(50))) continue;
    const std::string line = prompt_.take_line();
    if (line.empty()) return false;
    std::vector<Trip> trips;
    if (const orca::Status added = add(line, trips); !added.ok()) log_error(added.error().text());
    agenda_.set(std::move(trips));
    return true;
  }

  orca::Status read_file(std::vector<Trip>& trips) {
    const auto lines = orca::command::read_goal_file(*goals_file_);
    if (!lines) return lines.error();
    for (const orca::command::GoalLine& line : *lines)
      if (const orca::Status added = add(line.text, trips); !added.ok())
        return orca::fail(added.error().code, added.error().message, line.place);
    return orca::ok();
  }

  orca::Status add(const std::string& text, std::vector<Trip>& trips) {
    orca::Result<Trip> trip = orca::go::parse_trip(text);
    if (!trip) return trip.error();
    if (orca::Status found = mission_.look_up(*trip); !found.ok()) return found;
    trips.push_back(std::move(trip).value());
    return orca::ok();
  }

  orca::QueryServer<orca::idl::TripOrder, orca::idl::TripState> orders_{
      *this,
      "TripQuery",
      &Command::on_order,
      {.text = "Orders of an operator: other goals, more goals, or none. The answer is what it does then."}};
  MissionProxy mission_{*this, host()};

  orca::Param<std::vector<std::string>> goals_{
      *this,
      "goals",
      {},
      {.text = "Goals, each \"name: x y > door x y degrees width > x y\" in metres: any via points, then the "
               "goal; or \"hall > kitchen\": places by name. Other goals take the place of all."}};
  orca::Param<std::string> goals_file_{
      *this,
      "goals_file",
      "",
      {.file = true, .fixed = true, .text = "File of goals, one per line; # starts a comment line."}};
  orca::Param<std::int64_t> rounds_{
      *this,
      "rounds",
      1,
      {.min = 0,
       .max = 1e6,
       .text = "How often the goals are driven to, one after the other; 0: without end."}};
  orca::Param<double> goal_timeout_{
      *this,
      "goal_timeout",
      300.0,
      {.unit = "s", .min = 1.0, .text = "Longest time for one goal; after it the goal has failed."}};

  Agenda agenda_;
  std::vector<std::string> listed_;   // the parameter goals, as it was taken
  bool asks_ = false;                 // Whether goals come from the prompt.
  bool stays_ = false;                // Whether it waits for orders after the last goal.
  std::vector<std::string> ordered_;  // the goals of the orders that are carried out, as they were written
  std::optional<std::size_t> ordered_rounds_;  // theirs; nothing: none was given
  orca::command::Prompt prompt_;
  std::string going_to_;  // name of the goal on the way
  bool rests_ = false;    // Whether the goal before was not reached, and others are driven to in rounds.
  std::size_t tried_ = 0;
  std::size_t missed_ = 0;
  std::size_t reached_ = 0;
  std::string result_;                  // of the last goal that is over
  std::vector<std::string> unreached_;  // each once
};

}  // namespace

ORCA_COMPONENT(Command, "orca.Command")
ORCA_ALLOW_IN_VIRTUAL_TIME("poll", "with a timeout of zero: it asks for input and never waits for it")
