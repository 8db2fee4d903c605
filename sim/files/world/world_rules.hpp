// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/xml/rules.hpp"

// The elements of a world file and their attributes; docs/world-files.md describes them to people, and a test
// compares the two.
namespace orca::sim::detail {

extern const xml::ElementRule kWorldRule;
extern const xml::ElementRule kWallRule;
extern const xml::ElementRule kRoomRule;
extern const xml::ElementRule kBoxRule;
extern const xml::ElementRule kCylinderRule;
extern const xml::ElementRule kPolygonRule;
extern const xml::ElementRule kBitmapRule;
extern const xml::ElementRule kMeshRule;
extern const xml::ElementRule kPlaceRule;
extern const xml::ElementRule kGenerateRule;
extern const xml::ElementRule kWalkerRule;
extern const xml::ElementRule kItemRule;
extern const xml::ElementRule kSillRule;
extern const xml::ElementRule kWetRule;
extern const xml::ElementRule kMoveRule;
extern const xml::ElementRule kKidnapRule;
extern const xml::ElementRule kOutageRule;
extern const xml::ElementRule kDrainRule;
extern const xml::ElementRule kChargerRule;
extern const xml::ElementRule kLeafRule;
extern const xml::ElementRule kOpenRule;
extern const xml::ElementRule kShutRule;

extern const xml::FileRules kWorldFile;

}  // namespace orca::sim::detail
