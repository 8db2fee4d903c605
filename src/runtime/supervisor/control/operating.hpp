// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "control/reply.hpp"
#include "control/system_names.hpp"
#include "orca/base/result.hpp"
#include "orca/supervisor/system_facts.hpp"
#include "run/member.hpp"

namespace orca::supervisor {

/// What a run does at an operator's word.
struct RunLevers {
  std::function<void()> stop;              ///< Ends the run.
  std::function<Status(Member&)> restart;  ///< Ends a process and starts it again.
  /// Returns the edges in use of those that ports choose from.
  std::function<std::vector<const graph::Edge*>()> edges_in_use;
  std::function<void()> wake;  ///< Lets the supervisor's thread look at once. From any thread.
};

/// Carries out what an operator orders: pauses, new parameters, restarts, the end.
///
/// Thread contract: the supervisor's thread.
class Operating {
 public:
  /// All of these outlive the object.
  Operating(const graph::Graph& graph, const SystemFacts& facts, const SystemNames& names, RunLevers levers)
      : graph_(graph), facts_(facts), names_(names), levers_(std::move(levers)) {}

  /// Pause a component, and let it go on.
  void suspend(const std::string& component, const ReplyPtr& reply);
  void resume(const std::string& component, const ReplyPtr& reply);
  /// Answers with a parameter, "component.param", or with all of a component.
  void get(const std::string& what, const ReplyPtr& reply) const;
  /// Changes a parameter.
  void set(const std::string& what, const std::string& value, const ReplyPtr& reply);
  /// Returns the present values of a component's parameters.
  [[nodiscard]] graph::Params params_of(const graph::ComponentNode& component) const;
  /// Starts a process again, which is named by itself or by one of its components. The answer ends when it is back.
  void restart(const std::string& name, const ReplyPtr& reply);
  /// Ends the run. The answer does not end before.
  void stop(const ReplyPtr& reply);

  /// Notes what an operator has changed through an earlier supervisor.
  void recall(const std::vector<std::pair<std::string, Pairs>>& params);
  /// Notes that processes work again. Parameters that were changed have the graph's values there.
  void came_up(const std::vector<Member*>& members);

 private:
  struct ParamName {
    const graph::ComponentNode* component;
    std::string param;  // empty: all
  };
  [[nodiscard]] Result<ParamName> find(const std::string& what) const;
  [[nodiscard]] std::string value_of(const ParamName& name) const;
  void add_param(const ParamName& name, Reply& reply) const;
  void order(const std::string& component, const ReplyPtr& reply,
             const std::function<Order(const std::string&)>& make);

  const graph::Graph& graph_;
  const SystemFacts& facts_;
  const SystemNames& names_;
  const RunLevers levers_;
  std::map<std::string, graph::Params> changed_;    // by component: what is not as in the graph
  std::multimap<const Member*, ReplyPtr> awaited_;  // restarts
  std::vector<ReplyPtr> until_end_;
};

}  // namespace orca::supervisor
