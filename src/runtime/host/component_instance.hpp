// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "guard.hpp"
#include "orca/component/component.hpp"
#include "orca/component/manifest.hpp"
#include "run_context.hpp"

namespace orca {

/// The states of thesis Fig. 9.1; INIT and EXIT are explicit here.
enum class ComponentState { init, idle, connect, work, work_done, work_failed, exit };

[[nodiscard]] const char* to_string(ComponentState state);

/// How one component of the graph is to run.
struct ComponentSettings {
  std::string name;
  int priority = 0;
  std::optional<bool> autonomous;
  std::optional<Trigger> trigger;  ///< Instead of the author's.
  std::map<std::string, ParamValue> params;
  std::map<std::string, std::string> port_names;  ///< What the graph calls a port, by the author's name for it.
};

/// One component in this process: its ports, its strand, and the state machine that calls it.
///
/// Thread contract: the constructor and wiring before start(); endpoint(), state(), failure() from anywhere;
/// the hooks and laps run on the strand.
class ComponentInstance final : public ComponentHost {
 public:
  ComponentInstance(RunContext& run, ComponentSettings settings, const TypeEntry& type,
                    hw::HardwareContainer* hardware);
  ~ComponentInstance() override;

  /// Constructs the component and sets its parameters.
  /// @errors  internal with what it threw.
  Status construct();

  /// The endpoint of a declared port, or null.
  [[nodiscard]] Endpoint* endpoint(const std::string& port) const;

  void start();
  /// Lets the component leave IDLE: the whole system is up.
  void open_gate();
  /// Ends the strand at the next wait or lap boundary.
  void request_exit();
  [[nodiscard]] bool join_until(TimePoint deadline) { return strand_.join_until(deadline); }

  [[nodiscard]] ComponentState state() const { return state_.load(std::memory_order_acquire); }
  [[nodiscard]] bool at_rest() const;
  /// Why it is in WORK_FAILED, or why it could not be configured.
  [[nodiscard]] std::string failure() const;
  /// The hook that the strand is in now, for people; "" between hooks.
  [[nodiscard]] const char* current_hook() const { return hook_.load(std::memory_order_acquire); }

  // ComponentHost
  void declare_port(PortDeclaration declaration) override;
  void declare_param(ParamDeclaration declaration) override;
  void set_default_trigger(const Trigger& trigger) override { trigger_ = trigger; }
  [[nodiscard]] const std::string& name() const override { return settings_.name; }
  [[nodiscard]] TimePoint now() const override { return run_.executive.now(); }
  [[nodiscard]] RandomStream random(std::string_view stream) const override;
  void write_log(log::Level level, std::string_view text) const override;
  void announce(const Announcement& announcement) override { run_.announce(announcement); }
  [[nodiscard]] hw::HardwareContainer* hardware() override { return hardware_; }
  void stay_active(bool active) override { stays_active_ = active; }
  [[nodiscard]] Strand& strand() override { return strand_; }

 private:
  template <class Kind>
  struct Intake {
    Kind* endpoint;
    typename Kind::Handler handler;
  };

  void main();
  bool configure();
  Status resolve_trigger();
  [[nodiscard]] const std::string& name_in_graph(const std::string& port) const;
  void turn();
  void follow_clients();
  void enter_work();
  void leave_work(ComponentState next);
  void lap();
  void conclude(const Outcome& outcome);
  bool handle_one_intake();
  bool handle_sent(SendServerEndpoint& endpoint);
  bool handle_asked(QueryServerEndpoint& endpoint);

  std::optional<PluginFault> call(const char* hook, const std::function<void()>& body);
  void fail_with(const char* hook, const std::string& what);
  void set_state(ComponentState state);
  void open_intakes();
  void close_intakes(const std::string& reason);
  void release_clients();

  [[nodiscard]] bool wanted() const;
  [[nodiscard]] bool lap_is_due() const;
  [[nodiscard]] TimePoint next_wake_up() const;
  template <class Kind>
  Kind& add_endpoint(const PortContract& contract);

  RunContext& run_;
  const ComponentSettings settings_;
  const TypeEntry& type_;
  hw::HardwareContainer* const hardware_;
  Strand strand_;
  PortHome home_;
  std::vector<std::unique_ptr<Endpoint>> endpoints_;  // all, in order of declaration
  std::vector<PushServerEndpoint*> push_servers_;
  std::vector<PushClientEndpoint*> push_clients_;
  std::vector<PushClientEndpoint*> automatic_clients_;  // those that the runtime subscribes
  std::vector<Intake<SendServerEndpoint>> send_servers_;
  std::vector<Intake<QueryServerEndpoint>> query_servers_;
  std::vector<ParamDeclaration> params_;
  Trigger trigger_;
  PushClientEndpoint* trigger_port_ = nullptr;
  std::unique_ptr<Component, void (*)(Component*)> component_;

  // Strand only.
  bool stays_active_ = false;
  bool in_lap_ = false;
  TimePoint next_lap_{};

  // Any strand.
  std::atomic<ComponentState> state_{ComponentState::init};
  std::atomic<bool> gate_open_{false};
  std::atomic<bool> exit_requested_{false};
  std::atomic<const char*> hook_{""};
  mutable std::mutex failure_mutex_;
  std::string failure_;
};

}  // namespace orca
