// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control/joint_orders.hpp"
#include "control/params/present_params.hpp"
#include "control/system_names.hpp"
#include "members/conductor.hpp"
#include "members/member.hpp"
#include "members/reply.hpp"
#include "orca/base/result.hpp"
#include "orca/base/system/pace.hpp"
#include "orca/host/component_report.hpp"
#include "orca/supervisor/system_facts.hpp"

namespace orca::supervisor {

/// What a run does at an operator's word.
struct RunLevers {
  std::function<void()> stop;              ///< Ends the run.
  std::function<Status(Member&)> restart;  ///< Ends a process and starts it again.
  Pace* pace = nullptr;                    ///< Of virtual time; null: the run is in real time.
};

/// Carries out what an operator orders: pauses, new parameters, restarts, the end. Jobs of the conductor call whatever says
/// that it waits.
///
/// Thread contract: the supervisor's thread.
class Operating {
 public:
  /// All of these outlive the object.
  Operating(Conductor& conductor, const graph::Graph& graph, const SystemFacts& facts,
            const SystemNames& names, host::Reports reports, RunLevers levers);

  /// Pause a component, or all of a group, and let them go on. All of a group obey, or none; who is so already is left
  /// alone. They are resumed in the order in which they start, and suspended the other way round. The answer has a
  /// record for each of a group. They wait.
  void suspend(const std::string& name, const ReplyPtr& reply);
  void resume(const std::string& name, const ReplyPtr& reply);
  /// Answers with a parameter, "component.param", or with all of a component and of the driver that it serves. A driver's name, too,
  /// may stand before its parameters.
  void get(const std::string& what, const ReplyPtr& reply) const;
  /// Changes parameters of any components: all of them, or none. They are checked before anything changes, and the
  /// answer has everything that is wrong with them. Those of a driver are refused with the command that puts it in anew. It waits.
  /// @param words  "component.param" and its value, in turn.
  void set(const std::vector<std::string>& words, const ReplyPtr& reply);
  /// Does the same with values that have been read and checked, by component. It waits.
  Status change(const std::map<std::string, graph::Params>& wanted);
  /// Sets a parameter for a component. It waits.
  /// @return the value before.
  /// @errors  as change().
  Result<std::string> set_for(const std::string& by, const PeerOrder& order);
  /// Carries out steps of several components, all of them or none, when no other joint order is under way. It waits.
  Status carry_out(const std::vector<JointStep>& steps) { return joint_orders_.carry_out(steps); }
  /// Learns where components are that are not in the graph, because they come or go; by name.
  void expect(std::map<std::string, std::string> processes) { comers_ = std::move(processes); }
  /// Returns the process of a component of the graph, or of one that comes or goes; empty: there is no such component.
  [[nodiscard]] std::string process_of(const std::string& component) const;
  /// Sends an order to a component, and waits until it has obeyed or refused.
  /// @errors  its own; not_found; unavailable if its process takes no orders at present, or ends before it has answered.
  [[nodiscard]] Status send(const std::string& component, Order order) const;
  /// Sends an order to a component that nobody waits for, if its process takes orders at present.
  void tell(const std::string& component, Order order) const;
  /// Returns whether an operator has paused a component.
  [[nodiscard]] bool is_suspended(const std::string& component) const {
    return host::is_suspended(reports_(component).state);
  }
  /// Returns what is known of the parameters of all.
  [[nodiscard]] PresentParams& present() { return present_; }
  /// Returns the present values of a component's parameters.
  [[nodiscard]] graph::Params params_of(const graph::ComponentNode& component) const;
  /// Starts a process again, which is named by itself or by one of its components. It waits until it is back.
  void restart(const std::string& name, const ReplyPtr& reply);
  /// Returns the pace of the run, which an operator may set; null: it is in real time.
  [[nodiscard]] Pace* pace() const { return levers_.pace; }
  /// Ends the run. The answer does not end before.
  void stop(const ReplyPtr& reply);

  /// Notes what an operator has changed through an earlier supervisor.
  void recall(const std::vector<std::pair<std::string, Pairs>>& params);
  /// Notes that processes work again. Parameters that were changed have the graph's values there.
  void came_up(const std::vector<Member*>& members);

 private:
  // A component or driver, and its parameters as they are now.
  struct Owner {
    std::string name;
    const Contract* contract;             // null: not known
    const graph::HardwareNode* hardware;  // null: a component
    graph::Params params;
  };
  struct ParamName {
    Owner owner;
    std::string param;  // empty: all
  };
  [[nodiscard]] Result<std::vector<Owner>> owners(const std::string& name) const;
  [[nodiscard]] Result<ParamName> find(const std::string& what) const;

  // What is to change in one component.
  struct Setting {
    std::string component;
    std::map<std::string, std::string> texts;  // as they were given
    graph::Params values;
    /// The values that they had when its turn came.
    std::shared_ptr<graph::Params> before = std::make_shared<graph::Params>();
  };
  class SettingReader;

  void pause(const std::string& name, bool suspends, const ReplyPtr& reply);
  [[nodiscard]] Status are_ready(const std::vector<std::string>& components) const;
  Status change(const std::vector<Setting>& settings, const std::string& who = "an operator");
  [[nodiscard]] Result<graph::Params> present_of(const Setting& setting) const;
  [[nodiscard]] JointStep step_of(const Setting& setting);
  [[nodiscard]] Result<Member*> ready_member_of(const std::string& component) const;

  Conductor& conductor_;
  const graph::Graph& graph_;
  const SystemNames& names_;
  const host::Reports reports_;
  const RunLevers levers_;
  PresentParams present_;
  std::map<std::string, std::string> comers_;  // see expect()
  std::vector<ReplyPtr> until_end_;
  JointOrders joint_orders_;
};

}  // namespace orca::supervisor
