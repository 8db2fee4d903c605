// SPDX-License-Identifier: LGPL-3.0-or-later
// The codes of everything that can be wrong with a robot. docs/errors-of-worlds.md explains them to people; a test
// compares the two. A code keeps its meaning for ever.
#pragma once

namespace orca::robot_file::codes {

inline constexpr const char* kWrongRoot = "R001";
inline constexpr const char* kUnknownElement = "R002";
inline constexpr const char* kUnknownAttribute = "R003";
inline constexpr const char* kMissing = "R004";
inline constexpr const char* kBadValue = "R005";
inline constexpr const char* kStrayText = "R006";
inline constexpr const char* kDuplicate = "R010";
inline constexpr const char* kLinkCount = "R011";
inline constexpr const char* kUnknownName = "R012";
inline constexpr const char* kTwoParents = "R013";
inline constexpr const char* kSeveralRoots = "R014";
inline constexpr const char* kLoop = "R015";
inline constexpr const char* kZeroAxis = "R016";
inline constexpr const char* kLimitsExchanged = "R017";
inline constexpr const char* kMass = "R018";
inline constexpr const char* kInertia = "R019";
inline constexpr const char* kSize = "R020";
inline constexpr const char* kUnreadableMesh = "R021";
inline constexpr const char* kContradiction = "R022";
inline constexpr const char* kBumperRadius = "R023";
inline constexpr const char* kUrdfdom = "R024";
inline constexpr const char* kXacro = "R025";
inline constexpr const char* kDoubtfulInertia = "R026";
inline constexpr const char* kBelowFloor = "R027";
inline constexpr const char* kOtherMesh = "R028";
inline constexpr const char* kUsualFigures = "R029";
inline constexpr const char* kDegrees = "R030";

}  // namespace orca::robot_file::codes
