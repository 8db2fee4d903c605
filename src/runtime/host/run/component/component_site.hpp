// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "component_settings.hpp"
#include "lap_trigger.hpp"
#include "orca/component/host.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"
#include "run/run_context.hpp"

namespace orca::host {

/// The declarations of a component's object. They may hold the plugin's code, so they must be destroyed
/// before it.
struct Declarations {
  std::vector<PortDeclaration> ports;  ///< By their names in the graph.
  std::vector<ParamDeclaration> params;
  Trigger trigger;
};

/// The process around one component, as the component sees it, and the place for its declarations.
///
/// Thread contract: as ComponentHost; the rest on the component's strand, or before that starts.
class ComponentSite final : public ComponentHost {
 public:
  /// @param home      of the component's ports, with its strand; outlives this object, as does `laps`.
  /// @param laps      what starts the component's laps.
  /// @param hardware  the hardware that the graph binds to the component, or null.
  ComponentSite(RunContext& run, const ComponentSettings& settings, PortHome& home, const LapTrigger& laps,
                Device* hardware);

  [[nodiscard]] const Declarations& declared() const { return declared_; }
  /// Returns whether the component is to work without clients: the graph's word counts before its own.
  [[nodiscard]] bool stays_active() const { return settings_.autonomous.value_or(stays_active_); }
  /// Drops everything that may lead into the plugin's code.
  void forget_code();
  /// Restores the state from before a component was constructed here.
  void reset();

  // ComponentHost
  void declare_port(PortDeclaration declaration) override;
  void declare_param(ParamDeclaration declaration) override;
  void set_default_trigger(const Trigger& trigger) override;
  [[nodiscard]] Duration lap_period() const override { return laps_.period(); }
  [[nodiscard]] const std::string& name() const override { return settings_.name; }
  [[nodiscard]] TimePoint now() const override { return run_.executive.now(); }
  [[nodiscard]] RandomStream random(std::string_view stream) const override;
  /// Writes a line to the log. It names the mission at which the component works, if there is one.
  void write_log(log::Level level, std::string_view text) const override;
  [[nodiscard]] Device* hardware() override { return hardware_; }
  void stay_active(bool active) override { stays_active_ = active; }
  [[nodiscard]] Strand& strand() override { return home_.strand; }
  std::uint64_t begin_mission() override;
  void end_mission() override { home_.provenance.end_task(); }
  void note_cause(const idl::OrcaObject& object) override { home_.provenance.note(object); }
  [[nodiscard]] std::vector<idl::Alarm> take_alarms() override;
  [[nodiscard]] std::vector<idl::Alarm> kept_alarms() const override;

 private:
  RunContext& run_;
  const ComponentSettings& settings_;
  PortHome& home_;
  const LapTrigger& laps_;
  Device* const hardware_;
  Declarations declared_;
  bool stays_active_ = false;       // as the component wants it
  std::uint64_t heard_alarms_ = 0;  // position in the news
};

}  // namespace orca::host
