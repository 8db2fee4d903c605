// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/log.hpp"
#include "orca/base/random.hpp"
#include "orca/base/result.hpp"
#include "orca/component/device.hpp"
#include "orca/idl/system.hpp"
#include "orca/patterns/port_owner.hpp"

namespace orca {

class Strand;

/// A parameter as declared by a member of a component or a hardware container.
struct ParamDeclaration {
  ParamContract contract;
  /// Stores a value that has been checked against the contract.
  std::function<void(const ParamValue&)> set;
  /// True, written by the host, while the value must not be read: the graph's is not there yet.
  bool* locked = nullptr;
};

/// The services that a process offers to the components and hardware containers that it hosts.
///
/// Thread contract: declarations from the constructor of the hosted object; the rest from its strand.
class PluginHost {
 public:
  virtual ~PluginHost() = default;

  virtual void declare_param(ParamDeclaration declaration) = 0;

  [[nodiscard]] virtual const std::string& name() const = 0;
  [[nodiscard]] virtual TimePoint now() const = 0;
  /// Returns a stream that depends only on the run's seed, this instance's name and `stream`.
  [[nodiscard]] virtual RandomStream random(std::string_view stream) const = 0;
  virtual void write_log(log::Level level, std::string_view text) const = 0;
};

/// An order of a component about another one.
struct PeerOrder {
  enum class Kind : std::uint8_t {
    set,      ///< Sets a parameter.
    suspend,  ///< Pauses the component between two of its laps, as an operator does.
    resume,   ///< Lets it go on, unless somebody else keeps it suspended.
  };

  Kind kind = Kind::set;
  std::string component;  ///< By its name in the graph.
  std::string param{};    ///< To set.
  std::string value{};    ///< To set: as written in a graph, with its unit.
};

inline constexpr const char* kPeerWorks = "works";
inline constexpr const char* kPeerIsSuspended = "suspended";

/// The services that a process offers to a component. The runtime implements it; a component author does not
/// need it.
class ComponentHost : public PluginHost {
 public:
  virtual void declare_port(PortDeclaration declaration) = 0;
  virtual void set_default_trigger(const Trigger& trigger) = 0;
  /// Returns the time between two laps [s]; 0: not known in advance.
  [[nodiscard]] virtual Duration lap_period() const = 0;

  /// Returns the hardware that the graph binds to this component, or null. This declaration makes it part of
  /// the contract.
  [[nodiscard]] virtual Device* hardware() = 0;

  virtual void stay_active(bool active) = 0;

  /// Begins a mission of this component and returns its id, which no other mission of the run has.
  virtual std::uint64_t begin_mission() = 0;
  /// Ends the component's mission, begun or received.
  virtual void end_mission() = 0;
  /// Makes an object the cause of everything sent from now on.
  virtual void note_cause(const idl::OrcaObject& object) = 0;
  /// Returns the strand on which the component runs.
  [[nodiscard]] virtual Strand& strand() = 0;

  /// Raises or clears an alarm of this component; see Component.
  virtual void raise_alarm(std::string_view /*kind*/, idl::AlarmSeverity /*severity*/,
                           std::string_view /*text*/) {}
  virtual void clear_alarm(std::string_view /*kind*/, std::string_view /*text*/) {}
  /// Returns the alarms of the whole system that were raised or cleared since the last call.
  [[nodiscard]] virtual std::vector<idl::Alarm> take_alarms() { return {}; }
  /// Returns the alarms of the whole system that nobody has acknowledged yet.
  [[nodiscard]] virtual std::vector<idl::Alarm> kept_alarms() const { return {}; }

  /// Returns whether the graph gives this component the right to set a parameter of another one: may_set="pilot.max_speed".
  [[nodiscard]] virtual bool may_set(const std::string& /*component*/, const std::string& /*param*/) const {
    return false;
  }
  /// Returns whether the graph gives this component the right to suspend another one: may_suspend="walk".
  [[nodiscard]] virtual bool may_suspend(const std::string& /*component*/) const { return false; }
  /// Orders another component, in whatever process it is. A component that it has suspended goes on when this one has ended or its process is
  /// lost.
  /// @return the number of the order.
  virtual std::uint64_t order_peer(const PeerOrder& /*order*/) { return 0; }
  /// Returns the outcome of such an order once it is there, and forgets it: the value before, as text; of a pause kPeerWorks, or
  /// kPeerIsSuspended if the order has changed nothing.
  /// @errors  failed_precondition without the right; those of the component and of the runtime, with their reasons.
  [[nodiscard]] virtual std::optional<Result<std::string>> take_outcome(std::uint64_t /*number*/) {
    return std::nullopt;
  }
};

}  // namespace orca
