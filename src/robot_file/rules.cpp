// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/robot_file/rules.hpp"

#include <array>

#include "orca/robot_file/codes.hpp"
#include "orca/robot_file/values.hpp"

namespace orca::robot_file {
namespace {

using namespace values;
using xml::ElementRule;

constexpr ValueRule kDevices = whole(1, 256);
constexpr ValueRule kReadings = whole(1, 10'000);
constexpr std::array<std::string_view, 3> kDriveKinds{"differential", "synchro", "holonomic"};
constexpr std::array<std::string_view, 4> kLevels{"ideal", "nominal", "harsh", "recorded"};
constexpr std::array<std::string_view, 6> kJointTypes{"fixed",     "continuous", "revolute",
                                                      "prismatic", "planar",     "floating"};

constexpr std::array kOrca{optional("vendor", kText), optional("model", kText), required("radius", kLength),
                           optional("bumper_radius", kLength)};
constexpr std::array kDrive{required("type", one_of(kDriveKinds)),
                            required("max_speed", positive("m/s")),
                            required("max_steer_speed", positive("rad/s")),
                            required("max_acceleration", positive("m/s2")),
                            required("max_steer_acceleration", positive("rad/s2")),
                            optional("stop_deceleration", positive("m/s2")),
                            required("track", kLength),
                            required("wheel_diameter", kLength),
                            optional("lag", kTime),
                            optional("dead_time", kTime),
                            optional("steer_gain", positive("")),
                            optional("speed_step", not_negative("m/s")),
                            optional("big_turn_angle", positive("rad")),
                            optional("big_turn_speed", not_negative("m/s")),
                            optional("vendor", kText),
                            optional("model", kText),
                            optional("port", kText)};
constexpr std::array kTurret{required("joint", kText),
                             required("max_speed", positive("rad/s")),
                             required("max_acceleration", positive("rad/s2")),
                             required("period", kPeriod),
                             optional("vendor", kText),
                             optional("model", kText),
                             optional("port", kText)};
constexpr ValueRule kReach = positive("m", 2.0);
constexpr ValueRule kWholeWay = positive("s", 3600.0);
constexpr std::array kGripper{
    required("link", kText),     required("opening", kReach),        required("depth", kReach),
    required("lift", kReach),    required("paddle_time", kWholeWay), required("lift_time", kWholeWay),
    required("period", kPeriod), optional("vendor", kText),          optional("model", kText),
    optional("port", kText)};
constexpr std::array kBattery{required("voltage", positive("V", 1000.0)),
                              required("driving", kPeriod),
                              required("standing", kPeriod),
                              required("charging", kPeriod),
                              required("period", kPeriod),
                              optional("vendor", kText),
                              optional("model", kText),
                              optional("port", kText)};
// Directions are given by `angles`, or else by `first_angle` and `pitch`.
constexpr std::array kSonarRing{required("name", kName),
                                required("count", kDevices),
                                optional("first_angle", kAngle),
                                optional("pitch", kAngle),
                                optional("angles", kAngle),
                                optional("positions", kText),
                                optional("heights", kCoordinate),
                                required("half_lobe", positive("rad")),
                                required("min_range", kLengthOrZero),
                                required("max_range", kLength),
                                optional("quantum", kLengthOrZero),
                                optional("radius", kLengthOrZero),
                                required("period", kPeriod),
                                required("link", kText),
                                optional("order", kText),
                                optional("parallel", kDevices),
                                optional("offset", kCoordinate),
                                optional("vendor", kText),
                                optional("model", kText),
                                optional("port", kText)};
constexpr std::array kLaser{required("name", kName),
                            required("link", kText),
                            required("count", kReadings),
                            required("first_angle", kAngle),
                            required("pitch", kAngle),
                            optional("min_range", kLengthOrZero),
                            required("max_range", kLength),
                            optional("quantum", kLengthOrZero),
                            optional("divergence", not_negative("rad")),
                            required("period", kPeriod),
                            optional("sweep", kTime),
                            optional("sees", kText),
                            optional("ignore", kText),
                            optional("vendor", kText),
                            optional("model", kText),
                            optional("port", kText)};
constexpr ValueRule kPixels = whole(1, 4096);
constexpr std::array kCamera{required("name", kName),
                             required("link", kText),
                             required("width", kPixels),
                             required("height", kPixels),
                             required("field_of_view", positive("rad")),
                             required("period", kPeriod),
                             optional("vendor", kText),
                             optional("model", kText),
                             optional("port", kText)};
constexpr std::array kInfraredRing{required("name", kName),
                                   required("link", kText),
                                   required("count", kDevices),
                                   optional("first_angle", kAngle),
                                   required("pitch", kAngle),
                                   required("half_beam", positive("rad")),
                                   optional("min_range", kLengthOrZero),
                                   required("max_range", kLength),
                                   optional("radius", kLengthOrZero),
                                   required("period", kPeriod),
                                   optional("vendor", kText),
                                   optional("model", kText),
                                   optional("port", kText)};
constexpr std::array kBumperRing{required("name", kName),         required("count", kDevices),
                                 optional("first_angle", kAngle), required("pitch", kAngle),
                                 optional("angles", kAngle),      optional("radius", kLengthOrZero),
                                 required("period", kPeriod),     optional("vendor", kText),
                                 optional("model", kText),        optional("port", kText)};
constexpr std::array kOdometry{required("period", kPeriod), optional("vendor", kText),
                               optional("model", kText), optional("port", kText)};
constexpr ValueRule kShare = not_negative("", 1.0);
constexpr std::array kWheelErrors{optional("realism", one_of(kLevels)), required("wheel_diameter", kShare),
                                  required("track", kShare), required("slip", kLengthOrZero),
                                  optional("turn_slip", kLengthOrZero)};
constexpr std::array kRangeErrors{optional("realism", one_of(kLevels)), required("fixed", kLengthOrZero),
                                  required("share", kShare)};

}  // namespace

constexpr ElementRule kWheelErrorsRule{.name = "wheel_errors", .attributes = kWheelErrors};
constexpr ElementRule kRangeErrorsRule{.name = "range_errors", .attributes = kRangeErrors};

namespace {

constexpr std::array kInOdometry{&kWheelErrorsRule};
constexpr std::array kInRangeSensor{&kRangeErrorsRule};

}  // namespace

constexpr ElementRule kDriveRule{.name = "drive", .attributes = kDrive};
constexpr ElementRule kTurretRule{.name = "turret", .attributes = kTurret};
constexpr ElementRule kGripperRule{.name = "gripper", .attributes = kGripper};
constexpr ElementRule kBatteryRule{.name = "battery", .attributes = kBattery};
constexpr ElementRule kSonarRingRule{
    .name = "sonar_ring", .attributes = kSonarRing, .children = kInRangeSensor};
constexpr ElementRule kLaserRule{.name = "laser", .attributes = kLaser, .children = kInRangeSensor};
constexpr ElementRule kInfraredRingRule{
    .name = "infrared_ring", .attributes = kInfraredRing, .children = kInRangeSensor};
constexpr ElementRule kCameraRule{.name = "camera", .attributes = kCamera};
constexpr ElementRule kBumperRingRule{.name = "bumper_ring", .attributes = kBumperRing};
constexpr ElementRule kOdometryRule{.name = "odometry", .attributes = kOdometry, .children = kInOdometry};

namespace {

constexpr std::array kInOrca{&kDriveRule,     &kTurretRule,  &kGripperRule,      &kBatteryRule,
                             &kSonarRingRule, &kLaserRule,   &kInfraredRingRule, &kBumperRingRule,
                             &kCameraRule,    &kOdometryRule};

}  // namespace

constexpr ElementRule kOrcaRule{.name = "orca", .attributes = kOrca, .children = kInOrca};
constexpr xml::ValueRule kJointType = one_of(kJointTypes);

namespace {

// Declares only the place of <orca>; the other content of <robot> is defined by URDF.
constexpr std::array kInRobot{&kOrcaRule};
constexpr ElementRule kRobotRule{.name = "robot", .children = kInRobot};

constexpr std::array kRobotElements{&kRobotRule,        &kOrcaRule,       &kDriveRule,     &kTurretRule,
                                    &kGripperRule,      &kBatteryRule,    &kSonarRingRule, &kLaserRule,
                                    &kInfraredRingRule, &kBumperRingRule, &kCameraRule,    &kOdometryRule,
                                    &kWheelErrorsRule,  &kRangeErrorsRule};

}  // namespace

constexpr xml::FileRules kRobotFile{"a robot",
                                    kRobotElements,
                                    {.unknown_element = codes::kUnknownElement,
                                     .unknown_attribute = codes::kUnknownAttribute,
                                     .missing_attribute = codes::kMissing,
                                     .stray_text = codes::kStrayText,
                                     .bad_value = codes::kBadValue}};

}  // namespace orca::robot_file
