// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "control/operating.hpp"
#include "control/system_names.hpp"
#include "control/trial/tryout.hpp"
#include "members/conductor.hpp"
#include "members/member.hpp"
#include "members/reply.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/graph/graph.hpp"
#include "orca/supervisor/record.hpp"
#include "orca/supervisor/system_facts.hpp"

namespace orca::supervisor {

/// The code that a component or a hardware element runs.
struct CodeFacts {
  std::string type;
  PluginFacts plugin;
  std::uint64_t swaps = 0;  ///< How often it was exchanged in this process.
};

/// How carefully code is exchanged.
struct Care {
  Duration tryout{2s};     ///< For which it is tried with what reaches the present one.
  Duration probation{2s};  ///< In which a failure brings the present one back.
  bool untried = false;    ///< It is taken even if it cannot be tried out.
};

/// Reads it from the words of an order: [--tryout DURATION] [--probation DURATION] [--untried]. Other words are left alone.
/// @errors  invalid_argument.
[[nodiscard]] Result<Care> read_care(const std::vector<std::string>& words);

/// What an operator wants to exchange.
struct SwapWish {
  std::string component;  ///< Or hardware.
  std::string file;
  std::string type;                           ///< Empty: the present one.
  std::map<std::string, std::string> params;  ///< New values, as written in a graph.
  Care care{};
  bool has_worked = false;  ///< In this system before, so it is not tried out.
  bool fresh = false;       ///< It begins without the state of the old one, which is not asked for it.
  bool only_tries = false;  ///< Nothing is exchanged.
  /// The graph with the connections of the component, if they have just changed.
  const graph::Graph* changed = nullptr;
};

/// Exchanges the code of components and drivers at an operator's word, and knows which code each of them runs.
///
/// Thread contract: the supervisor's thread.
class Exchanging {
 public:
  /// All of these outlive the object.
  Exchanging(Conductor& conductor, const graph::Graph& graph, const SystemFacts& facts,
             const SystemNames& names, Operating& operating)
      : conductor_(conductor), graph_(graph), facts_(facts), names_(names), operating_(operating) {}

  /// Exchanges a component's code, after it was tried out, or a driver. A job of the conductor waits until the old code, or
  /// the new one if it was refused, is gone.
  /// With --only-try it is tried out and nothing else, and the answer says what came of it.
  /// @param words  COMPONENT PLUGIN.so[:TYPE] [--set PARAM=VALUE]... [--tryout DURATION] [--probation DURATION] [--untried]
  ///               [--fresh] [--only-try].
  void swap(const std::vector<std::string>& words, const ReplyPtr& reply);
  /// Answers with the types of the plugin folders whose ports fit a component, and notes those that could not be asked for
  /// their ports. A job of the conductor waits for a copy of this process that looks at all of them.
  void show_fitting(const std::string& component, const ReplyPtr& reply);
  /// Does the same for a wish that was read.
  /// @return what an operator is told of it.
  Result<Record> exchange(const SwapWish& wish);
  /// Exchanges the code of all components that run a plugin whose file was built anew, each after it was tried out, and after
  /// an exchange that is under way. What comes of it goes to the log.
  void take_rebuilt(const std::string& file);
  /// Begins to exchange what was built anew. Call it often.
  void go_on();

  /// Returns the plugins of the components of this machine.
  [[nodiscard]] std::set<std::string> plugin_files() const;

  [[nodiscard]] CodeFacts code_of(const graph::ComponentNode& component) const {
    return code_of(component.name, component.type, component.process);
  }
  [[nodiscard]] CodeFacts code_of(const graph::HardwareNode& hardware) const {
    return code_of(hardware.name, hardware.type, hardware.process);
  }
  /// Returns the plugin that the graph's search finds for a type.
  [[nodiscard]] const PluginFacts& plugin_of(const std::string& type) const;

  /// Returns whether the code of a component is being tried out or exchanged.
  [[nodiscard]] bool is_busy(const std::string& component) const { return busy_.contains(component); }
  /// Forgets a component that has gone.
  void forget(const std::string& component) {
    exchanged_.erase(component);
    operating_.present().forget(component);
  }
  /// Notes that a component runs other code.
  void note(const ExchangedCode& code);
  /// Notes the code that a process was built from.
  void note(const Built& built, const std::string& process);
  /// Notes that processes work again. They run the code that the graph names.
  void came_up(const std::vector<Member*>& members);

 private:
  // An exchange that has been begun and has not ended.
  struct Underway {
    std::string file;
    Duration probation;
    std::optional<Moment> ordered;  // when the process was told; nothing: the code is being tried out
  };
  class Busy;

  [[nodiscard]] Error busy_with(const std::string& component) const;
  void swap_rebuilt(const SwapWish& wish);
  [[nodiscard]] std::vector<PortContract> ports_of(const std::string& component) const;
  [[nodiscard]] std::vector<ServerLine> lines_to_servers_of(const std::string& component) const;
  [[nodiscard]] Result<Record> exchange_component(const SwapWish& wish);
  [[nodiscard]] Result<Record> exchange_driver(const SwapWish& wish, const graph::HardwareNode& hardware);
  [[nodiscard]] host::ShadowOrder trial_of(const SwapWish& wish, const graph::ComponentNode& node) const;
  [[nodiscard]] Result<host::ShadowReport> try_out(const SwapWish& wish, const host::ShadowOrder& order,
                                                   Member& member, plugin::PluginImage& image);
  [[nodiscard]] Result<Record> only_try(const SwapWish& wish);
  [[nodiscard]] Result<Record> order_swap(Member& member, SwapCode swap);
  [[nodiscard]] CodeFacts code_of(const std::string& name, const std::string& type,
                                  const std::string& process) const;
  void forget_exchange(const std::string& name, const std::string& type);

  Conductor& conductor_;
  const graph::Graph& graph_;
  const SystemFacts& facts_;
  const SystemNames& names_;
  Operating& operating_;
  std::map<std::string, Underway> busy_;  // by component
  std::set<std::string> rebuilt_;         // components whose code was built anew and is not exchanged yet
  std::map<std::string, std::map<std::string, std::string>> builds_;  // build ids by process, then by type
  std::map<std::string, CodeFacts> exchanged_;                        // by component or hardware
};

}  // namespace orca::supervisor
