// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "moment_log.hpp"
#include "orca/hw/container.hpp"
#include "orca/hw/drawable.hpp"
#include "orca/sim/realism.hpp"
#include "orca/sim/world_model.hpp"
#include "shared_world.hpp"
#include "world_surroundings.hpp"

namespace orca::sim {

/// A robot in a simulated world. Robots whose graph entries name the same world file share one world. What is done with its senses and
/// motors is left to those that derive from this: they are endpoints, or the other ends of lines.
///
/// Thread contract: as HardwareContainer.
class SimulatedRobot : public hw::HardwareContainer, private hw::Drawable {
 public:
  explicit SimulatedRobot(hw::HardwareHost& host) : HardwareContainer(host) {}

  std::vector<HardwareFault> prepare() final;
  /// Only robots that share a world can be in each other's way.
  [[nodiscard]] std::vector<HardwareFault> conflicts_with(const HardwareContainer& earlier) const final;
  [[nodiscard]] idl::Robot description() const override;

 protected:
  /// Declares endpoints, once world and robot are known.
  /// @return what is wrong.
  virtual std::vector<HardwareFault> declare() = 0;
  /// Takes what the robot has sensed since the last call.
  virtual void sense(const SharedWorld::Inbox& inbox) = 0;
  /// Takes notice of what nobody was there to take.
  virtual void miss(const SharedWorld::Inbox& inbox) = 0;

  [[nodiscard]] const RobotModel& robot() const { return *robot_; }
  /// Returns where the graph puts the robot, in the world frame.
  [[nodiscard]] const Pose2& start() const { return start_; }
  [[nodiscard]] Realism realism() const;
  /// Tells the robot's motors what to do, from now on.
  Status command(const hw::DriveSetpoint& setpoint) { return shared_->command(id_, setpoint, host().now()); }
  /// Points the robot's turret, from now on. @param angle [rad]  in the robot's frame.
  Status point_turret(double angle) { return shared_->point_turret(id_, angle, host().now()); }
  /// Gives the robot's gripper an order.
  Status move_gripper(const GripperOrder& order) { return shared_->move_gripper(id_, order, host().now()); }
  [[nodiscard]] TimePoint next_tick() const { return shared_->next_tick(id_); }
  /// Advances the world, even if nobody listens.
  void go_on();

  Status open() override;

 private:
  std::optional<WorldModel> read_world_file(std::vector<HardwareFault>& errors) const;
  std::optional<RobotModel> read_robot_file(std::vector<HardwareFault>& errors) const;
  void find_start(std::vector<HardwareFault>& errors);
  void check_start_is_free(std::vector<HardwareFault>& errors) const;
  [[nodiscard]] const char* setting_unlike(const SimulatedRobot& other) const;
  [[nodiscard]] const char* start_param() const { return place_->empty() ? "x" : "place"; }
  [[nodiscard]] Result<ErrorLevels> levels() const;
  [[nodiscard]] std::string settings() const;
  void note_lost(Duration lost);

  hw::Drawable* drawable() final { return this; }
  void keep_moments() final { keeps_moments_ = true; }
  void keep_motion() final { keeps_motion_ = true; }
  void draw(Scene& scene) final;

  hw::Surroundings* surroundings() final { return &outside_; }

  static constexpr double kFarthest = 1e5;  // [m] A world reaches no farther.

  Param<std::string> world_file_{
      *this,
      "world",
      "",
      {.file = true,
       .text =
           "World (.xml), occupancy bitmap (.png, .pgm) or worlds of cylinders (.csv, .csv.gz); FILE#7 is "
           "number 7 of those in the file."}};
  Param<double> map_width_{
      *this,
      "map_width",
      0.0,
      {.unit = "m", .min = 0.0, .text = "Width of the whole bitmap; a bitmap needs this or map_resolution."}};
  Param<double> map_resolution_{
      *this,
      "map_resolution",
      0.0,
      {.unit = "m", .min = 0.0, .text = "Side of one pixel of a bitmap, instead of map_width."}};
  Param<std::string> robot_file_{
      *this, "robot", "", {.file = true, .text = "Description of the robot: URDF with an <orca> element."}};
  Param<std::string> packages_{
      *this,
      "packages",
      "",
      {.file = true,
       .text = "Folder that holds the packages which meshes of the robot name (package://PACKAGE/...); "
               "empty: they are looked for above the robot's file."}};
  Param<std::string> name_{
      *this, "name", "Dewey", {.text = "Name of this robot; each robot of a world has its own."}};
  Param<std::string> place_{
      *this, "place", "", {.text = "Start at this place of the world instead of x, y, heading."}};
  Param<double> x_{
      *this,
      "x",
      0.0,
      {.unit = "m", .min = -kFarthest, .max = kFarthest, .text = "Start position in the world frame."}};
  Param<double> y_{
      *this,
      "y",
      0.0,
      {.unit = "m", .min = -kFarthest, .max = kFarthest, .text = "Start position in the world frame."}};
  Param<double> heading_{
      *this,
      "heading",
      0.0,
      {.unit = "rad", .text = "Start heading, counter-clockwise from the world's x axis."}};
  Param<std::string> realism_{*this,
                              "realism",
                              "nominal",
                              {.choices = {"ideal", "nominal", "harsh", "recorded"},
                               .text = "Level of the errors of sensors, motors and odometry."}};
  Param<std::string> errors_{
      *this,
      "errors",
      "",
      {.text = "Factors on single errors of that level, or on estimates that all levels share, to see what "
               "depends on them: slip=2; wheel_grip=0.5. Names: docs/simulation.md."}};
  Param<double> dead_sonars_{
      *this,
      "dead_sonars",
      0.0,
      {.min = 0.0,
       .max = 1.0,
       .text = "Share of the sonar transducers that are silent in a run, drawn for each robot."}};
  Param<std::int64_t> threads_{*this,
                               "threads",
                               1,
                               {.min = 0.0,
                                .max = 64.0,
                                .text = "Number of threads that compute sensor readings; 0: one per "
                                        "processor. Results do not depend on it."}};

  std::optional<WorldModel> world_;
  std::optional<RobotModel> robot_;
  Pose2 start_;
  Duration lost_{0};  // that the world has left out, and that was not told yet
  std::shared_ptr<SharedWorld> shared_;
  RobotId id_{};
  bool keeps_moments_ = false;
  bool keeps_motion_ = false;
  std::optional<MomentLog> moments_;
  WorldSurroundings outside_{host()};
};

}  // namespace orca::sim
