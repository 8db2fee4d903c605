// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "control/reply.hpp"
#include "control/system_names.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/supervisor/system_facts.hpp"
#include "run/member.hpp"

namespace orca::supervisor {

/// The code that a component runs.
struct CodeFacts {
  std::string type;
  PluginFacts plugin;
  std::uint64_t swaps = 0;  ///< How often it was exchanged in this process.
};

/// Exchanges the code of components at an operator's word, and knows which code each of them runs.
///
/// Thread contract: the supervisor's thread.
class Exchanging {
 public:
  /// All of these outlive the object.
  Exchanging(const graph::Graph& graph, const SystemFacts& facts, const SystemNames& names)
      : graph_(graph), facts_(facts), names_(names) {}

  /// Exchanges a component's code. The answer ends when the old code, or the new one if it was refused, is gone.
  /// @param words  COMPONENT PLUGIN.so[:TYPE] [--probation DURATION].
  void swap(const std::vector<std::string>& words, const ReplyPtr& reply);

  [[nodiscard]] CodeFacts code_of(const graph::ComponentNode& component) const;
  /// Returns the plugin that the graph's search finds for a type.
  [[nodiscard]] const PluginFacts& plugin_of(const std::string& type) const;

  /// Notes that processes work again. They run the code that the graph names.
  void came_up(const std::vector<Member*>& members);

 private:
  void note(const std::string& component, CodeFacts code);

  const graph::Graph& graph_;
  const SystemFacts& facts_;
  const SystemNames& names_;
  std::map<std::string, CodeFacts> exchanged_;  // by component
};

}  // namespace orca::supervisor
