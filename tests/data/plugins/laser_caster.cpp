// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <memory>
#include <numbers>

#include "orca/component.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/sim/caster.hpp"
#include "orca/sim/world_file.hpp"

namespace {

using namespace orca::sim;

/// A laser without errors: half a turn ahead in steps of a degree, five times a second, cast from where the
/// localizer says the robot is.
class LaserCaster final : public orca::Component {
 public:
  explicit LaserCaster(orca::ComponentHost& host) : Component(host) {
    lap_every(std::chrono::milliseconds(200));
  }

 private:
  orca::Status configure() override {
    orca::xml::Diagnostics errors;
    world_ = read_world(*path_, {}, errors);
    if (!world_) return orca::fail(orca::Code::invalid_argument, errors.text());
    caster_ = std::make_unique<Caster>(*world_);
    return orca::ok();
  }

  orca::Outcome work() override {
    const auto pose = localizer_.get_update();
    auto scan = laser_.loan();
    scan->stamp(pose->stamp());
    scan->min_range(0.05);
    scan->max_range(kMaxRange);
    scan->angle_start(-std::numbers::pi / 2);
    scan->angle_increment(std::numbers::pi / 180);
    scan->ranges().resize(181);
    for (std::size_t i = 0; i < scan->ranges().size(); ++i) {
      const double angle =
          pose->orientation() + scan->angle_start() + scan->angle_increment() * static_cast<double>(i);
      scan->ranges()[i] =
          caster_->cast(Ray{{pose->x(), pose->y()}, {std::cos(angle), std::sin(angle)}, kMaxRange, 0.3})
              .range;
    }
    laser_.push(std::move(scan));
    return orca::again();
  }

  static constexpr double kMaxRange = 8.0;  // [m]

  orca::PushProxy<orca::idl::RobotPose> localizer_{*this, "localizer"};
  orca::PushServer<orca::idl::LaserRangeReadings> laser_{*this, "laser"};
  orca::Param<std::string> path_{*this, "world", "", {.file = true}};

  std::optional<WorldModel> world_;
  std::unique_ptr<Caster> caster_;
};

}  // namespace

ORCA_COMPONENT(LaserCaster, "test.LaserCaster")
