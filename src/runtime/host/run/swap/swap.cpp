// SPDX-License-Identifier: LGPL-3.0-or-later
#include "swap.hpp"

#include <utility>
#include <vector>

#include "containment/environment.hpp"
#include "fit.hpp"
#include "orca/base/text.hpp"

namespace orca::host {
namespace {

constexpr Duration kConfigureLimit = 10s;
constexpr Duration kEndLimit = 2s;

}  // namespace

Swap::Swap(const Place& place, SwapOrder order)
    : place_(place),
      order_(std::move(order)),
      beside_(place.run.executive, "swap", place.run.seed, place.run.changed, place.run.missions),
      backdrop_(place.run.executive) {}

Swap::~Swap() = default;

Result<SwapReport> Swap::give_up() {
  return end(refuse(Code::unavailable, "the system was stopped before the swap was done"));
}

Error Swap::refuse(Code code, const std::string& why) const { return fail(code, why, order_.component); }

// --- Beside the component ---------------------------------------------------------------------------------

Status Swap::prepare() {
  LoadedType type;
  Contract contract;
  if (Status acquired = acquire(type, contract); !acquired.ok()) return acquired;
  const std::vector<std::string> faults =
      misfits_in(place_.graph, place_.component.parts().settings, place_.component.parts().ports.contracts(),
                 contract.ports);
  if (!faults.empty())
    return refuse(Code::failed_precondition,
                  report_.new_type + " cannot take its place: " + joined(faults, "; "));
  if (Status made = make_successor(type, contract); !made.ok()) return made;
  limit_ = saturating_add(place_.run.executive.now(), kConfigureLimit);
  successor_->start();
  return ok();
}

Status Swap::acquire(LoadedType& type, Contract& contract) {
  if (place_.component.parts().hardware != nullptr)
    return refuse(Code::failed_precondition, "it serves hardware, and cannot be exchanged while that runs");
  report_.old_type = place_.type;
  report_.new_type = order_.type.empty() ? place_.type : order_.type;
  Result<LoadedType> acquired = place_.catalogue.acquire(std::move(order_.plugin), PluginKind::component,
                                                         report_.new_type, order_.trial);
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
  Result<ParamValues> values = inherited(contract.params, place_.component.params(), order_.params);
  if (!values) return values.error();
  settings.params = std::move(values).value();
  successor_ = std::make_unique<ComponentInstance>(
      beside_.context(), std::move(settings), [type] { return Result<LoadedType>(type); },
      [&catalogue = place_.catalogue](LoadedType gone) { return catalogue.release(std::move(gone)); },
      nullptr);
  if (Status loaded = successor_->load(); !loaded.ok()) return loaded;
  Backdrop::keep_places(place_.component, *successor_);
  return backdrop_.connect(place_.graph, *successor_);
}

// --- Step by step -----------------------------------------------------------------------------------------

std::optional<Result<SwapReport>> Swap::step() {
  switch (phase_) {
    case Phase::configuring: return configured();
    case Phase::taking_over: return taken_over();
    case Phase::probation: return watch();
    case Phase::confirming: return confirmed();
  }
  return std::nullopt;
}

TimePoint Swap::wake_up() const {
  return phase_ == Phase::configuring || phase_ == Phase::probation ? limit_ : kForever;
}

void Swap::await(Phase phase, std::shared_ptr<Order> order) {
  phase_ = phase;
  pending_ = std::move(order);
}

std::optional<Result<SwapReport>> Swap::configured() {
  if (successor_->state() == ComponentState::init) {
    if (place_.run.executive.now() < limit_) return std::nullopt;
    return end(refuse(Code::deadline_exceeded, "configure() of the new one did not return within 10 s"));
  }
  if (successor_->has_failed()) return end(refuse(Code::failed_precondition, successor_->failure()));
  Environment::of_process().look_ahead(order_.component);
  await(Phase::taking_over, place_.component.order_take_over(*successor_, take_over_));
  return step();
}

std::optional<Result<SwapReport>> Swap::taken_over() {
  if (!pending_->done()) return std::nullopt;
  if (const Status& taken = pending_->result(); !taken.ok())
    return end(refuse(taken.error().code, "the new one was not taken: " + taken.error().message));
  report_.pause = take_over_.pause;
  if (take_over_.state) report_.state = take_over_.state->text();
  phase_ = Phase::probation;
  limit_ = saturating_add(place_.run.executive.now(), order_.probation);
  return step();
}

std::optional<Result<SwapReport>> Swap::watch() {
  if (place_.component.take_back_reason() || place_.run.executive.now() >= limit_) {
    await(Phase::confirming, place_.component.order_confirmation());
    return step();
  }
  return std::nullopt;
}

std::optional<Result<SwapReport>> Swap::confirmed() {
  if (!pending_->done()) return std::nullopt;
  if (const std::optional<std::string> why = place_.component.take_back_reason())
    return end(refuse(Code::failed_precondition, "the new one failed, and the old one is back: " + *why));
  return end(report_);
}

// Destroys the object that is not needed any more, the old one or the new one.
Result<SwapReport> Swap::end(Result<SwapReport> outcome) {
  successor_->request_exit();
  if (successor_->join_until(saturating_add(place_.run.executive.now(), kEndLimit))) {
    successor_.reset();
  } else {
    is_stuck_ = true;
    place_.run.reporter.log(log::Level::error, order_.component,
                            "the object that is not needed any more does not end; it stays in memory");
  }
  return outcome;
}

}  // namespace orca::host
