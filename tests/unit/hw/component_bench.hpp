// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "diary.hpp"
#include "orca/component/component.hpp"
#include "peer.hpp"

namespace orca::test {

/// The minimum that a component needs around it: ports, a strand, and a caller of its hooks in the order of
/// the state machine of thesis 9.4. Failures are lines of its diary.
class ComponentBench final : public ComponentHost {
 public:
  ~ComponentBench() noexcept override {}  // components' destructors may throw; those of these tests do not
  ComponentBench(Executive& executive, std::string name, Device* hardware)
      : peer_(executive, std::move(name)), hardware_(hardware) {}

  /// Configures the component and works until `stopped()`.
  void run(Component& component) {
    while (!peer_.leaving()) turn(component);
    if (working_) leave_work(component);
    peer_.close("the bench is being stopped");
  }

  [[nodiscard]] Peer& peer() { return peer_; }
  [[nodiscard]] const Diary& diary() const { return diary_; }
  [[nodiscard]] bool working() const { return working_; }

  void declare_port(PortDeclaration declaration) override { peer_.declare_port(std::move(declaration)); }
  void declare_param(ParamDeclaration /*declaration*/) override {}
  void set_default_trigger(const Trigger& trigger) override { period_ = trigger.period; }
  [[nodiscard]] Duration lap_period() const override { return period_; }
  [[nodiscard]] const std::string& name() const override { return peer_.strand().name(); }
  [[nodiscard]] TimePoint now() const override { return peer_.strand().executive().now(); }
  [[nodiscard]] RandomStream random(std::string_view stream) const override { return {1, name(), stream}; }
  void write_log(log::Level /*level*/, std::string_view text) const override {
    diary_.note("log: " + std::string(text));
  }
  [[nodiscard]] Device* hardware() override { return hardware_; }
  void stay_active(bool active) override { stays_active_ = active; }
  [[nodiscard]] Strand& strand() override { return peer_.strand(); }
  std::uint64_t begin_mission() override { return 1; }
  void end_mission() override {}
  void note_cause(const idl::OrcaObject& /*object*/) override {}

 private:
  void turn(Component& component) {
    if (peer_.handle_one()) return;
    const bool wanted = !failed_ && (stays_active_ || peer_.has_subscribers());
    if (wanted && !working_) {
      enter_work(component);
    } else if (!wanted && working_) {
      leave_work(component);
    } else if (working_ && now() >= next_lap_) {
      lap(component);
    } else {
      peer_.strand().pause_until(working_ ? next_lap_ : kForever);
    }
  }

  void enter_work(Component& component) {
    working_ = true;
    next_lap_ = now();
    if (const Status started = component.start(); !started.ok())
      fail_with(component, "start: " + started.error().text());
  }

  void leave_work(Component& component) {
    component.stop();
    working_ = false;
  }

  void lap(Component& component) {
    next_lap_ += period_;
    const Outcome outcome = component.work();
    if (outcome.kind == Outcome::Kind::failed) fail_with(component, "work: " + outcome.reason);
  }

  void fail_with(Component& component, const std::string& what) {
    failed_ = true;
    leave_work(component);
    diary_.note("failed in " + what);
  }

  mutable Diary diary_;
  mutable Peer peer_;
  Device* hardware_;
  Duration period_{0};
  TimePoint next_lap_{};
  bool stays_active_ = false;
  bool failed_ = false;
  std::atomic<bool> working_{false};
};

}  // namespace orca::test
