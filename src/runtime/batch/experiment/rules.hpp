// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/xml/rules.hpp"

/// The codes of what may be wrong with an experiment; docs/comparing.md explains them. A code keeps its meaning for ever.
namespace orca::batch::codes {

inline constexpr const char* kWrongRoot = "E001";
inline constexpr const char* kUnknownElement = "E002";
inline constexpr const char* kUnknownAttribute = "E003";
inline constexpr const char* kMissing = "E004";
inline constexpr const char* kBadValue = "E005";
inline constexpr const char* kStrayText = "E006";
inline constexpr const char* kDuplicateName = "E007";
inline constexpr const char* kNumbers = "E008";
inline constexpr const char* kValueOrFile = "E009";
inline constexpr const char* kNoGraph = "E010";
inline constexpr const char* kTooMany = "E011";
inline constexpr const char* kReferences = "E012";
inline constexpr const char* kGoalPlace = "E013";
inline constexpr const char* kContrast = "E014";
inline constexpr const char* kTuning = "E015";
inline constexpr const char* kFail = "E016";

}  // namespace orca::batch::codes

namespace orca::batch {

extern const xml::ElementRule kContrastRule;
extern const xml::ElementRule kExperimentRule;
extern const xml::ElementRule kSetRule;
extern const xml::ElementRule kFailRule;
extern const xml::ElementRule kGoalRule;
extern const xml::ElementRule kSettingsFileRule;
extern const xml::ElementRule kTuneRule;
extern const xml::ElementRule kTuningRule;
extern const xml::ElementRule kVariantRule;
extern const xml::ElementRule kWorldRule;
extern const xml::ElementRule kWorldsRule;
extern const xml::FileRules kExperimentFile;

}  // namespace orca::batch
