// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "component_loop.hpp"
#include "lifecycle.hpp"
#include "orca/host/component_report.hpp"
#include "parts/component_parts.hpp"
#include "parts/residency.hpp"
#include "state/state_keeper.hpp"
#include "state/succession.hpp"

namespace orca::host {

/// One component in this process, as the rest of the process sees it. The state machine is in
/// component_states.hpp, the code that runs on the strand in component_loop.hpp.
///
/// Thread contract: the constructor, load() and declare() before start(); the rest from anywhere.
class ComponentInstance final {
 public:
  /// @param loader, unloader  bring the type's code into memory and release it, on the strand once it runs.
  /// @param hardware  the hardware that the graph binds to the component, or null.
  ComponentInstance(RunContext& run, ComponentSettings settings, Residency::Loader loader,
                    Residency::Unloader unloader, Device* hardware);
  ~ComponentInstance();
  ComponentInstance(const ComponentInstance&) = delete;
  ComponentInstance& operator=(const ComponentInstance&) = delete;

  /// Loads a component that is there from the start; see Residency::load().
  Status load() { return residency_.load(); }
  /// Makes the ports of a component that is loaded only on demand.
  void declare(const Contract& contract) { residency_.declare(contract); }

  [[nodiscard]] const std::string& name() const { return parts_.settings.name; }
  /// Returns the endpoint of a declared port, or null.
  [[nodiscard]] Endpoint* endpoint(const std::string& port) const { return parts_.ports.find(port); }

  /// Returns what there is of it apart from its code.
  [[nodiscard]] const ComponentParts& parts() const { return parts_; }

  /// Lets other processes wake its strand.
  /// @pre  it has not been loaded or declared yet.
  void set_doorbell(DoorbellWord& word) { parts_.strand.set_doorbell(word); }
  /// @param first  called on the strand before anything else; empty: nothing is.
  void start(std::function<void()> first = {});
  /// Lets the component leave IDLE: the whole system is up.
  void open_gate() { loop_.open_gate(); }
  /// Announces request_exit(): the component begins nothing new, and what others refuse it is no news. To be called
  /// for all components of a system before the first of them ends.
  void announce_exit() { loop_.announce_exit(); }
  /// Ends the strand at the next wait or lap boundary.
  /// @param keeps_state  whether its state is handed out then, whatever the graph says.
  void request_exit(bool keeps_state = false) { loop_.request_exit(keeps_state); }
  [[nodiscard]] bool join_until(TimePoint deadline) { return parts_.strand.join_until(deadline); }
  /// Destroys its object now, for whoever has to know how that goes. @pre  the strand has ended.
  /// @errors  see Residency::destroy().
  Status destroy() { return residency_.destroy(); }

  /// Return the order. Orders are carried out between two laps, one after the other. A lap that waits and has
  /// not taken or sent anything yet is given up for them, and begins anew afterwards.
  std::shared_ptr<Order> order_suspend();
  std::shared_ptr<Order> order_resume();
  /// Orders new parameter values. They change all together, or none does.
  /// @param values  checked against the contract.
  std::shared_ptr<Order> order_params(ParamValues values);
  /// Orders that its object saves its state and loads that again, as a test; see Succession::check_state().
  std::shared_ptr<Order> order_state_check();
  /// Orders a call of a function that changes connections of its ports.
  std::shared_ptr<Order> order_rewiring(std::function<Status()> rewire);
  /// Orders that the successor's object takes the place of this component's, which goes to the successor.
  /// @param successor  configured, and IDLE with a closed gate. It lives until the order is done and Succession::confirm() has
  ///                   returned true, as `report` does.
  /// @param fresh      see Succession::take_over().
  std::shared_ptr<Order> order_take_over(ComponentInstance& successor, bool fresh, TakeOver& report);
  /// Returns the exchange of its object, which others may confirm and ask why it was undone.
  [[nodiscard]] Succession& succession() { return succession_; }

  [[nodiscard]] ComponentState state() const { return life_.state(); }
  [[nodiscard]] bool at_rest() const;
  /// Returns whether a client has subscribed to it, or something that was sent or asked waits or is being handled.
  [[nodiscard]] bool is_in_use() const;
  /// Returns whether the component has ever been in WORK_FAILED, even if a new client has made it start anew.
  [[nodiscard]] bool has_failed() const { return life_.has_failed(); }
  /// Returns why it is in WORK_FAILED, or why it could not be configured.
  [[nodiscard]] std::string failure() const { return life_.failure(); }
  /// Returns why it could not be configured; nothing if it could.
  [[nodiscard]] std::optional<Error> refusal() const { return life_.refusal(); }
  /// Returns all of this about its state as one value.
  [[nodiscard]] ComponentReport report() const {
    return {state(), life_.has_worked(), has_failed(), life_.ended_badly(), failure()};
  }
  /// Returns the hook that the strand is in now, for people: "work()"; for a handler its port; else "".
  [[nodiscard]] const char* current_hook() const { return parts_.hooks.current(); }
  /// Fills in the mission and cause of what the component works on. To be called on its strand.
  void stamp(idl::OrcaObject& object) const { parts_.home.provenance.stamp(object); }

 private:
  ComponentParts parts_;
  Residency residency_;
  Succession succession_;
  StateKeeper keeper_;
  Lifecycle life_;
  ComponentLoop loop_;
};

}  // namespace orca::host
