// SPDX-License-Identifier: LGPL-3.0-or-later
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "orca/component.hpp"
#include "orca/hw/seat.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/world.hpp"

namespace {

constexpr orca::Duration kScenePeriod = std::chrono::milliseconds(100);

/// The simulated world seen from outside and changed while it runs, which no real world can be: with real hardware this component
/// has no ports.
class WorldServer final : public orca::Component {
 public:
  explicit WorldServer(orca::ComponentHost& host)
      : Component(host), seat_(static_cast<orca::hw::HardwareSeat*>(host.hardware())) {
    lap_every(kScenePeriod);
    if (seat_ == nullptr || has_world()) ports_ = std::make_unique<Ports>(*this);
  }

 private:
  using Surroundings = orca::hw::Surroundings;

  struct Ports {
    explicit Ports(WorldServer& server)
        : scene(server, "ScenePush",
                {.text = "All that moves, while somebody subscribes.", .period = kScenePeriod}),
          plan(server, "PlanQuery", &WorldServer::on_plan,
               {.text = "What never moves, with the named places: about is not read."}),
          change(server, "ChangeSend", &WorldServer::on_change,
                 {.text = "Changes the world at once, or is refused with the reason.",
                  .confirm = orca::QueuePolicy::Confirm::handled}) {}
    orca::PushServer<orca::idl::WorldScene> scene;
    orca::QueryServer<orca::idl::Ask, orca::idl::WorldPlan> plan;
    orca::SendServer<orca::idl::WorldChange> change;
  };

  // Before the hardware is open, whether it has a world is known, and the world is not there.
  [[nodiscard]] bool has_world() const {
    const orca::Status there = in_world([](Surroundings&) { return orca::ok(); });
    return there.ok() || there.error().code != orca::Code::unimplemented;
  }

  [[nodiscard]] orca::Status in_world(const std::function<orca::Status(Surroundings&)>& act) const {
    return seat_->in_surroundings(act);
  }

  orca::Status configure() override {
    if (seat_ == nullptr)
      return orca::fail(orca::Code::failed_precondition, "the graph binds no hardware to it");
    if (!ports_) return in_world([](Surroundings&) { return orca::ok(); });
    return orca::ok();
  }

  // Before the world is there, and while a driver is exchanged, there is nothing to show.
  orca::Outcome work() override {
    auto scene = ports_->scene.loan();
    const orca::Status there = in_world([&](Surroundings& world) {
      world.fill_scene(*scene);
      return orca::ok();
    });
    if (there.ok()) ports_->scene.push(std::move(scene));
    return orca::again();
  }

  orca::Result<orca::Loan<orca::idl::WorldPlan>> on_plan(const orca::ObjectPtr<orca::idl::Ask>& /*ask*/) {
    auto plan = orca::make_object<orca::idl::WorldPlan>();
    const orca::Status there = in_world([&](Surroundings& world) {
      world.fill_plan(*plan);
      return orca::ok();
    });
    if (!there.ok()) return there.error();
    return plan;
  }

  // A change that is done is over: the scenes that come are no answers to it.
  orca::Status on_change(const orca::ObjectPtr<orca::idl::WorldChange>& change) {
    return in_world([&](Surroundings& world) -> orca::Status {
      const orca::Result<std::string> changed = world.change(*change);
      if (!changed) return changed.error();
      log_info("by order of " + change->origin() + ": " + *changed);
      end_mission();
      return orca::ok();
    });
  }

  orca::hw::HardwareSeat* const seat_;
  std::unique_ptr<Ports> ports_;
};

}  // namespace

ORCA_COMPONENT(WorldServer, "orca.WorldServer")
