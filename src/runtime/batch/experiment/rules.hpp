// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/xml/rules.hpp"

namespace orca::batch {

extern const xml::ElementRule kExperimentRule;
extern const xml::ElementRule kSetRule;
extern const xml::ElementRule kVariantRule;
extern const xml::ElementRule kWorldRule;
extern const xml::ElementRule kWorldsRule;
extern const xml::FileRules kExperimentFile;

}  // namespace orca::batch
