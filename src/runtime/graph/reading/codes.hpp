// SPDX-License-Identifier: LGPL-3.0-or-later
// The codes of everything that can be wrong with a graph. docs/errors.md explains them; a test compares the
// two. The meaning of a code never changes.
#pragma once

namespace orca::graph::codes {

inline constexpr const char* kWrongRoot = "G001";
inline constexpr const char* kVersion = "G002";
inline constexpr const char* kUnknownElement = "G003";
inline constexpr const char* kMisplacedElement = "G004";
inline constexpr const char* kUnknownAttribute = "G006";
inline constexpr const char* kMissingAttribute = "G007";
inline constexpr const char* kStrayText = "G008";
inline constexpr const char* kBadName = "G009";
inline constexpr const char* kDuplicateName = "G010";
inline constexpr const char* kUndefinedArgument = "G011";
inline constexpr const char* kArgumentWithoutValue = "G012";
inline constexpr const char* kBadDollar = "G013";
inline constexpr const char* kBadSetting = "G014";
inline constexpr const char* kUnknownProfile = "G015";
inline constexpr const char* kUnknownComponent = "G016";
inline constexpr const char* kUnknownPort = "G017";
inline constexpr const char* kBadPort = "G018";
inline constexpr const char* kDirection = "G019";
inline constexpr const char* kPattern = "G020";
inline constexpr const char* kType = "G021";
inline constexpr const char* kLayout = "G022";
inline constexpr const char* kTooManyEdges = "G023";
inline constexpr const char* kDuplicateEdge = "G024";
inline constexpr const char* kUnconnected = "G025";
inline constexpr const char* kPolicy = "G026";
inline constexpr const char* kUnknownType = "G027";
inline constexpr const char* kPlugin = "G028";
inline constexpr const char* kUnknownParameter = "G029";
inline constexpr const char* kBadValue = "G030";
inline constexpr const char* kUnit = "G031";
inline constexpr const char* kRange = "G032";
inline constexpr const char* kChoice = "G033";
inline constexpr const char* kUnknownHardware = "G034";
inline constexpr const char* kHardwareMissing = "G035";
inline constexpr const char* kHardwareNotTaken = "G036";
inline constexpr const char* kCycle = "G037";
inline constexpr const char* kTwoTriggers = "G038";
inline constexpr const char* kTriggerPort = "G039";
inline constexpr const char* kTooManyComponents = "G040";
inline constexpr const char* kUnusedArgument = "G041";
inline constexpr const char* kHardwareRefuses = "G042";
inline constexpr const char* kCannotInclude = "G043";
inline constexpr const char* kIncludeCycle = "G044";
inline constexpr const char* kExpansion = "G045";
inline constexpr const char* kPortDisabled = "G046";
inline constexpr const char* kPortNeeded = "G047";
inline constexpr const char* kPortSetting = "G048";
inline constexpr const char* kNoLateBinding = "G049";
inline constexpr const char* kCandidate = "G050";
inline constexpr const char* kNoInfluence = "G051";
inline constexpr const char* kUnusedHardware = "G052";
inline constexpr const char* kNeverTriggered = "G053";
inline constexpr const char* kOnlyAsks = "G054";
inline constexpr const char* kCircle = "G055";
inline constexpr const char* kNothingToCollect = "G056";
inline constexpr const char* kHardwareDoubts = "G057";
inline constexpr const char* kLoading = "G060";
inline constexpr const char* kUnfit = "G061";
inline constexpr const char* kComponentRefuses = "G062";
inline constexpr const char* kUnknownProcess = "G063";
inline constexpr const char* kUnknownMachine = "G064";
inline constexpr const char* kNoMachine = "G065";
inline constexpr const char* kSplit = "G066";
inline constexpr const char* kLink = "G067";
inline constexpr const char* kNothingRuns = "G068";
inline constexpr const char* kConstraint = "G069";
inline constexpr const char* kUnknownProperty = "G070";
inline constexpr const char* kNothingFits = "G071";
inline constexpr const char* kTrade = "G072";
inline constexpr const char* kGroup = "G073";
inline constexpr const char* kChange = "G074";
inline constexpr const char* kRight = "G075";
inline constexpr const char* kTopic = "G076";
inline constexpr const char* kSecured = "G077";
inline constexpr const char* kTeam = "G078";

}  // namespace orca::graph::codes
