// SPDX-License-Identifier: LGPL-3.0-or-later
// The codes of everything that can be wrong with a world. docs/errors-of-worlds.md explains them to people; a test
// compares the two. A code keeps its meaning for ever.
#pragma once

namespace orca::sim::detail::world_codes {

inline constexpr const char* kWrongRoot = "W001";
inline constexpr const char* kUnknownElement = "W002";
inline constexpr const char* kUnknownAttribute = "W003";
inline constexpr const char* kMissing = "W004";
inline constexpr const char* kBadValue = "W005";
inline constexpr const char* kStrayText = "W006";
inline constexpr const char* kDuplicateName = "W007";
inline constexpr const char* kBadWall = "W008";
inline constexpr const char* kBadPolygon = "W009";
inline constexpr const char* kVersion = "W010";
inline constexpr const char* kUnreadable = "W011";
inline constexpr const char* kPlaceInObstacle = "W012";
inline constexpr const char* kScaleWithoutPicture = "W013";
inline constexpr const char* kTooMany = "W014";
inline constexpr const char* kTwoScales = "W015";
inline constexpr const char* kBadRow = "W016";
inline constexpr const char* kNumber = "W017";
inline constexpr const char* kCannotGenerate = "W018";
inline constexpr const char* kBadWalker = "W019";
inline constexpr const char* kUnreadableMesh = "W021";
inline constexpr const char* kBottomAboveTop = "W022";
inline constexpr const char* kScaleOfPicture = "W023";
inline constexpr const char* kBadEvent = "W024";
inline constexpr const char* kBadItem = "W025";
inline constexpr const char* kOtherFormat = "W026";
inline constexpr const char* kLightGrey = "W027";
inline constexpr const char* kNoSuchPlace = "W028";
inline constexpr const char* kBadBase = "W029";
inline constexpr const char* kBadDoor = "W030";

}  // namespace orca::sim::detail::world_codes
