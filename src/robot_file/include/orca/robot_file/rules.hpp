// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/xml/rules.hpp"

// Orca's own elements in a robot file, <orca> and what it holds, and their attributes; docs/robot-files.md
// describes them to people, and a test compares the two. The elements of URDF itself are not declared: other
// programs may add to them.
namespace orca::robot_file {

extern const xml::ElementRule kOrcaRule;
extern const xml::ElementRule kDriveRule;
extern const xml::ElementRule kTurretRule;
extern const xml::ElementRule kGripperRule;
extern const xml::ElementRule kBatteryRule;
extern const xml::ElementRule kSonarRingRule;
extern const xml::ElementRule kLaserRule;
extern const xml::ElementRule kInfraredRingRule;
extern const xml::ElementRule kBumperRingRule;
extern const xml::ElementRule kCameraRule;
extern const xml::ElementRule kOdometryRule;
extern const xml::ElementRule kWheelErrorsRule;
extern const xml::ElementRule kRangeErrorsRule;

// The types that a URDF joint may have.
extern const xml::ValueRule kJointType;

extern const xml::FileRules kRobotFile;

}  // namespace orca::robot_file
