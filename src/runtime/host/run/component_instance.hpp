// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "containment/guard.hpp"
#include "loaded_component.hpp"
#include "order.hpp"
#include "port_set.hpp"
#include "run_context.hpp"

namespace orca::host {

/// The states of thesis Fig. 9.1; INIT and EXIT are explicit here, UNLOADED and SUSPENDED are new.
enum class ComponentState {
  unloaded,  ///< Not even in memory: nobody has asked for it yet, or not for a while.
  init,
  idle,
  connect,
  work,
  work_done,
  work_failed,
  suspended,
  exit
};

[[nodiscard]] const char* to_string(ComponentState state);

/// How one component of the graph is to run.
struct ComponentSettings {
  std::string name;
  int priority = 0;
  std::optional<bool> autonomous;
  std::optional<Trigger> trigger;  ///< Instead of the author's.
  bool on_demand = false;          ///< Loaded when first asked for.
  bool stay_warm = false;          ///< Once loaded it stays.
  Duration idle_time{0};           ///< An on-demand component that nobody has used for so long is unloaded.
  std::map<std::string, ParamValue> params;
  std::map<std::string, std::string>
      port_names;  ///< What the graph calls a port, by the author's name for it.
};

/// One component in this process: its ports, its strand, and the state machine that calls it.
///
/// Thread contract: the constructor, load() and declare() before start(); endpoint(), state(), failure(),
/// params() and the orders from anywhere; the hooks and laps run on the strand.
class ComponentInstance final : public ComponentHost {
 public:
  using Loader = std::function<Result<LoadedType>()>;
  using Unloader = std::function<Status(LoadedType)>;

  /// @param loader, unloader  bring the type's code into memory and let it go; on the strand.
  ComponentInstance(RunContext& run, ComponentSettings settings, Loader loader, Unloader unloader,
                    Device* hardware);
  ~ComponentInstance() override;

  /// Loads and constructs the component and sets its parameters.
  /// @errors  of the loader; internal with what it threw.
  Status load();
  /// Makes the ports of one that is loaded on demand only.
  void declare(const Contract& contract);

  /// The endpoint of a declared port, or null.
  [[nodiscard]] Endpoint* endpoint(const std::string& port) const { return ports_.find(port); }

  void start();
  /// Lets the component leave IDLE: the whole system is up.
  void open_gate();
  /// Ends the strand at the next wait or lap boundary.
  void request_exit();
  [[nodiscard]] bool join_until(TimePoint deadline) { return strand_.join_until(deadline); }

  /// Orders are carried out between two laps, one after the other. A lap that waits and has not taken or sent
  /// anything yet is given up for them, and begins anew after.
  std::shared_ptr<Order> order_suspend();
  std::shared_ptr<Order> order_resume();
  /// All values change together, or none does.
  /// @param values  checked against the contract.
  std::shared_ptr<Order> order_params(std::map<std::string, ParamValue> values);

  [[nodiscard]] ComponentState state() const { return state_.load(std::memory_order_acquire); }
  [[nodiscard]] bool at_rest() const;
  /// Whether it has been in WORK_FAILED, be it that a new client made it start anew.
  [[nodiscard]] bool has_failed() const { return has_failed_.load(std::memory_order_acquire); }
  /// Why it is in WORK_FAILED, or why it could not be configured.
  [[nodiscard]] std::string failure() const;
  /// The hook that the strand is in now, for people; "" between hooks.
  [[nodiscard]] const char* current_hook() const { return hook_.load(std::memory_order_acquire); }
  /// What its parameters may be.
  [[nodiscard]] const std::vector<ParamContract>& param_contracts() const { return param_contracts_; }
  /// What they are now.
  [[nodiscard]] std::map<std::string, ParamValue> params() const;

  // ComponentHost
  void declare_port(PortDeclaration declaration) override;
  void declare_param(ParamDeclaration declaration) override {
    loaded_->params.push_back(std::move(declaration));
  }
  void set_default_trigger(const Trigger& trigger) override;
  [[nodiscard]] const std::string& name() const override { return settings_.name; }
  [[nodiscard]] TimePoint now() const override { return run_.executive.now(); }
  [[nodiscard]] RandomStream random(std::string_view stream) const override;
  void write_log(log::Level level, std::string_view text) const override;
  void announce(const Announcement& announcement) override { run_.announce(announcement); }
  [[nodiscard]] Device* hardware() override { return hardware_; }
  void stay_active(bool active) override { stays_active_ = active; }
  [[nodiscard]] Strand& strand() override { return strand_; }

 private:
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

  void be_unloaded();
  void unload();

  std::shared_ptr<Order> enqueue(std::function<Status()> body);
  bool carry_out_order();
  void refuse_orders();
  Status suspend();
  Status resume();
  Status change_params(const std::map<std::string, ParamValue>& values);
  void apply(const std::map<std::string, ParamValue>& values);

  std::optional<PluginFault> call(const char* hook, const std::function<void()>& body);
  void fail_with(const char* hook, const std::string& what);
  void set_state(ComponentState state);

  [[nodiscard]] bool wanted() const;
  [[nodiscard]] bool must_leave_lap() const;
  [[nodiscard]] bool lap_is_due() const;
  [[nodiscard]] bool unload_is_due() const;
  [[nodiscard]] TimePoint next_wake_up() const;

  RunContext& run_;
  const ComponentSettings settings_;
  const Loader loader_;
  const Unloader unloader_;
  Device* const hardware_;
  Strand strand_;
  PortHome home_;
  PortSet ports_;
  std::vector<ParamContract> param_contracts_;  // constant once the strand has started
  std::unique_ptr<LoadedComponent> loaded_;

  // Strand only.
  Trigger trigger_;
  PushClientEndpoint* trigger_port_ = nullptr;
  bool stays_active_ = false;
  bool in_lap_ = false;
  bool may_try_again_ = false;  // in WORK_FAILED: the component itself is sound
  std::uint64_t activity_before_lap_ = 0;
  TimePoint next_lap_{};
  TimePoint idle_since_{};
  ComponentState before_suspension_ = ComponentState::idle;

  // Any strand.
  std::atomic<ComponentState> state_;
  std::atomic<bool> gate_open_{false};
  std::atomic<bool> exit_requested_{false};
  std::atomic<bool> order_waits_{false};
  std::atomic<bool> has_failed_{false};
  std::atomic<const char*> hook_{""};
  mutable std::mutex mutex_;
  std::string failure_;
  std::map<std::string, ParamValue> values_;
  std::deque<std::shared_ptr<Order>> orders_;
  bool takes_orders_ = true;
};

}  // namespace orca::host
