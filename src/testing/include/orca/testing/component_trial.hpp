// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "orca/component.hpp"

namespace orca::testing {

/// The base class of a test's own ports. Its object is a component too, the only one beside the component under test:
/// each of its ports is connected to the port of the same name there, a PushServer to a PushProxy or a port array and so
/// on. There is no hardware, so a component that wraps some cannot be tried.
///
/// Thread contract: as Component. The script of the test runs on its strand, so it may use blocking calls.
class Partner : public Component {
 public:
  using Component::Component;
  using Component::now;
  using Component::sleep;
  using Component::wait_until;

 private:
  Outcome work() final;
};

/// A component to be tried.
struct Trial {
  std::string type;                             ///< As in a graph: "orca.Avoid".
  std::map<std::string, std::string> params{};  ///< As in a graph, with units: {"stop_distance", "0.6 m"}.
  std::vector<std::string> plugins{};  ///< Folders with plugins; none: ../plugins, seen from the program.
  Duration limit = std::chrono::seconds(60);  ///< Longest run [s of virtual time].
  std::uint64_t seed = 1;                     ///< Of all random streams.
  /// When another object of the same code takes the component's place, as by `orcactl swap` [s of virtual time]; 0: never.
  Duration swap_at{0};
};

namespace detail {

template <class Ports>
void* make_partner(PluginHost& host) {
  return static_cast<Component*>(new Ports(static_cast<ComponentHost&>(host)));
}

void try_component(const Trial& trial, void* (*make)(PluginHost&),
                   const std::function<void(Partner&)>& script);

}  // namespace detail

/// Runs a component and the script of a test in virtual time, opposite each other. The run is over when the script
/// returns. It is the same in each run: time passes only while everybody waits.
///
/// The component is loaded, checked, connected and started as by the deployer. It works while the test uses it, or by
/// itself if it stays active. The script is called 1 ms after its start, when everything is connected.
///
/// @tparam Ports  a class derived from Partner, whose members are the ports of the test.
/// @param script  is called with the object that has the ports. If a SendServer or QueryServer of the test takes
///                something while the script waits and has neither taken nor sent anything yet, the script starts again.
/// @errors  throws what the script throws; std::runtime_error if the component cannot be loaded, connected or
///          started, if it fails, and if the script does not return within the limit, each with the reason.
/// @thread  the main thread; one call at a time.
template <class Ports>
void try_component(const Trial& trial, const std::function<void(Ports&)>& script) {
  detail::try_component(trial, detail::make_partner<Ports>,
                        [&script](Partner& partner) { script(static_cast<Ports&>(partner)); });
}

}  // namespace orca::testing
