// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "component_parts.hpp"
#include "orca/component/host.hpp"

namespace orca::host {

/// The declarations of a component's object. They may hold the plugin's code, so they must be destroyed
/// before it.
struct Declarations {
  std::vector<PortDeclaration> ports;  ///< By their names in the graph.
  std::vector<ParamDeclaration> params;
  Trigger trigger;
};

/// The process around one object of a component, as the object sees it, and the place for its declarations. It goes with
/// the object when that takes the place of another one.
///
/// Thread contract: as ComponentHost; the rest on the component's strand, or before that starts.
class ComponentSite final : public ComponentHost {
 public:
  /// @param parts  of the component; they outlive this object, or it moves.
  explicit ComponentSite(ComponentParts& parts) : parts_(&parts) {}

  /// Moves to another component.
  void move_to(ComponentParts& parts) { parts_ = &parts; }

  [[nodiscard]] const Declarations& declared() const { return declared_; }
  /// Returns whether the component wants to work without clients.
  [[nodiscard]] bool stays_active() const { return stays_active_; }
  /// Takes no port or parameter any more: the object is constructed, and what it makes now no graph can connect or set.
  void close_declarations() { closed_ = true; }
  /// Drops everything that may lead into the plugin's code.
  void forget_code();

  // ComponentHost
  void declare_port(PortDeclaration declaration) override;
  void declare_param(ParamDeclaration declaration) override;
  void set_default_trigger(const Trigger& trigger) override;
  [[nodiscard]] Duration lap_period() const override { return parts_->laps.period(); }
  [[nodiscard]] const std::string& name() const override { return parts_->settings.name; }
  [[nodiscard]] TimePoint now() const override { return parts_->now(); }
  [[nodiscard]] RandomStream random(std::string_view stream) const override;
  /// Writes a line to the log. It names the mission at which the component works, if there is one.
  void write_log(log::Level level, std::string_view text) const override;
  [[nodiscard]] Device* hardware() override { return parts_->hardware; }
  void stay_active(bool active) override { stays_active_ = active; }
  [[nodiscard]] Strand& strand() override { return parts_->strand; }
  std::uint64_t begin_mission() override;
  void end_mission() override { parts_->home.provenance.end_task(); }
  void note_cause(const idl::OrcaObject& object) override { parts_->home.provenance.note(object); }
  void raise_alarm(std::string_view kind, idl::AlarmSeverity severity, std::string_view text) override;
  void clear_alarm(std::string_view kind, std::string_view text) override;
  [[nodiscard]] std::vector<idl::Alarm> take_alarms() override;
  [[nodiscard]] std::vector<idl::Alarm> kept_alarms() const override;
  [[nodiscard]] bool may_set(const std::string& component, const std::string& param) const override;
  [[nodiscard]] bool may_suspend(const std::string& component) const override;
  std::uint64_t order_peer(const PeerOrder& order) override;
  [[nodiscard]] std::optional<Result<std::string>> take_outcome(std::uint64_t number) override {
    return parts_->peer_orders->take(number);
  }

 private:
  ComponentParts* parts_;
  Declarations declared_;
  bool closed_ = false;
  bool stays_active_ = false;
  std::uint64_t heard_alarms_ = 0;  // position in the news
};

}  // namespace orca::host
