// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/graph/graph.hpp"
#include "orca/idl/object.hpp"
#include "orca/plugin/image.hpp"

namespace orca::host {

/// An object that has reached a component.
struct SeenObject {
  std::string port;   ///< Name of the component's port in the graph.
  ObjectLoan object;  ///< With its header as it came.
  TimePoint time{};   ///< When it came [run's clock].
};

/// What a shadow run tries.
struct ShadowOrder {
  graph::Graph graph;                             ///< With all connections of the component.
  std::string component;                          ///< Its name there.
  std::string type;                               ///< Type of the new object.
  std::vector<PortContract> ports;                ///< Of the component, by their names in the graph.
  graph::Params params;                           ///< Parameters of the present object.
  std::map<std::string, std::string> new_params;  ///< New values, as written in a graph.
  Duration span;                                  ///< Time for which objects were watched.
  /// Answers what the new object asks a server of the system; empty: nobody does, and it gets errors.
  std::function<Result<ObjectRef>(const graph::PortRef& server, ObjectLoan question)> answer{};
};

/// What came of a shadow run.
struct ShadowReport {
  /// Why the code could not be tried to the end, which says nothing about it; empty: it was.
  std::string untried;
  std::uint64_t given = 0;   ///< Objects that reached the new object.
  std::uint64_t pushed = 0;  ///< Objects that the new object pushed, to nobody.
};

/// Whether new code can be tried at all in this build: ThreadSanitizer cannot follow a copy of a process.
#if defined(__SANITIZE_THREAD__)
inline constexpr bool kTriesCode = false;
#else
inline constexpr bool kTriesCode = true;
#endif

/// Lets new code of a component work in a copy of this process, where it gets objects that reached the component before, at
/// their times, and where whatever it says reaches nobody. So a crash, an endless loop or memory without end cost the
/// running system nothing. Then it is suspended and resumed, saves its state and loads that again, ends and is unloaded.
///
/// What it asks is answered by the order, and what it sends counts as accepted. Plugins that the run's clock does not suit get
/// the machine's.
///
/// @param plugin   holds the new code; the copy of the process uses it up, this process does not.
/// @param seen     in the order of their times.
/// @param give_up  asked several times a second; true ends the run. Empty: never.
/// @return the report if nothing speaks against the code.
/// @errors  failed_precondition with what the object failed by; internal with how it ended its process;
///          deadline_exceeded if it hangs; those of PluginCatalogue::acquire().
/// @thread  any; the copy has only the calling thread.
[[nodiscard]] Result<ShadowReport> run_in_shadow(const ShadowOrder& order, plugin::PluginImage& plugin,
                                                 std::vector<SeenObject>& seen,
                                                 const std::function<bool()>& give_up);

}  // namespace orca::host
