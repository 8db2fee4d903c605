// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "orca/hw/container.hpp"
#include "orca/hw/surroundings.hpp"
#include "shared_world.hpp"

namespace orca::sim {

/// The world around a simulated robot, as objects.
///
/// Thread contract: enter() before the robot's hardware is Ready; the rest as hw::Surroundings.
class WorldSurroundings final : public hw::Surroundings {
 public:
  explicit WorldSurroundings(hw::HardwareHost& host) : host_(host) {}

  void enter(std::shared_ptr<SharedWorld> world) { world_ = std::move(world); }

  void fill_plan(idl::WorldPlan& plan) override;
  void fill_scene(idl::WorldScene& scene) override;
  Result<std::string> change(const idl::WorldChange& change) override;

 private:
  hw::HardwareHost& host_;
  std::shared_ptr<SharedWorld> world_;
};

}  // namespace orca::sim
