// SPDX-License-Identifier: LGPL-3.0-or-later
#include "swap.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "containment/environment.hpp"
#include "fit.hpp"
#include "orca/base/text.hpp"

namespace orca::host {
namespace {

constexpr Duration kMakeLimit = 10s;
constexpr Duration kConfigureLimit = 10s;
constexpr Duration kLapEndLimit = 5s;     // for the component to come to the end of a lap
constexpr Duration kTakeOverLimit = 10s;  // of save_state(), start() and load_state() together
constexpr Duration kEndLimit = 5s;
constexpr Duration kLongLap = 500ms;    // of which a probation must not be the beginning
constexpr Duration kLookAgain = 100ms;  // at a lap that is longer than the probation

}  // namespace

Swap::Swap(const Place& place, SwapOrder order)
    : place_(place),
      order_(std::move(order)),
      beside_(place.run.executive, "swap", place.run.seed, place.run.changed, place.run.missions),
      backdrop_(place.run.executive),
      task_(place.run) {}

Swap::~Swap() = default;

Error Swap::refuse(Code code, const std::string& why) const { return fail(code, why, order_.component); }

void Swap::enter(Phase phase, Duration limit) {
  phase_ = phase;
  task_.enter(limit);
}

// --- Beside the component ---------------------------------------------------------------------------------

Status Swap::prepare() {
  if (place_.component.parts().hardware != nullptr)
    return refuse(Code::failed_precondition, "it serves hardware, and cannot be exchanged while that runs");
  phase_ = Phase::making;
  task_.begin(kMakeLimit, [this] {
    made_ = make();
    if (!made_.ok()) successor_.reset();
  });
  return ok();
}

// Runs on a task of its own.
Status Swap::make() {
  LoadedType type;
  Contract contract;
  if (Status acquired = acquire(type, contract); !acquired.ok()) return acquired;
  offered_ = contract.ports;
  return make_successor(type, contract);
}

// The graph may change while the new object is made.
Status Swap::connect() {
  const std::vector<std::string> faults = misfits_in(place_.graph, place_.component.parts().settings,
                                                     place_.component.parts().ports.contracts(), offered_);
  if (!faults.empty())
    return refuse(Code::failed_precondition,
                  report_.new_type + " cannot take its place: " + joined(faults, "; "));
  Backdrop::keep_places(place_.component, *successor_);
  return backdrop_.connect(place_.graph, *successor_);
}

Status Swap::acquire(LoadedType& type, Contract& contract) {
  report_.old_type = place_.type;
  report_.new_type = order_.type.empty() ? place_.type : order_.type;
  is_loading_.store(true);
  Result<LoadedType> acquired = place_.catalogue.acquire(std::move(order_.plugin), PluginKind::component,
                                                         report_.new_type, order_.trial);
  is_loading_.store(false);
  if (!acquired) return acquired.error();
  type = std::move(acquired).value();
  report_.build_id = type.library->build_id();
  Result<Contract> described = plugin::describe_component(*type.entry, type.file(), nullptr);
  if (!described) return described.error();
  contract = std::move(described).value();
  return ok();
}

Status Swap::make_successor(const LoadedType& type, const Contract& contract) {
  ComponentSettings settings = place_.component.parts().settings;
  settings.on_demand = false;
  settings.failure.reset();
  Result<ParamValues> values =
      inherited(contract.params, place_.component.parts().params.values(), order_.params);
  if (!values) return values.error();
  report_.params = contract.params;
  report_.values = *values;
  settings.params = std::move(values).value();
  successor_ = std::make_unique<ComponentInstance>(
      beside_.context(), std::move(settings), [type] { return Result<LoadedType>(type); },
      [&catalogue = place_.catalogue](LoadedType gone) { return catalogue.release(std::move(gone)); },
      nullptr);
  return successor_->load();
}

// --- Step by step -----------------------------------------------------------------------------------------

Swap::Outcome Swap::step() {
  switch (phase_) {
    case Phase::making: return made();
    case Phase::configuring: return configured();
    case Phase::taking_over:
    case Phase::in_take_over: return taken_over();
    case Phase::probation:
    case Phase::going_back: return watch();
    case Phase::ending: return ended();
  }
  return std::nullopt;
}

TimePoint Swap::wake_up() const { return task_.limit(); }

Swap::Outcome Swap::made() {
  if (!task_.is_done()) {
    if (!task_.is_late()) return std::nullopt;
    outcome_ = refuse(Code::deadline_exceeded, "the constructor of the new one did not return within 10 s");
    if (is_loading_.load())
      return lose("its static initialisation hangs, and no code can be loaded any more");
    return leave_behind("the constructor of the new one");
  }
  task_.reset();
  if (!made_.ok()) return Outcome(made_.error());
  if (const Status connected = connect(); !connected.ok()) return end(connected.error());
  enter(Phase::configuring, kConfigureLimit);
  successor_->start([this] { task_.start_clock(); });
  return step();
}

Swap::Outcome Swap::configured() {
  if (successor_->state() == ComponentState::init) {
    if (!task_.is_late()) return std::nullopt;
    outcome_ = refuse(Code::deadline_exceeded, "configure() of the new one did not return within 10 s");
    return leave_behind("configure() of the new one");
  }
  if (successor_->has_failed()) return end(refuse(Code::failed_precondition, successor_->failure()));
  Environment::of_process().look_ahead(order_.component);
  enter(Phase::taking_over, kLapEndLimit);
  pending_ = place_.component.order_take_over(*successor_, order_.fresh, take_over_);
  return step();
}

Swap::Outcome Swap::taken_over() {
  if (!pending_->done()) return task_.is_late() ? withdraw() : std::nullopt;
  if (const Status& taken = pending_->result(); !taken.ok())
    return end(refuse(taken.error().code, "the new one was not taken: " + taken.error().message));
  report_.pause = take_over_.pause;
  if (take_over_.state) report_.state = take_over_.state->text();
  enter(Phase::probation, order_.probation);
  return step();
}

// Gives up what the component has not begun. What hangs in its place hangs on its strand, where nothing else can run then.
Swap::Outcome Swap::withdraw() {
  const std::string hook = place_.component.current_hook();
  if (pending_->withdraw())
    return end(refuse(Code::deadline_exceeded,
                      "it has not come to the end of a lap within 5 s" +
                          (hook.empty() ? "" : "; it is in " + hook) +
                          "; nothing has changed, so try again when that is over; if it never is, "
                          "orcactl restart begins its process anew, with the code of the graph"));
  if (phase_ == Phase::in_take_over) return lose((hook.empty() ? "it" : hook) + " hangs in an exchange");
  enter(Phase::in_take_over, kTakeOverLimit);
  return step();
}

Swap::Outcome Swap::watch() {
  const auto back = [this]() -> Outcome {
    const std::optional<std::string> why = place_.component.succession().take_back_reason();
    if (!why) return std::nullopt;
    return end(refuse(Code::failed_precondition, "the new one failed, and the old one is back: " + *why));
  };
  if (const Outcome outcome = back(); outcome || phase_ == Phase::ending) return outcome;
  if (!task_.is_late()) return std::nullopt;
  if (phase_ == Phase::probation && is_in_long_lap()) return wait_for_lap();
  if (place_.component.succession().confirm()) {
    const Outcome outcome = back();
    return outcome || phase_ == Phase::ending ? outcome : end(report_);
  }
  if (phase_ == Phase::going_back) return lose("the old object, which is to be back, hangs");
  enter(Phase::going_back, kTakeOverLimit);
  return std::nullopt;
}

// Returns whether the new object has computed or slept for long without waiting for anything of Orca.
bool Swap::is_in_long_lap() const {
  if (order_.probation == Duration{0}) return false;
  const auto stuck = place_.run.executive.stuck_task(std::min(kLongLap, order_.probation / 2));
  return stuck && stuck->name == order_.component;
}

// If the lap never ends, nothing could take the new object's place any more.
Swap::Outcome Swap::wait_for_lap() {
  overtime_ += kLookAgain;
  if (overtime_ > kTakeOverLimit)
    return lose(std::string(place_.component.current_hook()) + " of the new one hangs");
  enter(Phase::probation, kLookAgain);
  return std::nullopt;
}

// --- The end ----------------------------------------------------------------------------------------------

// Lets the object that is not needed any more end, the old one or the new one.
Swap::Outcome Swap::end(Result<SwapReport> outcome) {
  outcome_ = std::move(outcome);
  phase_ = Phase::ending;
  task_.begin(kEndLimit, [this] {
    successor_->request_exit();
    (void)successor_->join_until(kForever);
    successor_.reset();
  });
  return std::nullopt;
}

Swap::Outcome Swap::ended() {
  if (task_.is_done()) return task_.reset(), outcome_;
  if (!task_.is_late()) return std::nullopt;
  return leave_behind("stop() or the destructor of the object that is not needed any more");
}

// The exchange ends without the object. One that sleeps for ever takes nothing but memory.
Swap::Outcome Swap::leave_behind(const std::string& hangs) {
  if (task_.computes()) return lose(hangs + " computes without end");
  is_stuck_ = true;
  place_.run.reporter.log(log::Level::error, order_.component,
                          hangs + " does not return; it stays in memory until the process is started again");
  return outcome_;
}

Swap::Outcome Swap::lose(const std::string& hangs) {
  is_stuck_ = true;
  if (place_.stand_still)
    place_.stand_still(order_.component,
                       hangs + ", so the process is ended, and begins anew with the code of the graph");
  return outcome_ ? outcome_ : Outcome(refuse(Code::deadline_exceeded, hangs));
}

// What has not ended by now will not.
Result<SwapReport> Swap::give_up() {
  const Error reason = refuse(Code::unavailable, "the system was stopped before the swap was done");
  const TimePoint limit = saturating_add(place_.run.executive.now(), kEndLimit);
  if (!task_.join_until(limit)) is_stuck_ = true;
  if (is_stuck_ || successor_ == nullptr) return reason;
  successor_->request_exit();
  is_stuck_ = !successor_->join_until(limit);
  if (!is_stuck_) successor_.reset();
  return reason;
}

}  // namespace orca::host
