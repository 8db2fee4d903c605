// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/component/host.hpp"
#include "orca/component/outcome.hpp"
#include "orca/component/param.hpp"
#include "orca/component/state.hpp"
#include "orca/patterns/port_owner.hpp"
#include "orca/patterns/push.hpp"

namespace orca {

/// The base class of every component (thesis 9.3): an equal peer that talks through ports only.
///
/// The state machine (thesis 9.4) calls the hooks. INIT calls configure(), CONNECT calls start(), WORK calls
/// work() lap by lap, and the way back to IDLE calls stop(). suspend() and resume() enclose SUSPENDED. A
/// component works while somebody subscribes to one of its PushServers, or while it has asked for work with
/// stay_active(); the graph may also say `autonomous`.
///
/// Two rules make this sound. The constructor only declares: ports and parameters are members, and it opens
/// and starts nothing, so a process may construct a component only to describe it. All hooks, laps and
/// handlers run on one strand, so they never overlap and need no locks.
///
/// Thread contract: everything on the component's strand.
class Component : public PortOwner {
 public:
  explicit Component(ComponentHost& host) : host_(host) {}
  ~Component() noexcept(false) override {}  // clang 14 takes no "= default" here
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;

  /// Checks the parameters and connections, and allocates. Called in INIT, once, after the parameters are set. An
  /// error keeps the whole system from starting; Param::refuse() gives it the place of a parameter.
  ///
  /// `deployer --check` and each start call it before in a copy of the process, as a trial, while all hardware is
  /// closed. The errors of all components are then reported at once, with their places in the graph, except
  /// unavailable and deadline_exceeded, which may be due to the trial. The trial ends at the first call that would
  /// leave a trace outside the copy: writing a file, opening a device, connecting to another program.
  virtual Status configure() { return ok(); }

  /// Prepares for work. Called in CONNECT, each time a first client comes, after the component's own
  /// providers have been subscribed to. An error leads to WORK_FAILED.
  virtual Status start() { return ok(); }

  /// Does one lap of WORK. Blocking calls on ports are welcome. While a lap waits and has not yet taken or
  /// sent anything, handlers of this component may run: the wait throws Interrupted, and the lap starts again
  /// afterwards.
  virtual Outcome work() = 0;

  /// Ends the work. Called after the last lap, when nobody uses the component any more and its providers are
  /// still there.
  virtual void stop() {}

  /// Prepares for a pause. Called between two laps when an operator pauses the component: SUSPENDED. The
  /// component stays subscribed, incoming objects wait in its queues, and nothing is called before resume().
  /// Robots stop by themselves when their commands cease.
  virtual void suspend() {}

  /// Ends a pause. Called before the first lap after SUSPENDED.
  virtual void resume() {}

  /// Takes note of new parameter values. They all change at once, between two laps. An error restores the old
  /// values and is returned to whoever requested the new ones.
  virtual Status params_changed() { return ok(); }

  /// Writes what an object that takes this one's place needs to go on as if nothing had happened: counts, estimates, what
  /// it has begun. Called between two laps when the component is exchanged for another version of itself; then parameters, ports,
  /// subscriptions and what waits in queues stay anyway. With restore="last" in the graph also called after laps and handlers, at
  /// most every 0.1 s, for the object that begins if the process is lost.
  virtual void save_state(StateWriter& /*state*/) const {}

  /// Takes over what the predecessor has written, if anything, in the same order. Called once, after configure() and, if the component
  /// works, after start(). All that was written must be read. An error leaves the predecessor in its place; if there is none any more,
  /// because the process was lost, the component fails.
  virtual Status load_state(StateReader& /*state*/) { return ok(); }

  /// Returns the version of what save_state() writes. Count it up whenever that changes.
  [[nodiscard]] virtual std::uint32_t state_version() const { return 1; }

  /// Returns the states that load_state() can read besides those of the same type and version; StateReader::tag() says
  /// which one it is. A state of another version of the same type that is not among them keeps the predecessor in its
  /// place; one of another type is left unread, and the object starts fresh.
  [[nodiscard]] virtual std::vector<StateTag> accepted_states() const { return {}; }

  // Used by the handles that are members of a component.
  void declare_port(PortDeclaration declaration) final { host_.declare_port(std::move(declaration)); }
  void declare_param(ParamDeclaration declaration) { host_.declare_param(std::move(declaration)); }

 protected:
  /// Sets that a lap starts once a period, unless the graph sets it. Without one of these, the next lap follows at once.
  /// @pre  of all four: called from the constructor or from configure().
  void lap_every(Duration period) { host_.set_default_trigger({Trigger::Kind::period, period, {}}); }
  /// Sets that a lap starts at each new object on a port, unless the graph sets it.
  /// @param at_least_every  [s] a lap also starts that long after the last one; 0: it does not.
  void lap_on(std::string port, Duration at_least_every = Duration{0}) {
    host_.set_default_trigger({Trigger::Kind::on_any, at_least_every, {std::move(port)}});
  }
  void lap_on(const PushProxyHandle& port) { lap_on(port.name()); }
  /// Sets that a lap starts when all these ports have something new.
  void lap_on_all(std::vector<std::string> ports, Duration at_least_every = Duration{0}) {
    host_.set_default_trigger({Trigger::Kind::on_all, at_least_every, std::move(ports)});
  }

  /// Returns the time between two laps as far as it is known in advance, for PushServer::start(): the period,
  /// or the one that the servers announce whose objects start the laps; 0: not known.
  /// @pre  called from start() or later, when the component is subscribed to its servers.
  [[nodiscard]] Duration lap_period() const { return host_.lap_period(); }

  [[nodiscard]] const std::string& name() const { return host_.name(); }
  [[nodiscard]] TimePoint now() const { return host_.now(); }
  [[nodiscard]] RandomStream random(std::string_view stream) const { return host_.random(stream); }

  /// Blocks this component for `time` [s].
  /// @errors  throws Interrupted.
  void sleep(Duration time);

  /// Blocks until the condition holds, at most `limit` [s]. The condition is evaluated whenever something
  /// arrives at a port of this component.
  /// @return whether it holds.
  /// @errors  throws Interrupted when the component must leave its lap; let it pass.
  bool wait_until(const std::function<bool()>& condition, Duration limit);

  void log_debug(std::string_view text) const { host_.write_log(log::Level::debug, text); }
  void log_info(std::string_view text) const { host_.write_log(log::Level::info, text); }
  void log_warning(std::string_view text) const { host_.write_log(log::Level::warning, text); }
  void log_error(std::string_view text) const { host_.write_log(log::Level::error, text); }

  /// Sets whether the component works even without subscribers, from now on. If the graph says `autonomous`, this
  /// has no effect.
  void stay_active(bool active) { host_.stay_active(active); }

  /// Begins a mission, the component's task from now on. Everything that it sends and logs belongs to this
  /// mission until it begins another or ends it, and so does whatever the receivers send because of it.
  /// @return the mission's id, which is in the header of all these objects; never 0.
  std::uint64_t begin_mission() { return host_.begin_mission(); }
  /// Ends the mission at which the component works, whether it has begun it or got it by Send: what it sends
  /// from now on belongs to none.
  void end_mission() { host_.end_mission(); }
  /// Makes an object the cause of what is sent from now on. If the component has no task, the object's mission
  /// is its mission in this lap. Objects that a PushProxy returns count without this; those that a component
  /// only looks at with latest() or gets from a PushProxyArray do not.
  void note_cause(const idl::OrcaObject& object) { host_.note_cause(object); }

  /// Raises an alarm of this component's own. It reaches the log, the operator (`orcactl alarms`), AlarmCentral and the result of
  /// the run, and stays until it is cleared and an operator has acknowledged it. An alarm that is active already is not raised again.
  /// @param kind  a word of capitals, digits and '_', "GRIPPER_WORN", and none of the runtime's own kinds: else an error is logged
  ///              instead.
  /// @param text  what is wrong and what to do, for people.
  void raise_alarm(std::string_view kind, idl::AlarmSeverity severity, std::string_view text) {
    host_.raise_alarm(kind, severity, text);
  }
  /// Says that what an alarm of this component is about is over. Without such an alarm it does nothing.
  void clear_alarm(std::string_view kind, std::string_view text) { host_.clear_alarm(kind, text); }

  /// Returns the alarms of the whole system that were raised or cleared since the last call, whichever process raised
  /// them; the first call returns the latest of the run. For a component that passes them on.
  [[nodiscard]] std::vector<idl::Alarm> take_alarms() { return host_.take_alarms(); }
  /// Returns the alarms of the whole system that nobody has acknowledged yet. They outlive their sources.
  [[nodiscard]] std::vector<idl::Alarm> kept_alarms() const { return host_.kept_alarms(); }

  [[nodiscard]] ComponentHost& host() const { return host_; }

 private:
  ComponentHost& host_;
};

}  // namespace orca
